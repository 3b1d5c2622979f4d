//! `gradus completions`: what a shell needs to complete the command line.

use std::io::Write;

use clap::CommandFactory;
use clap_complete::Shell;

use crate::io::Io;
use crate::status::Status;

const DETAILS: &str = "\
Examples:
  gradus completions bash > ~/.local/share/bash-completion/completions/gradus
  gradus completions zsh > ~/.zfunc/_gradus
  gradus completions fish > ~/.config/fish/completions/gradus.fish";

/// Write the completions for a shell.
#[derive(Debug, clap::Args)]
#[command(after_long_help = DETAILS)]
pub struct Args {
    /// The shell to complete in.
    shell: Shell,
}

/// Writes them as the shell reads them.
pub fn run(args: &Args, io: &mut Io) -> std::io::Result<Status> {
    let mut script = Vec::new();
    let mut command = crate::args::Args::command();
    clap_complete::generate(args.shell, &mut command, "gradus", &mut script);
    io.answer().write_all(&script)?;
    Ok(Status::Done)
}
