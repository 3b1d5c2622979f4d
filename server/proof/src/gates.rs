use crate::Signal;

/// Whatever can build an and-gate can build every other.
///
/// `and` folds constants and finds gates that are there already, so all that
/// is built from it does.
pub trait Gates {
    /// `a * b`
    fn and(&mut self, a: Signal, b: Signal) -> Signal;

    /// `a + b`
    fn or(&mut self, a: Signal, b: Signal) -> Signal {
        !self.and(!a, !b)
    }

    /// 1 where exactly one of the two is.
    fn xor(&mut self, a: Signal, b: Signal) -> Signal {
        let only_a = self.and(a, !b);
        let only_b = self.and(!a, b);
        self.or(only_a, only_b)
    }

    /// 1 where both are the same.
    fn equal(&mut self, a: Signal, b: Signal) -> Signal {
        !self.xor(a, b)
    }

    /// 1 unless `a` holds and `b` does not.
    fn implies(&mut self, a: Signal, b: Signal) -> Signal {
        !self.and(a, !b)
    }

    /// `then` where `condition` holds, else `otherwise`.
    fn ite(&mut self, condition: Signal, then: Signal, otherwise: Signal) -> Signal {
        if then == otherwise {
            return then;
        }
        let yes = self.and(condition, then);
        let no = self.and(!condition, otherwise);
        self.or(yes, no)
    }

    /// 1 where all are; 1 if there are none. A balanced tree, so that its
    /// depth grows with the logarithm of their number.
    fn all(&mut self, signals: &[Signal]) -> Signal {
        let mut layer = signals.to_vec();
        while layer.len() > 1 {
            layer = layer
                .chunks(2)
                .map(|pair| match *pair {
                    [a, b] => self.and(a, b),
                    _ => pair[0],
                })
                .collect();
        }
        layer.first().copied().unwrap_or(Signal::TRUE)
    }

    /// 1 where any is; 0 if there are none.
    fn any(&mut self, signals: &[Signal]) -> Signal {
        let complements: Vec<Signal> = signals.iter().map(|&signal| !signal).collect();
        !self.all(&complements)
    }
}
