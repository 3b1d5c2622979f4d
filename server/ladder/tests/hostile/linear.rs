//! Twice the text takes at most twice the work, counted in bytes and blocks
//! that reading asks memory for, and in what it gives.

use ladder::Reading;

use crate::forms::FORMS;

/// What reading a text cost and gave.
#[derive(Debug)]
struct Work {
    length: usize,
    blocks: u64,
    bytes: u64,
    most_bytes: u64,
    elements: usize,
    findings: usize,
}

fn work(text: &str) -> Work {
    let mut reading: Option<Reading> = None;
    let counted = allocation_counter::measure(|| {
        reading = Some(ladder::read(text.as_bytes()));
    });
    let reading = reading.expect("a reading");
    let rungs = reading.program.rungs();
    Work {
        length: text.len(),
        blocks: counted.count_total,
        bytes: counted.bytes_total,
        most_bytes: counted.bytes_max,
        elements: rungs
            .map(|(_, rung)| rung.network.len() + rung.network.graph().edge_count())
            .sum(),
        findings: reading.diagnostics.len(),
    }
}

/// Twice as much, and a little for what does not depend on the length: a table
/// that grows does so by doubling.
fn is_linear(once: u64, twice: u64) -> bool {
    twice <= once * 22 / 10 + 200_000
}

#[test]
fn twice_the_text_takes_twice_the_work() {
    for form in FORMS {
        let (once, twice) = (work(&(form.text)(800)), work(&(form.text)(1_600)));
        let pairs = [
            (once.blocks, twice.blocks),
            (once.bytes, twice.bytes),
            (once.most_bytes, twice.most_bytes),
        ];
        assert!(
            pairs
                .into_iter()
                .all(|(once, twice)| is_linear(once, twice)),
            "{}: {once:?}, {twice:?}",
            form.name
        );
        assert!(
            twice.elements <= twice.length && twice.findings <= twice.length,
            "{}: {twice:?}",
            form.name
        );
    }
}

/// Most bytes held at once for each byte of a text that repeats one character.
/// The most is taken where each is a rung or a fault with a finding of its own,
/// and by tabs in drawings, each of which stands for eight columns.
const MOST_PER_BYTE: u64 = 1_000;

#[test]
fn no_character_repeated_takes_memory_out_of_proportion() {
    const LENGTH: usize = 5_000;
    let characters = "\t \r\n()[]{}<>|+-*/\\\"'$&;:,.%#=@^!?~_aA0é\u{feff}";
    for first in characters.chars() {
        for begin in [
            "",
            "rung: a -> b\nrung: ",
            "|--[ ]--( )\n|",
            "XIC(a)OTE(b);",
        ] {
            let text = begin.to_owned() + &first.to_string().repeat(LENGTH);
            let work = work(&text);
            assert!(
                work.most_bytes <= MOST_PER_BYTE * LENGTH as u64,
                "{begin:?} {first:?}: {work:?}"
            );
        }
    }
}
