//! `gradus lsp`: the language server.

use crate::io::Io;
use crate::lsp;
use crate::status::Status;

const DETAILS: &str = "\
An editor starts this command and talks to it on standard input and output, in
the Language Server Protocol. There is nothing to see on a terminal; press Ctrl-C.
What the server has to tell people who look for a fault goes to standard error.

The files are those of all other commands: ladders in any form that Gradus reads,
and the specs beside them. Documents that hold neither get no answer.

Settings, commands and requests beyond the protocol: docs/protocol.md. Setting up
an editor: docs/editors.

Exit status: 0 after a shutdown that the editor asked for, else 1.

Examples:
  gradus lsp                     as an editor starts it
  gradus lsp --stdio             the same; some editors add this word";

/// Serve an editor: hovers, suggestions, findings and more.
#[derive(Debug, clap::Args)]
#[command(after_long_help = DETAILS)]
pub struct Args {
    /// Use standard input and output, as is always done.
    #[arg(long)]
    stdio: bool,
}

/// Serves until the editor is done; ends the process.
pub fn run(_: &Args, _: &mut Io) -> std::io::Result<Status> {
    match lsp::serve()? {}
}
