//! The boxes of rung notation.

use super::{Completion, call};

/// A box: its name, its operands, and what it does.
type Box = (&'static str, &'static [&'static str], &'static str);

/// The boxes that rung notation knows by name.
pub(crate) const BOXES: [Box; 9] = [
    (
        "TON",
        &["timer", "5s"],
        "on-delay timer: its output is on once power has lasted for the time",
    ),
    (
        "TOF",
        &["timer", "5s"],
        "off-delay timer: its output stays on for the time after power",
    ),
    (
        "TP",
        &["timer", "5s"],
        "pulse timer: a rise of power starts its output for the time",
    ),
    (
        "RTO",
        &["timer", "5s"],
        "retentive timer: adds up the time under power until it is reset",
    ),
    (
        "CTU",
        &["counter", "10"],
        "counts rises of power upwards, to the preset",
    ),
    (
        "CTD",
        &["counter", "10"],
        "counts rises of power downwards, from the preset",
    ),
    (
        "CTC",
        &["counter", "10"],
        "counts rises of power round and round, to the preset",
    ),
    ("RES", &["timer or counter"], "resets a timer or counter"),
    ("MCR", &[], "begins or ends a zone under master control"),
];

pub(super) fn boxes() -> impl Iterator<Item = Completion> {
    BOXES
        .iter()
        .map(|(name, operands, summary)| match operands.is_empty() {
            true => call(name, operands, summary).insert(format!("{name}()")),
            false => call(name, operands, summary),
        })
}

#[cfg(test)]
mod tests {
    use super::BOXES;

    #[test]
    fn every_box_is_one_that_the_reader_knows() {
        for (name, operands, _) in BOXES {
            let handed: Vec<&str> = operands
                .iter()
                .map(|it| match it.starts_with(|c: char| c.is_ascii_digit()) {
                    true => it,
                    false => "x",
                })
                .collect();
            let text = format!("rung: a -> {name}({})", handed.join(", "));
            assert_eq!(::ladder::read(text.as_bytes()).diagnostics, [], "{text}");
        }
    }
}
