//! What never becomes stable, and what must not fail.

use grafcet::evolution::Machine;

use crate::run::{check, machine, scan};

#[test]
fn a_loop_that_never_becomes_stable_is_an_error_that_names_it() {
    check(
        "Step A, B, C, D
         Transition start, t1, t2, t3
         Input a, go
         Marking D
         Transitions:
         start: D*go |- @A
         t1: A*a |- @B
         t2: B |- @C
         t3: C |- @A",
        "go -> A |
         a -> never becomes stable: t1, t2, t3, over and over (steps A, B, C)
         /a -> A |",
    );
}

#[test]
fn a_loop_that_counts_without_end_is_named_too() {
    check(
        "Step A, B
         Transition t1, t2
         Internal n
         Output x
         Marking A
         Transitions:
         t1: A*x |- @B
         t2: B |- @A
         Steps:
         B: |- n := n + 1",
        " -> A |
         x -> never becomes stable: t1, t2, over and over (steps A, B)",
    );
}

#[test]
fn a_loop_that_counts_to_an_end_is_stable() {
    check(
        "Step A, B, C
         Transition t1, t2, t3
         Output n
         Marking A
         Transitions:
         t1: A*n < 100 |- @B
         t2: B |- @A
         t3: A*n = 100 |- @C
         Steps:
         B: |- n := n + 1",
        " -> C | n=100",
    );
}

#[test]
fn a_transition_that_changes_nothing_is_stable() {
    // t4 of the published example leads from p1 to p1.
    check(
        "Step p1
         Transition t4
         Input a
         Marking p1
         Transitions:
         t4: p1*a |- @p1",
        "a -> p1 |
         -> p1 |",
    );
}

#[test]
fn an_error_leaves_the_machine_as_it_was() {
    let text = "Step A, B
         Transition t1, t2
         Input a, b
         Output n, x
         Marking A
         Transitions:
         t1: A*a |- @B
         t2: B*a |- @A
         Steps:
         A: |- n := n + 1 on rise(b)
         A: |- x";
    check(
        text,
        " -> A | x
         a b -> never becomes stable: t1, t2, over and over (steps A, B)
         /a -> A | n=1 x",
    );
    let mut machine = machine(text);
    assert_eq!(scan(&mut machine, ""), "A | x");
    let before = machine.clone();
    scan(&mut machine, "a b");
    scan(&mut machine, "a b");
    machine.set_input("a", false);
    machine.set_input("b", false);
    assert!(machine.is_as_in(&before));
    assert_eq!(machine.scans(), 1);
}

#[test]
fn a_scan_tells_how_it_came_about() {
    let mut machine = machine(
        "Step A, B, C
         Transition t1, t2
         Input a
         Marking A
         Transitions:
         t1: A*a |- @B
         t2: B |- @C",
    );
    scan(&mut machine, "a");
    let fired: Vec<Vec<&str>> = machine
        .evolutions()
        .map(|evolution| evolution.transitions.iter().map(|name| &***name).collect())
        .collect();
    assert_eq!(fired, [["t1"], ["t2"]]);
    scan(&mut machine, "");
    assert_eq!(machine.evolutions().count(), 0);
}

#[test]
fn what_is_not_declared_harms_nothing() {
    let text = "Step A
         Macro M(Nowhere)
         Enclosing E(Neither)
         Marking A, M, E
         Transitions:
         t1: A*Gone*x |- @Also
         t2: A*5s/Gone |- @Also
         Steps:
         A: |- force Nobody{Gone}
         A: |- A := 3
         Gone: |- y

         Expansion Round(R, R)
         Macro R(Round)";
    let mut machine = Machine::new(&grafcet::read(text).spec.grafcet);
    machine.set_input("x", f64::NAN);
    assert!(!machine.set_input("A", false));
    for _ in 0..3 {
        assert_eq!(scan(&mut machine, "1h"), "A M E |");
    }
}

#[test]
fn a_number_that_is_none_is_no_change() {
    let mut machine = machine(
        "Step A, B
         Transition t1
         Input n
         Marking A
         Transitions:
         t1: A*n <> 3 |- @B",
    );
    machine.set_input("n", f64::NAN);
    assert_eq!(scan(&mut machine, ""), "B |");
}
