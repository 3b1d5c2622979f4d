//! Measures the language server as an editor meets it: through its streams.
//!
//! `cargo build --release -p gradus && cargo run --release -p gradus-bench --bin gradus-bench-editor`
//! prints the tables that `docs/benchmarks.md` explains. The environment's
//! `GRADUS` names another executable to measure.

use std::env;
use std::fs;
use std::io::Write as _;
use std::path::PathBuf;
use std::time::{Duration, Instant};

use bench::plant::plant;
use end_to_end::lsp::{Client, Profile};
use tower_lsp::ls_types::request::{CodeActionRequest, HoverRequest};
use tower_lsp::ls_types::{
    CodeActionContext, CodeActionParams, HoverParams, Position, Range, TextDocumentIdentifier,
};

/// Rungs of the programs that are edited.
const SIZES: [usize; 3] = [500, 5_000, 13_000];

/// How often each thing is done.
const ROUNDS: usize = 40;

/// Edits that follow each other without waiting.
const BURST: usize = 50;

/// Edits after which memory is compared.
const EDITS: usize = 10_000;

fn main() -> std::io::Result<()> {
    let executable = executable();
    let mut out = std::io::stdout();
    writeln!(
        out,
        "| program | what | p50 | p95 | p99 |\n|---|---|---|---|---|"
    )?;
    for size in SIZES {
        let session = Session::open(&executable, "plant.ladder", &plant(size));
        for (what, times) in session.measured() {
            writeln!(out, "| {size} rungs | {what} | {} |", percentiles(times))?;
        }
    }
    if let Some((name, text)) = largest() {
        let session = Session::open(&executable, "plant.L5X", &text);
        for (what, times) in session.measured() {
            writeln!(out, "| `{name}` | {what} | {} |", percentiles(times))?;
        }
    }
    writeln!(out, "\n| memory | |\n|---|---|")?;
    for (what, said) in memory(&executable) {
        writeln!(out, "| {what} | {said} |")?;
    }
    Ok(())
}

/// The server: the one that is named, else the one built beside this program.
fn executable() -> String {
    let beside = || -> Option<PathBuf> {
        let own = env::current_exe().ok()?;
        Some(
            own.parent()?
                .join(format!("gradus{}", env::consts::EXE_SUFFIX)),
        )
    };
    let named = env::var_os("GRADUS").map(PathBuf::from);
    let path = named.or_else(beside).unwrap_or_else(|| "gradus".into());
    path.to_string_lossy().into_owned()
}

/// The largest L5X of the real files, with its name.
fn largest() -> Option<(String, String)> {
    let folder = end_to_end::corpus()?.join("l5x");
    let files = fs::read_dir(folder).ok()?.flatten();
    let largest = files.max_by_key(|it| it.metadata().map_or(0, |it| it.len()))?;
    let text = fs::read_to_string(largest.path()).ok()?;
    Some((largest.file_name().to_string_lossy().into_owned(), text))
}

/// A document in a server, just opened.
struct Session {
    client: Client,
    name: &'static str,
    /// From the start of the process to its first answer.
    ready: Duration,
    /// From opening the document to its findings.
    opened: Duration,
    /// A byte inside a name of a rung in the middle.
    middle: usize,
}

impl Session {
    fn open(executable: &str, name: &'static str, text: &str) -> Self {
        let since = Instant::now();
        let mut client = Client::start(executable, Profile::Eglot);
        let ready = since.elapsed();
        let since = Instant::now();
        client.open_plain(name, text);
        client.diagnostics(name);
        Self {
            client,
            name,
            ready,
            opened: since.elapsed(),
            middle: middle(text),
        }
    }

    fn measured(mut self) -> [(&'static str, Vec<Duration>); 5] {
        let keystrokes = (0..ROUNDS).map(|round| self.keystroke(round)).collect();
        let at = position(self.client.text(self.name), self.middle);
        let hovers = (0..ROUNDS).map(|_| self.hover(at)).collect();
        let actions = (0..ROUNDS).map(|_| self.actions(at)).collect();
        [
            ("start to ready", vec![self.ready]),
            ("open to findings", vec![self.opened]),
            ("keystroke to findings", keystrokes),
            ("hover", hovers),
            ("code actions", actions),
        ]
    }

    /// A letter is typed, and deleted in the next round.
    fn keystroke(&mut self, round: usize) -> Duration {
        let at = self.middle;
        match round % 2 {
            0 => self.client.edit(self.name, at..at, "q"),
            _ => self.client.edit(self.name, at..at + 1, ""),
        }
        let since = Instant::now();
        self.client.diagnostics(self.name);
        since.elapsed()
    }

    /// So many edits, faster than the findings come.
    fn type_fast(&mut self, edits: usize) {
        let at = self.middle;
        for round in 0..edits {
            match round % 2 {
                0 => self.client.edit(self.name, at..at, "q"),
                _ => self.client.edit(self.name, at..at + 1, ""),
            }
            if round % BURST == BURST - 1 {
                self.client.diagnostics(self.name);
            }
        }
    }

    fn hover(&mut self, at: Position) -> Duration {
        let params = HoverParams {
            text_document_position_params: self.client.at(self.name, at),
            work_done_progress_params: Default::default(),
        };
        let since = Instant::now();
        self.client.request::<HoverRequest>(params);
        since.elapsed()
    }

    fn actions(&mut self, at: Position) -> Duration {
        let params = CodeActionParams {
            text_document: TextDocumentIdentifier {
                uri: self.client.uri(self.name),
            },
            range: Range::new(at, at),
            context: CodeActionContext::default(),
            work_done_progress_params: Default::default(),
            partial_result_params: Default::default(),
        };
        let since = Instant::now();
        self.client.request::<CodeActionRequest>(params);
        since.elapsed()
    }
}

/// A byte inside a name of the rung in the middle of `text`.
fn middle(text: &str) -> usize {
    let half = text.len() / 2;
    let half = (half..).find(|&at| text.is_char_boundary(at)).unwrap_or(0);
    let rest = &text[half..];
    let found = ["_fill *", "_advance *", "_start*", "XIC("]
        .into_iter()
        .filter_map(|sign| Some(rest.find(sign)? + sign.len().min(4)))
        .min();
    half + found.unwrap_or(0)
}

fn position(text: &str, offset: usize) -> Position {
    let before = &text[..offset];
    let line = before.matches('\n').count();
    let start = before.rfind('\n').map_or(0, |at| at + 1);
    let column = before[start..].encode_utf16().count();
    Position::new(
        u32::try_from(line).unwrap_or(u32::MAX),
        u32::try_from(column).unwrap_or(u32::MAX),
    )
}

/// The middle and the two ends of what was measured, as cells of a table.
fn percentiles(mut times: Vec<Duration>) -> String {
    times.sort();
    let at = |percent: usize| {
        let place = (times.len() * percent).div_ceil(100).max(1) - 1;
        times.get(place).copied().unwrap_or_default()
    };
    let said = |time: Duration| format!("{:.1} ms", time.as_secs_f64() * 1e3);
    match times.len() {
        1 => format!("{} | - | -", said(at(50))),
        _ => format!("{} | {} | {}", said(at(50)), said(at(95)), said(at(99))),
    }
}

/// What the server holds of memory: with nothing open, and after many edits
/// against before.
fn memory(executable: &str) -> Vec<(&'static str, String)> {
    let idle = Client::start(executable, Profile::Eglot);
    let resting = resident(idle.wire.id());
    drop(idle);
    let mut session = Session::open(executable, "plant.ladder", &plant(500));
    // The first edits fill what later ones use again.
    session.type_fast(EDITS / 10);
    let before = resident(session.client.wire.id());
    session.type_fast(EDITS);
    let after = resident(session.client.wire.id());
    let said = |bytes: Option<u64>| match bytes {
        Some(bytes) => format!("{:.1} MB", bytes as f64 / 1e6),
        None => "not known on this system".to_owned(),
    };
    let growth = before.zip(after).map(|(before, after)| {
        let more = after as f64 / before as f64 - 1.0;
        format!("{:+.1} %", more * 100.0)
    });
    vec![
        ("nothing open", said(resting)),
        ("500 rungs, after 1,000 edits", said(before)),
        ("500 rungs, after 11,000 edits", said(after)),
        ("growth", growth.unwrap_or_else(|| said(None))),
    ]
}

/// The resident bytes of a process, where the system tells.
fn resident(process: u32) -> Option<u64> {
    let status = fs::read_to_string(format!("/proc/{process}/status")).ok()?;
    let line = status.lines().find(|line| line.starts_with("VmRSS:"))?;
    let kilobytes: u64 = line.split_whitespace().nth(1)?.parse().ok()?;
    Some(kilobytes * 1024)
}
