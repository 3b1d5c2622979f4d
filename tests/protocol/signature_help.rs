use end_to_end::lsp::Profile;
use tower_lsp::ls_types::request::SignatureHelpRequest;
use tower_lsp::ls_types::{ParameterLabel, SignatureHelp, SignatureHelpParams};

use crate::client_like;

fn shown(name: &str, text: &str) -> Option<SignatureHelp> {
    let mut client = client_like(Profile::Plain);
    let marked = client.open(name, text);
    let params = SignatureHelpParams {
        context: None,
        text_document_position_params: client.at(name, marked.position(0, false)),
        work_done_progress_params: Default::default(),
    };
    client.request::<SignatureHelpRequest>(params)
}

#[track_caller]
fn check(name: &str, text: &str, label: &str, operand: &str) {
    let help = shown(name, text).expect("a signature");
    let signature = &help.signatures[0];
    assert_eq!(signature.label, label);
    let active = help.active_parameter.expect("an operand") as usize;
    let operands = signature.parameters.as_ref().expect("operands");
    assert_eq!(
        operands[active].label,
        ParameterLabel::Simple(operand.to_owned())
    );
}

#[test]
fn the_operand_that_is_typed_is_told() {
    check(
        "a.ladder",
        "rung \"\u{1f6d1}\": s -> TON(t1, $0)",
        "TON(timer, 5s)",
        "5s",
    );
    check(
        "a.txt",
        "XIC(s)\r\nMOV(x,$0y);",
        "MOV(Source, Dest)",
        "Dest",
    );
}

#[test]
fn outside_of_boxes_and_in_xml_there_is_none() {
    assert_eq!(shown("a.ladder", "rung: s * ($0a)"), None);
    assert_eq!(shown("a.xml", "<note>TON($0)</note>"), None);
}
