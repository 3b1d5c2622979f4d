//! Going from contacts to coils, to steps, and back: definition, declaration,
//! references, highlights.

use end_to_end::lsp::{Client, Marked, Profile, selected};
use tower_lsp::ls_types::request::{
    DocumentHighlightRequest, GotoDeclaration, GotoDefinition, References,
};
use tower_lsp::ls_types::{
    DocumentHighlightKind, DocumentHighlightParams, GotoDefinitionParams, GotoDefinitionResponse,
    Location, Position, ReferenceContext, ReferenceParams,
};

use crate::{client, client_like};

const LADDER: &str = "\
program Tank\r
output \"Öffnen 🛑\" %Q0 // Ventil auf\r
rung: (s + \"Öffnen 🛑\") * /ls2 -> \"Öffnen 🛑\"\r
rung: \"Öffnen 🛑\" * ls2 + v2 -> v2\r
";

const SPEC: &str = "\
Step X0, Xö for \"Öffnen 🛑\"\r
Step Xv2 for v2\r
Transition t1\r
Input s\r
Marking X0\r
Transitions:\r
t1: X0*s |- @Xö\r
//! accept \"Öffnen 🛑\" -> v2\r
";

fn params(client: &Client, name: &str, at: Position) -> GotoDefinitionParams {
    GotoDefinitionParams {
        text_document_position_params: client.at(name, at),
        work_done_progress_params: Default::default(),
        partial_result_params: Default::default(),
    }
}

/// `file:line:what stands there`, of places in the two texts.
fn shown(client: &Client, locations: &[Location]) -> Vec<String> {
    let shown = locations.iter().map(|it| {
        let name = it.uri.as_str().rsplit('/').next().expect("a name");
        let text = selected(client.text(name), it.range);
        format!("{name}:{}:{text}", it.range.start.line + 1)
    });
    shown.collect()
}

/// Opens both texts, one of which has a cursor.
fn opened(client: &mut Client, ladder: &str, spec: &str) -> (&'static str, Marked) {
    let ladder = client.open("tank.ladder", ladder);
    let spec = client.open("tank.grafcet", spec);
    match ladder.cursors.is_empty() {
        true => ("tank.grafcet", spec),
        false => ("tank.ladder", ladder),
    }
}

/// Where the definition of what is at the cursor is.
fn defined(ladder: &str, spec: &str) -> Vec<String> {
    let mut client = client();
    let (name, marked) = opened(&mut client, ladder, spec);
    let asked = params(&client, name, marked.position(0, false));
    match client.request::<GotoDefinition>(asked) {
        Some(GotoDefinitionResponse::Link(links)) => {
            let places: Vec<Location> = links
                .iter()
                .map(|it| Location::new(it.target_uri.clone(), it.target_selection_range))
                .collect();
            shown(&client, &places)
        }
        None => Vec::new(),
        other => panic!("no links: {other:?}"),
    }
}

fn with(text: &str, context: &str) -> String {
    let bare = Marked::of(context).text;
    assert!(text.contains(&bare), "{bare}");
    text.replacen(&bare, context, 1)
}

#[test]
fn contacts_lead_to_coils_coils_to_steps_and_steps_to_coils() {
    let coil = ["tank.ladder:3:\"Öffnen 🛑\""];
    let step = ["tank.grafcet:1:Xö"];
    assert_eq!(defined(&with(LADDER, "(s + \"Ö$0ff"), SPEC), coil);
    assert_eq!(defined(&with(LADDER, "-> \"Öffnen 🛑$0\""), SPEC), step);
    assert_eq!(defined(LADDER, &with(SPEC, "@X$0ö")), coil);
    assert_eq!(defined(LADDER, &with(SPEC, "accept $0\"Ö")), coil);
    assert_eq!(
        defined(LADDER, &with(SPEC, "-> v2$0")),
        ["tank.ladder:4:v2"]
    );
}

#[test]
fn a_client_without_links_gets_locations_in_its_own_columns() {
    for profile in [Profile::Helix, Profile::Eglot, Profile::Plain] {
        let mut client = client_like(profile);
        let (name, marked) = opened(&mut client, &with(LADDER, "(s + \"Ö$0ff"), SPEC);
        let at = marked.position(0, profile.counts_bytes());
        let asked = params(&client, name, at);
        let Some(GotoDefinitionResponse::Array(found)) = client.request::<GotoDefinition>(asked)
        else {
            panic!("{profile:?}: no locations");
        };
        let coil = Marked::of(&with(LADDER, "ls2 -> $0\"Öffnen 🛑\"$1"));
        let coil = [0, 1].map(|cursor| coil.position(cursor, profile.counts_bytes()));
        let range = found.first().expect("a coil").range;
        assert_eq!([range.start, range.end], coil, "{profile:?}");
    }
}

#[test]
fn what_is_typed_counts_before_it_is_saved() {
    let mut client = client();
    client.write("tank.grafcet", "Step Xold for v1\n");
    let ladder = client.open("tank.ladder", "rung: a + v1 -> $0v1");
    let at = ladder.position(0, false);
    let found = |client: &mut Client| {
        let asked = params(client, "tank.ladder", at);
        match client.request::<GotoDefinition>(asked) {
            Some(GotoDefinitionResponse::Link(links)) => links[0].target_range,
            other => panic!("no links: {other:?}"),
        }
    };
    assert_eq!(found(&mut client).start, Position::new(0, 5));
    client.open("tank.grafcet", "Step X0\nStep Xnew for v1\n");
    assert_eq!(found(&mut client).start, Position::new(1, 5));
    client.replace("tank.grafcet", "Step X0\n", "");
    assert_eq!(found(&mut client).start, Position::new(0, 5));
}

#[test]
fn declarations_stay_in_the_document() {
    let mut client = client();
    let (name, marked) = opened(&mut client, LADDER, &with(SPEC, "@X$0ö"));
    let asked = params(&client, name, marked.position(0, false));
    let Some(GotoDefinitionResponse::Link(found)) = client.request::<GotoDeclaration>(asked) else {
        panic!("no links");
    };
    assert_eq!(found.len(), 1);
    assert_eq!(found[0].target_uri, client.uri("tank.grafcet"));
    assert_eq!(found[0].target_range.start, Position::new(0, 9));
}

fn referred(ladder: &str, spec: &str, include_declaration: bool) -> Vec<String> {
    let mut client = client();
    let (name, marked) = opened(&mut client, ladder, spec);
    let params = ReferenceParams {
        text_document_position: client.at(name, marked.position(0, false)),
        work_done_progress_params: Default::default(),
        partial_result_params: Default::default(),
        context: ReferenceContext {
            include_declaration,
        },
    };
    let found = client.request::<References>(params).unwrap_or_default();
    shown(&client, &found)
}

#[test]
fn references_reach_over_both_documents() {
    let uses = [
        "tank.ladder:3:\"Öffnen 🛑\"",
        "tank.ladder:3:\"Öffnen 🛑\"",
        "tank.ladder:4:\"Öffnen 🛑\"",
        "tank.grafcet:1:\"Öffnen 🛑\"",
        "tank.grafcet:7:Xö",
        "tank.grafcet:8:\"Öffnen 🛑\"",
    ];
    let from_ladder = with(LADDER, "-> $0\"Öffnen");
    assert_eq!(referred(&from_ladder, SPEC, false), uses);
    assert_eq!(referred(LADDER, &with(SPEC, "X$0ö for"), false), uses);
    let all = referred(&from_ladder, SPEC, true);
    assert_eq!(all.len(), uses.len() + 2);
    assert_eq!(all[0], "tank.ladder:2:Öffnen 🛑");
    assert_eq!(all[4], "tank.grafcet:1:Xö");
}

#[test]
fn highlights_tell_reading_from_writing() {
    let mut client = client();
    let (name, marked) = opened(&mut client, &with(LADDER, "-> $0\"Öffnen"), SPEC);
    let params = DocumentHighlightParams {
        text_document_position_params: client.at(name, marked.position(0, false)),
        work_done_progress_params: Default::default(),
        partial_result_params: Default::default(),
    };
    let lit = client.request::<DocumentHighlightRequest>(params);
    let lit: Vec<_> = lit
        .unwrap_or_default()
        .iter()
        .map(|it| (it.range.start.line, it.kind))
        .collect();
    assert_eq!(
        lit,
        [
            (1, Some(DocumentHighlightKind::TEXT)),
            (2, Some(DocumentHighlightKind::READ)),
            (2, Some(DocumentHighlightKind::WRITE)),
            (3, Some(DocumentHighlightKind::READ)),
        ]
    );
}

#[test]
fn the_same_coil_is_found_in_every_format() {
    for (fixture, contact) in [
        ("neutralization.ladder", "(s + v$01)"),
        ("neutralization.L5X", "XIC(v$01)"),
        ("neutralization.xml", "<variable>v$01</variable>"),
    ] {
        let mut client = client();
        let path = end_to_end::path(&format!("fixtures/neutralization/{fixture}"));
        let text = std::fs::read_to_string(path).expect("a fixture");
        let marked = client.open(fixture, &with(&text, contact));
        let asked = params(&client, fixture, marked.position(0, false));
        let Some(GotoDefinitionResponse::Link(links)) = client.request::<GotoDefinition>(asked)
        else {
            panic!("{fixture}: no links");
        };
        assert_eq!(links.len(), 1, "{fixture}");
        let name = selected(&marked.text, links[0].target_selection_range);
        let whole = selected(&marked.text, links[0].target_range);
        assert_eq!(name, "v1", "{fixture}");
        let coil = ["v1", "OTE(v1)"].contains(&whole) || whole.starts_with("<coil");
        assert!(coil, "{fixture}: {whole}");
    }
}

#[test]
fn calls_lead_to_routines_in_neutral_text() {
    let mut client = client();
    let text = "XIC(a)JMP(en$0d);\nXIC(b)OTE(c);\nLBL(end)XIC(c)OTE(d);\n";
    let marked = client.open("rungs.txt", text);
    let asked = params(&client, "rungs.txt", marked.position(0, false));
    let Some(GotoDefinitionResponse::Link(links)) = client.request::<GotoDefinition>(asked) else {
        panic!("no links");
    };
    assert_eq!(selected(&marked.text, links[0].target_range), "LBL(end)");
}

#[test]
fn xml_that_is_no_ladder_leads_nowhere() {
    let mut client = client();
    client.open("note.xml", "<note>v1</note>");
    let asked = params(&client, "note.xml", Position::new(0, 7));
    assert_eq!(client.request::<GotoDefinition>(asked), None);
}

#[test]
fn calls_lead_to_routines_and_to_the_bodies_of_blocks_in_exports() {
    for (fixture, call, heading) in [
        ("press.L5X", "JSR(do$0wn,0)", "<Routine Name=\"Down\""),
        (
            "press.L5X",
            "[CDATA[Deb$0ounce(Guard_Input",
            "<Routine Name=\"Logic\"",
        ),
        ("conveyor.L5K", "JSR(Sto$0ps,0);", "ROUTINE Stops"),
        ("conveyor.L5K", "N: J$0am(Jam1", "ROUTINE Logic"),
    ] {
        let mut client = client();
        let path = end_to_end::path(&format!("fixtures/rockwell/{fixture}"));
        let text = std::fs::read_to_string(path).expect("a fixture");
        let marked = client.open(fixture, &with(&text, call));
        let asked = params(&client, fixture, marked.position(0, false));
        let found = client.request::<GotoDefinition>(asked);
        let Some(GotoDefinitionResponse::Link(links)) = found else {
            panic!("{fixture}: {call}: {found:?}");
        };
        let whole = selected(&marked.text, links[0].target_range);
        assert!(whole.starts_with(heading), "{call}: {whole}");
        let name = selected(&marked.text, links[0].target_selection_range);
        assert!(heading.contains(name) && !name.is_empty(), "{call}: {name}");
    }
}
