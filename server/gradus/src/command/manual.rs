//! `gradus manual`: the manual, made of the same words as `--help`.

use std::fmt::Write as _;
use std::io::Write as _;

use clap::{Command, CommandFactory, ValueEnum};

use crate::io::Io;
use crate::status::Status;

const DETAILS: &str = "\
Examples:
  gradus manual | man -l -                        read it
  gradus manual > ~/.local/share/man/man1/gradus.1
  gradus manual check > ~/.local/share/man/man1/gradus-check.1
  gradus manual --format markdown > docs/cli.md";

/// Write the manual page of gradus or of one of its commands.
#[derive(Debug, clap::Args)]
#[command(after_long_help = DETAILS)]
pub struct Args {
    /// The command whose page to write; without it, the page of gradus.
    command: Option<String>,

    /// The form to write.
    #[arg(long, value_name = "FORM", default_value = "man")]
    format: Form,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum Form {
    /// A page for `man`.
    Man,
    /// A page in Markdown, the commands included.
    Markdown,
}

/// Writes the page.
pub fn run(args: &Args, io: &mut Io) -> std::io::Result<Status> {
    let mut whole = crate::args::Args::command().term_width(100);
    whole.build();
    let page = match &args.command {
        None => Some(whole),
        Some(name) => whole.find_subcommand(name).cloned(),
    };
    let Some(page) = page else {
        io.complain("there is no such command; `gradus --help` lists them");
        return Ok(Status::Usage);
    };
    match args.format {
        Form::Man => io.answer().write_all(roff(page)?.as_bytes())?,
        Form::Markdown => io.answer().write_all(markdown(page).as_bytes())?,
    }
    Ok(Status::Done)
}

/// The page in the language of `man`.
fn roff(page: Command) -> std::io::Result<String> {
    let mut out = Vec::new();
    let source = concat!("gradus ", env!("CARGO_PKG_VERSION"));
    clap_mangen::Man::new(page)
        .source(source)
        .render(&mut out)?;
    // What follows the options is laid out by hand, so its lines are kept.
    let out = String::from_utf8_lossy(&out);
    Ok(out.replace(".SH EXTRA\n", ".SH DETAILS\n.nf\n"))
}

/// The help of a command and of all commands below it.
fn markdown(page: Command) -> String {
    let mut out = String::from("# Command line\n");
    let below: Vec<_> = page.get_subcommands().cloned().collect();
    for mut command in std::iter::once(page).chain(below) {
        let name = command.get_bin_name().unwrap_or("gradus").to_owned();
        let help = command.render_long_help();
        // Writing into a string cannot fail.
        let _ = write!(
            out,
            "\n## {name}\n\n```text\n{}\n```\n",
            plain(&help.to_string())
        );
    }
    out
}

fn plain(help: &str) -> String {
    let lines: Vec<_> = help.trim_end().lines().map(str::trim_end).collect();
    lines.join("\n")
}
