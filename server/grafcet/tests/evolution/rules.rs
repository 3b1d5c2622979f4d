//! The five rules of evolution, edges and time. Each test is a section of
//! `docs/evolution.md`.

use crate::run::check;

#[test]
fn all_that_can_be_cleared_is_cleared_at_once() {
    check(
        "Step A, B, C, D
         Transition t1, t2
         Input a
         Marking A, C
         Transitions:
         t1: A*a |- @B
         t2: C*a*(A) |- @D",
        // t2 sees A as it was before t1 was cleared.
        " -> A C |
         a -> B D |",
    );
}

#[test]
fn an_evolution_goes_on_until_it_is_stable() {
    check(
        "Step A, B, C
         Transition t1, t2, t3
         Input a
         Output x, y
         Marking A
         Transitions:
         t1: A*a |- @B
         t2: B*a |- @C
         t3: C*/a |- @A
         Steps:
         B: |- x
         C: |- y",
        // B is transient: x is never published.
        " -> A |
         a -> C | y
         /a -> A |",
    );
}

#[test]
fn the_first_scan_may_leave_the_initial_situation() {
    check(
        "Step A, B
         Transition t1
         Input a
         Output x
         Marking A
         Transitions:
         t1: A*a |- @B
         Steps:
         B: |- x",
        "a -> B | x",
    );
}

#[test]
fn edges_are_true_in_the_first_evolution_only() {
    check(
        "Step A, B, C
         Transition t1, t2
         Input a
         Marking A
         Transitions:
         t1: A*rise(a) |- @B
         t2: B*rise(a) |- @C",
        // One press, one step.
        " -> A |
         a -> B |
         a -> B |
         /a -> B |
         a -> C |",
    );
}

#[test]
fn before_the_first_scan_what_an_edge_looks_at_is_0() {
    check(
        "Step A, B, C, D
         Transition t1, t2
         Input a
         Marking A, C
         Transitions:
         t1: A*rise(/a) |- @B
         t2: C*fall(/a) |- @D",
        " -> B C |
         a -> B D |",
    );
}

#[test]
fn the_edge_of_a_steps_variable_comes_with_the_next_scan() {
    check(
        "Step A, B, C, D
         Transition t1, t2
         Input a
         Marking A, C
         Transitions:
         t1: A*a |- @B
         t2: C*rise(B) |- @D",
        " -> A C |
         a -> B C |
         -> B D |",
    );
}

#[test]
fn a_step_both_activated_and_deactivated_stays_active() {
    check(
        "Step A, B
         Transition t1, t2, t3
         Input a
         Output n
         Marking A, B
         Transitions:
         t1: A*rise(a) |- @B
         t2: B*rise(a) |- @A
         t3: B*fall(a) |- @B
         Steps:
         A: |- n := n + 1",
        // A and B change places, and nothing happens to them: the action on
        // activation is performed for the initial situation only.
        " -> A B | n=1
         a -> A B | n=1
         /a -> A B | n=1",
    );
}

#[test]
fn the_clock_of_a_step_that_stays_active_goes_on() {
    check(
        "Step A, B
         Transition again, done
         Input a
         Marking A
         Transitions:
         again: A*rise(a) |- @A
         done: A*3s/A |- @B",
        " -> A |
         a 2s -> A |
         1s -> B |",
    );
}

#[test]
fn a_step_that_is_left_and_entered_again_counts_anew() {
    check(
        "Step A, B, C
         Transition away, back, done
         Input a
         Output n
         Marking A
         Transitions:
         away: A*rise(a) |- @B
         back: B |- @A
         done: A*3s/A |- @C
         Steps:
         A: |- n := n + 1",
        // Away and back are two evolutions of one scan.
        " -> A | n=1
         a 2s -> A | n=2
         1s -> A | n=2
         2s -> C | n=2",
    );
}

#[test]
fn the_time_of_a_step_begins_with_the_scan_that_activates_it() {
    check(
        "Step A, B, C
         Transition t1, t2
         Marking A
         Transitions:
         t1: A*5s/A |- @B
         t2: B*0s/B*1s/B |- @C",
        // However long before the first scan the machine was made.
        "1h -> A |
         4999ms -> A |
         1ms -> B |
         1s -> C |",
    );
}

#[test]
fn sources_and_sinks() {
    check(
        "Step A
         Transition source, sink
         Input a, b
         Transitions:
         source: rise(a) |- @A
         sink: A*b |-",
        " -> |
         a -> A |
         /a -> A |
         a -> A |
         b -> |",
    );
}

#[test]
fn several_steps_before_and_after_a_transition() {
    check(
        "Step A, B, C, D
         Transition fork, join
         Input a, b
         Marking A
         Transitions:
         fork: A*a |- @B*@C
         join: B*C*b |- @D",
        "b -> A |
         /b a -> B C |
         b -> D |",
    );
}

#[test]
fn two_transitions_after_one_step_are_both_cleared() {
    // An OR divergence whose receptivities do not exclude each other opens
    // both ways, as rule 4 has it.
    check(
        "Step A, B, C
         Transition t1, t2
         Input a, b
         Marking A
         Transitions:
         t1: A*a |- @B
         t2: A*b |- @C",
        "a b -> B C |",
    );
}

#[test]
fn numbers_are_compared() {
    check(
        "Step A, B, C
         Transition t1, t2
         Input Level, Set
         Marking A
         Transitions:
         t1: A*Level > 50 |- @B
         t2: B*Level <= Set |- @C",
        "Level=50 -> A |
         Level=51 Set=20 -> B |
         Level=20 -> C |",
    );
}

#[test]
fn a_variable_may_be_called_by_its_address() {
    check(
        "Step A, B
         Transition t1
         Input a %I0
         Output q %Q1
         Marking A
         Transitions:
         t1: A*%i0*%M3 |- @B
         Steps:
         B: |- %Q1
         B: |- %Q2",
        "%I0 -> A |
         %M3 -> B | q %Q2",
    );
}
