//! What a growing selection takes, step by step: a name, its contact, the
//! branch that this stands in, the rung, the routine.

use std::ops::Range;

use ::ladder::text::branches as branches_of;
use ::ladder::{Element, Format, Rung};
use logic::notation::{Lexer, TokenKind};
use source::Span;

use crate::{Ladder, Scenario, Spec, folds_in_scenario};

/// The stretches around the byte `offset` of a ladder, each inside the next.
pub fn selections_in_ladder(ladder: &Ladder, offset: usize) -> Vec<Span> {
    let mut spans = vec![Span::new(0, ladder.text.len())];
    let program = ladder.program();
    spans.extend(ladder.names().at(offset).map(|it| it.span));
    if let Some(place) = ladder.names().element_at(offset)
        && let Some((rung, element)) = crate::element(program, place)
    {
        spans.push(rung.place(element.within));
    }
    if let Some(place) = ladder.rung_at(offset)
        && let Some((routine, rung)) = ladder.rung(place)
    {
        spans.extend([rung.span, routine.span]);
        let unit = program.routines.iter().filter(|it| it.unit == routine.unit);
        spans.extend(unit.map(|it| it.span).reduce(Span::cover).map(|unit| {
            match ladder.unit_name(routine) {
                Some(name) if program.format == Format::Ladder => unit.cover(name),
                _ => unit,
            }
        }));
        let text = ladder.text.get(rung.span.range()).unwrap_or_default();
        let branches = match program.format {
            Format::Ladder => branches(text, &IN_RUNGS),
            Format::L5x | Format::L5k | Format::NeutralText => branches(text, &IN_NEUTRAL_TEXT),
            Format::Plcopen | Format::Ascii | Format::Unknown => Vec::new(),
        };
        spans.extend(branches.into_iter().map(|it| moved(it, rung.span)));
        if program.format == Format::Plcopen {
            spans.extend(drawn_branches(rung, offset));
        }
    } else {
        let mut declarations = program.declarations.iter();
        let declared = declarations.find(|it| it.span.touches(offset));
        spans.extend(declared.map(|it| it.span));
    }
    chain(spans, offset)
}

/// The stretches around the byte `offset` of a spec, each inside the next.
pub fn selections_in_spec(spec: &Spec, offset: usize) -> Vec<Span> {
    let mut spans = vec![Span::new(0, spec.text.len())];
    let places = &spec.reading.places;
    spans.extend(places.mention_at(offset).map(|it| it.span));
    spans.extend(places.sections.iter().map(|it| it.span));
    match places.rules.iter().find(|it| it.span.touches(offset)) {
        Some(rule) => {
            let text = spec.text.get(rule.span.range()).unwrap_or_default();
            let sides = branches(text, &IN_RULES);
            spans.extend(sides.into_iter().map(|it| moved(it, rule.span)));
            spans.push(rule.span);
        }
        None => spans.extend(line(&spec.text, offset)),
    }
    chain(spans, offset)
}

/// The stretches around the byte `offset` of a scenario, each inside the next: a
/// name, what is done or expected of it, all that is, the step, the steps around
/// it.
pub fn selections_in_scenario(scenario: &Scenario, offset: usize) -> Vec<Span> {
    let text = &*scenario.text;
    let mut spans = vec![Span::new(0, text.len())];
    spans.extend(scenario.name_at(offset).map(|it| it.span));
    spans.extend(line(text, offset));
    spans.extend(folds_in_scenario(scenario).iter().map(|it| it.span));
    if let Some(step) = scenario
        .step_at(offset)
        .and_then(|at| scenario.steps().get(at))
    {
        spans.push(step.span);
        let said = text.get(step.span.range()).unwrap_or_default();
        let sides = branches(said, &IN_STEPS);
        spans.extend(sides.into_iter().map(|it| moved(it, step.span)));
        let tokens = crate::statement::code(said, 0..said.len());
        let arrow = tokens.iter().find(|it| it.kind == TokenKind::DoubleArrow);
        if let Some(Range {
            start: end,
            end: start,
        }) = arrow.map(|it| it.span.range())
        {
            let trimmed = |from: usize, to: usize| {
                let part = &said[from..to];
                let from = from + part.len() - part.trim_start().len();
                let to = from + part.trim().len();
                moved(Span::new(from, to), step.span)
            };
            spans.extend([trimmed(0, end), trimmed(start, said.len())]);
        }
    }
    chain(spans, offset)
}

fn moved(span: Span, by: Span) -> Span {
    let (start, range) = (by.range().start, span.range());
    Span::new(start + range.start, start + range.end)
}

/// Those that hold the byte, from the smallest on, each inside the next.
fn chain(mut spans: Vec<Span>, offset: usize) -> Vec<Span> {
    spans.retain(|it| it.touches(offset) && !it.is_empty());
    spans.sort_by_key(|it| it.len());
    let mut chain: Vec<Span> = Vec::new();
    for span in spans {
        let holds =
            |inner: &Span| *inner != span && span.start <= inner.start && inner.end <= span.end;
        if chain.last().is_none_or(holds) {
            chain.push(span);
        }
    }
    chain
}

/// The line of the byte `offset`, blanks around it left out.
fn line(text: &str, offset: usize) -> Option<Span> {
    let start = text
        .get(..offset)?
        .rfind(['\n', '\r'])
        .map_or(0, |at| at + 1);
    let rest = text.get(start..)?;
    let line = rest.split(['\n', '\r']).next().unwrap_or_default();
    let said = line.trim();
    let at = start + line.len() - line.trim_start().len();
    (!said.is_empty()).then(|| Span::new(at, at + said.len()))
}

/// The branches of a rung of which the elements stand one by one in the text, as
/// far as those of a branch stand together.
fn drawn_branches(rung: &Rung, offset: usize) -> Vec<Span> {
    let elements: Vec<_> = rung.network.elements().skip(1).collect();
    let at = elements
        .iter()
        .find(|(_, it)| rung.place(it.within).touches(offset));
    let Some((at, _)) = at else {
        return Vec::new();
    };
    let groups = branches_of(&rung.network).into_iter();
    let around = groups
        .filter(|group| group.contains(at))
        .filter_map(|group| {
            let own = group
                .iter()
                .map(|at| rung.place(rung.network.element(*at).within));
            let span = own.reduce(Span::cover)?;
            let strange = |(at, it): &&(_, &Element)| {
                let its = rung.place(it.within);
                !group.contains(at) && its.start < span.end && span.start < its.end
            };
            elements.iter().find(strange).is_none().then_some(span)
        });
    around.collect()
}

/// How a notation writes branches.
struct Signs {
    open: TokenKind,
    close: TokenKind,
    /// What stands between the members of a branch.
    between: &'static [TokenKind],
}

const IN_RUNGS: Signs = Signs {
    open: TokenKind::Open,
    close: TokenKind::Close,
    between: &[
        TokenKind::Plus,
        TokenKind::Comma,
        TokenKind::Arrow,
        TokenKind::Colon,
    ],
};

const IN_NEUTRAL_TEXT: Signs = Signs {
    open: TokenKind::OpenBracket,
    close: TokenKind::CloseBracket,
    between: &[TokenKind::Comma],
};

const IN_RULES: Signs = Signs {
    open: TokenKind::Open,
    close: TokenKind::Close,
    between: &[TokenKind::Plus, TokenKind::Yields, TokenKind::Colon],
};

const IN_STEPS: Signs = Signs {
    open: TokenKind::Open,
    close: TokenKind::Close,
    between: &[TokenKind::Comma, TokenKind::DoubleArrow],
};

/// All branches in `text`, with their signs, and the members of each.
fn branches(text: &str, signs: &Signs) -> Vec<Span> {
    let mut found = Vec::new();
    // The branches that are open: their first sign, and the member so far.
    let mut open: Vec<(Span, Option<Span>)> = vec![(Span::at(0), None)];
    let mut lexer = Lexer::new(text);
    while let Some(token) = lexer.take() {
        if matches!(token.kind, TokenKind::Comment | TokenKind::LineEnd) {
            continue;
        }
        let closes = token.kind == signs.close && open.len() > 1;
        let mut taken = token.span;
        if token.kind == signs.open {
            open.push((token.span, None));
            continue;
        }
        if closes && let Some((first, member)) = open.pop() {
            taken = first.cover(token.span);
            found.extend(member);
            found.push(taken);
        }
        if let Some((_, member)) = open.last_mut() {
            if signs.between.contains(&token.kind) {
                found.extend(member.take());
            } else {
                *member = Some(member.map_or(taken, |it| it.cover(taken)));
            }
        }
    }
    found.extend(open.into_iter().filter_map(|(_, member)| member));
    found
}

#[cfg(test)]
mod tests {
    use logic::Budget;

    use super::*;

    fn cut(text: &str) -> (String, usize) {
        let offset = text.find("$0").expect("a cursor");
        (text.replace("$0", ""), offset)
    }

    fn shown(text: &str, spans: &[Span]) -> Vec<String> {
        spans.iter().map(|it| text[it.range()].to_owned()).collect()
    }

    fn in_ladder(text: &str) -> Vec<String> {
        let (text, offset) = cut(text);
        let ladder = Ladder::read(text.as_str().into(), &Budget::default());
        shown(&text, &selections_in_ladder(&ladder, offset))
    }

    #[test]
    fn from_a_name_over_branches_to_the_rung_and_the_routine() {
        assert_eq!(
            in_ladder("program P\nrung: (s + /v$01*a) * /ls2 -> v1\nrung: a -> b\n"),
            [
                "v1",
                "/v1",
                "/v1*a",
                "(s + /v1*a)",
                "(s + /v1*a) * /ls2",
                "rung: (s + /v1*a) * /ls2 -> v1",
                "rung: (s + /v1*a) * /ls2 -> v1\nrung: a -> b",
                "P\nrung: (s + /v1*a) * /ls2 -> v1\nrung: a -> b",
                "program P\nrung: (s + /v1*a) * /ls2 -> v1\nrung: a -> b\n",
            ]
        );
    }

    #[test]
    fn branches_of_neutral_text_are_in_brackets() {
        let found = in_ladder("[XIC(a)XIO(b$0),XIC(c)]OTE(d);\nXIC(d)OTE(e);\n");
        assert_eq!(
            found[..5],
            [
                "b",
                "XIO(b)",
                "XIC(a)XIO(b)",
                "[XIC(a)XIO(b),XIC(c)]",
                "[XIC(a)XIO(b),XIC(c)]OTE(d);"
            ]
        );
    }

    #[test]
    fn a_declaration_is_one_thing() {
        assert_eq!(
            in_ladder("input $0s %I0 // Start\nrung: s -> b"),
            ["s", "input s %I0", "input s %I0 // Start\nrung: s -> b"]
        );
    }

    #[test]
    fn in_a_spec_from_a_name_to_its_rule_and_section() {
        let (text, offset) = cut("Step X0\nTransitions:\nt1: X0*(a + $0b) |- @X0\nt2: X0 |-\n");
        let spec = Spec::read(text.as_str().into());
        assert_eq!(
            shown(&text, &selections_in_spec(&spec, offset)),
            [
                "b",
                "(a + b)",
                "X0*(a + b)",
                "t1: X0*(a + b) |- @X0",
                "Transitions:\nt1: X0*(a + b) |- @X0\nt2: X0 |-",
                &text,
            ]
        );
        let (text, offset) = cut("Step X$00 for v1\r\nStep X1\r\n");
        let spec = Spec::read(text.as_str().into());
        assert_eq!(
            shown(&text, &selections_in_spec(&spec, offset)),
            ["X0", "Step X0 for v1", &text]
        );
    }

    #[test]
    fn in_a_scenario_from_a_name_to_its_step_and_those_around() {
        let (text, offset) = cut("// x\non s, off b => on v$01, off h // y\nscan\n");
        let scenario = Scenario::read(text.as_str().into());
        assert_eq!(
            shown(&text, &selections_in_scenario(&scenario, offset)),
            [
                "v1",
                "on v1",
                "on v1, off h",
                "on s, off b => on v1, off h",
                "on s, off b => on v1, off h // y",
                "on s, off b => on v1, off h // y\nscan",
                &text,
            ]
        );
    }

    #[test]
    fn every_selection_holds_the_one_before() {
        let text = "rung: ((a + b) * [c -> TON(t1, 5s), (x -> y";
        let ladder = Ladder::read(text.into(), &Budget::default());
        for offset in 0..=text.len() {
            let chain = selections_in_ladder(&ladder, offset);
            assert_eq!(chain.last(), Some(&Span::new(0, text.len())));
            for pair in chain.windows(2) {
                assert_eq!(pair[0].cover(pair[1]), pair[1]);
            }
        }
    }
}
