//! `workspace/executeCommand`.
//!
//! | command | argument | answer |
//! |---|---|---|
//! | `gradus.convert` | `{ "uri", "accept" }` | brings the spec up to the ladder |
//! | `gradus.acceptHandovers` | `{ "uri" }` | the same, with all handovers accepted |
//! | `gradus.openSpec` | `{ "uri" }` | where the spec is |
//! | `gradus.ladderText` | `{ "uri" }` | the ladder in rung notation |
//! | `gradus.conditions` | `{ "uri" }` | the conditions of all coils |
//! | `gradus.simulate` | `{ "uri" }` | the scans of a scenario |
//! | `gradus.search` | `{ "uri" }` | what sequences of inputs show of the ladder's successions |
//! | `gradus.verify` | `{ "uri" }` | whether the spec does what the ladder does |
//! | `gradus.showScan` | `{ "uri", "line" or "scan" }` | shows a scan in ladder and spec |
//! | `gradus.hideScan` | | shows it no more |
//! | `gradus.explain` | a code | its page |
//! | `gradus.report` | | what to tell about a fault |

use recovery::conversion::{Accept, decide, update};
use serde::Deserialize;
use serde_json::{Value, json};
use source::Code;
use tower_lsp::jsonrpc::{Error, Result};
use tower_lsp::ls_types::{ExecuteCommandParams, Uri, WorkspaceEdit};

use super::code_action::put;
use super::simulate::{HIDE_SCAN, SHOW_SCAN, SIMULATE, Wanted};
use super::verify::VERIFY;
use crate::lsp::edit::Changes;
use crate::lsp::log::Log;
use crate::lsp::query::Query;
use crate::lsp::searching::SEARCH;
use crate::lsp::virtual_document::View;
use crate::lsp::world::World;

/// The command that shows the page of a code.
pub const EXPLAIN: &str = "gradus.explain";

/// The command that opens the spec of a ladder.
pub const OPEN_SPEC: &str = "gradus.openSpec";

/// All commands.
pub const ALL: [&str; 12] = [
    "gradus.convert",
    "gradus.acceptHandovers",
    OPEN_SPEC,
    "gradus.ladderText",
    "gradus.conditions",
    SIMULATE,
    SHOW_SCAN,
    HIDE_SCAN,
    SEARCH,
    VERIFY,
    EXPLAIN,
    "gradus.report",
];

/// A command with its argument.
#[derive(Debug)]
pub enum Command {
    /// Something about the ladder at an address.
    Ladder(Uri, LadderCommand),
    /// Show the scans of the scenario at an address.
    Simulate(Uri),
    /// Search for sequences of inputs that show which state follows which in the
    /// ladder of the pair at an address.
    Search(Uri),
    /// Find out whether the spec of the pair at an address does what its ladder does.
    Verify(Uri),
    /// Show, in ladder and spec, a scan of the scenario at an address.
    ShowScan(Uri, Wanted),
    /// Show no scan any more.
    HideScan,
    /// The page of a code.
    Explain(Code),
    /// What to tell about a fault.
    Report,
}

/// What is to be done with a ladder.
#[derive(Debug)]
pub enum LadderCommand {
    /// Bring the spec up to it.
    Convert(Accept),
    /// Find its spec.
    OpenSpec,
    /// Show it.
    Show(View),
}

impl LadderCommand {
    /// Whether it is about successions that were seen, so that somebody must have
    /// searched for them.
    pub fn needs_sights(&self) -> bool {
        matches!(self, Self::Convert(Accept::Witnessed))
    }
}

/// The argument of most commands.
#[derive(Debug, Deserialize)]
struct Argument {
    uri: Uri,
    accept: Option<Word>,
    line: Option<u32>,
    scan: Option<u64>,
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "lowercase")]
enum Word {
    None,
    Handover,
    Witnessed,
    All,
}

/// Reads a command.
pub fn read(params: ExecuteCommandParams) -> Result<Command> {
    let name = params.command;
    let first = params.arguments.into_iter().next();
    let wrong = |what: String| Error::invalid_params(format!("{name}: {what}"));
    match name.as_str() {
        "gradus.report" => return Ok(Command::Report),
        HIDE_SCAN => return Ok(Command::HideScan),
        EXPLAIN => {
            let text = first.as_ref().and_then(Value::as_str).unwrap_or_default();
            let code = Code::parse(text);
            return code
                .map(Command::Explain)
                .ok_or_else(|| wrong(format!("`{text}` is no code")));
        }
        _ => {}
    }
    let argument = || -> Result<Argument> {
        let argument = first.ok_or_else(|| wrong("an object with `uri` is needed".to_owned()))?;
        serde_json::from_value(argument).map_err(|error| wrong(error.to_string()))
    };
    let (uri, command) = match name.as_str() {
        SIMULATE => return Ok(Command::Simulate(argument()?.uri)),
        SEARCH => return Ok(Command::Search(argument()?.uri)),
        VERIFY => return Ok(Command::Verify(argument()?.uri)),
        SHOW_SCAN => {
            let argument = argument()?;
            let number = argument.scan.map(Wanted::Number);
            let wanted = number.or(argument.line.map(Wanted::EndOfLine));
            let wanted =
                wanted.ok_or_else(|| wrong("missing field `line` or `scan`".to_owned()))?;
            return Ok(Command::ShowScan(argument.uri, wanted));
        }
        "gradus.convert" => {
            let argument = argument()?;
            let accept = match argument.accept {
                None | Some(Word::None) => Accept::None,
                Some(Word::Handover) => Accept::Handovers,
                Some(Word::Witnessed) => Accept::Witnessed,
                Some(Word::All) => Accept::All,
            };
            (argument.uri, LadderCommand::Convert(accept))
        }
        "gradus.acceptHandovers" => (argument()?.uri, LadderCommand::Convert(Accept::Handovers)),
        OPEN_SPEC => (argument()?.uri, LadderCommand::OpenSpec),
        "gradus.ladderText" => (argument()?.uri, LadderCommand::Show(View::Ladder)),
        "gradus.conditions" => (argument()?.uri, LadderCommand::Show(View::Conditions)),
        _ => return Err(wrong("gradus has no such command".to_owned())),
    };
    Ok(Command::Ladder(uri, command))
}

/// What a command about a ladder comes to.
#[derive(Debug)]
pub struct Done {
    /// The answer to the client.
    pub answer: Value,
    /// What the client is to change first.
    pub edit: Option<WorkspaceEdit>,
    /// What the client is to show.
    pub show: Option<Uri>,
}

impl Done {
    fn answer(answer: Value) -> Self {
        Self {
            answer,
            edit: None,
            show: None,
        }
    }
}

/// Works a command about a ladder out.
pub fn answer(query: &Query, command: &LadderCommand) -> Option<Done> {
    let pair = query.pair();
    let document = pair.ladder.as_ref()?;
    let ladder = pair.ladder()?;
    match command {
        LadderCommand::Show(view) => Some(Done::answer(json!({
            "title": format!("{}.{}", document.key.name(), view.ending()),
            "language": view.language(),
            "text": view.text(ladder, &query.budget),
            "uri": view.address(&document.uri),
        }))),
        LadderCommand::OpenSpec => {
            let place = query.world.spec_place(&document.uri)?;
            let exists = query.world.document(&place).is_some();
            Some(Done {
                answer: json!({ "uri": place, "exists": exists }),
                edit: None,
                show: exists.then_some(place),
            })
        }
        LadderCommand::Convert(accept) => {
            let existing = pair
                .spec()
                .map(|it| it.reading.spec.clone())
                .unwrap_or_default();
            let decisions = decide(&ladder.analysis, &existing.decisions, accept);
            let updated = update(&ladder.analysis, &existing, &decisions, &query.budget);
            let old = pair.spec().map_or("", |it| &*it.text);
            let budget = &query.budget;
            let new = ide::merged_spec(&ladder.analysis, old, &existing, &updated.spec, budget);
            if query.budget.cancel.is_cancelled() {
                return None;
            }
            let mut edit = Changes::new("Convert the ladder");
            put(query, &pair, &mut edit, &new)?;
            let chart = &updated.spec.grafcet.chart;
            let open = ide::count(
                ladder,
                Some(&ide::Spec::read(new.as_str().into())),
                query.weakest(),
            );
            Some(Done {
                answer: json!({
                    "uri": query.world.spec_place(&document.uri),
                    "changed": !edit.is_empty(),
                    "summary": format!(
                        "{} steps, {} transitions, {} actions; {} suggestions open",
                        chart.steps.len(),
                        chart.transitions.len(),
                        chart.actions.len(),
                        open.open,
                    ),
                }),
                edit: (!edit.is_empty()).then(|| edit.workspace_edit(&query.world)),
                show: None,
            })
        }
    }
}

/// The page of a code.
pub fn page(code: Code) -> Value {
    json!({ "title": format!("{code}.md"), "language": "markdown", "text": code.page() })
}

/// What to tell about a fault: versions, settings and what was done last, but
/// nothing of what the files hold.
pub fn report(world: &World, log: &Log) -> Value {
    let open = world.open.values().map(|document| {
        let bytes = document.rope.len_bytes();
        let ending = document
            .key
            .name()
            .rsplit('.')
            .next()
            .unwrap_or_default()
            .to_owned();
        format!("- a document `.{ending}` of {bytes} bytes")
    });
    let open: Vec<String> = open.collect();
    let mut settings = vec![world.settings.client.config()];
    for document in world.open.values() {
        let obeyed = world.config(&document.key);
        if !settings.contains(&obeyed) {
            settings.push(obeyed);
        }
    }
    let text = format!(
        "# gradus {}\n\n## Client\n\n```text\n{:#?}\n```\n\n## Settings\n\n```text\n{:#?}\n```\n\n\
         ## Open documents\n\n{}\n\n## Log\n\n```text\n{}\n```\n",
        env!("CARGO_PKG_VERSION"),
        world.abilities,
        settings,
        open.join("\n"),
        log.lines().join("\n"),
    );
    json!({ "title": "gradus-report.md", "language": "markdown", "text": text })
}
