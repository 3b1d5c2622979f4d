//! `textDocument/semanticTokens`: what each name is, for colouring.

use ide::tokens::{Mark, Token, TokenKind, tokens_in_ladder, tokens_in_spec};
use ide::tokens_in_scenario;
use source::Span;
use tower_lsp::ls_types::{
    Position, Range, SemanticToken, SemanticTokenModifier, SemanticTokenType, SemanticTokens,
    SemanticTokensLegend,
};

use crate::lsp::query::{Query, Text};

/// What the numbers in tokens mean.
pub fn legend() -> SemanticTokensLegend {
    let types = TokenKind::ALL.iter();
    let modifiers = Mark::ALL.iter();
    SemanticTokensLegend {
        token_types: types.map(|it| SemanticTokenType::new(it.word())).collect(),
        token_modifiers: modifiers
            .map(|it| SemanticTokenModifier::new(it.word()))
            .collect(),
    }
}

/// All tokens of the document.
pub fn full(query: &Query) -> Option<SemanticTokens> {
    encoded(query, &tokens(query)?)
}

/// Those that a range touches.
pub fn range(query: &Query, range: Range) -> Option<SemanticTokens> {
    let wanted = query.encoding().span(&query.document.rope, range);
    let mut tokens = tokens(query)?;
    tokens.retain(|it| it.span.start <= wanted.end && wanted.start <= it.span.end);
    encoded(query, &tokens)
}

fn tokens(query: &Query) -> Option<Vec<Token>> {
    Some(match query.text()? {
        Text::Ladder(ladder) => tokens_in_ladder(ladder),
        Text::Spec(spec) => tokens_in_spec(spec),
        Text::Scenario(scenario) => tokens_in_scenario(scenario, query.pair().looked_at()),
    })
}

/// The tokens as the protocol has them: each place relative to the one before,
/// none longer than its line.
fn encoded(query: &Query, tokens: &[Token]) -> Option<SemanticTokens> {
    let mut before = Position::default();
    let mut data = Vec::with_capacity(tokens.len());
    for token in tokens {
        for range in lines(query, token.span) {
            let (start, end) = (range.start, range.end);
            let is_same_line = start.line == before.line;
            let from = if is_same_line { before.character } else { 0 };
            data.push(SemanticToken {
                delta_line: start.line.checked_sub(before.line)?,
                delta_start: start.character.checked_sub(from)?,
                length: end.character.saturating_sub(start.character),
                token_type: token.kind as u32,
                token_modifiers_bitset: token.marks.bits(),
            });
            before = start;
        }
    }
    Some(SemanticTokens {
        result_id: None,
        data,
    })
}

/// The pieces of a span that lie on one line each, line ends and empty pieces
/// left out.
fn lines(query: &Query, span: Span) -> Vec<Range> {
    let rope = &query.document.rope;
    let whole = query.range(span);
    if whole.start.line == whole.end.line {
        return vec![whole];
    }
    let lines = whole.start.line..=whole.end.line;
    let pieces = lines.map(|line| {
        let past_the_end = Position::new(line, u32::MAX);
        let end = query.encoding().offset(rope, past_the_end);
        let start = query.encoding().offset(rope, Position::new(line, 0));
        let (from, to) = (span.range().start.max(start), span.range().end.min(end));
        query.range(Span::new(from, to))
    });
    pieces.filter(|it| it.start != it.end).collect()
}

#[cfg(test)]
mod tests {
    use std::str::FromStr;
    use std::sync::Arc;

    use ide::tokens::Marks;
    use logic::Budget;
    use tower_lsp::ls_types::Uri;

    use super::*;
    use crate::lsp::document::Document;
    use crate::lsp::world::World;

    #[test]
    fn a_token_of_several_lines_is_told_line_by_line() {
        let uri = Uri::from_str("file:///p/a.txt").expect("an address");
        let text = "\u{1f6d1} ab\r\n\r\ncd e";
        let query = Query {
            world: World::default(),
            document: Arc::new(Document::new(uri, "", None, text)),
            budget: Budget::default(),
        };
        let token = |part: &str| {
            let start = text.find(part).expect("in the text");
            Token {
                span: Span::new(start, start + part.len()),
                kind: TokenKind::Variable,
                marks: Marks::default(),
            }
        };
        let tokens = [token("ab\r\n\r\ncd"), token("e")];
        let data = encoded(&query, &tokens).expect("tokens").data;
        let places: Vec<[u32; 3]> = data
            .iter()
            .map(|it| [it.delta_line, it.delta_start, it.length])
            .collect();
        assert_eq!(places, [[0, 3, 2], [2, 0, 2], [0, 3, 1]]);
    }
}
