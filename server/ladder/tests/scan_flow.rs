//! The order of execution: which rungs are solved, when, under which guards.

mod scan_rungs;

use ladder::Program;
use ladder::flow::{Execution, Guard, Order, Place, execution};
use ladder::scan::Machine;
use scan_rungs::{program, rungs};
use source::Code;

/// Visits one a line, `Routine.rung`, each with its guards, outermost first.
fn shown(program: &Program, order: &Order) -> Vec<String> {
    let place = |by: Place| {
        let visit = &order.visits[by.visit];
        let routine = &program.routines[visit.routine];
        format!("{}.{}", routine.name, visit.rung)
    };
    let guard = |guard: Guard| match guard {
        Guard::Skipped { by, solved_when } => {
            format!("{}{}", if solved_when { "" } else { "/" }, place(by))
        }
        Guard::Zone { begin } => format!("zone {}", place(begin)),
        Guard::Repeated { rung, .. } => format!("repeated by {rung}"),
    };
    let visits = order.visits.iter().map(|visit| {
        let mut guards: Vec<_> = order.guards(visit.guards).map(guard).collect();
        guards.reverse();
        let routine = &program.routines[visit.routine];
        let name = format!("{}.{}", routine.name, visit.rung);
        match guards.is_empty() {
            true => name,
            false => format!("{name} if {}", guards.join(", ")),
        }
    });
    visits.collect()
}

#[track_caller]
fn check(text: &str, expected: &str) -> Execution {
    let program = program(text);
    let execution = execution(&program);
    let expected: Vec<&str> = expected.lines().map(str::trim).collect();
    assert_eq!(shown(&program, &execution.scan), expected);
    execution
}

fn codes(execution: &Execution) -> Vec<String> {
    let code = |code: Code| code.to_string();
    let found = execution.diagnostics.iter();
    found.map(|diagnostic| code(diagnostic.code)).collect()
}

#[test]
fn rungs_are_visited_in_order_main_routine_by_main_routine() {
    let execution = check(
        "main A\n  OTE(a)\n  OTE(b)\nmain B\n  OTE(c)\n",
        "A.0\nA.1\nB.0",
    );
    assert!(codes(&execution).is_empty());
    assert!(execution.scan.visits.iter().all(|v| v.guards.is_empty()));
}

#[test]
fn a_call_is_solved_where_it_stands_while_it_has_power() {
    check(
        "main M\n  XIC(a) JSR(Sub)\n  OTE(b)\ncalled Sub\n  OTE(c)\n  XIC(d) JSR(Inner)\ncalled Inner\n  OTE(e)\n",
        "M.0
         Sub.0 if M.0
         Sub.1 if M.0
         Inner.0 if M.0, Sub.1
         M.1",
    );
}

#[test]
fn a_call_in_the_middle_of_a_rung_cuts_it() {
    let execution = check(
        "main M\n  [XIC(a) JSR(Sub), OTE(b)]\ncalled Sub\n  OTE(c)\n",
        "M.0
         Sub.0 if M.0
         M.0",
    );
    let stretches: Vec<_> = execution
        .scan
        .visits
        .iter()
        .map(|v| v.elements.clone())
        .collect();
    assert_eq!(stretches, [0..3, 0..2, 3..4]);
}

#[test]
fn a_routine_called_twice_is_visited_twice() {
    check(
        "main M\n  XIC(a) JSR(Sub)\n  XIC(b) JSR(Sub)\ncalled Sub\n  OTE(c)\n",
        "M.0
         Sub.0 if M.0
         M.1
         Sub.0 if M.1",
    );
}

#[test]
fn a_forward_jump_guards_what_lies_before_its_label() {
    check(
        "main M\n  XIC(a) JMP(L)\n  OTE(b)\n  LBL(L) OTE(c)\n",
        "M.0
         M.1 if /M.0
         M.2",
    );
}

#[test]
fn jumps_that_overlap_end_each_at_its_own_label() {
    check(
        "main M\n  XIC(a) JMP(K)\n  XIC(b) JMP(L)\n  OTE(c)\n  LBL(K) OTE(d)\n  LBL(L) OTE(e)\n",
        "M.0
         M.1 if /M.0
         M.2 if /M.0, /M.1
         M.3 if /M.1
         M.4",
    );
}

#[test]
fn a_return_guards_the_rest_of_its_routine_only() {
    check(
        "main M\n  JSR(Sub)\n  OTE(a)\ncalled Sub\n  XIC(b) RET\n  OTE(c)\n",
        "M.0
         Sub.0 if M.0
         Sub.1 if M.0, /Sub.0
         M.1",
    );
}

#[test]
fn the_end_of_a_program_guards_the_rest_of_its_main_routine() {
    check(
        "main M\n  JSR(Sub)\n  OTE(a)\nmain N\n  OTE(d)\ncalled Sub\n  XIC(b) END\n  OTE(c)\n",
        "M.0
         Sub.0 if M.0
         Sub.1 if M.0, /Sub.0
         M.1 if /Sub.0
         N.0",
    );
}

#[test]
fn a_zone_reaches_from_its_begin_to_its_end() {
    check(
        "main M\n  XIC(a) MCR\n  OTE(b)\n  MCR\n  OTE(c)\n  XIC(d) MCR\n  OTE(e)\n",
        "M.0
         M.1 if zone M.0
         M.2 if zone M.0
         M.3
         M.4
         M.5 if zone M.4",
    );
}

#[test]
fn rungs_between_a_label_and_a_jump_back_are_marked() {
    let execution = check(
        "main M\n  OTE(a)\n  LBL(L) OTE(b)\n  XIC(c) JMP(L)\n  OTE(d)\n",
        "M.0
         M.1 if repeated by 2
         M.2 if repeated by 2
         M.3",
    );
    assert_eq!(codes(&execution), ["G2014"]);
}

#[test]
fn what_leads_nowhere_is_reported_at_its_place() {
    let text = "main M\n  JSR(Gone)\n  JMP(L)\n  OTE(a)\n";
    let execution = check(text, "M.0\nM.1\nM.2");
    assert_eq!(codes(&execution), ["G1205", "G1301"]);
    let places: Vec<_> = execution
        .diagnostics
        .iter()
        .map(|diagnostic| &text[diagnostic.span.range()])
        .collect();
    assert_eq!(places, ["Gone", "L"]);
}

#[test]
fn a_routine_that_calls_itself_is_cut() {
    let execution = check(
        "main M\n  JSR(A)\ncalled A\n  JSR(B)\ncalled B\n  XIC(x) JSR(A)\n  OTE(y)\n",
        "M.0
         A.0 if M.0
         B.0 if M.0, A.0
         B.1 if M.0, A.0",
    );
    assert_eq!(codes(&execution), ["G2012"]);
}

#[test]
fn routines_without_a_call_and_rungs_always_passed_over_are_reported() {
    let execution = check(
        "main M\n  JMP(L)\n  OTE(a)\n  OTE(b)\n  LBL(L) OTE(c)\ncalled Idle\n  OTE(d)\n",
        "M.0
         M.1 if /M.0
         M.2 if /M.0
         M.3",
    );
    assert_eq!(codes(&execution), ["G2011", "G2011"]);
    assert_eq!(execution.unreachable, [1]);
}

#[test]
fn rungs_behind_a_label_that_another_jump_reaches_are_not_passed_over() {
    let program = rungs("XIC(a) JMP(K)\nJMP(L)\nLBL(K) OTE(b)\nLBL(L) OTE(c)");
    assert!(codes(&execution(&program)).is_empty());
}

#[test]
fn units_that_define_blocks_have_orders_of_their_own() {
    let program = program(
        "main P/M\n  OTE(a)\ndefinition Valve/Logic\n  XIC(b) JSR(Sub)\ncalled Valve/Sub\n  OTE(c)\ndefinition Motor/Logic\n  OTE(d)\n",
    );
    let execution = execution(&program);
    assert_eq!(shown(&program, &execution.scan), ["M.0"]);
    let definitions: Vec<_> = execution
        .definitions
        .iter()
        .map(|(unit, order)| (&**unit, shown(&program, order).join("; ")))
        .collect();
    assert_eq!(
        definitions,
        [
            ("Valve", "Logic.0; Sub.0 if Logic.0".to_owned()),
            ("Motor", "Logic.0".to_owned())
        ]
    );
    assert!(codes(&execution).is_empty());
}

#[test]
fn calls_that_unfold_without_end_are_cut() {
    let mut text = "main R0\n  JSR(R1)\n  JSR(R1)\n".to_owned();
    for level in 1..60 {
        let next = level + 1;
        text += &format!("called R{level}\n  JSR(R{next})\n  JSR(R{next})\n");
    }
    text += "called R60\n  OTE(a)\n";
    let program = program(&text);
    let execution = execution(&program);
    assert_eq!(codes(&execution), ["G2012"]);
    assert!(execution.scan.visits.len() < 30_000);
}

#[test]
fn guard_sets_are_shared_and_each_extends_an_earlier_one() {
    let program = rungs("XIC(a) RET\nOTE(b)\nOTE(c)\nXIC(d) RET\nOTE(e)");
    let order = execution(&program).scan;
    assert_eq!(order.visits[1].guards, order.visits[2].guards);
    let (_, outer) = order.last_guard(order.visits[4].guards).unwrap();
    assert_eq!(outer, order.visits[1].guards);
    for visit in &order.visits {
        for guard in order.guards(visit.guards) {
            let (Guard::Skipped { by, .. } | Guard::Zone { begin: by }) = guard else {
                continue;
            };
            assert!(order.visits[by.visit].guards < visit.guards);
        }
    }
}

#[test]
fn a_file_that_holds_only_definitions_is_solved_as_one_instance_of_each() {
    let block = "input a\noutput q\nroutine Valve block\nrung: a -> q\n";
    let reading = ladder::read(block.as_bytes());
    let mut machine = Machine::new(&reading.program);
    machine.set_input("a", true);
    machine.scan(10);
    assert!(machine.is_on("q"));

    // With a main routine beside it, only its instances would be solved.
    let beside = format!("rung: a -> m\n{block}");
    let reading = ladder::read(beside.as_bytes());
    let mut machine = Machine::new(&reading.program);
    machine.set_input("a", true);
    machine.scan(10);
    assert!(machine.is_on("m"));
    assert!(!machine.is_on("q"));
}
