//! Reading a text again after an edit: the same comes out as from reading all
//! of it, and what did not change is not read.

use std::sync::Arc;

use ladder::{Edition, Format, Network, reread};
use proptest::collection::vec;
use proptest::prelude::*;
use proptest::sample::{Index, select};

/// The text with `$old$new$` standing for an edit: before it and after it.
fn edited(marked: &str) -> (String, String) {
    let parts: Vec<_> = marked.split('$').collect();
    let [before, old, new, behind] = parts[..] else {
        panic!("one edit in {marked}")
    };
    (
        format!("{before}{old}{behind}"),
        format!("{before}{new}{behind}"),
    )
}

/// The edition after an edit, which must be what reading its text gives.
#[track_caller]
fn next(before: &Edition, text: &str) -> Edition {
    let edition = reread(before, text.into());
    assert_eq!(edition.reading, ladder::read(text.as_bytes()), "{text}");
    edition
}

/// How many statements are read anew after an edit, and of how many.
#[track_caller]
fn read_anew(marked: &str) -> (usize, usize) {
    let (before, after) = edited(marked);
    let before = Edition::new(before.as_str().into());
    (next(&before, &after).read_anew, before.read_anew)
}

fn networks(edition: &Edition) -> Vec<Arc<Network>> {
    let rungs = edition.reading.program.rungs();
    rungs.map(|(_, rung)| rung.network.clone()).collect()
}

/// A letter for each rung after the edit: `=` if its network is one of those
/// before it, `+` if it is new.
#[track_caller]
fn kept(marked: &str) -> String {
    let (before, after) = edited(marked);
    let before = Edition::new(before.as_str().into());
    let (after, before) = (networks(&next(&before, &after)), networks(&before));
    let is_kept = |it: &Arc<Network>| before.iter().any(|before| Arc::ptr_eq(it, before));
    let sign = |it: &Arc<Network>| if is_kept(it) { '=' } else { '+' };
    after.iter().map(sign).collect()
}

#[test]
fn typing_in_a_rung_reads_that_rung() {
    assert_eq!(
        read_anew("rung: a -> b\nrung: c$$1$ -> d\nrung: e -> f"),
        (1, 3)
    );
    assert_eq!(
        read_anew("rung: a$ -> b$$\nrung: c -> d\nrung: e -> f"),
        (1, 3)
    );
    assert_eq!(read_anew("rung: a -> b // $so$such$\nrung: c -> d"), (1, 2));
    assert_eq!(
        read_anew("rung: a -> b\r\nrung: c -> d\r\nrung: e -> f$$*$"),
        (1, 3)
    );
    assert_eq!(
        read_anew("\u{feff}rung: a -> b\nrung: $/$$c -> d\nrung: x"),
        (1, 3)
    );
}

#[test]
fn a_new_rung_is_read_with_one_beside_it() {
    assert_eq!(
        read_anew("rung: a -> b\n$$rung: x -> y\n$rung: c -> d"),
        (2, 2)
    );
    assert_eq!(
        read_anew("rung: a -> b\n$rung: x -> y\n$$rung: c -> d"),
        (1, 3)
    );
    assert_eq!(read_anew("input a\n$$rung: x -> y\n$rung: c -> d"), (2, 2));
}

#[test]
fn a_comment_is_read_with_the_rung_below() {
    assert_eq!(
        read_anew("rung: a -> b\n// $One$Two$\nrung: c -> d\nrung: e -> f"),
        (2, 3)
    );
    assert_eq!(
        read_anew("rung: a -> b\n// $One$Two$\n\nrung: c -> d\nrung: e -> f"),
        (1, 3)
    );
    assert_eq!(
        read_anew("$$//$rung: a -> b\nrung: c -> d\nrung: e -> f"),
        (1, 3)
    );
}

#[test]
fn nothing_is_read_where_nothing_changed() {
    assert_eq!(read_anew("rung: a -> b\n$$$rung: c -> d"), (0, 2));
}

#[test]
fn what_concerns_other_rungs_has_them_read() {
    for all in [
        "$$input$ a %I0\nrung: %I0 -> b",
        "rung: a -> TON(t, 5s)\nrung: b -> c\nrung: t.$x$DN$ -> d",
        "rung: a -> b\nrung: b -> c\nrung: %$M$I$0.1 -> d",
        "rung: a -> b\nroutine $R$S$\nrung: b -> c",
    ] {
        let (after, _) = edited(all);
        let statements = after.lines().count();
        assert_eq!(read_anew(all).0, statements, "{all}");
    }
    // What is said elsewhere too is said all the same.
    let text = "rung: a -> TON(t, 5s)\nrung: t.DN -> c\nrung: t.$x$DN$ -> d";
    assert_eq!(read_anew(text), (1, 3));
    let text = "rung: %I0.1 -> c\nrung: %I0.1*$/$$a -> d";
    assert_eq!(read_anew(text), (1, 2));
}

#[test]
fn rungs_that_say_the_same_keep_their_networks() {
    assert_eq!(kept("rung: a -> b\nrung: c$$1$ -> d\nrung: e -> f"), "=+=");
    assert_eq!(kept("rung: a -> b\n$$rung: x -> y\n$rung: e -> f"), "=+=");
    assert_eq!(kept("rung: a -> b\n$rung: x -> y\n$$rung: e -> f"), "==");
    assert_eq!(kept("$rung: x -> y\n$$rung: e -> f\nrung: g -> h"), "==");
    assert_eq!(kept("rung: a -> b // $one$two$\nrung: e -> f"), "==");
    assert_eq!(
        kept("$$input c %I0 // C\n$rung: a -> b\nrung: %I0 -> f"),
        "=+"
    );
    assert_eq!(
        kept("program P\nroutine $R$S$\nrung: a -> b\nrung: c -> d"),
        "++"
    );
}

#[test]
fn in_other_formats_too() {
    assert_eq!(
        kept("XIC(a)OTE(b);\n$$XIC(x)OTE(y);\n$XIC(c)OTE(d);\n"),
        "=+="
    );
    let file = end_to_end::path("fixtures/neutralization/neutralization.xml");
    let text = std::fs::read_to_string(&file).expect("a fixture");
    let before = Edition::new(text.as_str().into());
    let after = next(
        &before,
        &text.replacen("<variable>s</variable>", "<variable>start</variable>", 1),
    );
    assert_eq!(after.reading.program.format, Format::Plcopen);
    let pairs: Vec<_> = networks(&before)
        .into_iter()
        .zip(networks(&after))
        .collect();
    let changed = pairs
        .iter()
        .filter(|(old, new)| !Arc::ptr_eq(old, new))
        .count();
    assert_eq!((changed, pairs.len() > 2), (1, true));
}

#[test]
fn a_rung_that_names_its_place_is_another_one_when_it_moves() {
    assert_eq!(
        kept("rung: a$$1$ -> b\nrung: x y -> c\nrung: e -> f"),
        "++="
    );
    assert_eq!(
        kept("rung: a$1$2$ -> b\nrung: x y -> c\nrung: e -> f"),
        "+=="
    );
}

/// Lines of a text, right and wrong.
const LINES: &[&str] = &[
    "",
    "  ",
    "// above",
    "//",
    "program P",
    "program",
    "routine R",
    "routine M main",
    "routine \"R\" block // why",
    "input a %I0 // A",
    "input a",
    "output b : BOOL = 0",
    "internal w %MW4",
    "input t : TIMER",
    "variable %M5",
    "input (",
    "rung: a -> b",
    "rung \"title\": a * /b -> c // behind",
    "RUNG label l: a -> set b, (c -> reset b)",
    "rung: t.DN -> TON(t, 5s), CTU(c1, 3)",
    "rung: a -> TON(%M5, 5s)",
    "rung: %M5.Q*%MW4.3 + %mw4.3 -> %QX0.1",
    "rung: %qx0.1 + %MX7.1.2 + %mx7.1 -> x",
    "rung: rise(a*b) + x >= 5 -> y := y + 1, jump l",
    "rung: a",
    "rung:",
    "rung",
    "rung: a b -> c",
    "rung: (a -> FOO(x), BAR()",
    "  + c -> d",
    "  * d // in it",
    "none of it",
    "\"open",
];

/// What is typed: parts of the above, and what may join or part lines.
const PIECES: &[&str] = &[
    "\n",
    "\r\n",
    "\r",
    "\n\n",
    " ",
    "\t",
    "\u{feff}",
    "\u{a0}",
    "a",
    "b",
    "é",
    ".",
    ".Q",
    ".DN",
    "t",
    "%",
    "%I0",
    "%i0",
    "%MW4",
    "5",
    "5e+",
    "16#",
    "T#",
    "\"",
    "//",
    "/",
    "*",
    "+",
    "(",
    ")",
    "->",
    ":",
    "|",
    "<",
    "rung",
    "rung:",
    "rung: a -> b\n",
    "input",
    "input z %I0\n",
    "\ninput z\n",
    "program",
    "routine",
    "\nroutine N\n",
    "label l",
    "jump l",
    "TON(t, 5s)",
    "x y",
    "// c\n",
];

fn text() -> impl Strategy<Value = String> {
    let end = select(&["\n", "\n", "\n", "\r\n", "\r"][..]);
    let line = (select(LINES), end).prop_map(|(line, end)| format!("{line}{end}"));
    (prop::bool::weighted(0.1), vec(line, 0..14)).prop_map(|(mark, lines)| {
        format!(
            "{}rung: a -> b\n{}",
            if mark { "\u{feff}" } else { "" },
            lines.concat()
        )
    })
}

/// An edit: where, how many characters it takes away, what it puts there.
fn edit() -> impl Strategy<Value = (Index, usize, String)> {
    let taken = prop_oneof![4 => Just(0), 4 => 1..4_usize, 1 => 4..40_usize];
    let typed = prop_oneof![
        6 => select(PIECES).prop_map(str::to_owned),
        2 => select(LINES).prop_map(|line| format!("{line}\n")),
        2 => Just(String::new()),
    ];
    (any::<Index>(), taken, typed)
}

fn apply(text: &str, (at, taken, typed): &(Index, usize, String)) -> String {
    let mut places: Vec<_> = text.char_indices().map(|(at, _)| at).collect();
    places.push(text.len());
    let first = at.index(places.len());
    let last = (first + taken).min(places.len() - 1);
    let mut text = text.to_owned();
    text.replace_range(places[first]..places[last], typed);
    text
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 500,
        failure_persistence: None,
        ..ProptestConfig::default()
    })]

    #[test]
    fn any_edits_leave_what_reading_the_last_text_gives(text in text(), edits in vec(edit(), 1..10)) {
        let mut edition = Edition::new(text.as_str().into());
        let mut text = text;
        for edit in &edits {
            text = apply(&text, edit);
            edition = reread(&edition, text.as_str().into());
            prop_assert_eq!(&edition.reading, &ladder::read(text.as_bytes()), "{:?}", text);
        }
    }
}
