//! The command line as a whole. What a command takes is said in its own file
//! under `command/`.

use clap::Parser;

use crate::colour::When;
use crate::command::Command;

const DETAILS: &str = "\
Exit status:
  0    done, and all is well
  1    done, and problems were found
  2    the command line makes no sense, or a file cannot be read or written
  130  stopped by Ctrl-C

The answer goes to standard output, everything else to standard error. A path
may be `-`, standard input. What a file is, is decided by what it holds, never by
its name.

Examples:
  gradus check line3.L5X         what is wrong or odd in a program
  gradus suggest line3.L5X       which state follows which
  gradus convert line3.L5X       the spec beside it, line3.grafcet
  gradus explain G2002           what a finding means and how to mend it
  gradus check --help            everything about one command";

/// Shows the sequence hidden in PLC ladder programs and keeps it as a Grafcet
/// beside them.
#[derive(Debug, Parser)]
#[command(
    name = "gradus",
    version,
    propagate_version = false,
    after_long_help = DETAILS,
    arg_required_else_help = true,
    disable_help_subcommand = true
)]
pub struct Args {
    /// What to do.
    #[command(subcommand)]
    pub command: Command,

    /// When to colour output.
    #[arg(
        long,
        visible_alias = "colour",
        value_name = "WHEN",
        default_value = "auto",
        global = true
    )]
    pub color: When,
}
