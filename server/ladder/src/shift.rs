use source::{Diagnostic, Span};

/// What an edit does to the places behind it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Shift {
    /// The first byte that moves, and all behind it do.
    pub(crate) from: u32,
    /// By how many bytes.
    pub(crate) by: i64,
}

impl Shift {
    /// Whether a place is moved.
    pub(crate) fn moves(self, place: u32) -> bool {
        place >= self.from
    }

    /// Where a place is after the edit.
    pub(crate) fn place(self, place: u32) -> u32 {
        if !self.moves(place) {
            return place;
        }
        let moved = i64::from(place).saturating_add(self.by).max(0);
        u32::try_from(moved).unwrap_or(u32::MAX)
    }

    /// Where a stretch is after the edit, which is not inside of it.
    pub(crate) fn span(self, span: Span) -> Span {
        Span {
            start: self.place(span.start),
            end: self.place(span.end),
        }
    }

    /// A finding about a place that was not edited.
    pub(crate) fn diagnostic(self, finding: &Diagnostic) -> Diagnostic {
        let mut finding = finding.clone();
        finding.span = self.span(finding.span);
        for related in &mut finding.related {
            related.span = self.span(related.span);
        }
        for edit in finding.fix.iter_mut().flat_map(|fix| &mut fix.edits) {
            edit.span = self.span(edit.span);
        }
        finding
    }
}
