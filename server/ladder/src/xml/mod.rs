//! What the readers of XML formats share beside the pull reader itself.

mod attributes;

pub(crate) use attributes::{Attribute, attributes};
