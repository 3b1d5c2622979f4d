//! Which pairs of states are looked for.

use std::collections::{BTreeSet, HashMap};

use logic::{Datum, Name, Relation};
use recovery::Analysis;
use recovery::successions::Evidence;

/// Of a group of so many states every pair is looked for; of a larger one only
/// those that are suggested.
const ALL_PAIRS_OF: usize = 20;

/// So many pairs are looked for in all.
const MOST_PAIRS: usize = 4_000;

/// Where a state is held.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Held {
    /// The variable.
    pub variable: Name,
    /// The value of a step register; `None` of a bit.
    pub value: Option<i64>,
}

impl Held {
    /// Whether the state is on where the variable holds `datum`.
    pub fn is_on(&self, datum: Datum) -> bool {
        match self.value {
            Some(value) => datum.compares(Relation::Equal, Datum::Integer(value)),
            None => datum.is_on(),
        }
    }
}

/// Pairs of states: the one that ends, the one that begins.
#[derive(Debug, Default)]
pub(super) struct Pairs {
    /// The pairs, what is suggested first.
    pub list: Vec<(Name, Name)>,
    /// How many of them, at the beginning, are written or hand over.
    pub strong: usize,
    /// Where their states are held.
    pub held: HashMap<Name, Held>,
    /// States held in bits that depend on each other.
    pub groups: Vec<Vec<Name>>,
    /// The group of a state, by its place.
    pub group_of: HashMap<Name, usize>,
    /// Whether these are all pairs of states that depend on each other.
    pub are_all: bool,
}

impl Pairs {
    /// The pairs of a program.
    pub fn of(analysis: &Analysis) -> Self {
        let mut pairs = Self {
            are_all: true,
            ..Self::default()
        };
        let mut held: HashMap<Name, Held> = HashMap::new();
        for state in &analysis.states().states {
            let variable = state.name.clone();
            let value = None;
            held.insert(state.name.clone(), Held { variable, value });
        }
        for register in &analysis.registers {
            for state in &register.states {
                let variable = register.name.clone();
                let value = Some(state.value);
                held.insert(register.state_name(state.value), Held { variable, value });
            }
        }
        let mut listed: BTreeSet<(Name, Name)> = BTreeSet::new();
        let mut add = |pair: (Name, Name), pairs: &mut Self| {
            if pair.0 != pair.1 && listed.insert(pair.clone()) {
                match pairs.list.len() < MOST_PAIRS {
                    true => pairs.list.push(pair),
                    false => pairs.are_all = false,
                }
            }
        };
        // These come best first.
        for it in analysis.successions() {
            add((it.from.clone(), it.to.clone()), &mut pairs);
            if it.evidence <= Evidence::Handover {
                pairs.strong = pairs.list.len();
            }
        }
        for group in analysis.groups() {
            let is_bit = |name: &&Name| held.get(*name).is_some_and(|it| it.value.is_none());
            let bits: Vec<Name> = group.states.iter().filter(is_bit).cloned().collect();
            if bits.len() <= ALL_PAIRS_OF {
                for from in &bits {
                    for to in &bits {
                        add((from.clone(), to.clone()), &mut pairs);
                    }
                }
            } else {
                pairs.are_all = false;
            }
            let at = pairs.groups.len();
            let of_group = bits.iter().map(|name| (name.clone(), at));
            pairs.group_of.extend(of_group);
            pairs.groups.push(bits);
        }
        let is_listed: BTreeSet<&Name> = listed.iter().flat_map(|(a, b)| [a, b]).collect();
        held.retain(|name, _| is_listed.contains(name) || pairs.group_of.contains_key(name));
        pairs.held = held;
        pairs
    }

    /// Whether two states depend on each other.
    pub fn are_of_one_group(&self, from: &Name, to: &Name) -> bool {
        let group = self.group_of.get(from);
        group.is_some() && self.group_of.get(to) == group
    }
}
