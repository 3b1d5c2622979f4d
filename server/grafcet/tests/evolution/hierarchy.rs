//! Macro-steps, enclosures, forcing orders and instances. Each test is a
//! section of `docs/evolution.md`.

use crate::run::check;

#[test]
fn a_macro_step_is_its_expansion() {
    check(
        "Step A, B
         Macro M(Load)
         Transition t1, t2
         Input a, b, c
         Output x, y
         Marking A
         Transitions:
         t1: A*a |- @M
         t2: M*c |- @B
         Steps:
         M: |- x
         M: |- y after 2s

         Expansion Load(E, S)
         Step E, S
         Transition u
         Transitions:
         u: E*b |- @S",
        // t2 waits for the exit step, whatever c is.
        "c -> A |
         a -> M E | x
         2s -> M E | x y
         b /c -> M S | x y
         c -> B |",
    );
}

#[test]
fn a_macro_step_may_begin_with_another() {
    check(
        "Step A, B
         Macro M(Outer)
         Transition t1, t2
         Input a
         Marking A
         Transitions:
         t1: A*a |- @M
         t2: M*/a |- @B

         Expansion Outer(N, N)
         Macro N(Inner)

         Expansion Inner(E, E)
         Step E",
        "a -> M N E |
         /a -> B |",
    );
}

#[test]
fn nothing_is_cleared_in_an_expansion_before_its_macro_step_is_entered() {
    check(
        "Step A
         Macro M(Load)
         Transition t1
         Input a, b
         Marking A
         Transitions:
         t1: A*a |- @M

         Expansion Load(E, F)
         Step E, F
         Transition source
         Transitions:
         source: b |- @F",
        "b -> A |
         a -> M E F |",
    );
}

#[test]
fn enclosed_grafcets_live_while_their_step_does() {
    check(
        "Step A
         Enclosing E(G)
         Transition t1, t2
         Input a, b
         Output x
         Marking A
         Transitions:
         t1: A*a |- @E
         t2: E*/a |- @A

         Partial G
         Step P, Q
         Transition u1, u2
         Activation P
         Transitions:
         u1: P*rise(b) |- @Q
         u2: rise(b) |- @P
         Steps:
         Q: |- set x
         P: |- reset x on deactivation",
        // Nothing in G, not even its source u2, before E is active.
        "b -> A |
         /b -> A |
         a -> E P |
         b -> E P Q | x
         /a -> A |",
    );
}

#[test]
fn an_initial_enclosing_step_starts_with_the_initial_steps_of_its_parts() {
    check(
        "Enclosing E(G, H)
         Input a
         Marking E

         Partial G
         Step P, Q
         Marking Q
         Activation P

         Partial H
         Step R
         Activation R",
        // H has no initial step, so its link counts.
        " -> E Q R |",
    );
}

#[test]
fn what_an_initial_enclosing_step_starts_may_enclose_too() {
    check(
        "Enclosing E(G)
         Marking E

         Partial H
         Step R
         Activation R

         Partial G
         Enclosing F(H)
         Activation F",
        " -> E R F |",
    );
}

#[test]
fn a_forcing_order_imposes_a_situation_and_keeps_it() {
    check(
        "Step A, B
         Transition t1, t2
         Input stop, a
         Output n
         Marking A
         Transitions:
         t1: A*stop |- @B
         t2: B*/stop |- @A
         Steps:
         B: |- force G{Q}

         Partial G
         Step P, Q
         Transition u1, u2
         Marking P
         Transitions:
         u1: P*a |- @Q
         u2: Q*a |- @P
         Steps:
         Q: |- n := n + 1",
        " -> A P |
         stop -> B Q | n=1
         a -> B Q | n=1
         /stop /a -> A Q | n=1
         ",
    );
}

#[test]
fn orders_freeze_reset_and_empty() {
    let text = |order: &str| {
        format!(
            "Step A, B
             Transition t1
             Input stop, a
             Marking A
             Transitions:
             t1: A*stop |- @B
             Steps:
             B: |- force G{order}

             Partial G
             Step P, Q, R
             Transition u1, u2
             Marking P
             Transitions:
             u1: P*a |- @Q
             u2: Q*/a |- @R"
        )
    };
    check(&text("{*}"), "a -> A Q |\n stop -> B Q |\n /a -> B Q |");
    check(&text("{INIT}"), "a -> A Q |\n stop -> B P |\n a -> B P |");
    check(&text("{}"), "a -> A Q |\n stop -> B |\n a -> B |");
}

#[test]
fn an_order_with_a_condition_holds_while_the_condition_does() {
    check(
        "Step A
         Input stop, a
         Marking A
         Steps:
         A: stop |- force G{P}

         Partial G
         Step P, Q
         Transition u1
         Marking P
         Transitions:
         u1: P*a |- @Q",
        // The order comes before what could be cleared at that moment.
        "a stop -> A P |
         /stop -> A Q |
         stop -> A P |",
    );
}

#[test]
fn of_two_orders_for_one_part_the_first_in_the_text_counts() {
    check(
        "Step A, B
         Marking A, B
         Steps:
         A: |- force G{P}
         B: |- force G{Q}

         Partial G
         Step P, Q",
        " -> A B P |",
    );
}

#[test]
fn orders_may_force_those_who_give_orders() {
    check(
        "Step A, B
         Transition t1
         Input stop
         Marking A
         Transitions:
         t1: A*stop |- @B
         Steps:
         B: |- force G{Q}

         Partial G
         Step P, Q
         Marking P
         Steps:
         Q: |- force H{S}

         Partial H
         Step R, S, T
         Output x
         Transition u
         Marking R
         Transitions:
         u: R*stop |- @T
         Steps:
         T: |- set x",
        // All of it within one evolution: T is never active.
        " -> A P R |
         stop -> B Q S |",
    );
}

#[test]
fn instances_run_with_variables_of_their_own() {
    check(
        "Step A
         Input s1, s2
         Output q1, q2
         Instance d1 of Drill(s1, q1), d2 of Drill(s2, q2)
         Marking A

         Reusable Drill(go, motor)
         Step E, F
         Transition t1
         Marking E
         Transitions:
         t1: E*go |- @F
         Steps:
         F: |- motor",
        "s2 -> A d1.E d2.F | q2",
    );
}
