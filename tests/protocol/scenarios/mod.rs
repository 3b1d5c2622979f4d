//! Scenarios through the protocol: what a scenario runs on, what it shows, and
//! what its names have to do with the ladder and the spec.

mod actions;
mod findings;
mod names;
mod running;
mod texts;

use end_to_end::lsp::{Client, Marked};

pub const LADDER: &str = "\
program Tank
input s
input ls2
output v1 %Q0 // Fill
rung: (s + v1) * /ls2 -> v1
";

pub const SPEC: &str = "\
Grafcet Tank
Step X0, Xv1 for v1
Transition t1, t2
Input s, ls2
Output v1
Marking X0
Transitions:
t1: X0*s*/ls2 |- @Xv1
t2: Xv1*ls2 |- @X0
Steps:
Xv1: |- v1
";

const SCENARIO: &str = "\
scenario \"Filled\"
for tank.ladder, tank.grafcet

on s             => on v1, on Xv1
off s, scan 3    => on v1
on ls2           => off %Q0
";

/// A client of the usual kind with the ladder and the spec open, and the scenario
/// with its cursors.
fn tank(scenario: &str) -> (Client, Marked) {
    let mut client = crate::client();
    client.open("tank.ladder", LADDER);
    client.open("tank.grafcet", SPEC);
    let marked = client.open("fill.scenario", scenario);
    (client, marked)
}

/// The scenario with a cursor where `context` has one.
fn with_cursor(context: &str) -> String {
    let bare = context.replace("$0", "");
    assert!(SCENARIO.contains(&bare), "{bare}");
    SCENARIO.replacen(&bare, context, 1)
}
