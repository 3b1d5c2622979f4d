//! Continuous and stored actions. Each test is a section of
//! `docs/evolution.md`.

use crate::run::{check, machine};

#[test]
fn continuous_actions_with_conditions_delays_and_limits() {
    check(
        "Step A
         Input a
         Output x, y, z
         Marking A
         Steps:
         A: a |- x
         A: |- y after 2s
         A: |- z until 3s",
        " -> A | z
         a 1s -> A | x z
         1s -> A | x y z
         /a 1s -> A | y",
    );
}

#[test]
fn an_output_is_on_while_one_of_its_actions_acts() {
    check(
        "Step A, B
         Input a, b
         Output x
         Marking A, B
         Steps:
         A: a |- x
         B: b |- x",
        " -> A B |
         a -> A B | x
         /a b -> A B | x
         /b -> A B |",
    );
}

#[test]
fn an_output_without_actions_is_off() {
    check(
        "Step A
         Input a
         Output x, y
         Marking A
         Steps:
         A: a |- x",
        " -> A |
         a -> A | x",
    );
    let machine = machine("Step A\nInput a\nOutput x, y\nMarking A\nSteps:\nA: a |- x");
    assert_eq!(
        ["a", "x", "y"].map(|it| machine.decides(it)),
        [false, true, true]
    );
}

#[test]
fn edges_in_conditions_of_continuous_actions_last_for_the_scan() {
    check(
        "Step A, B, C
         Transition t1, t2
         Input a
         Output x
         Marking A, C
         Transitions:
         t1: A*a |- @B
         t2: B*/a |- @A
         Steps:
         C: rise(a) |- x",
        // Although the scan has an evolution in which the edge is over.
        " -> A C |
         a -> B C | x
         -> B C |",
    );
}

#[test]
fn edges_in_conditions_of_continuous_actions_compare_stable_situations() {
    check(
        "Step A, B, C
         Transition t1, t2
         Input a
         Output x, y, z
         Marking A, C
         Transitions:
         t1: A*a |- @B
         t2: B*/a |- @A
         Steps:
         C: a |- x
         C: rise(x) |- y
         C: fall(B) |- z",
        // What has just been published, and the step that has just been left.
        " -> A C |
         a -> B C | x y
         -> B C | x
         /a -> A C | z
         -> A C |",
    );
}

#[test]
fn receptivities_read_outputs_as_they_were_published() {
    check(
        "Step A, B, C
         Transition t1, t2
         Input a
         Output x
         Marking A
         Transitions:
         t1: A*a |- @B
         t2: B*x |- @C
         Steps:
         B: |- x",
        "a -> B | x
         -> C |",
    );
}

#[test]
fn conditions_of_outputs_see_each_other_whatever_their_order() {
    let steps = "Step A\nInput a\nOutput x, y, z\nMarking A\nSteps:\n";
    let scans = "a -> A | x y z
                 /a -> A |";
    check(&format!("{steps}A: a |- x\nA: x |- y\nA: y |- z"), scans);
    check(&format!("{steps}A: y |- z\nA: x |- y\nA: a |- x"), scans);
}

#[test]
fn outputs_in_a_circle_see_each_other_as_published() {
    check(
        "Step A
         Input a, b
         Output x, y, z
         Marking A
         Steps:
         A: x + a |- x
         A: z + b |- y
         A: y |- z",
        "a b -> A | x y
         /a /b -> A | x z
         -> A | x y",
    );
}

#[test]
fn stored_actions_are_performed_in_transient_situations_too() {
    check(
        "Step A, B, C
         Transition t1, t2, t3
         Input a
         Output x, n
         Marking A
         Transitions:
         t1: A*a |- @B
         t2: B*a |- @C
         t3: C*/a |- @A
         Steps:
         B: |- set x
         B: |- n := n + 2 on deactivation
         A: |- reset x",
        " -> A |
         a -> C | x n=2
         /a -> A | n=2",
    );
}

#[test]
fn what_is_stored_is_read_by_the_next_evolution() {
    check(
        "Step A, B, C
         Transition t1, t2
         Input a
         Internal n
         Marking A
         Transitions:
         t1: A*a |- @B
         t2: B*n = 7 |- @C
         Steps:
         B: |- n := 7",
        "a -> C |",
    );
}

#[test]
fn the_initial_situation_is_activated_by_the_first_scan() {
    check(
        "Step A, B
         Transition t1, t2
         Input a
         Output x
         Marking A
         Transitions:
         t1: A*a |- @B
         t2: B*/a |- @A
         Steps:
         A: |- set x
         B: |- reset x",
        " -> A | x
         a -> B |
         /a -> A | x",
    );
}

#[test]
fn what_ends_gives_way_to_what_begins_and_a_reset_to_no_set() {
    check(
        "Step A, B
         Transition t1
         Input a
         Output x, y
         Marking A
         Transitions:
         t1: A*a |- @B
         Steps:
         A: |- reset x on deactivation
         B: |- set x
         B: |- reset y
         B: |- set y",
        "a -> B | x",
    );
}

#[test]
fn conditions_are_looked_at_before_anything_is_stored() {
    check(
        "Step A, B
         Transition t1
         Input a
         Output x, y
         Marking A
         Transitions:
         t1: A*a |- @B
         Steps:
         B: /y |- set x
         B: /x |- set y",
        "a -> B | x y",
    );
}

#[test]
fn actions_on_events_act_in_the_steps_that_are_active_when_they_come() {
    check(
        "Step A, B
         Transition t1
         Input a, b
         Output x, n
         Marking A
         Transitions:
         t1: A*a |- @B
         Steps:
         B: |- n := n + 1 on a
         B: b |- set x on rise(a)",
        // The first a makes B active; it was not active when a came.
        "a -> B |
         /a -> B |
         a -> B | n=1
         a -> B | n=1
         /a b -> B | n=1
         a -> B | x n=2",
    );
}

#[test]
fn an_output_with_actions_of_both_kinds_is_on_for_either() {
    check(
        "Step A
         Input a, b, c
         Output x
         Marking A
         Steps:
         A: a |- x
         A: |- set x on b
         A: |- reset x on c",
        "a -> A | x
         /a -> A |
         b -> A | x
         /b -> A | x
         c a -> A | x
         /a -> A |",
    );
}

#[test]
fn values_are_sums_of_numbers_and_names() {
    check(
        "Step A
         Input a, n
         Output s, d
         Marking A
         Steps:
         A: |- s := n + 3 - -2 on a
         A: |- d := -1 - n + s on fall(a)",
        "n=4 a -> A | s=9
         /a -> A | s=9 d=4",
    );
}
