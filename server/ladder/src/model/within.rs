use source::Span;

/// A place in a rung, in bytes from the rung's origin.
///
/// Text above a rung moves the rung and nothing in it; so the network of a
/// rung stays what it is while somebody types elsewhere. Where the place is in
/// the file, only the rung can tell: [`Rung::place`](super::Rung::place).
///
/// While a network is being built its places still count from the start of the
/// file; [`NetworkBuilder::finish`](super::NetworkBuilder::finish) moves them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Within(Span);

impl Within {
    /// A place of a network that is being built.
    pub(super) fn in_file(span: Span) -> Self {
        Self(span)
    }

    /// The place in the file of something whose network is being built.
    pub(crate) fn while_building(self) -> Span {
        self.0
    }

    /// The first byte, counted from the origin.
    pub(super) fn start(self) -> u32 {
        self.0.start
    }

    /// The place in the file if places count from the byte `origin` of it.
    pub(super) fn from(self, origin: u32) -> Span {
        Span {
            start: self.0.start.saturating_add(origin),
            end: self.0.end.saturating_add(origin),
        }
    }

    /// The place of a finished network that begins at `origin`, which is not
    /// behind it.
    pub(super) fn counted_from(self, origin: u32) -> Self {
        Self(Span {
            start: self.0.start.saturating_sub(origin),
            end: self.0.end.saturating_sub(origin),
        })
    }
}
