use strsim::osa_distance;

use super::Subject;

/// Characters that may be wrong in a name of so many characters.
fn allowance(length: usize) -> usize {
    (length / 3).clamp(1, 3)
}

/// The name in `subject` that somebody may have meant by `written`: the one that
/// takes the fewest corrections, of several the first by the alphabet. `None` if
/// none is near.
pub(super) fn nearest(written: &str, subject: Subject<'_>) -> Option<String> {
    let length = written.chars().count();
    let most = allowance(length);
    let lower = written.to_lowercase();
    let corrections = |name: &str| {
        let is_near = name.chars().count().abs_diff(length) <= most;
        let distance = is_near.then(|| osa_distance(&lower, &name.to_lowercase()))?;
        (distance <= most && distance < length).then_some(distance)
    };
    let ranked = known(subject).filter_map(|name| Some((corrections(name)?, name)));
    ranked.min().map(|(_, name)| name.to_owned())
}

/// Everything that a scenario can name.
fn known<'s>(subject: Subject<'s>) -> impl Iterator<Item = &'s str> {
    let program = subject.ladder.into_iter();
    let in_ladder = program.flat_map(|program| {
        let declared = program.declarations.iter().map(|it| &*it.name);
        let elements = program
            .rungs()
            .flat_map(|(_, rung)| rung.network.elements().map(|(_, element)| element));
        declared.chain(elements.flat_map(|element| {
            let reads = element.kind.reads().into_iter();
            reads.chain(element.kind.writes()).map(|it| &*it.name)
        }))
    });
    let in_grafcet = subject.grafcet.into_iter().flat_map(|grafcet| {
        let variables = grafcet.variables().map(|it| &*it.name);
        variables.chain(grafcet.steps().map(|it| &*it.name))
    });
    in_ladder.chain(in_grafcet)
}
