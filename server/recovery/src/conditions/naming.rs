//! The order of atoms: coils before inputs, each by address.
//!
//! The order is that of the paper's Table 5. It decides how conditions print
//! and, for the paper's own rule (`cubes`), what that rule finds.

use foldhash::{HashMap, HashMapExt, HashSet, HashSetExt};
use std::cmp::Ordering;

use ladder::{Declarations, ElementKind, Program};
use logic::{Atom, Name};

/// The Boolean variables of `program`, each once: what it writes first, in
/// the order of addresses, or of rungs where an address is missing; then what
/// it only reads, in the order of addresses, or of declarations and first
/// reading where one is missing.
pub(super) fn order(program: &Program) -> Vec<Atom> {
    let mut written = Vec::new();
    let mut read = Vec::new();
    let mut seen = HashSet::new();
    for (_, rung) in program.rungs() {
        for (_, element) in rung.network.elements() {
            if let ElementKind::Coil(coil) = &element.kind
                && seen.insert(coil.operand.name.clone())
            {
                written.push(coil.operand.name.clone());
            }
        }
    }
    for (_, rung) in program.rungs() {
        for (_, element) in rung.network.elements() {
            if let ElementKind::Contact(contact) = &element.kind
                && seen.insert(contact.operand.name.clone())
            {
                read.push(contact.operand.name.clone());
            }
        }
    }
    let mut place = HashMap::new();
    for (at, declaration) in program.declarations.iter().enumerate() {
        place.entry(declaration.name.clone()).or_insert(at);
    }
    read.sort_by_key(|name| place.get(name).copied().unwrap_or(usize::MAX));
    let names = [written, read].map(|names| by_address(names, &program.declarations));
    names.into_iter().flatten().map(Atom::Variable).collect()
}

/// `names` in the order of their addresses, or as they are if any has none.
fn by_address(mut names: Vec<Name>, declarations: &Declarations) -> Vec<Name> {
    let address = |name: &Name| -> Option<Name> {
        if name.starts_with('%') {
            return Some(name.clone());
        }
        declarations.find(name)?.address.clone()
    };
    if names.iter().all(|name| address(name).is_some()) {
        names.sort_by(|a, b| {
            natural(
                &address(a).unwrap_or_default(),
                &address(b).unwrap_or_default(),
            )
        });
    }
    names
}

/// Compares texts with the numbers in them by value: `%I2` before `%I10`.
pub(crate) fn natural(a: &str, b: &str) -> Ordering {
    pieces(a).cmp(pieces(b))
}

/// Runs of digits by value, other characters one by one.
fn pieces(text: &str) -> impl Iterator<Item = (u64, char)> + '_ {
    let mut rest = text.chars().peekable();
    std::iter::from_fn(move || {
        let first = rest.next()?;
        let Some(mut value) = first.to_digit(10).map(u64::from) else {
            return Some((0, first));
        };
        while let Some(digit) = rest.peek().and_then(|c| c.to_digit(10)) {
            value = value.saturating_mul(10).saturating_add(u64::from(digit));
            rest.next();
        }
        Some((value, '0'))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_in_addresses_count_by_value() {
        let mut addresses = ["%I10", "%I2", "%I1.10", "%I1.9", "%I1"];
        addresses.sort_by(|a, b| natural(a, b));
        assert_eq!(addresses, ["%I1", "%I1.9", "%I1.10", "%I2", "%I10"]);
    }
}
