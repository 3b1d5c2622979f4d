//! What a person is shown of ladders and grafcets, as plain data.
//!
//! Every command and every editor asks here, so that they say the same. An
//! answer holds names, texts and places in bytes; it knows no protocol, no
//! terminal and no file. What is looked at is a [`Ladder`], the [`Spec`] beside
//! it, and scenarios that run on them. One thing to be shown is one file with one entry:
//!
//! * [`coils`]: every coil with all that is known of it, in words;
//! * [`said`] and [`legible`]: a condition in the notation, past a size that a
//!   person can read not at all;
//! * [`language`]: whether a text is a ladder or a spec;
//! * [`decide`]: what a new decision does to those made before;
//! * [`changed`]: the smallest edits from one text to another;
//! * [`navigate`]: from a name to the places that belong to it;
//! * [`symbols`]: what a document holds, as a tree;
//! * [`folds_in_ladder`], [`selections_in_ladder`], [`link_in_ladder`] and the
//!   same for specs: what folds, what a growing selection takes, and where a
//!   text names the one beside it;
//! * [`hover_in_ladder`], [`hover_in_spec`]: the thing under the pointer, and the
//!   [`Term`]s it uses, each with its page;
//! * [`hierarchy`]: which step follows which;
//! * [`tokens`]: what each name is, for colouring;
//! * [`Scenario`] and [`Run`]: a scenario, and what comes of it on a ladder and a
//!   spec, said as findings, lenses, hints and hovers;
//! * [`Judged`]: a ladder and its spec with what a proof found, said as a line and
//!   as findings, as [a scenario](trace_scenario), and as [rules](exclusions)
//!   under which a difference cannot happen.

mod actions;
mod change;
mod changed;
mod coil;
mod completion;
mod condition;
pub mod decide;
mod decided;
mod describe;
mod folding;
pub mod hierarchy;
mod hints;
mod hover;
mod ladder;
pub mod language;
mod layout;
mod lenses;
mod link;
mod merged;
mod names;
pub mod navigate;
mod next;
mod rename;
mod routine;
mod scenario;
mod section;
mod selection;
mod signature;
mod spec;
mod statement;
pub mod symbols;
mod term;
pub mod tokens;
mod verdict;

pub use actions::{
    Action, ActionKind, Asked, Effect, actions_in_ladder, actions_in_scenario, actions_in_spec,
    actions_on_verdict,
};
pub use change::{Change, Departing, changed_spec};
pub use changed::{changed, edited};
pub use coil::{AtRest, Coil, Drawn, Part, Said, coil, coils, kind_word};
pub use completion::{
    Completion, CompletionKind, Completions, complete_in_ladder, complete_in_scenario,
    complete_in_spec,
};
pub use condition::{broken, legible, said};
pub use decided::{Decided, Standing};
pub use folding::{Fold, folds_in_ladder, folds_in_scenario, folds_in_spec};
pub use hints::{Hint, hints_in_ladder, hints_in_spec};
pub use hover::{
    Block, Hover, RunOn, Rungs, Target, hover_in_ladder, hover_in_scenario, hover_in_spec,
    hover_of_variable,
};
pub use ladder::Ladder;
pub use layout::{Extent, lay_out_ladder, lay_out_scenario, lay_out_spec};
pub use lenses::{Count, Lens, count, lenses_in_ladder, lenses_in_spec};
pub use link::{link_in_ladder, link_in_spec, links_in_scenario, namings_of};
pub use merged::merged_spec;
pub use names::{Mention, Names, Usage, element};
pub use next::{Next, NextKind, next, next_at};
pub use rename::{
    Refusal, Renamable, Renaming, edits_in_scenario, renamable_in_ladder, renamable_in_scenario,
    renamable_in_spec, rename_in_ladder, rename_in_scenario, rename_in_spec,
};
pub use scenario::{
    Finding, Run, Scenario, ScenarioLens, Shows, StepName, hints_in_scenario, is_meant,
    lenses_in_scenario, meaning, powered_in_ladder, situation_in_spec, subject, tokens_in_scenario,
};
pub use selection::{selections_in_ladder, selections_in_scenario, selections_in_spec};
pub use signature::{Signature, signature};
pub use spec::Spec;
pub use term::Term;
pub use verdict::{
    About, Exclusion, Judged, Observed, Question, Verdict, VerdictFinding, exclusions, trace_name,
    trace_scenario, verdict_findings, verdict_line, verdict_word,
};
