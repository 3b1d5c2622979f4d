use std::fmt;
use std::ops::Not;

/// A wire of a netlist: what a constant, an input, a latch or a gate gives, or
/// the complement of it.
///
/// A complement costs nothing: it is one bit of the signal. Signals belong to
/// the netlist that made them; in another one they mean something else.
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Signal(u32);

impl Signal {
    /// Always 0.
    pub const FALSE: Self = Self(0);
    /// Always 1.
    pub const TRUE: Self = Self(1);

    /// The constant `value`.
    pub const fn constant(value: bool) -> Self {
        if value { Self::TRUE } else { Self::FALSE }
    }

    /// The node's own signal, or its complement.
    pub(crate) const fn new(node: usize, complement: bool) -> Self {
        Self((node as u32) << 1 | complement as u32)
    }

    /// The node that the signal comes from.
    pub(crate) const fn node(self) -> usize {
        (self.0 >> 1) as usize
    }

    /// Whether it is the complement of what its node gives.
    pub(crate) const fn is_complement(self) -> bool {
        self.0 & 1 == 1
    }

    /// The signal, complemented if `complement` is set.
    #[must_use]
    pub(crate) const fn flipped(self, complement: bool) -> Self {
        Self(self.0 ^ complement as u32)
    }
}

impl Not for Signal {
    type Output = Self;

    fn not(self) -> Self {
        self.flipped(true)
    }
}

impl fmt::Debug for Signal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let sign = if self.is_complement() { "/" } else { "" };
        match *self {
            Self::FALSE => f.write_str("0"),
            Self::TRUE => f.write_str("1"),
            _ => write!(f, "{sign}n{}", self.node()),
        }
    }
}
