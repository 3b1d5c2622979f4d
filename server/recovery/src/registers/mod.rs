//! Step registers: whole numbers that count the steps of a sequence
//! (semantics, section 2).
//!
//! A register R bundles states `R=10`, `R=20`, of which exactly one holds. Its
//! arcs need no heuristic: for every value c and every write of R, the guard
//! of the write with R:=c says when R goes from c to what is written. A number
//! that is only moved and compared, such as the command word of a drive, is no
//! step register: at least one of its writes must depend on the number itself.

mod naming;
mod value;

use std::collections::{BTreeMap, BTreeSet, HashMap, HashSet, VecDeque};

use ladder::{Program, Value};
use logic::{Atom, AtomId, Atoms, Budget, Function, Name, Relation};
use source::Span;

use crate::conditions::{Conditions, Place, RegisterWrite};
use crate::successions::{Evidence, Kind, Succession};
use value::AtValue;

/// A step register and its chart.
#[derive(Clone, Debug)]
pub struct Register {
    /// The variable.
    pub name: Name,
    /// The value it starts with.
    pub start: i64,
    /// Its states, in the order of their values.
    pub states: Vec<RegisterState>,
    /// Its arcs, in the order of their values.
    pub arcs: Vec<RegisterArc>,
    /// Increments to a value that nothing in the program names: from, to.
    pub left_out: Vec<(i64, i64)>,
}

/// One value of a step register.
#[derive(Clone, Debug)]
pub struct RegisterState {
    /// The value.
    pub value: i64,
    /// What the comments of its rungs call the step.
    pub title: Option<Name>,
}

/// A change of a step register.
#[derive(Clone, Debug)]
pub struct RegisterArc {
    /// The value before.
    pub from: i64,
    /// The value written.
    pub to: i64,
    /// When, with the register at `from`; the sum over all writes that do it.
    pub condition: Function,
    /// The elements that write it.
    pub written_at: Vec<(Place, Span)>,
}

impl Register {
    /// The state at `value`, as answers spell it: `Seq=10`.
    pub fn state_name(&self, value: i64) -> Name {
        format!("{}={value}", self.name).into()
    }

    /// The arcs as suggestions: read off the writes, no heuristic.
    pub fn successions(&self) -> Vec<Succession> {
        self.arcs
            .iter()
            .map(|arc| Succession {
                from: self.state_name(arc.from),
                to: self.state_name(arc.to),
                evidence: Evidence::Written,
                kind: Kind::Or,
                condition: Some(arc.condition.clone()),
                witness: None,
            })
            .collect()
    }
}

/// A register must be able to stay in at least this many values to count
/// steps.
const FEWEST_STATES: usize = 3;

/// A chart of more values than this is not drawn by counting them one by one.
const MOST_VALUES: usize = 1_000;

/// The step registers of `program`. New atoms, such as `OK[3]` for `OK[R]` at
/// 3, are added to the table of `conditions`.
pub fn registers(program: &Program, conditions: &mut Conditions, budget: &Budget) -> Vec<Register> {
    if conditions.register_writes.is_empty() {
        return Vec::new();
    }
    let mut writes: BTreeMap<Name, Vec<RegisterWrite>> = BTreeMap::new();
    for write in &conditions.register_writes {
        writes
            .entry(write.target.clone())
            .or_default()
            .push(write.clone());
    }
    let named = named_values(&conditions.atoms);
    let mut found = Vec::new();
    for (name, writes) in writes {
        let reads_itself = |write: &RegisterWrite| {
            write.guard.as_ref().is_ok_and(|guard| {
                guard
                    .support()
                    .iter()
                    .any(|atom| value::mentions(conditions.atoms.atom(*atom), &name))
            })
        };
        if !writes.iter().any(reads_itself) {
            continue;
        }
        let Some(values) = values(&name, &writes, &named) else {
            continue;
        };
        let start = start_value(&name, &writes, program, conditions);
        let chart = chart(&name, start, &values, &writes, conditions, budget);
        if chart.waiting(budget) >= FEWEST_STATES && chart.depends_on_itself {
            found.push(Register {
                states: chart
                    .states
                    .iter()
                    .map(|&value| RegisterState {
                        value,
                        title: naming::title(program, &name, value),
                    })
                    .collect(),
                arcs: chart.arcs,
                left_out: chart.left_out.into_iter().collect(),
                name,
                start,
            });
        }
    }
    found
}

/// Values that comparisons and constant indices name, by register and, for
/// indices, by array.
struct Named {
    compared: HashMap<Name, BTreeSet<i64>>,
    /// Arrays read at `[R]`, by R.
    arrays: HashMap<Name, HashSet<String>>,
    /// Constant indices, by array.
    indices: HashMap<String, BTreeSet<i64>>,
}

fn named_values(atoms: &Atoms) -> Named {
    let mut named = Named {
        compared: HashMap::new(),
        arrays: HashMap::new(),
        indices: HashMap::new(),
    };
    for (_, atom) in atoms.iter() {
        match atom {
            Atom::Comparison(comparison) => {
                let Ok(value) = comparison.right.parse::<i64>() else {
                    continue;
                };
                let values = named.compared.entry(comparison.left.clone()).or_default();
                // The other side of a strict bound is a value of its own.
                match comparison.relation {
                    Relation::Equal => values.extend([value]),
                    Relation::Less => values.extend([value - 1, value]),
                    Relation::Greater => values.extend([value, value + 1]),
                    _ => {}
                }
            }
            Atom::Variable(name) => {
                for (array, index) in value::indices(name) {
                    match index.parse::<i64>() {
                        Ok(value) => {
                            named.indices.entry(array).or_default().insert(value);
                        }
                        Err(_) => {
                            named.arrays.entry(index.into()).or_default().insert(array);
                        }
                    }
                }
            }
            _ => {}
        }
    }
    named
}

/// The values that the program names for a register, if it is read by value
/// at all.
fn values(name: &Name, writes: &[RegisterWrite], named: &Named) -> Option<BTreeSet<i64>> {
    let mut values = named.compared.get(name).cloned().unwrap_or_default();
    let arrays = named.arrays.get(name);
    for array in arrays.into_iter().flatten() {
        values.extend(named.indices.get(array).into_iter().flatten());
    }
    if values.is_empty() && arrays.is_none() {
        return None;
    }
    for write in writes {
        if let Value::Constant(value) = write.value {
            values.insert(value);
        }
    }
    (values.len() <= MOST_VALUES).then_some(values)
}

/// The value at the start: what the first scan moves in, else the declared
/// initial value, else 0.
fn start_value(
    name: &Name,
    writes: &[RegisterWrite],
    program: &Program,
    conditions: &Conditions,
) -> i64 {
    let first_scan = |function: &Function| {
        function.support().iter().any(|&atom| {
            matches!(conditions.atoms.atom(atom), Atom::Variable(n) if is_first_scan(n))
                && function.restrict(atom, true).is_true()
        })
    };
    let set_first = writes.iter().find_map(|write| match write.value {
        Value::Constant(value) if write.guard.as_ref().is_ok_and(first_scan) => Some(value),
        _ => None,
    });
    let declared = || {
        let declaration = program.declarations.find(name)?;
        declaration.initial.as_ref()?.parse().ok()
    };
    set_first.or_else(declared).unwrap_or(0)
}

/// Whether a name is the bit that is on in the first scan only.
pub(crate) fn is_first_scan(name: &str) -> bool {
    ["S:FS", "%S6", "FirstScan", "First_Scan", "__FIRST_SCAN"]
        .iter()
        .any(|known| name.eq_ignore_ascii_case(known))
}

struct Chart {
    states: BTreeSet<i64>,
    arcs: Vec<RegisterArc>,
    left_out: BTreeSet<(i64, i64)>,
    /// Whether some write happens at some values under other conditions than
    /// at others, not counting the value that it writes.
    depends_on_itself: bool,
}

impl Chart {
    /// The number of values at which the register can stay.
    fn waiting(&self, budget: &Budget) -> usize {
        let stays = |value: &&i64| {
            let mut leaving = self.arcs.iter().filter(|arc| arc.from == **value);
            let leaving = leaving.try_fold(Function::constant(false), |sum, arc| {
                sum.or(&arc.condition, budget)
            });
            !leaving.is_ok_and(|leaving| leaving.is_true())
        };
        self.states.iter().filter(stays).count()
    }
}

/// The values that can be reached from `start`, and the arcs between them.
fn chart(
    name: &Name,
    start: i64,
    values: &BTreeSet<i64>,
    writes: &[RegisterWrite],
    conditions: &mut Conditions,
    budget: &Budget,
) -> Chart {
    let mut chart = Chart {
        states: BTreeSet::from([start]),
        arcs: Vec::new(),
        left_out: BTreeSet::new(),
        depends_on_itself: false,
    };
    // The condition of each write at the first value it was looked at.
    let mut first_seen: HashMap<usize, Function> = HashMap::new();
    let mut arcs: BTreeMap<(i64, i64), RegisterArc> = BTreeMap::new();
    let mut open = VecDeque::from([start]);
    let resolved = value::dependent_coils(conditions, name);
    while let Some(from) = open.pop_front() {
        if budget.cancel.is_cancelled() {
            break;
        }
        let mut at = AtValue::new(name, from, &resolved, conditions, budget);
        for (which, write) in writes.iter().enumerate() {
            let to = match write.value {
                Value::Constant(value) => value,
                Value::Increment(by) => from.saturating_add(by),
                _ => continue,
            };
            let Ok(guard) = &write.guard else { continue };
            let Ok(condition) = at.condition(guard) else {
                continue;
            };
            if to == from {
                continue;
            }
            let elsewhere = first_seen.entry(which).or_insert_with(|| condition.clone());
            chart.depends_on_itself |= *elsewhere != condition;
            if !at.can_happen(&condition) {
                continue;
            }
            if !values.contains(&to) {
                chart.left_out.insert((from, to));
                continue;
            }
            let arc = arcs.entry((from, to)).or_insert_with(|| RegisterArc {
                from,
                to,
                condition: Function::constant(false),
                written_at: Vec::new(),
            });
            arc.written_at.push((write.place, write.span));
            if let Ok(sum) = arc.condition.or(&condition, budget) {
                arc.condition = sum;
            }
            if chart.states.insert(to) {
                open.push_back(to);
            }
        }
    }
    chart.arcs = arcs.into_values().collect();
    chart
}

/// The atom of a register's state, for tables that speak of both kinds.
pub fn state_atom(register: &Register, value: i64, atoms: &mut Atoms) -> AtomId {
    atoms.add(Atom::Comparison(logic::Comparison {
        left: register.name.clone(),
        relation: Relation::Equal,
        right: value.to_string().into(),
    }))
}
