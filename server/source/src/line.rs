/// A position as people count it, both from 1. The column counts characters
/// (Unicode scalar values), not bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct LineColumn {
    /// Line, from 1.
    pub line: usize,
    /// Column in characters, from 1.
    pub column: usize,
}

/// Finds the line of a byte offset in logarithmic time.
///
/// A line ends at `\n`, `\r\n` or a lone `\r`. A byte order mark at the start
/// takes no column.
#[derive(Clone, Debug)]
pub struct LineIndex {
    starts: Vec<usize>,
    /// Characters before every [`BLOCK`]: exports put a whole program on one
    /// line, and counting from its start for every finding would be quadratic.
    characters: Vec<usize>,
}

const BLOCK: usize = 1024;

const BYTE_ORDER_MARK: &[u8] = b"\xEF\xBB\xBF";

impl LineIndex {
    /// Scans `text` once for its line ends.
    pub fn new(text: &[u8]) -> Self {
        let first = if text.starts_with(BYTE_ORDER_MARK) {
            BYTE_ORDER_MARK.len()
        } else {
            0
        };
        let mut starts = vec![first];
        for (at, byte) in text.iter().enumerate() {
            let ends_line = match byte {
                b'\n' => true,
                b'\r' => text.get(at + 1) != Some(&b'\n'),
                _ => false,
            };
            if ends_line {
                starts.push(at + 1);
            }
        }
        let mut total = 0;
        let mut characters = vec![0];
        for block in text.chunks(BLOCK) {
            total += count(block);
            characters.push(total);
        }
        Self { starts, characters }
    }

    /// Line and column of the byte at `offset` in `text`, the text that the
    /// index was made of. An offset past the end gives the end.
    pub fn locate(&self, text: &[u8], offset: usize) -> LineColumn {
        let offset = offset.min(text.len());
        let line = self.starts.partition_point(|&start| start <= offset).max(1);
        let start = self.starts[line - 1].min(offset);
        LineColumn {
            line,
            column: self.before(text, offset) - self.before(text, start) + 1,
        }
    }

    /// Number of characters before the byte at `offset`.
    fn before(&self, text: &[u8], offset: usize) -> usize {
        let block = offset / BLOCK;
        let counted = self.characters.get(block).copied().unwrap_or_default();
        counted + count(&text[block * BLOCK..offset])
    }
}

/// Number of characters that begin in `bytes`.
fn count(bytes: &[u8]) -> usize {
    bytes.iter().filter(|&&byte| byte & 0xC0 != 0x80).count()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn locate(text: &str, offset: usize) -> (usize, usize) {
        let found = LineIndex::new(text.as_bytes()).locate(text.as_bytes(), offset);
        (found.line, found.column)
    }

    #[test]
    fn lines_end_at_any_of_the_three_line_ends() {
        assert_eq!(locate("a\nb\r\nc\rd", 2), (2, 1));
        assert_eq!(locate("a\nb\r\nc\rd", 5), (3, 1));
        assert_eq!(locate("a\nb\r\nc\rd", 7), (4, 1));
    }

    #[test]
    fn columns_count_characters_and_no_byte_order_mark() {
        assert_eq!(locate("\u{feff}äb", 3), (1, 1));
        assert_eq!(locate("\u{feff}äb", 5), (1, 2));
        assert_eq!(locate("", 9), (1, 1));
    }

    #[test]
    fn columns_are_right_far_into_a_long_line() {
        let line = "ä".repeat(5_000);
        for column in [0, 511, 512, 513, 4_999, 5_000] {
            assert_eq!(locate(&line, 2 * column), (1, column + 1));
        }
    }
}
