//! What the readers of XML formats share beside the pull reader itself.

mod attributes;

pub(crate) use attributes::{Attribute, attributes, repeated};

/// Bytes of the prefix that a qualified name begins with, its colon included.
pub(crate) fn prefix_length(name: &str) -> usize {
    // Nearly all names have none and are letters, which come after the colon.
    if name.bytes().all(|byte| byte > b':') {
        return 0;
    }
    name.rfind(':').map_or(0, |colon| colon + 1)
}
