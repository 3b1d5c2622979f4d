//! Which line ends a text has.

use super::piece::Piece;

/// A line end.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum LineEnd {
    /// `\n`
    Lf,
    /// `\r\n`
    CrLf,
}

impl LineEnd {
    pub(super) fn text(self) -> &'static str {
        match self {
            Self::Lf => "\n",
            Self::CrLf => "\r\n",
        }
    }

    /// The line end that most lines of `text` have. Those inside statements
    /// that are left as they are count only if there are no others: else a
    /// second layout, after blank lines have gone, might count differently.
    pub(super) fn prevailing(text: &str, pieces: &[Piece]) -> Self {
        let (mut crlf, mut lf) = count(text);
        let (all_crlf, all_lf) = (crlf, lf);
        for piece in pieces {
            if let Piece::Left { text, .. } = piece {
                let (inner_crlf, inner_lf) = count(text);
                crlf -= inner_crlf;
                lf -= inner_lf;
            }
        }
        if crlf + lf == 0 {
            (crlf, lf) = (all_crlf, all_lf);
        }
        if crlf > lf { Self::CrLf } else { Self::Lf }
    }
}

/// Numbers of CRLF and of lone LF.
fn count(text: &str) -> (usize, usize) {
    let crlf = text.matches("\r\n").count();
    (crlf, text.matches('\n').count() - crlf)
}
