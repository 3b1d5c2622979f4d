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
use tower_lsp::ls_types::request::{CodeActionRequest, CodeActionResolveRequest, HoverRequest};
use tower_lsp::ls_types::{
    CodeAction, CodeActionContext, CodeActionOrCommand, CodeActionParams, HoverParams, Position,
    Range, TextDocumentIdentifier,
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
    let plants = SIZES.map(|size| (format!("{size} rungs"), "plant.ladder", plant(size)));
    let real = largest().map(|(name, text)| (format!("`{name}`"), "plant.L5X", text));
    for (title, name, text) in plants.into_iter().chain(real) {
        let rows = measured(&executable, name, &text);
        for (what, times) in rows {
            writeln!(out, "| {title} | {what} | {} |", percentiles(times))?;
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

/// What an editor waits for while somebody works on `text`.
fn measured(
    executable: &str,
    name: &'static str,
    text: &str,
) -> Vec<(&'static str, Vec<Duration>)> {
    let mut typing = Session::open(executable, Profile::Eglot, name, text);
    let keystrokes = (0..ROUNDS).map(|round| typing.keystroke(round)).collect();
    let (ready, opened) = (typing.ready, typing.opened);
    drop(typing);
    // A client that asks for what an action changes when it is taken.
    let mut asking = Session::open(executable, Profile::Neovim, name, text);
    let after_keystrokes = (0..ROUNDS)
        .map(|round| {
            asking.press(round);
            asking.hover()
        })
        .collect();
    let hovers = (0..ROUNDS).map(|_| asking.hover()).collect();
    let actions = (0..ROUNDS).map(|_| asking.actions().0).collect();
    let taken = (0..ROUNDS / 4)
        .filter_map(|_| asking.take_action())
        .collect();
    vec![
        ("start to ready", vec![ready]),
        ("open to findings", vec![opened]),
        ("keystroke to findings", keystrokes),
        ("keystroke to hover", after_keystrokes),
        ("hover", hovers),
        ("code actions", actions),
        ("what an action changes", taken),
    ]
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
    fn open(executable: &str, profile: Profile, name: &'static str, text: &str) -> Self {
        let since = Instant::now();
        let mut client = Client::start(executable, profile);
        let ready = since.elapsed();
        let since = Instant::now();
        client.open_plain(name, text);
        if profile == Profile::Eglot {
            client.diagnostics(name);
        }
        Self {
            client,
            name,
            ready,
            opened: since.elapsed(),
            middle: middle(text),
        }
    }

    /// A letter is typed, and deleted in the next round.
    fn keystroke(&mut self, round: usize) -> Duration {
        self.press(round);
        let since = Instant::now();
        self.client.diagnostics(self.name);
        since.elapsed()
    }

    fn press(&mut self, round: usize) {
        let at = self.middle;
        match round % 2 {
            0 => self.client.edit(self.name, at..at, "q"),
            _ => self.client.edit(self.name, at..at + 1, ""),
        }
    }

    /// So many edits, faster than the findings come.
    fn type_fast(&mut self, edits: usize) {
        for round in 0..edits {
            self.press(round);
            if round % BURST == BURST - 1 {
                self.client.diagnostics(self.name);
            }
        }
    }

    /// The place in the middle.
    fn at(&self) -> Position {
        position(self.client.text(self.name), self.middle)
    }

    fn hover(&mut self) -> Duration {
        let at = self.at();
        let params = HoverParams {
            text_document_position_params: self.client.at(self.name, at),
            work_done_progress_params: Default::default(),
        };
        let since = Instant::now();
        self.client.request::<HoverRequest>(params);
        since.elapsed()
    }

    /// Offers what can be done, and the first action of that.
    fn actions(&mut self) -> (Duration, Option<CodeAction>) {
        let at = self.at();
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
        let offered = self.client.request::<CodeActionRequest>(params);
        let took = since.elapsed();
        let first = offered.into_iter().flatten().find_map(|it| match it {
            CodeActionOrCommand::CodeAction(action) if action.data.is_some() => Some(action),
            _ => None,
        });
        (took, first)
    }

    /// The first action is taken: what it changes is worked out.
    fn take_action(&mut self) -> Option<Duration> {
        let (_, action) = self.actions();
        let action = action?;
        let since = Instant::now();
        self.client.request::<CodeActionResolveRequest>(action);
        Some(since.elapsed())
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
        0 => "- | - | -".to_owned(),
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
    let mut session = Session::open(executable, Profile::Eglot, "plant.ladder", &plant(500));
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
