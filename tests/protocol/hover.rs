use end_to_end::lsp::{Client, Marked, Profile};
use serde_json::json;
use tower_lsp::ls_types::{MarkupKind, Position};

use crate::{client, client_like, hover_at};

const TANK: &str = "\
program Tank

input  s   %I0 // Start
input  ls2     // Level
output v1  %Q0 // Fill
output v2      // Dose

rung \"Fill the tank\": (s + v1) * /ls2 -> v1
rung: (ls2 + v2) * s -> v2
";

/// What is shown at the cursor in the tank's ladder.
fn shown(profile: Profile, before: &str, after: &str) -> Option<(MarkupKind, String)> {
    let mut client = client_like(profile);
    let text = TANK.replacen(
        &format!("{before}{after}"),
        &format!("{before}$0{after}"),
        1,
    );
    let marked = client.open("tank.ladder", &text);
    let at = marked.position(0, profile.counts_bytes());
    let (markup, _) = hover_at(&mut client, "tank.ladder", at)?;
    Some((markup.kind, markup.value))
}

#[test]
fn on_a_contact_the_conditions_of_its_coil_are_shown() {
    let wanted = "**v1** `%Q0`  
Fill: holds a state (seal-in)

```text
turns on     s*/ls2
stays on     /ls2
turns off    ls2

follows      v2 (possible)
followed by  v2 (handover on s*ls2)

┬──[ s ]───┬──[/ls2]────( v1 )
└──[ v1 ]──┘
```

Driven by rung 0 of Tank (Fill the tank)";
    let markdown = shown(Profile::Neovim, "(s + v", "1) *");
    assert_eq!(markdown, Some((MarkupKind::Markdown, wanted.to_owned())));
}

#[test]
fn rungs_are_links_where_the_client_follows_them() {
    let (_, text) = shown(Profile::VsCode, "(s + v", "1) *").expect("a hover");
    let line = text.lines().find(|line| line.starts_with("Driven by"));
    let line = line.expect("a line");
    let begins = line.starts_with("Driven by [rung 0 of Tank (Fill the tank)](file:///");
    assert!(begins && line.ends_with("/tank.ladder#L8)"), "{line}");
}

#[test]
fn words_lead_to_their_pages_where_the_client_shows_them() {
    let mut client = client();
    let text = "\
rung \"Up\": (go + $0up) * /down * /top -> up
rung \"Down\": (back + down) * /up * /low -> down
rung: $1lamp -> set horn
rung: Seq = 0 * go -> Seq := 10
rung: Seq = $210 * done -> Seq := 20
rung: Seq = 20 * back -> Seq := 0
rung: up$3 -> running
";
    let marked = client.open("hoist.ladder", text);
    let mut pages = |cursor: usize| -> Vec<String> {
        let at = marked.position(cursor, false);
        let (markup, _) = hover_at(&mut client, "hoist.ladder", at).expect("a hover");
        let line = markup.value.lines().last().unwrap_or_default().to_owned();
        let links = line.strip_prefix("More on ").unwrap_or_default();
        links.split(", ").map(str::to_owned).collect()
    };
    let state = [
        "[state](gradus-explain:/state.md)",
        "[seal-in](gradus-explain:/seal-in.md)",
        "[interlock](gradus-explain:/interlock.md)",
        "[succession](gradus-explain:/succession.md)",
    ];
    assert_eq!(pages(0), state);
    // What nothing is said of leads nowhere.
    assert_eq!(pages(1), [""]);
    assert_eq!(
        pages(2),
        [
            "[step register](gradus-explain:/step-register.md)",
            "[succession](gradus-explain:/succession.md)",
        ]
    );
    assert_eq!(pages(3), state);
    for (address, heading) in [
        ("gradus-explain:/interlock.md", "# Interlock\n"),
        ("gradus-explain:/step-register.md", "# Step register\n"),
        ("gradus-explain:/G2010.md", "# G2010: "),
    ] {
        let answer = client.ask_raw("workspace/textDocumentContent", json!({ "uri": address }));
        let text = answer["text"].as_str().expect("a text");
        assert!(text.starts_with(heading), "{text}");
    }
}

#[test]
fn what_a_condition_supposes_is_said_with_the_rung_that_may_belie_it() {
    let mut client = client();
    let text = "\
rung: ready -> set alarm
rung: start -> ready
rung: /ready -> reset $0alarm
";
    let marked = client.open("twice.ladder", text);
    let at = marked.position(0, false);
    let (markup, _) = hover_at(&mut client, "twice.ladder", at).expect("a hover");
    let supposed =
        "supposes  ready at rest: rung 1 of main writes it between contacts that see it\n";
    assert!(markup.value.contains(supposed), "{}", markup.value);
    assert!(
        markup
            .value
            .contains("[at rest](gradus-explain:/at-rest.md)"),
        "{}",
        markup.value
    );
}

#[test]
fn a_client_without_markdown_is_shown_plain_text() {
    let (kind, text) = shown(Profile::Eglot, "(s + v", "1) *").expect("a hover");
    assert_eq!(kind, MarkupKind::PlainText);
    assert!(
        text.starts_with("v1  %Q0\nFill: holds a state (seal-in)\n\nturns on     s*/ls2\n"),
        "{text}"
    );
}

#[test]
fn on_an_input_its_readers_are_shown() {
    let (_, text) = shown(Profile::Helix, "/ls", "2 ->").expect("a hover");
    assert_eq!(
        text,
        "**ls2**  \nLevel: input\n\nRead by rung 0 of Tank (Fill the tank), rung 1 of Tank"
    );
}

#[test]
fn a_value_of_a_step_register_is_a_state() {
    let mut client = client();
    let text = "\
rung: Seq = 0 * go -> Seq := 10
rung: Seq = $010 * done -> Seq := 20
rung: Seq = 20 * back -> Seq := 0
";
    let marked = client.open("press.ladder", text);
    let at = marked.position(0, false);
    let (markup, _) = hover_at(&mut client, "press.ladder", at).expect("a hover");
    assert_eq!(
        markup.value,
        "**Seq=10**  
value of a step register

```text
powered      1

follows      Seq=0 (written)
followed by  Seq=20 (written)

──[ Seq = 10 ]────[ done ]────[ Seq := 20 ]
```

More on [step register](gradus-explain:/step-register.md), [succession](gradus-explain:/succession.md)"
    );
}

#[test]
fn what_is_long_goes_on_in_the_next_line() {
    let mut client = client_like(Profile::Helix);
    let names: Vec<String> = (0..9).map(|at| format!("conveyor_{at}_empty")).collect();
    let text = format!("rung: {} -> $0ready\n", names.join(" * "));
    let marked = client.open("wide.ladder", &text);
    let at = marked.position(0, true);
    let (markup, _) = hover_at(&mut client, "wide.ladder", at).expect("a hover");
    assert_eq!(
        markup.value,
        "**ready**  
follows its condition, holds nothing

```text
on while  conveyor_0_empty*conveyor_1_empty*conveyor_2_empty*
            conveyor_3_empty*conveyor_4_empty*conveyor_5_empty*
            conveyor_6_empty*conveyor_7_empty*conveyor_8_empty

──[ conveyor_0_empty ]────[ conveyor_1_empty ]────[ conveyor_2_empty ]───→
→───[ conveyor_3_empty ]────[ conveyor_4_empty ]────[ conveyor_5_empty ]───→
→───[ conveyor_6_empty ]────[ conveyor_7_empty ]────[ conveyor_8_empty ]───→
→───( ready )
```

Driven by rung 0 of main"
    );
}

/// What is shown at the first place of `what` in an open document.
fn shown_at(client: &mut Client, name: &str, what: &str) -> String {
    let text = client.text(name).to_owned();
    let at = text.find(what).expect("the place");
    let marked = Marked {
        text,
        cursors: vec![at],
    };
    let (markup, _) = hover_at(client, name, marked.position(0, true)).expect("a hover");
    markup.value
}

#[test]
fn the_same_coil_has_the_same_conditions_in_every_format() {
    for (form, contact) in [
        ("ladder", "v2 + ls2"),
        ("L5X", "v2) ,XIC(ls2)"),
        ("xml", "v2</variable>"),
    ] {
        let mut client = client_like(Profile::Helix);
        let name = format!("tank.{form}");
        client.open_fixture(
            &format!("fixtures/neutralization/neutralization.{form}"),
            &name,
        );
        let text = shown_at(&mut client, &name, contact);
        let conditions = "\
turns on     ls2*/ls3*/as
stays on     /ls3*/tl + /ls3*/as
turns off    ls3 + tl*as

follows      v1 (handover on ls2*/ls3*/as)
";
        assert!(text.contains(conditions), "{form}: {text}");
        assert!(text.contains("holds a state (seal-in)"), "{form}: {text}");
    }
}

#[test]
fn a_step_and_a_transition_tell_what_they_stand_for() {
    let mut client = client_like(Profile::Helix);
    client.open("tank.ladder", TANK);
    client.open(
        "tank.grafcet",
        "\
Step X0
Step Xv1 for v1 // Fill it
Transition t1
Input s
Marking X0
Transitions:
t1: X0*s |- @Xv1 // by hand
",
    );
    assert_eq!(
        shown_at(&mut client, "tank.grafcet", "Xv1 for"),
        "**Xv1**  
Fill it: step for v1

```text
begins by    t1: from X0 to Xv1 on s

turns on     s*/ls2
stays on     /ls2
turns off    ls2

follows      v2 (possible)
followed by  v2 (handover on s*ls2)

┬──[ s ]───┬──[/ls2]────( v1 )
└──[ v1 ]──┘
```

Driven by rung 0 of Tank (Fill the tank)"
    );
    assert_eq!(
        shown_at(&mut client, "tank.grafcet", "t1: X0"),
        "**t1**  
by hand: transition

```text
from  X0
to    Xv1
on    s
```"
    );
    let read = shown_at(&mut client, "tank.grafcet", "s |- @");
    assert!(read.starts_with("**s** `%I0`  \nStart: input\n"), "{read}");
}

#[test]
fn between_things_nothing_is_shown() {
    assert_eq!(shown(Profile::VsCode, "program Tank\n", "\n"), None);
}

#[test]
fn xml_that_is_no_ladder_gets_no_answer() {
    let mut client = client();
    client.open("note.xml", "<note>v1</note>");
    assert_eq!(hover_at(&mut client, "note.xml", Position::default()), None);
    assert_eq!(client.diagnostics("note.xml"), []);
}
