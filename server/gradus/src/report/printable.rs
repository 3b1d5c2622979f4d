//! Text from files that is safe to show on a terminal.
//!
//! Sources and file names can hold characters that a terminal obeys: escape
//! sequences that erase what was written, marks that reverse the order of
//! reading. Each is shown as a visible stand-in of its own.

/// `text` without characters that a terminal would obey.
pub fn printable(text: &str) -> String {
    text.chars().map(stand_in).collect()
}

/// The character that shows `character`: itself if it is harmless.
pub fn stand_in(character: char) -> char {
    match character {
        // The pictures of control characters stand in their order at U+2400.
        '\0'..='\x1f' => char::from_u32(0x2400 + u32::from(character)).unwrap_or('\u{fffd}'),
        '\x7f' => '\u{2421}',
        '\u{80}'..='\u{9f}' => '\u{fffd}',
        // Line and paragraph separators; embeddings, overrides and isolates.
        '\u{2028}'..='\u{202e}' | '\u{2066}'..='\u{2069}' => '\u{fffd}',
        _ => character,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn control_characters_become_visible() {
        assert_eq!(printable("a\x1b[2Jb\n"), "a␛[2Jb␊");
        assert_eq!(printable("Förder\u{202e}band"), "Förder\u{fffd}band");
    }
}
