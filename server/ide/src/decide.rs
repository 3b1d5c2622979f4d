//! What a new decision does to those made before.
//!
//! A person who accepts a pair takes back its rejection; who accepts two
//! followers together no longer accepts them apart. So each is a change of the
//! list, not only an addition to it.

use grafcet::{Decision, Verdict};
use logic::Name;
use recovery::Analysis;

/// Takes back that some of the states `to` do not follow `from`.
pub fn take_rejection_back(decisions: &mut Vec<Decision>, from: &Name, to: &[Name]) {
    decisions.retain(|decision| match &decision.verdict {
        Verdict::Reject { from: f, to: t } => f != from || !to.contains(t),
        _ => true,
    });
}

/// Accepts that the states `to` start together after `from`.
pub fn accept(decisions: &mut Vec<Decision>, from: &Name, to: &[Name]) {
    take_rejection_back(decisions, from, to);
    // The first decision about one of these states becomes the new one; they
    // leave all others.
    let mut new = Some(to.to_vec());
    for decision in decisions.iter_mut() {
        let Verdict::Accept { from: f, to: group } = &mut decision.verdict else {
            continue;
        };
        if f != from || !group.iter().any(|state| to.contains(state)) {
            continue;
        }
        let is_same = group.len() == to.len() && group.iter().all(|state| to.contains(state));
        let rest: Vec<Name> = group
            .iter()
            .filter(|state| !to.contains(state))
            .cloned()
            .collect();
        if is_same {
            new = None;
        } else if rest.is_empty() && new.is_some() {
            *group = new.take().unwrap_or_default();
        } else {
            *group = rest;
        }
    }
    decisions.retain(
        |decision| !matches!(&decision.verdict, Verdict::Accept { to, .. } if to.is_empty()),
    );
    if let Some(to) = new {
        let from = from.clone();
        decisions.push(Verdict::Accept { from, to }.into());
    }
}

/// Decides that `to` does not follow `from`.
pub fn reject(decisions: &mut Vec<Decision>, from: &Name, to: &Name) {
    for decision in decisions.iter_mut() {
        if let Verdict::Accept { from: f, to: group } = &mut decision.verdict
            && f == from
        {
            group.retain(|state| state != to);
        }
    }
    let rejection = Verdict::Reject {
        from: from.clone(),
        to: to.clone(),
    };
    decisions.retain(|decision| match &decision.verdict {
        Verdict::Accept { to, .. } => !to.is_empty(),
        verdict => *verdict != rejection,
    });
    decisions.push(rejection.into());
}

/// Decides that sequences start in these states. In a group of states that
/// depend on each other they take the place of those decided before.
pub fn start_in(states: &[Name], analysis: &Analysis, decisions: &mut Vec<Decision>) {
    let group_of = |name: &Name| {
        let mut groups = analysis.groups().iter();
        groups.position(|group| group.states.contains(name))
    };
    let groups: Vec<_> = states.iter().map(group_of).collect();
    decisions.retain(|decision| match &decision.verdict {
        Verdict::Initial(old) => states.contains(old) || !groups.contains(&group_of(old)),
        _ => true,
    });
    for name in states {
        let initial = Verdict::Initial(name.clone());
        if !decisions.iter().any(|it| it.verdict == initial) {
            decisions.push(initial.into());
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Decisions, each a line of the notation.
    fn decisions(lines: &str) -> Vec<Decision> {
        grafcet::read(lines).spec.decisions
    }

    #[track_caller]
    fn check(change: impl Fn(&mut Vec<Decision>), before: &str, after: &str) {
        let mut made = decisions(before);
        change(&mut made);
        assert_eq!(made, decisions(after));
    }

    fn names(list: &[&str]) -> Vec<Name> {
        list.iter().map(|name| (*name).into()).collect()
    }

    fn accepting<'a>(from: &'a str, to: &'a [&str]) -> impl Fn(&mut Vec<Decision>) + 'a {
        move |made| accept(made, &from.into(), &names(to))
    }

    #[test]
    fn accepting_takes_a_rejection_back() {
        check(
            accepting("a", &["b"]),
            "//! reject a -> b\n//! reject a -> c\n",
            "//! reject a -> c\n//! accept a -> b\n",
        );
    }

    #[test]
    fn accepting_together_replaces_accepting_apart() {
        check(
            accepting("a", &["b", "c"]),
            "//! accept a -> b  // seen\n//! accept a -> c\n//! accept x -> c\n",
            "//! accept a -> b & c  // seen\n//! accept x -> c\n",
        );
    }

    #[test]
    fn accepting_apart_leaves_the_others_together() {
        check(
            accepting("a", &["b"]),
            "//! accept a -> b & c & d\n",
            "//! accept a -> c & d\n//! accept a -> b\n",
        );
    }

    #[test]
    fn accepting_again_changes_nothing() {
        let before = "//! accept a -> b & c\n//! keep t1\n";
        check(accepting("a", &["c", "b"]), before, before);
    }

    #[test]
    fn rejecting_takes_an_acceptance_back() {
        check(
            |made| reject(made, &"a".into(), &"b".into()),
            "//! accept a -> b\n//! accept a -> c & b\n",
            "//! accept a -> c\n//! reject a -> b\n",
        );
    }
}
