//! A scan looked at closely, runs that end early, and names that are nearly
//! right.

use ladder::{ElementKind, Program};
use recovery::simulation::{Extent, Moment, Stop, Subject, moment, simulate_within, unknown_names};

const DOOR: &str = "\
input up %I0
input top
internal moving
output motor %Q0
rung: (up + moving) * /top -> moving
rung: moving -> motor
";

const SPEC: &str = "\
Step X0, Xup for motor
Transition t1, t2
Input up, top
Output motor
Marking X0
Transitions:
t1: X0*up |- @Xup
t2: Xup*top |- @X0
Steps:
Xup: |- motor
";

const OPENED: &str = "on up\noff up, scan 3\non top\n";

/// The contacts and coils of a rung that get power, with what they name.
fn powered(program: &Program, moment: &Moment<'_>, rung: usize) -> Vec<String> {
    let network = &program.routines[0].rungs[rung].network;
    let power = moment.power(0, rung).expect("a rung that was solved");
    let elements = network.elements().filter(|(at, _)| power.after(*at));
    let named = elements.filter_map(|(_, element)| match &element.kind {
        ElementKind::Contact(contact) => Some(contact.operand.name.to_string()),
        ElementKind::Coil(coil) => Some(format!("({})", coil.operand.name)),
        _ => None,
    });
    named.collect()
}

#[test]
fn a_scan_has_values_active_steps_and_powered_contacts() {
    let program = ladder::read(DOOR.as_bytes()).program;
    let grafcet = grafcet::read(SPEC).spec.grafcet;
    let subject = Subject {
        ladder: Some(&program),
        grafcet: Some(&grafcet),
    };
    let scenario = scenario::read(OPENED).scenario;
    let at = |scan| moment(&scenario, subject, scan, &|| true);

    let first = at(1).expect("the first scan");
    assert_eq!(powered(&program, &first, 0), ["up", "top", "(moving)"]);
    assert!(first.active().map(|it| &**it).eq(["Xup"]));
    assert_eq!(first.in_ladder("moving"), Some(true.into()));
    assert_eq!(first.in_ladder("%Q0"), Some(true.into()));
    assert_eq!(first.in_grafcet("motor"), Some(true.into()));
    assert_eq!(first.in_grafcet("moving"), None);

    let second = at(2).expect("the second scan");
    assert_eq!(powered(&program, &second, 0), ["moving", "top", "(moving)"]);
    let last = at(5).expect("the last scan");
    assert_eq!(powered(&program, &last, 0), ["moving"]);
    assert_eq!(powered(&program, &last, 1), [""; 0]);
    assert!(last.active().map(|it| &**it).eq(["X0"]));
    assert!(at(6).is_none() && at(0).is_none());
}

#[test]
fn a_run_ends_where_it_is_told_to_or_where_nobody_waits() {
    let program = ladder::read(DOOR.as_bytes()).program;
    let subject = Subject {
        ladder: Some(&program),
        grafcet: None,
    };
    let scenario = scenario::read(OPENED).scenario;
    let stopped = |scans, wanted: bool| {
        let extent = Extent {
            scans,
            wanted: &|| wanted,
        };
        simulate_within(&scenario, subject, extent).stopped
    };
    assert_eq!(stopped(5, true), None);
    assert_eq!(stopped(3, true), Some((1, Stop::Enough(3))));
    assert_eq!(stopped(5, false), Some((0, Stop::Cancelled)));
}

/// What may have been meant by a name in a step.
fn meant(name: &str) -> Option<String> {
    let program = ladder::read(DOOR.as_bytes()).program;
    let grafcet = grafcet::read(SPEC).spec.grafcet;
    let subject = Subject {
        ladder: Some(&program),
        grafcet: Some(&grafcet),
    };
    let text = format!("on up => on {name}\n");
    let found = unknown_names(&scenario::read(&text).scenario, subject);
    let [finding] = &found[..] else {
        panic!("{found:?}");
    };
    assert_eq!(&text[finding.span.range()], name);
    let fix = finding.fix.as_ref()?;
    assert_eq!(fix.edits[0].span, finding.span);
    Some(fix.edits[0].text.clone())
}

#[test]
fn a_name_that_is_nearly_right_is_put_right() {
    assert_eq!(meant("moter").as_deref(), Some("motor"));
    assert_eq!(meant("MOTOR").as_deref(), Some("motor"));
    assert_eq!(meant("Xpu").as_deref(), Some("Xup"));
    assert_eq!(meant("heater"), None);
}
