//! How a controller solves a program, element by element: a program, what is
//! done to it, and what its variables then are.

mod scan_rungs;

use ladder::scan::{Datum, Machine};
use ladder::{
    Class, Coil, CoilKind, Contact, ContactKind, Counter, CounterKind, Declaration, Edge,
    ElementKind, Network, NetworkBuilder, Operand, Port, Program, Timer, TimerKind, Wire,
};
use scan_rungs::{program, rungs};
use source::Span;

/// Runs a program by a script and gives the values of the watched variables
/// after every scan.
///
/// A script is a list of words: `a` switches an input on, `/a` off, `n=5`
/// gives a value, `.` is a scan 100 ms after the last. Values of one variable
/// stand in a row, one a scan.
fn run(program: &Program, script: &str, watch: &[&str]) -> Vec<String> {
    let mut machine = Machine::new(program);
    let mut rows = vec![Vec::new(); watch.len()];
    for word in script.split_whitespace() {
        if word == "." {
            machine.scan(100);
            for (row, name) in rows.iter_mut().zip(watch) {
                row.push(machine.value(name).to_string());
            }
        } else if let Some((name, number)) = word.split_once('=') {
            machine.set_input(name, number.parse::<i64>().unwrap());
        } else if let Some(name) = word.strip_prefix('/') {
            machine.set_input(name, false);
        } else {
            machine.set_input(word, true);
        }
    }
    rows.iter().map(|row| row.join(" ")).collect()
}

/// Checks one main routine: its rungs, a script, and for each variable its
/// values scan by scan.
#[track_caller]
fn check(text: &str, script: &str, expected: &[(&str, &str)]) {
    check_program(&rungs(text), script, expected);
}

#[track_caller]
fn check_program(program: &Program, script: &str, expected: &[(&str, &str)]) {
    let (watch, values): (Vec<&str>, Vec<&str>) = expected.iter().copied().unzip();
    assert_eq!(run(program, script, &watch), values, "{watch:?}");
}

#[test]
fn contacts_in_series_are_and_and_branches_are_or() {
    check(
        "XIC(a) [XIC(b), XIO(c)] OTE(q)",
        "c . a . b . /c /b . /a .",
        &[("q", "0 0 1 1 0")],
    );
}

#[test]
fn a_seal_in_keeps_itself_until_it_is_broken() {
    check(
        "[XIC(start), XIC(run)] XIO(stop) OTE(run)",
        ". start . /start . stop . /stop .",
        &[("run", "0 1 1 0 0")],
    );
}

#[test]
fn the_later_of_set_and_reset_wins() {
    check(
        "XIC(s) OTL(q)\nXIC(r) OTU(q)",
        "s . r . /s /r . s . /s .",
        &[("q", "1 0 0 1 1")],
    );
    check(
        "XIC(r) OTU(q)\nXIC(s) OTL(q)",
        "s . r . /s .",
        &[("q", "1 1 0")],
    );
}

#[test]
fn of_two_coils_the_last_write_is_seen_outside_and_the_first_between() {
    check(
        "XIC(a) OTE(q)\nXIC(q) OTE(between)\nXIC(b) OTE(q)",
        "a . b . /a .",
        &[("q", "0 1 1"), ("between", "1 1 0")],
    );
}

#[test]
fn a_contact_sees_what_was_written_above_it_and_not_what_is_below() {
    check(
        "XIC(q) OTE(late)\nXIC(a) OTE(q)\nXIC(q) OTE(now)",
        "a . . /a . .",
        &[("late", "0 1 1 0"), ("now", "1 1 0 0")],
    );
}

#[test]
fn coils_of_every_kind() {
    check(
        "XIC(a) [OTE(plain), OTN(negated), OTR(rising), OTF(falling)]",
        ". a . . /a . .",
        &[
            ("plain", "0 1 1 0 0"),
            ("negated", "1 0 0 1 1"),
            ("rising", "0 1 0 0 0"),
            ("falling", "0 0 0 1 0"),
        ],
    );
}

#[test]
fn an_edge_contact_compares_with_its_own_last_evaluation() {
    check(
        "XIC(en) RISE(a) OTE(up)\nFALL(a) OTE(down)",
        "en . a . . /a . . /en . a . en .",
        &[("up", "0 1 0 0 0 0 0 0"), ("down", "0 0 0 1 0 0 0 0")],
    );
}

#[test]
fn an_edge_contact_that_is_not_solved_compares_when_it_is_again() {
    check(
        "XIC(skip) JMP(L)\nRISE(a) OTE(up)\nLBL(L) OTE(x)",
        ". skip a . /a . a . /skip . .",
        &[("up", "0 0 0 0 1 0")],
    );
}

#[test]
fn a_one_shot_passes_power_for_one_scan() {
    check(
        "XIC(a) ONS(m) OTE(up)\nXIC(a) OSF(n) OTE(down)\nXIC(a) ONS OTE(own)",
        ". a . . /a . .",
        &[
            ("up", "0 1 0 0 0"),
            ("m", "0 1 1 0 0"),
            ("down", "0 0 0 1 0"),
            ("own", "0 1 0 0 0"),
        ],
    );
}

#[test]
fn inversion_gates_and_open_rungs() {
    check(
        "XIC(a) NOT OTE(not)\n[XIC(a), XIC(b)] AND OTE(and)\n[XIC(a), XIC(b)] OR OTE(or)\n[XIC(a), XIC(b)] XOR OTE(xor)\nAFI OTE(never)",
        ". a . b . /a .",
        &[
            ("not", "1 0 0 1"),
            ("and", "0 0 1 0"),
            ("or", "0 1 1 1"),
            ("xor", "0 1 0 1"),
            ("never", "0 0 0 0"),
        ],
    );
}

#[test]
fn comparisons_of_numbers_and_terms() {
    check(
        "GRT(n,5) OTE(more)\nLES(n + 1, m * 2) OTE(less)\nEQU(n,m) OTE(same)",
        "n=5 m=3 . n=6 m=4 . m=6 .",
        &[("more", "0 1 1"), ("less", "0 1 1"), ("same", "0 0 1")],
    );
}

#[test]
fn moves_increments_and_terms_write_while_powered() {
    check(
        "XIC(a) MOV(10,n)\nXIC(b) INC(-3,n)\nXIC(c) CPT(t,(n + 1) / 2)\nMOV(t,copy)",
        "a . /a b . . c .",
        &[("n", "10 7 4 1"), ("t", "0 0 0 1"), ("copy", "0 0 0 1")],
    );
}

#[test]
fn a_bit_of_a_word_changes_with_the_word() {
    check(
        "XIC(a) OTL(W.3)\nXIC(W.0) OTE(first)\nXIC(clear) MOV(0,W)",
        "W=1 . a . clear . /a .",
        &[("W", "1 9 0 0"), ("W.3", "0 1 0 0"), ("first", "1 1 1 0")],
    );
}

#[test]
fn a_step_register_advances_by_its_index() {
    check(
        "XIC(OK[Step]) INC(1,Step)\nEQU(Step,2) OTE(there)",
        ". OK[0] . OK[1] . .",
        &[("Step", "0 1 2 2"), ("there", "0 0 1 1")],
    );
}

#[test]
fn an_on_delay_times_while_it_has_power() {
    check(
        "XIC(a) TON(T,250)\nXIC(T.DN) OTE(q)",
        ". a . . . . . /a . a . .",
        &[
            ("T.ACC", "0 0 100 200 250 250 0 0 100"),
            ("T.EN", "0 1 1 1 1 1 0 1 1"),
            ("T.TT", "0 1 1 1 0 0 0 1 1"),
            ("q", "0 0 0 0 1 1 0 0 0"),
        ],
    );
}

#[test]
fn an_off_delay_holds_after_power_is_gone() {
    check(
        "XIC(a) TOFQ(T,200) OTE(q)",
        ". a . . /a . . . . a . /a . a . /a .",
        &[
            ("q", "0 1 1 1 1 0 0 1 1 1 1"),
            ("T.ET", "0 0 0 0 100 200 200 0 0 0 0"),
            ("T.TT", "0 0 0 1 1 0 0 0 1 0 1"),
        ],
    );
}

#[test]
fn a_pulse_lasts_its_time_whatever_its_input_does() {
    check(
        "XIC(a) TPQ(T,200) OTE(q)",
        ". a . /a . a . . /a . a . . . .",
        &[
            ("q", "0 1 1 0 0 0 1 1 0 0"),
            ("T.ET", "0 0 100 200 200 0 0 100 200 200"),
        ],
    );
}

#[test]
fn a_retentive_timer_keeps_its_time_until_it_is_reset() {
    check(
        "XIC(a) RTO(T,200)\nXIC(r) RES(T)",
        "a . . /a . . a . . . /a . r .",
        &[
            ("T.ACC", "0 100 100 100 100 200 200 200 0"),
            ("T.DN", "0 0 0 0 0 1 1 1 0"),
        ],
    );
}

#[test]
fn a_timer_that_was_passed_over_measures_the_time_since() {
    check(
        "XIC(skip) JMP(L)\nXIC(a) TON(T,1000)\nLBL(L) OTE(x)",
        "a . skip . . /skip .",
        &[("T.ACC", "0 0 0 300")],
    );
}

#[test]
fn a_preset_can_be_written_while_it_runs() {
    check(
        "XIC(a) TON(T,1000)\nXIC(short) MOV(100,T.PRE)",
        "a . . short . .",
        &[("T.ACC", "0 100 200 100"), ("T.DN", "0 0 0 1")],
    );
}

#[test]
fn counters_count_rises() {
    check(
        "XIC(a) CTU(C,2)\nXIC(r) RES(C)",
        "a . . /a . a . /a . r . /r a .",
        &[("C.ACC", "1 1 1 2 2 0 1"), ("C.DN", "0 0 0 1 1 0 0")],
    );
    check(
        "XIC(a) CTD(C,0)",
        "C.ACC=1 . a . /a . a .",
        &[("C.ACC", "1 0 0 -1"), ("C.DN", "1 1 1 0")],
    );
    check(
        "XIC(a) CTDQ(C,5) OTE(q)",
        "C.CV=1 . a . /a . a .",
        &[("C.CV", "1 0 0 0"), ("q", "0 1 1 1")],
    );
    check(
        "XIC(a) CTC(C,1)",
        "a . /a . a . /a . a .",
        &[("C.ACC", "1 1 0 0 1")],
    );
}

#[test]
fn a_jump_leaves_what_it_skips_as_it_was() {
    check(
        "XIC(skip) JMP(L)\nXIC(a) OTE(q)\nLBL(L) XIC(a) OTE(r)",
        "a . skip /a . /skip .",
        &[("q", "1 1 0"), ("r", "1 0 0")],
    );
}

#[test]
fn a_call_solves_its_routine_in_its_place_and_leaves_it_as_it_was_without_power() {
    check_program(
        &program(
            "main M\n  XIC(run) JSR(Sub)\n  XIC(q) OTE(after)\ncalled Sub\n  XIC(a) OTE(q)\n  XIC(leave) RET\n  XIC(a) OTE(r)\n",
        ),
        "a . run . /run /a . run leave .",
        &[("q", "0 1 1 0"), ("after", "0 1 1 0"), ("r", "0 1 1 1")],
    );
}

#[test]
fn a_call_in_the_middle_of_a_rung_runs_before_what_stands_behind_it() {
    check_program(
        &program("main M\n  [XIC(a) JSR(Sub), XIC(q) OTE(r)]\ncalled Sub\n  OTE(q)\n"),
        ". a .",
        &[("q", "0 1"), ("r", "0 1")],
    );
}

#[test]
fn a_temporary_end_leaves_only_the_routine_that_it_stands_in() {
    check_program(
        &program(
            "main M\n  JSR(Sub)\n  XIC(a) OTE(q)\ncalled Sub\n  XIC(end) TND\n  XIC(a) OTE(r)\n",
        ),
        "a . end /a .",
        &[("q", "1 0"), ("r", "1 1")],
    );
}

#[test]
fn a_preset_in_a_variable_is_read_whenever_the_box_is_solved() {
    check_program(
        &program("main M\n  XIC(a) TON(T,delay)\n  XIC(T.DN) OTE(q)\n  MOV(150,delay)\n"),
        "a . . . . /a .",
        &[("T.PRE", "0 150 150 150 150"), ("q", "1 0 1 1 0")],
    );
    check_program(
        &program("main M\n  MOV(2,most)\n  XIC(a) CTU(C,most)\n  XIC(C.DN) OTE(q)\n"),
        "a . /a . a . .",
        &[("C.PRE", "2 2 2 2"), ("q", "0 0 1 1")],
    );
}

#[test]
fn the_end_of_a_program_leaves_its_main_routine() {
    check_program(
        &program(
            "main M\n  JSR(Sub)\n  XIC(a) OTE(q)\nmain N\n  XIC(a) OTE(r)\ncalled Sub\n  XIC(end) END\n",
        ),
        "a . end /a .",
        &[("q", "1 1"), ("r", "1 0")],
    );
}

#[test]
fn a_zone_without_power_writes_plain_coils_off_and_nothing_else() {
    check_program(
        &program(
            "main M\n  XIC(zone) MCR\n  XIC(a) OTE(q)\n  XIC(a) OTL(l)\n  XIC(a) OTU(u)\n  XIC(a) MOV(5,n)\n  XIC(a) JSR(Sub)\n  MCR\n  XIC(a) OTE(out)\ncalled Sub\n  OTE(called)\n",
        ),
        "a u . zone . /zone n=1 l u .",
        &[
            ("q", "0 1 0"),
            ("l", "0 1 1"),
            ("u", "1 0 1"),
            ("n", "0 5 1"),
            ("called", "0 1 1"),
            ("out", "1 1 1"),
        ],
    );
}

#[test]
fn a_jump_into_a_zone_finds_it_switched_on() {
    check(
        "XIC(in) JMP(L)\nXIC(zone) MCR\nOTE(x)\nLBL(L) XIC(a) OTE(q)\nMCR",
        "a . in .",
        &[("q", "0 1")],
    );
}

#[test]
fn a_jump_back_repeats_until_its_condition_is_off() {
    check(
        "MOV(0,n)\nLBL(L) INC(1,n)\nLES(n,5) JMP(L)",
        ".",
        &[("n", "5")],
    );
}

#[test]
fn a_scan_without_an_end_is_cut_by_the_watchdog() {
    let program = rungs("LBL(L) INC(1,n)\nJMP(L)");
    let mut machine = Machine::new(&program);
    machine.scan(10);
    assert!(machine.overran());
    let program = rungs("OTE(q)");
    let mut machine = Machine::new(&program);
    machine.scan(10);
    assert!(!machine.overran());
}

#[test]
fn the_first_scan_has_a_bit_of_its_own() {
    check("XIC(S:FS) MOV(7,n)", ". n=0 .", &[("n", "7 0")]);
    check("XIC(s:fs) OTE(q)", ". .", &[("q", "1 0")]);
}

#[test]
fn variables_begin_at_their_declared_values_and_keep_their_types() {
    let mut program = rungs("XIC(on) OTE(q)\nMOV(x,whole)\nMOV(3,flag)");
    let mut declare = |name: &str, data_type: &str, initial: &str| {
        let mut declaration = Declaration::new(name, Class::Internal, Span::default());
        declaration.data_type = Some(data_type.into());
        declaration.initial = Some(initial.into());
        program.declarations.add(declaration);
    };
    declare("on", "BOOL", "TRUE");
    declare("x", "REAL", "2.5");
    declare("whole", "DINT", "0");
    declare("flag", "BOOL", "0");
    declare("delay", "TIME", "T#1m");
    check_program(
        &program,
        ".",
        &[
            ("q", "1"),
            ("x", "2.5"),
            ("whole", "2"),
            ("flag", "1"),
            ("delay", "60000"),
        ],
    );
    let mut machine = Machine::new(&program);
    machine.scan(0);
    assert_eq!(machine.value("flag"), Datum::Bool(true));
    assert_eq!(machine.value("whole"), Datum::Integer(2));
}

#[test]
fn a_box_that_decides_about_power_passes_none_on_that_it_does_not_get() {
    check(
        "XIC(a) WITHIN(0,x,9) OTE(q)",
        ". a . WITHIN(0,x,9) . /a .",
        &[("q", "0 0 1 0")],
    );
}

#[test]
fn what_cannot_be_computed_is_an_input_and_listed() {
    let program = rungs("PID(x) OTE(q)\nCPT(n,FOO(a))\nGRT(n,BAR[) OTE(r)\nTON(T)");
    let mut machine = Machine::new(&program);
    let unknown: Vec<&str> = machine.unknown().map(|name| &**name).collect();
    assert_eq!(unknown, ["BAR[", "FOO(a)", "PID(x)", "T.PRE"]);
    machine.set_input("PID(x)", true);
    machine.set_input("FOO(a)", 5);
    machine.set_input("BAR[", 4);
    machine.scan(0);
    assert!(machine.is_on("q") && machine.is_on("r"));
    assert_eq!(machine.value("n"), Datum::Integer(5));
}

#[test]
fn routines_that_define_blocks_are_not_solved_by_the_scan() {
    check_program(
        &program("main P/M\n  OTE(a)\ndefinition Valve/Logic\n  OTE(b)\n"),
        ".",
        &[("a", "1"), ("b", "0")],
    );
}

/// A rung of contacts `a`, `b`, `c` that feed pins of a box in this order,
/// with a coil `q` at the box's output pin.
fn box_with_pins(kind: ElementKind, pins: &[&str], output: &str) -> Program {
    let mut builder = NetworkBuilder::new(Span::default());
    let mut contact = |name: &str| {
        let contact = Contact {
            operand: Operand::new(name, Span::default()),
            kind: ContactKind::Open,
        };
        let kind = ElementKind::Contact(contact);
        builder.add_after(&[Network::rail()], kind, Span::default())
    };
    let contacts = ["a", "b", "c"].map(&mut contact);
    let place = builder.add(kind, Span::default());
    for (from, pin) in contacts.into_iter().zip(pins) {
        let wire = Wire {
            to: Port::Pin((*pin).into()),
            ..Wire::default()
        };
        assert!(builder.join(from, place, wire));
    }
    let coil = ElementKind::Coil(Coil {
        operand: Operand::new("q", Span::default()),
        kind: CoilKind::Plain,
    });
    let coil = builder.add(coil, Span::default());
    let wire = Wire {
        from: Port::Pin(output.into()),
        ..Wire::default()
    };
    assert!(builder.join(place, coil, wire));
    let mut program = rungs("OTE(x)");
    program.routines[0].rungs[0].network = builder.finish().network;
    program
}

#[test]
fn timers_and_counters_are_read_at_their_own_pins() {
    let timer = ElementKind::Timer(Timer {
        kind: TimerKind::Retentive,
        instance: Operand::new("T", Span::default()),
        output: "T.Q".into(),
        preset_ms: Some(100),
        preset_from: None,
    });
    check_program(
        &box_with_pins(timer, &["IN", "R"], "Q"),
        "a . . /a . b . /b .",
        &[("q", "0 1 1 0 0"), ("T.ET", "0 100 100 0 0")],
    );
    let counter = ElementKind::Counter(Counter {
        kind: CounterKind::UpDown,
        instance: Operand::new("C", Span::default()),
        output: "C.QU".into(),
        preset: Some(2),
        preset_from: None,
    });
    check_program(
        &box_with_pins(counter, &["CU", "CD", "LD"], "QD"),
        ". a . /a . b . /b c . /c .",
        &[
            ("C.CV", "0 1 1 0 2 2"),
            ("C.QU", "0 0 0 0 1 1"),
            ("q", "1 0 0 1 0 0"),
        ],
    );
}

#[test]
fn a_pin_hands_over_the_complement_or_an_edge_only() {
    let mut builder = NetworkBuilder::new(Span::default());
    let contact = Contact {
        operand: Operand::new("a", Span::default()),
        kind: ContactKind::Open,
    };
    let contact = builder.add_after(
        &[Network::rail()],
        ElementKind::Contact(contact),
        Span::default(),
    );
    let wires = [
        ("not", true, None),
        ("rise", false, Some(Edge::Rising)),
        ("fall", false, Some(Edge::Falling)),
    ];
    for (name, negated, edge) in wires {
        let coil = ElementKind::Coil(Coil {
            operand: Operand::new(name, Span::default()),
            kind: CoilKind::Plain,
        });
        let coil = builder.add(coil, Span::default());
        let wire = Wire {
            negated,
            edge,
            ..Wire::default()
        };
        assert!(builder.join(contact, coil, wire));
    }
    let mut program = rungs("OTE(x)");
    program.routines[0].rungs[0].network = builder.finish().network;
    check_program(
        &program,
        ". a . . /a . .",
        &[
            ("not", "1 0 0 1 1"),
            ("rise", "0 1 0 0 0"),
            ("fall", "0 0 0 1 0"),
        ],
    );
}
