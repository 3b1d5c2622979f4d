//! Ladders in other encodings than UTF-8, and bytes that are no text.

use crate::{gives, read};

const TEXTS: [&str; 4] = [
    "<RSLogix5000Content/>",
    "<?xml version=\"1.0\"?><project/>",
    "XIC(a)OTE(b);",
    "rung: a -> b\n",
];

#[test]
fn utf_16_is_named_with_and_without_its_mark() {
    for text in TEXTS {
        let little: Vec<u8> = text.encode_utf16().flat_map(u16::to_le_bytes).collect();
        let big: Vec<u8> = text.encode_utf16().flat_map(u16::to_be_bytes).collect();
        for bytes in [
            [b"\xFF\xFE", &little[..]].concat(),
            [b"\xFE\xFF", &big[..]].concat(),
            little,
            big,
        ] {
            let reading = read(&bytes);
            assert!(gives(&reading, "G1003"), "{text}");
            let only = &reading.diagnostics[0];
            assert!(only.message.contains("UTF-16"), "{only:?}");
            assert!(only.help.is_some(), "{only:?}");
        }
    }
}

#[test]
fn a_byte_that_is_no_text_is_named_at_its_place() {
    for text in TEXTS {
        for (byte, message) in [
            (0, "NUL"),
            (0xFF, "not valid UTF-8"),
            (0x80, "not valid UTF-8"),
        ] {
            let mut bytes = text.as_bytes().to_vec();
            let at = text.len() / 2;
            bytes.insert(at, byte);
            let reading = read(&bytes);
            assert!(gives(&reading, "G1003"), "{text}");
            let only = &reading.diagnostics[0];
            assert_eq!(only.span.range().start, at, "{text}");
            assert!(only.message.contains(message), "{only:?}");
        }
    }
}

#[test]
fn a_mark_of_utf_8_moves_every_place_and_changes_nothing_else() {
    for text in [
        "XIC(a)OTE(b);XIC(;",
        "rung: a -> b\nrung: c -> (\n",
        "<project><a></b></project>",
    ] {
        let plain = read(text.as_bytes());
        let marked = read(format!("\u{feff}{text}").as_bytes());
        let moved = |by: usize, reading: &ladder::Reading| -> Vec<_> {
            let findings = reading.diagnostics.iter();
            findings
                .map(|it| (it.code, it.span.range().start + by))
                .collect()
        };
        assert!(!plain.diagnostics.is_empty(), "{text}");
        assert_eq!(moved(3, &plain), moved(0, &marked), "{text}");
    }
}
