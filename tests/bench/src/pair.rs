//! Two rungs that share all their variables.

use std::fmt::Write;

/// A program of two rungs, each a series of branches over the same even number
/// of `variables` contacts, some of them closed, with a seal-in.
///
/// What ends the one and what starts the other share every variable, the worst
/// case of a rule that tries each assignment of the shared ones. The pairing
/// of contacts differs between the rungs, so that neither is a copy of the
/// other.
pub fn pair(variables: usize) -> String {
    let mut text = String::new();
    for (coil, offset) in [("p", 0), ("f", 1)] {
        let mut rung = format!("rung: ({coil} + x{offset} + x{})", offset + 1);
        for branch in 1..variables / 2 {
            let sign = if branch % 2 == offset { "/" } else { "" };
            let first = (2 * branch + offset) % variables;
            let second = (2 * branch + 1 + offset) % variables;
            let _ = write!(rung, " * ({sign}x{first} + x{second})");
        }
        let _ = writeln!(text, "{rung} -> {coil}");
    }
    text
}

#[cfg(test)]
mod tests {
    use recovery::conditions::conditions;

    #[test]
    fn both_rungs_depend_on_every_variable() {
        for variables in [8, 12, 16, 20] {
            let text = super::pair(variables);
            let reading = ladder::read(text.as_bytes());
            assert_eq!(reading.diagnostics, [], "{text}");
            let conditions = conditions(&reading.program, &logic::Budget::default());
            for coil in ["p", "f"] {
                let next = &conditions.find(coil).expect("a coil").next;
                let support = next.as_ref().expect("a small function").support().len();
                assert_eq!(support, variables + 1, "{text}");
            }
        }
    }
}
