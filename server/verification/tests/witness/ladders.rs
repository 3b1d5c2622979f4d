//! Small ladders, each with what can be seen of it.

use logic::Budget;
use proof::Limits;
use recovery::analyse;
use verification::witness::sights;

use crate::{assert_told, seen, told};

#[track_caller]
fn check(ladder: &str, expected: &str) {
    let analysis = seen(ladder, &[]);
    assert_told(&told(analysis.successions().iter()), expected);
}

#[test]
fn a_state_that_begins_a_while_after_another_has_ended_is_delayed() {
    // A copy of a, one scan late, keeps b off in the scan in which a ends.
    check(
        "input go\ninput ready\ninput done\noutput a\noutput b\ninternal late\n\
         rung: (go + a) * /done -> a\n\
         rung: (ready*/a*/late + b) * /go -> b\n\
         rung: a -> late\n",
        "
        b -> a  handover: on ready; on go
        a -> b  delayed: on go; on done; on ready; off go
        ",
    );
}

#[test]
fn a_state_that_the_next_rung_ends_a_scan_later_is_in_turn() {
    check(
        "input go\ninput next\noutput a\noutput b\n\
         rung: (go + a) * /b -> a\n\
         rung: (a*next + b) * /go -> b\n",
        "
        a -> b  handover: on go; on next; off go; scan
        b -> a  delayed: on next; on go; off go; on go; scan
        ",
    );
}

#[test]
fn the_values_of_a_step_register_begin_with_the_first() {
    check(
        "input go\ninput back\ninternal Seq : INT\n\
         rung: Seq = 0 * go -> Seq := 10\n\
         rung: Seq = 10 * back -> Seq := 20\n\
         rung: Seq = 20 * /go -> Seq := 0\n",
        "
        Seq=0 -> Seq=10  written: on go
        Seq=10 -> Seq=20  written: on go; on back
        Seq=20 -> Seq=0  written: on go; on back; off go
        ",
    );
}

#[test]
fn a_timer_takes_its_time() {
    check(
        "input go\ninternal T : TON\noutput a\noutput b\n\
         rung: (go + a) * /T.Q -> a\n\
         rung: a -> TON(T, 5s)\n\
         rung: (T.Q + b) * /go -> b\n",
        "
        a -> b  handover: on go; off go; scan
        b -> a  handover: on go; off go; scan; on go
        ",
    );
}

#[test]
fn what_the_limits_do_not_allow_stays_as_it_is() {
    let ladder = crate::text(crate::TANK);
    let program = ladder::read(ladder.as_bytes()).program;
    let analysis = analyse(&program, &Budget::default());
    let before = told(analysis.successions().iter());
    let limits = Limits {
        steps: 20_000,
        ..Limits::default()
    };
    let found = sights(&analysis, &[], &limits).expect("a translation");
    assert!(!found.is_whole && found.pairs.is_empty());
    let seeing = analysis.seeing(found);
    assert_eq!(told(seeing.successions().iter()), before);
}
