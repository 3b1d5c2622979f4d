use std::ops::Range;

/// A place in a source text: the bytes from `start` up to, not including,
/// `end`.
///
/// Offsets count bytes of the file as it lies on disk, a byte order mark
/// included, so that an offset found by a reader can be given to an editor
/// without knowing the format. A `u32` holds 4 GiB, far beyond any program.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Span {
    /// First byte.
    pub start: u32,
    /// One past the last byte.
    pub end: u32,
}

impl Span {
    /// The span from `start` to `end`, both byte offsets. An `end` before
    /// `start` gives the empty span at `start`.
    pub fn new(start: usize, end: usize) -> Self {
        let start = clamp(start);
        Self {
            start,
            end: clamp(end).max(start),
        }
    }

    /// The empty span at `offset`.
    pub fn at(offset: usize) -> Self {
        Self::new(offset, offset)
    }

    /// The smallest span that holds both.
    pub fn cover(self, other: Self) -> Self {
        Self {
            start: self.start.min(other.start),
            end: self.end.max(other.end),
        }
    }

    /// Whether the byte at `offset`, or the caret just after the last byte,
    /// lies in the span.
    pub fn touches(self, offset: usize) -> bool {
        let offset = clamp(offset);
        self.start <= offset && offset <= self.end
    }

    /// Number of bytes.
    pub fn len(self) -> usize {
        (self.end - self.start) as usize
    }

    /// Whether the span holds no byte.
    pub fn is_empty(self) -> bool {
        self.start == self.end
    }

    /// The span as a range for slicing.
    pub fn range(self) -> Range<usize> {
        self.start as usize..self.end as usize
    }
}

/// Offsets past `u32::MAX` collapse onto it: no reader accepts such a file.
fn clamp(offset: usize) -> u32 {
    u32::try_from(offset).unwrap_or(u32::MAX)
}
