use std::sync::Arc;

use quick_xml::Reader;
use quick_xml::events::Event;
use source::{Diagnostic, Span, codes};

use crate::text::Traces;
use crate::{Format, Program, ascii, plcopen, rockwell, text};

/// What reading a file gives: always a program, and what there is to say.
#[derive(Clone, Debug, PartialEq)]
pub struct Reading {
    /// The program, holding all that could be understood.
    pub program: Arc<Program>,
    /// Findings about the text, in the order of their places.
    pub diagnostics: Vec<Diagnostic>,
}

impl Reading {
    /// A reading that understood nothing, and says why.
    pub(crate) fn nothing(diagnostic: Diagnostic) -> Self {
        Self {
            program: Program::empty(Format::Unknown).into(),
            diagnostics: vec![diagnostic],
        }
    }

    /// Brings the findings in order.
    pub(crate) fn sort(&mut self) {
        self.diagnostics
            .sort_by_key(|diagnostic| (diagnostic.span, diagnostic.code));
    }
}

/// A text to read and the place of its first byte in the file, which is 3
/// after a byte order mark.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Source<'t> {
    pub(crate) text: &'t str,
    pub(crate) base: usize,
}

impl Source<'_> {
    /// The place in the file of bytes `start..end` of the text.
    pub(crate) fn span(&self, start: usize, end: usize) -> Span {
        Span::new(self.base + start, self.base + end)
    }
}

/// Reads a ladder program of any known form. What the bytes hold decides
/// which, never the name of the file.
pub fn read(bytes: &[u8]) -> Reading {
    match decode(bytes) {
        Ok(source) => read_source(source).0,
        Err(diagnostic) => Reading::nothing(*diagnostic),
    }
}

/// Reads a text, and takes down how if it is a `.ladder`.
pub(crate) fn read_source(source: Source<'_>) -> (Reading, Option<Traces>) {
    let mut traces = None;
    let mut reading = match detect(source.text) {
        Some(Format::L5x) => rockwell::read_l5x(source),
        Some(Format::L5k) => rockwell::read_l5k(source),
        Some(Format::NeutralText) => rockwell::read_neutral_text(source),
        Some(Format::Plcopen) => plcopen::read(source),
        Some(Format::Ascii) => ascii::read(source),
        Some(Format::Ladder) => {
            let (reading, taken) = text::read(source);
            traces = Some(taken);
            reading
        }
        _ => Reading::nothing(not_a_program(source)),
    };
    reading.sort();
    (reading, traces)
}

/// The text of `bytes`, which must be UTF-8.
pub(crate) fn decode(bytes: &[u8]) -> Result<Source<'_>, Box<Diagnostic>> {
    let refuse = |at: usize, what: &str| {
        let diagnostic = Diagnostic::new(codes::ENCODING, Span::at(at), what)
            .help("save the file as UTF-8 and try again");
        Err(Box::new(diagnostic))
    };
    if bytes.len() > u32::MAX as usize {
        return Err(Box::new(Diagnostic::new(
            codes::TOO_LARGE_FILE,
            Span::at(0),
            "the file is larger than 4 GiB",
        )));
    }
    if bytes.starts_with(b"\xFF\xFE") || bytes.starts_with(b"\xFE\xFF") {
        return refuse(0, "the file is UTF-16, and only UTF-8 is read");
    }
    if let Some(at) = memchr::memchr(0, bytes) {
        if is_utf16(bytes) {
            return refuse(
                0,
                "the file is UTF-16 without a byte order mark, and only UTF-8 is read",
            );
        }
        return refuse(
            at,
            "the file holds a NUL byte, so it is binary or not UTF-8",
        );
    }
    let base = if bytes.starts_with(b"\xEF\xBB\xBF") {
        3
    } else {
        0
    };
    match std::str::from_utf8(&bytes[base..]) {
        Ok(text) => Ok(Source { text, base }),
        Err(error) => refuse(
            base + error.valid_up_to(),
            "the bytes from here on are not valid UTF-8",
        ),
    }
}

/// Whether each of the first characters is an ASCII one in two bytes.
fn is_utf16(bytes: &[u8]) -> bool {
    let mut pairs = bytes.chunks_exact(2).take(32).peekable();
    let is_little_endian = pairs.peek().is_some_and(|pair| pair[1] == 0);
    pairs.peek().is_some()
        && pairs.all(|pair| (pair[1] == 0, pair[0] == 0) == (is_little_endian, !is_little_endian))
}

/// The form that `text` is in, if it is one that is known.
pub(crate) fn detect(text: &str) -> Option<Format> {
    let start = text.trim_start();
    if start.starts_with("version https://git-lfs.github.com/spec/") {
        return None;
    }
    if start.starts_with('<') {
        return match root(start)?.as_str() {
            "RSLogix5000Content" => Some(Format::L5x),
            "project" | "pou" | "pous" => Some(Format::Plcopen),
            _ => None,
        };
    }
    if rockwell::looks_like_l5k(start) {
        Some(Format::L5k)
    } else if rockwell::looks_like_neutral_text(start) {
        Some(Format::NeutralText)
    } else if ascii::looks_like_it(start) {
        Some(Format::Ascii)
    } else if text::looks_like_it(start) {
        Some(Format::Ladder)
    } else {
        None
    }
}

/// The local name of an XML text's first element.
fn root(text: &str) -> Option<String> {
    let mut reader = Reader::from_str(text);
    loop {
        match reader.read_event().ok()? {
            Event::Start(tag) | Event::Empty(tag) => {
                return Some(tag.local_name().into_inner().to_owned());
            }
            Event::Eof => return None,
            _ => {}
        }
    }
}

fn not_a_program(source: Source<'_>) -> Diagnostic {
    let first_line = source.text.lines().next().unwrap_or_default();
    let span = source.span(0, first_line.len());
    if source
        .text
        .trim_start()
        .starts_with("version https://git-lfs")
    {
        return Diagnostic::new(
            codes::STORED_ELSEWHERE,
            span,
            "this is a Git LFS pointer; the program itself is stored elsewhere",
        )
        .help("fetch it with `git lfs pull`");
    }
    let message = if source.text.trim().is_empty() {
        "the file is empty"
    } else {
        "this is none of the ladder forms that Gradus reads"
    };
    Diagnostic::new(codes::NOT_A_PROGRAM, span, message)
        .help("give a .ladder text, Rockwell L5X, L5K or neutral text, or PLCopen XML")
}
