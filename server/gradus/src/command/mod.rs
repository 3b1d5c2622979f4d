//! The commands, one file each.
//!
//! A command's file holds its arguments, with the help that `--help` and the
//! manual show, and `run`, which does it. To add one: its file, and its line in
//! each of the three lists here.

pub mod check;
mod completions;
pub mod conditions;
mod convert;
mod explain;
mod fmt;
pub mod generate;
mod lsp;
mod manual;
pub mod simulate;
mod suggest;
pub mod verify;

use crate::io::Io;
use crate::status::Status;

/// What to do, with its arguments.
#[derive(Debug, clap::Subcommand)]
pub enum Command {
    Check(check::Args),
    Conditions(conditions::Args),
    Suggest(suggest::Args),
    Convert(convert::Args),
    Verify(verify::Args),
    Simulate(simulate::Args),
    Generate(generate::Args),
    Fmt(fmt::Args),
    Lsp(lsp::Args),
    Explain(explain::Args),
    Completions(completions::Args),
    Manual(manual::Args),
}

/// Does it. An error means that the answer could not be written.
pub fn run(command: &Command, io: &mut Io) -> std::io::Result<Status> {
    match command {
        Command::Check(args) => check::run(args, io),
        Command::Conditions(args) => conditions::run(args, io),
        Command::Suggest(args) => suggest::run(args, io),
        Command::Convert(args) => convert::run(args, io),
        Command::Verify(args) => verify::run(args, io),
        Command::Simulate(args) => simulate::run(args, io),
        Command::Generate(args) => generate::run(args, io),
        Command::Fmt(args) => fmt::run(args, io),
        Command::Lsp(args) => lsp::run(args, io),
        Command::Explain(args) => explain::run(args, io),
        Command::Completions(args) => completions::run(args, io),
        Command::Manual(args) => manual::run(args, io),
    }
}
