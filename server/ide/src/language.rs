//! What a file is: a ladder, a spec or a scenario. Its content tells, never its
//! name.
//!
//! Ladders have readers that know their own marks, so the question here is only
//! whether a text is a spec or a scenario. Both of the project's notations declare inputs and
//! outputs with the same words; what only a spec has is a rule with `|-`, a
//! section, or a list of steps.

use source::codes;

/// A file, as what it is.
pub enum File<'f> {
    /// A ladder in any form, or nothing that is known: the readers of ladders
    /// say what is wrong with it.
    Ladder(&'f [u8]),
    /// The rule text of a grafcet.
    Spec(&'f str),
    /// The steps of a scenario.
    Scenario(&'f str),
}

/// What follows a rail in a drawn ladder, and never `|-` in a rule.
const DRAWN: [char; 7] = ['-', '+', '|', '[', '(', '<', '>'];

const SECTIONS: [&str; 4] = ["Transitions:", "Steps:", "Environment:", "Never:"];

/// What the file that holds `bytes` is.
pub fn of(bytes: &[u8]) -> File<'_> {
    match std::str::from_utf8(bytes) {
        Ok(text) if has_plain_rung(text) => File::Ladder(bytes),
        Ok(text) if is_spec(text) => File::Spec(text),
        Ok(text) if is_scenario(text) => File::Scenario(text),
        _ => File::Ladder(bytes),
    }
}

/// Boxes of a rung hand values over with the arrow that scenarios have too.
fn is_scenario(text: &str) -> bool {
    let body = text.strip_prefix('\u{feff}').unwrap_or(text).trim_start();
    !body.starts_with('<') && !body.lines().any(begins_rung) && scenario::is_scenario(body)
}

fn is_spec(text: &str) -> bool {
    let body = text.strip_prefix('\u{feff}').unwrap_or(text);
    if body.trim_start().starts_with('<') {
        return false;
    }
    let lines = || {
        body.lines()
            .map(|line| line.split("//").next().unwrap_or_default().trim())
            .filter(|line| !line.is_empty())
    };
    if lines().any(begins_rung) {
        return false;
    }
    lines().any(|line| SECTIONS.contains(&line) || is_rule(line))
        || lines().next().is_some_and(declares_steps)
}

/// Whether some line begins with the word as it is mostly written. An editor
/// asks after every keystroke what a text is, and this tells it of large
/// ladders without looking at each of their lines.
fn has_plain_rung(text: &str) -> bool {
    text.match_indices("rung").any(|(at, _)| {
        let (before, rest) = text.split_at(at);
        let line = before.rsplit('\n').next().unwrap_or_default();
        line.trim_matches(['\u{feff}', ' ', '\t']).is_empty()
            && begins_rung(rest.lines().next().unwrap_or_default())
            && !text
                .trim_start_matches('\u{feff}')
                .trim_start()
                .starts_with('<')
    })
}

/// Whether the line begins a rung of a `.ladder` text.
fn begins_rung(line: &str) -> bool {
    let word = line.split([' ', '\t', ':', '"']).next();
    word.is_some_and(|word| word.eq_ignore_ascii_case("rung"))
}

/// Whether the line is `label: ... |- ...`. In drawn ladders, `|-` is a rail
/// and a wire goes on after it.
fn is_rule(line: &str) -> bool {
    let Some((label, rule)) = line.split_once(':') else {
        return false;
    };
    let Some((_, right)) = rule.split_once("|-") else {
        return false;
    };
    !label.contains(char::is_whitespace) && !right.starts_with(DRAWN)
}

/// Whether the line is a declaration that only specs have, rather than a
/// sentence that begins with the same word.
fn declares_steps(line: &str) -> bool {
    let word = line.split_whitespace().next().unwrap_or_default();
    let begins = ["Grafcet", "Step", "Macro", "Enclosing", "Transition"].contains(&word);
    let found = |line| grafcet::read(line).diagnostics.into_iter();
    begins && !found(line).any(|finding| finding.code == codes::SPEC_SYNTAX)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_spec_has_rules_sections_or_steps() {
        assert!(is_spec("Input m\n\nt1:  p1*m |-  @p2\n"));
        assert!(is_spec("\u{feff}Input m // start\r\nTransitions:\r\n"));
        assert!(is_spec("// A tank\nStep p1, p2\n"));
    }

    #[test]
    fn a_ladder_is_no_spec() {
        assert!(!is_spec("input m\nrung \"t1: a |- b\": m -> v\n"));
        assert!(!is_spec("input m\noutput v\n"));
        assert!(!is_spec("Rung1: |---[ a ]---( b )---|\n"));
        assert!(!is_spec("Drain: |-| |--( b )---|\n"));
        assert!(!is_spec("<project>t1: a |- b</project>"));
        assert!(!is_spec("XIC(a)OTE(b);"));
    }

    #[test]
    fn a_scenario_has_steps() {
        assert!(is_scenario("\u{feff}on s => on v1\r\n"));
        assert!(is_scenario("// A tank\nscenario \"Filling\"\n"));
        assert!(!is_scenario("rung: 1 -> PID(a, q => b)\non s => on v1\n"));
        assert!(!is_scenario("<on s => on v1>"));
    }

    #[test]
    fn neither_is_a_sentence() {
        assert!(!is_spec("Step back from the machine.\n"));
        assert!(!is_spec(""));
    }
}
