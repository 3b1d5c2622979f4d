//! What holds for every text, however broken.

use ladder::Reading;
use proptest::prelude::*;

use crate::{corpus, shown};

/// Whether every place named lies in the text, between characters.
fn places_are_inside(text: &[u8], reading: &Reading) {
    let inside = |span: source::Span| {
        span.range().end <= text.len()
            && std::str::from_utf8(text).is_ok_and(|text| text.get(span.range()).is_some())
    };
    for it in &reading.diagnostics {
        assert!(inside(it.span), "{it:?}");
        assert!(it.related.iter().all(|related| inside(related.span)));
    }
    for routine in &reading.program.routines {
        assert!(inside(routine.span), "{}", routine.scope);
    }
    for (_, rung) in reading.program.rungs() {
        assert!(inside(rung.span), "rung {}", rung.number);
        for (_, element) in rung.network.elements() {
            assert!(inside(rung.place(element.within)), "{element:?}");
            for operand in shown::operands(element) {
                assert!(inside(rung.place(operand.within)), "{operand:?}");
            }
        }
    }
    for it in reading.program.declarations.iter() {
        assert!(inside(it.span), "{it:?}");
    }
    for chart in &reading.program.charts {
        assert!(inside(chart.span));
        assert!(chart.transitions.iter().all(|it| inside(it.span)));
    }
}

/// A tag path without an index that reading would write otherwise.
fn tag() -> impl Strategy<Value = String> {
    prop_oneof![
        "[a-d]",
        "[A-D]\\.[x-z]\\.[0-9]",
        "[A-D]\\[[0-9]\\]\\.DN",
        "Local:[1-3]:[IO]\\.Data\\.[0-7]",
    ]
}

/// A rung: contacts, branches and coils, with blanks in odd places.
fn rung() -> impl Strategy<Value = String> {
    let contact = (prop_oneof!["XIC", "XIO", "ONS"], tag()).prop_map(|(m, t)| format!("{m}({t}) "));
    let comparison = (tag(), -9..9).prop_map(|(t, n)| format!("EQU( {t} ,{n})"));
    let leaf = prop_oneof![contact, comparison];
    let series = leaf.prop_recursive(4, 24, 4, |inner| {
        prop_oneof![
            prop::collection::vec(inner.clone(), 0..4).prop_map(|items| items.concat()),
            prop::collection::vec(inner, 1..4).prop_map(|legs| format!("[{} ]", legs.join(" ,"))),
        ]
    });
    (series, tag()).prop_map(|(series, tag)| format!("{series}OTE({tag});\n"))
}

proptest! {
    #[test]
    fn an_operand_stands_where_it_says(rungs in prop::collection::vec(rung(), 1..8)) {
        let text = rungs.concat();
        let reading = ladder::read(text.as_bytes());
        places_are_inside(text.as_bytes(), &reading);
        prop_assert_eq!(reading.diagnostics.len(), 0);
        prop_assert_eq!(reading.program.rungs().count(), rungs.len());
        for (_, rung) in reading.program.rungs() {
            for (_, element) in rung.network.elements() {
                for operand in shown::operands(element) {
                    let written = &text[rung.place(operand.within).range()];
                    prop_assert_eq!(written.to_lowercase(), operand.name.to_lowercase());
                }
            }
        }
    }

    #[test]
    fn no_text_is_too_odd(text in "[\\[\\](),;?:.'\"$#a \n]{0,40}|(XIC|OTE|TON|[\\[\\](),;]|a|'){0,60}") {
        let text = format!("XIC(a)OTE(b);{text}");
        let reading = ladder::read(text.as_bytes());
        places_are_inside(text.as_bytes(), &reading);
    }

    #[test]
    fn no_fixture_cut_or_changed_is_too_odd(
        place in any::<prop::sample::Index>(),
        at in any::<prop::sample::Index>(),
        length in 0..60_usize,
        insert in "[<>/&;\\[\\]()\"'=a-z]{0,6}",
        cut in any::<bool>(),
    ) {
        let files = corpus::small_texts();
        let mut text = place.get(files).clone();
        let start = floor(&text, at.index(text.len()));
        let end = if cut { text.len() } else { floor(&text, (start + length).min(text.len())) };
        text.replace_range(start..end, &insert);
        let reading = ladder::read(text.as_bytes());
        places_are_inside(text.as_bytes(), &reading);
    }
}

fn floor(text: &str, at: usize) -> usize {
    (0..=at)
        .rev()
        .find(|&at| text.is_char_boundary(at))
        .unwrap_or(0)
}
