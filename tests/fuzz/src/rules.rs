use source::{Diagnostic, Span};

/// Reads `bytes` as a rule text. Places lie in the text; the layout is stable
/// and says the same; so does what is written; a text that is rewritten to say
/// what it says stays as it is.
pub fn keeps_rules(bytes: &[u8]) {
    let Ok(text) = std::str::from_utf8(bytes) else {
        return;
    };
    let reading = grafcet::read(text);
    for it in &reading.diagnostics {
        are_inside(text, it);
    }
    let laid_out = grafcet::format(text);
    let again = grafcet::format(&laid_out.text);
    assert_eq!(laid_out.text, again.text, "laid out twice");
    let rest = grafcet::read(&laid_out.text);
    assert!(rest.spec.says_the_same(&reading.spec), "laid out: {}", laid_out.text);

    let rewritten = grafcet::rewrite(text, &reading.spec);
    assert_eq!(rewritten, text, "rewritten to say what it says");

    let written = grafcet::write(&reading.spec);
    let back = grafcet::read(&written);
    assert!(back.spec.says_the_same(&reading.spec), "written: {written}");
}

/// Every place of a finding lies in the text.
pub(crate) fn are_inside(text: &str, it: &Diagnostic) {
    let is_inside = |span: Span| text.get(span.range()).is_some();
    assert!(is_inside(it.span), "outside: {it:?}");
    assert!(it.related.iter().all(|related| is_inside(related.span)), "outside: {it:?}");
    let mut edits = it.fix.iter().flat_map(|fix| &fix.edits);
    assert!(edits.all(|edit| is_inside(edit.span)), "outside: {it:?}");
}
