use super::references::in_ladder;
use super::subject::{access, named};
use super::{Pair, Reference, Side};

/// The places of the thing at the byte `offset`, in the same text, under the
/// same name: on a step its step, not the coil that it stands for.
pub fn highlights(pair: Pair<'_>, side: Side, offset: usize) -> Vec<Reference> {
    let found = match side {
        Side::Ladder => named(pair, side, offset)
            .zip(pair.ladder)
            .map(|(named, ladder)| in_ladder(ladder, &named.subject)),
        Side::Spec => pair.spec.and_then(|spec| {
            let places = &spec.reading.places;
            let same = places.same_as(places.mention_at(offset)?);
            let same = same.map(|it| Reference {
                side,
                span: it.span,
                access: access(it),
            });
            Some(same.collect())
        }),
    };
    let mut found = found.unwrap_or_default();
    found.sort_by_key(|it| (it.span, it.access));
    found.dedup_by_key(|it| it.span);
    found
}

#[cfg(test)]
mod tests {
    use super::super::Access;
    use super::super::tests::{Fixture, LADDER, SPEC, with_cursor};
    use super::*;

    /// What lights up, as `line: text` with `!` where it is written.
    fn lit(ladder: &str, spec: &str) -> Vec<String> {
        let fixture = Fixture::new(ladder, spec);
        let found = highlights(fixture.pair(), fixture.side, fixture.offset);
        let shown = found.iter().map(|it| {
            let mark = if it.access == Access::Written {
                "!"
            } else {
                ""
            };
            format!("{}{mark}", fixture.show(it.side, it.span))
        });
        shown.collect()
    }

    #[test]
    fn contacts_are_read_and_coils_are_written() {
        let ladder = with_cursor(LADDER, "v2 * s -> $0v2");
        assert_eq!(lit(&ladder, SPEC), ["ladder 5: v2", "ladder 5: v2!"]);
    }

    #[test]
    fn steps_after_a_transition_are_written() {
        let spec = with_cursor(SPEC, "X$0v1 for");
        assert_eq!(lit(LADDER, &spec), ["spec 1: Xv1", "spec 6: Xv1!"]);
    }

    #[test]
    fn between_names_nothing_lights_up() {
        let spec = with_cursor(SPEC, "Trans$0itions:");
        assert_eq!(lit(LADDER, &spec), [""; 0]);
        let ladder = with_cursor(LADDER, "r$0ung: (s");
        assert_eq!(lit(&ladder, SPEC), [""; 0]);
    }
}
