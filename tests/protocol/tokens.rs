//! Semantic tokens: what each name is.

use end_to_end::lsp::{Client, Marked, Profile};
use tower_lsp::ls_types::request::{SemanticTokensFullRequest, SemanticTokensRangeRequest};
use tower_lsp::ls_types::{
    Position, Range, SemanticTokens, SemanticTokensLegend, SemanticTokensParams,
    SemanticTokensRangeParams, SemanticTokensRangeResult, SemanticTokensResult,
    SemanticTokensServerCapabilities, TextDocumentIdentifier,
};

use crate::{client, client_like};

fn legend(client: &Client) -> SemanticTokensLegend {
    match &client.server.capabilities.semantic_tokens_provider {
        Some(SemanticTokensServerCapabilities::SemanticTokensOptions(it)) => it.legend.clone(),
        other => panic!("no legend: {other:?}"),
    }
}

fn full(client: &mut Client, name: &str) -> Option<SemanticTokens> {
    let params = SemanticTokensParams {
        text_document: TextDocumentIdentifier {
            uri: client.uri(name),
        },
        work_done_progress_params: Default::default(),
        partial_result_params: Default::default(),
    };
    match client.request::<SemanticTokensFullRequest>(params)? {
        SemanticTokensResult::Tokens(tokens) => Some(tokens),
        SemanticTokensResult::Partial(_) => panic!("a part"),
    }
}

/// `line: text is kind and marks`, as a client reads the numbers.
fn read(client: &Client, text: &str, tokens: &SemanticTokens, bytes: bool) -> Vec<String> {
    let legend = legend(client);
    let lines: Vec<&str> = text.split_inclusive('\n').collect();
    let (mut line, mut column) = (0, 0);
    let mut out = Vec::new();
    for token in &tokens.data {
        if token.delta_line > 0 {
            column = 0;
        }
        line += token.delta_line as usize;
        column += token.delta_start as usize;
        let (from, to) = (column, column + token.length as usize);
        let text = match bytes {
            true => lines[line][from..to].to_owned(),
            false => {
                let units: Vec<u16> = lines[line].encode_utf16().collect();
                String::from_utf16(&units[from..to]).expect("whole characters")
            }
        };
        let mut said = format!(
            "{}: {text} is {}",
            line + 1,
            legend.token_types[token.token_type as usize].as_str()
        );
        for (bit, modifier) in legend.token_modifiers.iter().enumerate() {
            if token.token_modifiers_bitset & 1 << bit != 0 {
                said += &format!(" {}", modifier.as_str());
            }
        }
        out.push(said);
    }
    out
}

const LADDER: &str = "\
program Tänk\r
rung: (\"🛑\" + vö) * /ls2 * /v2 -> vö\r
rung: (ls2 + v2) * /\"🛑\" -> v2\r
";

const TOKENS: [&str; 10] = [
    "1: Tänk is namespace declaration",
    "2: \"🛑\" is contact",
    "2: vö is contact state",
    "2: ls2 is contact",
    "2: v2 is contact state interlock",
    "2: vö is coil modification state",
    "3: ls2 is contact",
    "3: v2 is contact state",
    "3: \"🛑\" is contact",
    "3: v2 is coil modification state",
];

#[test]
fn names_are_told_in_the_columns_of_the_client() {
    for profile in [Profile::VsCode, Profile::Neovim] {
        let mut client = client_like(profile);
        client.open("tank.ladder", LADDER);
        let tokens = full(&mut client, "tank.ladder").expect("tokens");
        let read = read(&client, LADDER, &tokens, profile.counts_bytes());
        assert_eq!(read, TOKENS, "{profile:?}");
    }
}

#[test]
fn a_range_has_its_own_tokens_only() {
    let mut client = client();
    client.open("tank.ladder", LADDER);
    let params = SemanticTokensRangeParams {
        text_document: TextDocumentIdentifier {
            uri: client.uri("tank.ladder"),
        },
        range: Range::new(Position::new(2, 0), Position::new(3, 0)),
        work_done_progress_params: Default::default(),
        partial_result_params: Default::default(),
    };
    let Some(SemanticTokensRangeResult::Tokens(tokens)) =
        client.request::<SemanticTokensRangeRequest>(params)
    else {
        panic!("no tokens");
    };
    assert_eq!(read(&client, LADDER, &tokens, false), TOKENS[6..]);
}

#[test]
fn a_spec_has_steps_and_states() {
    let mut client = client();
    let text = "Step X0, Xö for \"🛑\"\r\nTransitions:\r\nt1: X0*s |- @Xö\r\n";
    client.open("tank.grafcet", text);
    let tokens = full(&mut client, "tank.grafcet").expect("tokens");
    assert_eq!(
        read(&client, text, &tokens, false),
        [
            "1: X0 is enumMember declaration",
            "1: Xö is enumMember declaration",
            "1: \"🛑\" is coil state",
            "3: t1 is event",
            "3: X0 is enumMember",
            "3: s is variable",
            "3: Xö is enumMember modification",
        ]
    );
}

#[test]
fn inside_xml_the_operands_are_told() {
    for (fixture, contact) in [
        ("neutralization.L5X", "XIC($0v1)"),
        ("neutralization.xml", "<variable>$0v1</variable>"),
    ] {
        let mut client = client();
        let path = end_to_end::path(&format!("fixtures/neutralization/{fixture}"));
        let text = std::fs::read_to_string(path).expect("a fixture");
        let bare = Marked::of(contact).text;
        let marked = client.open(fixture, &text.replacen(&bare, contact, 1));
        let line = marked.position(0, false).line + 1;
        let tokens = full(&mut client, fixture).expect("tokens");
        let read = read(&client, &marked.text, &tokens, false);
        let wanted = format!("{line}: v1 is contact state");
        assert!(read.contains(&wanted), "{fixture}: {wanted} in {read:#?}");
        assert!(
            read.iter()
                .any(|it| it.ends_with("v2 is coil modification state"))
        );
    }
}

#[test]
fn neutral_text_has_boxes_and_what_is_unknown() {
    let mut client = client();
    let text = "XIC(a)TON(t1,5000,0);\nXIC(t1.DN)SORTED(x);\n";
    client.open("rungs.txt", text);
    let tokens = full(&mut client, "rungs.txt").expect("tokens");
    let read = read(&client, text, &tokens, false);
    for wanted in [
        "1: a is contact",
        "1: TON is function",
        "1: t1 is variable modification",
        "2: t1.DN is contact",
        "2: SORTED is function opaque",
    ] {
        assert!(read.iter().any(|it| it == wanted), "{wanted} in {read:#?}");
    }
}

#[test]
fn xml_that_is_no_ladder_has_no_tokens() {
    let mut client = client();
    client.open("note.xml", "<note>v1</note>");
    assert_eq!(full(&mut client, "note.xml"), None);
}

#[test]
fn the_legend_is_the_documented_one() {
    let client = client();
    let page = std::fs::read_to_string(end_to_end::path("docs/protocol.md")).expect("the page");
    let legend = legend(&client);
    let types = legend.token_types.iter().map(|it| it.as_str());
    let modifiers = legend.token_modifiers.iter().map(|it| it.as_str());
    for word in types.chain(modifiers) {
        assert!(page.contains(&format!("\n| `{word}` |")), "`{word}`");
    }
}
