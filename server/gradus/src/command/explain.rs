//! `gradus explain`: what a finding means and how to mend it.

use std::cmp::Reverse;
use std::io::Write;

use serde_json::{Value, json};
use source::{Code, codes};

use crate::io::Io;
use crate::report::printable;
use crate::status::Status;

const DETAILS: &str = "\
JSON:
  with CODE   {\"code\", \"severity\", \"title\", \"page\"}; the page is Markdown
  without     {\"codes\": [{\"code\", \"severity\", \"title\"}]}

Examples:
  gradus explain G2002    the page of one code
  gradus explain          all codes";

/// Explain a finding by its code, or list all codes.
#[derive(Debug, clap::Args)]
#[command(after_long_help = DETAILS)]
pub struct Args {
    /// The code, such as G2002; without it, all codes are listed.
    code: Option<String>,

    /// Answer in JSON.
    #[arg(long)]
    json: bool,
}

/// Prints the page of a code, or the list.
pub fn run(args: &Args, io: &mut Io) -> std::io::Result<Status> {
    match &args.code {
        None => list(args, io),
        Some(text) => match Code::parse(text.trim()) {
            Some(code) => page(args, code, io),
            None => unknown(text, io),
        },
    }
}

fn list(args: &Args, io: &mut Io) -> std::io::Result<Status> {
    if args.json {
        let all: Vec<_> = codes::ALL.iter().map(|code| entry(*code)).collect();
        writeln!(io.answer(), "{:#}", json!({ "codes": all }))?;
        return Ok(Status::Done);
    }
    for code in codes::ALL {
        writeln!(io.answer(), "{}", line(*code))?;
    }
    Ok(Status::Done)
}

fn page(args: &Args, code: Code, io: &mut Io) -> std::io::Result<Status> {
    if args.json {
        let mut answer = entry(code);
        answer["page"] = code.page().into();
        writeln!(io.answer(), "{answer:#}")?;
    } else {
        io.answer().write_all(code.page().as_bytes())?;
    }
    Ok(Status::Done)
}

fn unknown(text: &str, io: &mut Io) -> std::io::Result<Status> {
    io.complain(&format!("`{}` is no code", printable(text)));
    let lines = near(text)
        .into_iter()
        .map(|code| format!("  {}\n", line(code)));
    io.aside(&format!("Near it:\n{}", lines.collect::<String>()))?;
    Ok(Status::Usage)
}

fn line(code: Code) -> String {
    format!("{code}  {:<11}  {}", code.severity().word(), code.title())
}

fn entry(code: Code) -> Value {
    json!({
        "code": code.to_string(),
        "severity": code.severity().word(),
        "title": code.title(),
    })
}

/// The codes whose titles hold the word `text`, or else those written most like
/// it.
fn near(text: &str) -> Vec<Code> {
    let word = text.to_lowercase();
    let named = |code: &Code| word.len() > 2 && code.title().to_lowercase().contains(&word);
    let mut near: Vec<_> = codes::ALL.iter().copied().filter(named).collect();
    if near.is_empty() {
        near = codes::ALL.to_vec();
        near.sort_by_key(|code| Reverse(likeness(text, &code.to_string())));
        near.truncate(3);
    }
    near
}

/// How many characters agree, place by place, and how many of them at the start.
fn likeness(text: &str, code: &str) -> (usize, usize) {
    let mut upper = text.to_ascii_uppercase();
    if !upper.starts_with('G') {
        upper.insert(0, 'G');
    }
    let pairs = || upper.chars().zip(code.chars());
    let in_place = pairs().filter(|(one, other)| one == other).count();
    let at_start = pairs().take_while(|(one, other)| one == other).count();
    (in_place, at_start)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn nearest(text: &str) -> String {
        near(text)[0].to_string()
    }

    #[test]
    fn a_mistyped_code_is_near_the_one_that_was_meant() {
        assert_eq!(nearest("G3009"), "G3001");
        assert_eq!(nearest("2002"), "G2002");
        assert_eq!(nearest("G110"), "G1101");
        assert_eq!(near("").len(), 3);
    }

    #[test]
    fn a_word_finds_the_codes_that_speak_of_it() {
        let found: Vec<_> = near("jump").iter().map(Code::to_string).collect();
        assert_eq!(found, ["G2014"]);
    }
}
