//! Every fixture, asked at every place: nothing fails, what is offered fits, and
//! whatever is renamed says the same afterwards.

use std::fs;
use std::path::{Path, PathBuf};

use ide::navigate::{self, Pair};
use ide::symbols::symbols_of_scenario;
use ide::{
    Asked, Extent, Ladder, Run, RunOn, Scenario, Spec, actions_in_scenario, complete_in_ladder,
    complete_in_scenario, complete_in_spec, edited, edits_in_scenario, folds_in_scenario,
    hints_in_scenario, hover_in_scenario, lay_out_ladder, lay_out_scenario, lay_out_spec,
    lenses_in_scenario, next_at, rename_in_ladder, rename_in_scenario, rename_in_spec,
    selections_in_scenario, signature, tokens_in_scenario,
};
use logic::Budget;
use recovery::successions::Evidence;
use source::Span;

fn fixtures(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).expect("the fixtures") {
        let path = entry.expect("a fixture").path();
        match path.is_dir() {
            true => fixtures(&path, found),
            false => found.push(path),
        }
    }
}

/// The texts of all fixtures with one of these endings.
fn texts(endings: &[&str]) -> Vec<(PathBuf, String)> {
    let mut found = Vec::new();
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fixtures");
    fixtures(&folder, &mut found);
    found.sort();
    found.retain(|path| {
        let ending = path.extension().and_then(|it| it.to_str());
        ending.is_some_and(|it| endings.contains(&it))
    });
    let read = |path: PathBuf| Some((path.clone(), fs::read_to_string(path).ok()?));
    let texts: Vec<_> = found.into_iter().filter_map(read).collect();
    assert!(!texts.is_empty(), "no fixture ends in {endings:?}");
    texts
}

/// A name that no fixture has.
const NEW: &str = "zz_new";

#[test]
fn ladders_answer_everywhere() {
    let budget = Budget::default();
    let mut renamed = 0;
    for (path, text) in texts(&["ladder", "txt", "L5X", "L5K", "xml"]) {
        let ladder = Ladder::read(text.as_str().into(), &budget);
        for offset in (0..=text.len()).step_by(1 + text.len() / 500) {
            if let Some(found) = complete_in_ladder(&ladder, offset) {
                assert!(found.span.touches(offset) || !text.is_char_boundary(offset));
            }
            signature(&ladder, offset);
        }
        let mut names: Vec<_> = ladder.names().all().iter().collect();
        names.dedup_by(|a, b| a.name == b.name);
        for mention in names.iter().step_by(1 + names.len() / 20) {
            let offset = mention.span.range().start;
            let Some(Ok(renaming)) = rename_in_ladder(&ladder, None, offset, NEW, &budget) else {
                continue;
            };
            // And back again, but for the case of letters and needless quotes.
            let new = edited(&text, &renaming.ladder);
            let again = Ladder::read(new.as_str().into(), &budget);
            let place = new.find(NEW).expect("the new name");
            let back = rename_in_ladder(&again, None, place, &renaming.old, &budget);
            let back = match back.expect("a name") {
                Ok(back) => back,
                // A fixture may have names that nobody should give.
                Err(why) if why.0.contains("is a word of the language") => continue,
                Err(why) => panic!("{}: {why:?}", path.display()),
            };
            let same = |text: &str| text.to_lowercase().replace('"', "");
            assert_eq!(
                same(&edited(&new, &back.ladder)),
                same(&text),
                "{}",
                path.display()
            );
            renamed += 1;
        }
    }
    assert!(renamed > 100, "only {renamed} names could be renamed");
}

#[test]
fn what_is_cut_or_holds_odd_characters_answers_too() {
    let budget = Budget::default();
    for (_, text) in texts(&["ladder", "txt", "L5X", "L5K", "xml", "grafcet"]) {
        for part in 1..4 {
            let mut cut: String = text.chars().take(text.chars().count() * part / 4).collect();
            cut += ["\u{1f6d1}", "\"\u{e4}", "<![CDATA[\u{fc}"][part - 1];
            let ladder = Ladder::read(cut.as_str().into(), &budget);
            let spec = Spec::read(cut.as_str().into());
            for back in 0..12 {
                // Inside of characters, too, and past the end.
                let offset = (cut.len() + 2).saturating_sub(back);
                complete_in_ladder(&ladder, offset);
                complete_in_spec(&spec, Some(&ladder), offset, Evidence::Possible, &budget);
                next_at(&spec, &ladder, offset, Evidence::Possible, &budget);
                signature(&ladder, offset);
                rename_in_ladder(&ladder, Some(&spec), offset, "\u{e4}", &budget);
                rename_in_spec(&spec, Some(&ladder), offset, NEW, &budget);
                lay_out_ladder(&ladder, Extent::Statements(Span::new(offset / 2, offset)));
                lay_out_spec(&spec, Extent::Line(offset));
            }
            let names = ladder.names().all().iter();
            for mention in names.step_by(1 + ladder.names().all().len() / 5) {
                let offset = mention.span.range().start;
                rename_in_ladder(&ladder, None, offset, NEW, &budget);
            }
        }
    }
}

#[test]
fn specs_answer_everywhere() {
    let budget = Budget::default();
    for (path, text) in texts(&["grafcet"]) {
        let spec = Spec::read(text.as_str().into());
        let ladder = fs::read_to_string(path.with_extension("ladder")).unwrap_or_default();
        let ladder = Ladder::read(ladder.into(), &budget);
        for offset in (0..=text.len()).step_by(1 + text.len() / 500) {
            let found = complete_in_spec(&spec, Some(&ladder), offset, Evidence::Possible, &budget);
            assert!(found.is_none_or(|it| it.span.range().end <= text.len()));
            next_at(&spec, &ladder, offset, Evidence::Possible, &budget);
            if let Some(Ok(renaming)) = rename_in_spec(&spec, None, offset, NEW, &budget) {
                let new = Spec::read(edited(&text, &renaming.spec).into());
                assert_eq!(
                    new.reading.diagnostics.len(),
                    spec.reading.diagnostics.len()
                );
            }
        }
    }
}

/// Everything that can be asked about a scenario at a place; how often something
/// was renamed, and said the same afterwards.
fn asked_at(scenario: &Scenario, pair: Pair<'_>, run: &Run, offset: usize) -> usize {
    let budget = Budget::default();
    let length = scenario.text.len();
    if let Some(found) = complete_in_scenario(scenario, pair, &[], offset) {
        assert!(found.span.range().end <= length);
    }
    let own = RunOn { run_on: pair, run };
    if let Some(hover) = hover_in_scenario(scenario, pair, own, offset, &budget) {
        assert!(hover.span.touches(offset));
    }
    let jumps = [
        navigate::definition_in_scenario(scenario, pair, offset),
        navigate::declaration_in_scenario(scenario, pair, offset),
    ];
    for jump in jumps.into_iter().flatten() {
        assert!(jump.from.touches(offset) && !jump.to.is_empty());
    }
    let lit = navigate::highlights_in_scenario(scenario, pair, offset);
    assert!(lit.is_empty() || lit.iter().any(|(span, _)| span.touches(offset)));
    let chain = selections_in_scenario(scenario, offset);
    for pair in chain.windows(2) {
        assert_eq!(pair[0].cover(pair[1]), pair[1]);
    }
    let asked = Asked {
        span: Span::at(offset),
        findings: &[],
        weakest: Evidence::Possible,
        budget: &budget,
    };
    actions_in_scenario(scenario, run, None, asked);
    lay_out_scenario(scenario, Extent::Line(offset));
    lay_out_scenario(scenario, Extent::Statements(Span::new(offset / 2, offset)));
    let renaming = rename_in_scenario(scenario, pair, offset, NEW, &budget);
    let Some(Ok(renaming)) = renaming else {
        return 0;
    };
    let edits = edits_in_scenario(scenario, &renaming).expect("a name that is free");
    let new = Scenario::read(edited(&scenario.text, &edits).into());
    assert_eq!(new.names().count(), scenario.names().count());
    let ladder = pair.ladder.map(|it| edited(&it.text, &renaming.ladder));
    let ladder = Ladder::read(ladder.unwrap_or_default().into(), &budget);
    let renamed = Pair {
        ladder: pair.ladder.map(|_| &ladder),
        ..pair
    };
    let again = Run::new(&new, renamed, &|| true);
    let went = |run: &Run| {
        run.simulation
            .as_ref()
            .map(|it| (it.rows.len(), it.failures().count()))
    };
    assert_eq!(went(&again), went(run));
    1
}

/// Everything that can be asked about a whole scenario.
fn asked_whole(scenario: &Scenario, pair: Pair<'_>, run: &Run) {
    let all = Span::new(0, scenario.text.len());
    hints_in_scenario(scenario, pair, run, all);
    lenses_in_scenario(scenario, pair, run, Some(0));
    run.findings(scenario, pair);
    for fold in folds_in_scenario(scenario) {
        assert!(scenario.text.get(fold.span.range()).is_some());
    }
    let mut end = 0;
    for token in tokens_in_scenario(scenario, pair) {
        assert!(token.span.start >= end && !token.span.is_empty());
        end = token.span.end;
    }
    for symbol in symbols_of_scenario(scenario) {
        assert_eq!(symbol.whole.cover(symbol.span), symbol.whole);
    }
}

#[test]
fn scenarios_answer_everywhere() {
    let budget = Budget::default();
    let mut renamed = 0;
    for (path, text) in texts(&["scenario"]) {
        // The hostile ones have nothing that they could run on.
        let ladder = fs::read_to_string(path.with_file_name("neutralization.ladder"));
        let ladder = ladder.ok().map(|it| Ladder::read(it.into(), &budget));
        let pair = Pair {
            ladder: ladder.as_ref(),
            spec: None,
        };
        let scenario = Scenario::read(text.as_str().into());
        let run = Run::new(&scenario, pair, &|| true);
        let runs = run.simulation.is_some();
        assert_eq!(runs, ladder.is_some(), "{}", path.display());
        asked_whole(&scenario, pair, &run);
        for offset in (0..=text.len()).step_by(3) {
            renamed += asked_at(&scenario, pair, &run, offset);
        }
    }
    assert!(renamed > 30, "only {renamed} names could be renamed");
}

#[test]
fn what_is_no_scenario_answers_too() {
    let budget = Budget::default();
    for (_, text) in texts(&["scenario", "ladder", "grafcet"]) {
        for part in 1..4 {
            let mut cut: String = text.chars().take(text.chars().count() * part / 4).collect();
            cut += ["\u{1f6d1}", "\"\u{e4}", "on s => \"on"][part - 1];
            let ladder = Ladder::read(text.as_str().into(), &budget);
            let spec = Spec::read(cut.as_str().into());
            let scenario = Scenario::read(cut.as_str().into());
            let pair = Pair {
                ladder: Some(&ladder),
                spec: Some(&spec),
            };
            let run = Run::new(&scenario, pair, &|| true);
            asked_whole(&scenario, pair, &run);
            for back in 0..12 {
                // Inside of characters, too, and past the end.
                let offset = (cut.len() + 2).saturating_sub(back);
                complete_in_scenario(&scenario, pair, &[], offset);
                let own = RunOn {
                    run_on: pair,
                    run: &run,
                };
                hover_in_scenario(&scenario, pair, own, offset, &budget);
                selections_in_scenario(&scenario, offset);
                lay_out_scenario(&scenario, Extent::Line(offset));
            }
        }
    }
}

#[test]
fn edits_lay_a_text_out_as_the_formatter_does() {
    for (path, text) in texts(&["ladder"]) {
        let ladder = Ladder::read(text.as_str().into(), &Budget::default());
        let Some(edits) = lay_out_ladder(&ladder, Extent::Whole) else {
            // Some fixtures only bear the ending.
            let format = ladder.program().format;
            assert_ne!(format, ladder::Format::Ladder, "{}", path.display());
            continue;
        };
        let laid = ladder::text::format(&text).text;
        assert_eq!(edited(&text, &edits), laid, "{}", path.display());
        let all = Extent::Statements(Span::new(0, text.len()));
        let parts = lay_out_ladder(&ladder, all).expect("a layout");
        assert_eq!(edited(&text, &parts), laid, "{}", path.display());
    }
    for (path, text) in texts(&["scenario"]) {
        let edits = lay_out_scenario(&Scenario::read(text.as_str().into()), Extent::Whole);
        let laid = scenario::format(&text).text;
        assert_eq!(edited(&text, &edits), laid, "{}", path.display());
    }
    for (path, text) in texts(&["grafcet"]) {
        let edits = lay_out_spec(&Spec::read(text.as_str().into()), Extent::Whole);
        assert_eq!(
            edited(&text, &edits),
            grafcet::format(&text).text,
            "{}",
            path.display()
        );
    }
}
