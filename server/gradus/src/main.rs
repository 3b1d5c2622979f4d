//! The `gradus` executable: everything the editors can do, from a shell.
//!
//! A run is: the arguments ([`args`]) name a command ([`command`]), the command
//! reads files ([`file`], [`input`]), asks the core crates, which do no input
//! or output of their own, and answers through [`io::Io`]. What it answers on
//! standard output is the answer; everything else goes to standard error. How
//! it ended is a [`status::Status`], the exit status of the process.

mod args;
mod colour;
mod command;
mod condition;
mod diff;
mod file;
mod input;
mod interrupt;
mod io;
mod lsp;
mod program;
mod progress;
mod report;
mod settings;
mod sights;
mod status;
mod subject;

use std::process::ExitCode;

use clap::Parser;

use crate::args::Args;
use crate::io::Io;

fn main() -> ExitCode {
    let args = Args::parse();
    let mut io = Io::of_process(args.color);
    interrupt::listen(io.cancel().clone());
    let ended = command::run(&args.command, &mut io);
    status::settle(ended, io).into()
}
