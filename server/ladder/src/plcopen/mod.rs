//! PLCopen TC6 XML.

use crate::reading::{Reading, Source};

pub(crate) fn read(_source: Source<'_>) -> Reading {
    todo!()
}
