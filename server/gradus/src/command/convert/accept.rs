//! `--accept`: a word, or a list of pairs.

use grafcet::Decision;
use ide::decide;
use logic::Name;
use recovery::Analysis;
use recovery::conversion::Accept;

use super::named;
use crate::report::printable;

/// What to accept, as the command line says it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Wanted {
    /// Nothing new.
    None,
    /// All handovers.
    Handover,
    /// What a search for sequences of inputs shows.
    Witnessed,
    /// Every suggestion.
    All,
    /// Each a state and those that start together after it.
    These(Vec<(String, Vec<String>)>),
}

/// Reads the value of `--accept`.
pub fn parse(text: &str) -> Result<Wanted, String> {
    Ok(match text {
        "none" => Wanted::None,
        "handover" => Wanted::Handover,
        "witnessed" => Wanted::Witnessed,
        "all" => Wanted::All,
        list if list.contains("->") => Wanted::These(pairs(list)?),
        _ => {
            return Err(
                "expected none, handover, witnessed, all, or a list such as `v1->v2,v1->h&m`"
                    .to_owned(),
            );
        }
    })
}

fn pairs(list: &str) -> Result<Vec<(String, Vec<String>)>, String> {
    split(list, ',').into_iter().map(pair).collect()
}

fn pair(text: &str) -> Result<(String, Vec<String>), String> {
    let expected = || format!("expected `FROM->TO` or `FROM->TO&TO`, found `{text}`");
    let (from, to) = text.split_once("->").ok_or_else(expected)?;
    let names: Vec<String> = std::iter::once(from)
        .chain(split(to, '&'))
        .map(plain)
        .collect();
    if names.iter().any(String::is_empty) {
        return Err(expected());
    }
    let mut names = names.into_iter();
    let from = names.next().ok_or_else(expected)?;
    Ok((from, names.collect()))
}

/// Splits at `separator`, but not inside double quotes or brackets: a name may
/// be `"a,b"` or `Bit[1,2]`.
fn split(text: &str, separator: char) -> Vec<&str> {
    let mut in_quotes = false;
    let mut depth = 0_usize;
    text.split(move |character| {
        match character {
            '"' => in_quotes = !in_quotes,
            '[' if !in_quotes => depth += 1,
            ']' if !in_quotes => depth = depth.saturating_sub(1),
            _ => {}
        }
        character == separator && !in_quotes && depth == 0
    })
    .collect()
}

/// A name without the quotes around it.
fn plain(text: &str) -> String {
    let text = text.trim();
    let inside = text
        .strip_prefix('"')
        .and_then(|text| text.strip_suffix('"'));
    inside.unwrap_or(text).to_owned()
}

/// `decisions` with those that `wanted` asks for. The error says what cannot be
/// accepted.
pub fn apply(
    wanted: &Wanted,
    analysis: &Analysis,
    mut decisions: Vec<Decision>,
) -> Result<Vec<Decision>, String> {
    let by_evidence = |accept| recovery::conversion::decide(analysis, &decisions, &accept);
    match wanted {
        Wanted::None => Ok(decisions),
        Wanted::Witnessed => Ok(by_evidence(Accept::Witnessed)),
        Wanted::Handover => Ok(by_evidence(Accept::Handovers)),
        Wanted::All => Ok(by_evidence(Accept::All)),
        Wanted::These(pairs) => {
            for (from, to) in pairs {
                let from = named::state(from, analysis)?;
                let to: Vec<Name> = to
                    .iter()
                    .map(|name| named::state(name, analysis))
                    .collect::<Result<_, _>>()?;
                check_values(&from, &to, analysis)?;
                if analysis.states().find(&from).is_some() {
                    decide::accept(&mut decisions, &from, &to);
                } else {
                    decide::take_rejection_back(&mut decisions, &from, &to);
                }
            }
            Ok(decisions)
        }
    }
}

/// The values of a register follow each other as its writes say, and nothing
/// else can be decided about them.
fn check_values(from: &Name, to: &[Name], analysis: &Analysis) -> Result<(), String> {
    let is_value = |name: &Name| analysis.states().find(name).is_none();
    for to in to {
        if from == to {
            return Err(format!("`{}` cannot follow itself", printable(from)));
        }
        if !is_value(from) && !is_value(to) {
            continue;
        }
        let mut successions = analysis.successions().iter();
        if !successions.any(|it| it.from == *from && it.to == *to) {
            return Err(format!(
                "no write leads from `{}` to `{}`, so the one cannot follow the other",
                printable(from),
                printable(to)
            ));
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn these(list: &[(&str, &[&str])]) -> Result<Wanted, String> {
        let owned = |names: &[&str]| names.iter().map(|name| (*name).to_owned()).collect();
        let pairs = list.iter();
        Ok(Wanted::These(
            pairs
                .map(|(from, to)| ((*from).to_owned(), owned(to)))
                .collect(),
        ))
    }

    #[test]
    fn a_list_holds_pairs_and_states_that_start_together() {
        assert_eq!(
            parse("v1->v2, v1 -> h & m"),
            these(&[("v1", &["v2"]), ("v1", &["h", "m"])])
        );
        assert_eq!(
            parse("\"a,b\"->Bit[1,2],Seq=10->Seq=20"),
            these(&[("a,b", &["Bit[1,2]"]), ("Seq=10", &["Seq=20"])])
        );
    }

    #[test]
    fn what_is_neither_a_word_nor_a_list_is_refused() {
        for text in ["handovers", "v1->", "->v1", "v1->v2,v3", "v1->v2&", ""] {
            assert!(parse(text).is_err(), "{text}");
        }
    }
}
