//! `textDocument/signatureHelp`.

use tower_lsp::ls_types::{
    Documentation, ParameterInformation, ParameterLabel, Position, SignatureHelp,
    SignatureInformation,
};

use crate::lsp::query::Query;

/// The box whose operands are typed at a position.
pub fn answer(query: &Query, at: Position) -> Option<SignatureHelp> {
    let found = ide::signature(query.document.ladder()?, query.offset(at))?;
    // Labels hold ASCII only, so that bytes and code units are the same.
    let parameter = |range: &std::ops::Range<usize>| ParameterInformation {
        label: match query.world.abilities.label_offsets {
            true => ParameterLabel::LabelOffsets([range.start as u32, range.end as u32]),
            false => ParameterLabel::Simple(found.label[range.clone()].to_owned()),
        },
        documentation: None,
    };
    Some(SignatureHelp {
        signatures: vec![SignatureInformation {
            parameters: Some(found.operands.iter().map(parameter).collect()),
            documentation: Some(Documentation::String(found.summary)),
            label: found.label,
            active_parameter: None,
        }],
        active_signature: Some(0),
        active_parameter: u32::try_from(found.active).ok(),
    })
}
