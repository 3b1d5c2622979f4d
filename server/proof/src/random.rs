/// Numbers without a pattern that the engines could fall for, the same on
/// every run: SplitMix64 (Steele, Lea, Flood: Fast splittable pseudorandom
/// number generators, OOPSLA 2014), whose whole state is one number.
#[derive(Clone, Debug)]
pub(crate) struct Random(u64);

impl Random {
    pub fn new(seed: u64) -> Self {
        Self(seed)
    }

    /// 64 bits, each 1 half of the time.
    pub fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        mixed(self.0)
    }

    /// 64 bits, each 1 once in `2^halvings`. Three halvings share a draw, each
    /// with other bits of it.
    pub fn rare(&mut self, halvings: u32) -> u64 {
        let mut rare = u64::MAX;
        let mut draw = 0;
        for halving in 0..halvings {
            draw = match halving % 3 {
                0 => self.bits(),
                _ => draw.rotate_left(21),
            };
            rare &= draw;
        }
        rare
    }
}

/// A number in which each bit depends on every bit of `value`.
pub(crate) fn mixed(value: u64) -> u64 {
    let value = (value ^ value >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let value = (value ^ value >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
    value ^ value >> 31
}
