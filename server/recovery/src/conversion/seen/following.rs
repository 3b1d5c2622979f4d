//! The way through all writes, in the order of the scan.

use std::collections::{BTreeSet, HashMap};

use ladder::scan::Machine;
use logic::{Atom, AtomId, Budget, Expr, Function, Name};

use super::Seen;
use crate::Analysis;
use crate::conditions::{AT_START, Variable, Write, WriteKind, value_after};
use crate::conversion::actions::own_variables;
use crate::conversion::unsaid::Unsaid;
use crate::order::{Order, Place, Reader, names_in};

/// The way through a program that finds out what rungs see.
struct Following<'a> {
    seen: Seen,
    writes: HashMap<AtomId, Vec<Known>>,
    between: HashMap<(AtomId, usize), Result<Function, Unsaid>>,
    machine: Machine<'a>,
    order: &'a Order,
    budget: Budget,
}

/// A write as it is seen, and when it happens.
type Known = (Place, Result<Write, Unsaid>);

/// What the own variables of a ladder become in a scan.
pub(super) fn followed(analysis: &Analysis, budget: &Budget) -> Seen {
    Following::new(analysis, budget).seen
}

impl<'a> Following<'a> {
    fn new(analysis: &'a Analysis, budget: &Budget) -> Self {
        let order = analysis.order();
        // What only rungs write that no scan solves is an input.
        let is_written = |it: &&Variable| {
            let mut writes = it.writes.iter();
            writes.any(|write| order.of(write.place.rung(), write.place.element).is_some())
        };
        let variables: Vec<&Variable> = own_variables(analysis).filter(is_written).collect();
        let machine = Machine::new(&analysis.program);
        let mut atoms = analysis.conditions.atoms.clone();
        // A line end keeps these apart from all that a program can name.
        let before: HashMap<AtomId, AtomId> = variables
            .iter()
            .map(|it| {
                let name = format!("{}\nbefore the scan", it.name).into();
                (it.atom, atoms.add_variable(&name))
            })
            .collect();
        let first = atoms.add_variable(&"\nthe first scan".into());
        let on = variables.iter().filter(|it| machine.is_on(&it.name));
        let seen = Seen {
            atoms,
            of_before: before.iter().map(|(of, before)| (*before, *of)).collect(),
            before,
            first,
            next: HashMap::new(),
            initial: on.map(|it| it.atom).collect(),
        };
        let mut following = Self {
            seen,
            writes: HashMap::new(),
            between: HashMap::new(),
            machine,
            order,
            budget: budget.clone(),
        };
        following.follow(&variables);
        following
    }

    /// Brings all writes, in the order of the scan, to what they see.
    fn follow(&mut self, variables: &[&Variable]) {
        let mut open = Vec::new();
        let mut repeated = BTreeSet::new();
        for variable in variables {
            self.writes.insert(variable.atom, Vec::new());
            for write in &variable.writes {
                match self.order.of(write.place.rung(), write.place.element) {
                    Some(Ok(rank)) => open.push(((rank, write.place.element), write)),
                    Some(Err(())) => {
                        repeated.insert(variable.atom);
                    }
                    None => {}
                }
            }
        }
        open.sort_by_key(|(place, _)| *place);
        for (place, write) in &open {
            let known = self.writes.entry(write.target).or_default();
            known.push((*place, Err(Unsaid::Repeated)));
        }
        let mut done: HashMap<AtomId, usize> = HashMap::new();
        for (place, write) in open {
            let seen = self.write(place, write);
            let at = done.entry(write.target).or_default();
            if let Some(it) = self
                .writes
                .get_mut(&write.target)
                .and_then(|it| it.get_mut(*at))
            {
                it.1 = seen;
            }
            *at += 1;
        }
        for variable in variables {
            let next = match repeated.contains(&variable.atom) {
                true => Err(Unsaid::Repeated),
                false => self.folded(variable.atom, usize::MAX),
            };
            self.seen.next.insert(variable.atom, next);
        }
    }

    /// A variable after its first `writes` writes, over its own atom as what
    /// it was before.
    fn folded(&self, atom: AtomId, writes: usize) -> Result<Function, Unsaid> {
        let known = self.writes.get(&atom).map_or(&[][..], Vec::as_slice);
        let known: Result<Vec<Write>, Unsaid> = known
            .iter()
            .take(writes)
            .map(|(_, write)| write.clone())
            .collect();
        value_after(atom, &known?, &self.budget).map_err(|_| Unsaid::TooLarge)
    }

    /// The same as others see it.
    fn after_writes(&mut self, atom: AtomId, writes: usize) -> Result<Function, Unsaid> {
        if let Some(known) = self.between.get(&(atom, writes)) {
            return known.clone();
        }
        let value = self.folded(atom, writes).and_then(|value| {
            let before = Function::atom(self.seen.before[&atom]);
            let value = value.substitute(atom, &before, &self.budget);
            value.map_err(|_| Unsaid::TooLarge)
        });
        self.between.insert((atom, writes), value.clone());
        value
    }

    /// A write with everything in it as it is seen there.
    fn write(&mut self, place: Place, write: &Write) -> Result<Write, Unsaid> {
        let mut seen = write.clone();
        let reader = self.order.reader(place, write.place.rung());
        let whole = |it: &Result<Function, _>| it.as_ref().is_ok_and(Function::is_true);
        let is_always = whole(&write.solved) && whole(&write.zone);
        for circumstance in [&write.solved, &write.zone].into_iter().flatten() {
            self.check_own(circumstance, write.target, &reader)?;
        }
        for function in [&mut seen.guard, &mut seen.solved, &mut seen.zone] {
            let known = function.as_ref().map_err(|_| Unsaid::TooLarge)?;
            *function = Ok(self.function(known, write.target, &reader, is_always)?);
        }
        if let Some(effective) = &write.effective {
            let known = effective.as_ref().map_err(|_| Unsaid::TooLarge)?;
            let known = self.function(known, write.target, &reader, is_always)?;
            seen.effective = Some(Ok(known));
        }
        match write.kind {
            WriteKind::Coil(_) | WriteKind::Bit(_) => {}
            WriteKind::BitOf(source) => {
                let source = self.copied(source, &reader)?;
                seen.kind = WriteKind::BitOf(source);
            }
            WriteKind::Unknown(_) => return Err(Unsaid::Written),
        }
        Ok(seen)
    }

    /// What decides whether a rung is solved may depend on the variable that it
    /// writes: folding takes that for what was before the scan.
    fn check_own(
        &self,
        circumstance: &Function,
        target: AtomId,
        reader: &Reader,
    ) -> Result<(), Unsaid> {
        let Atom::Variable(name) = self.seen.atoms.atom(target) else {
            return Ok(());
        };
        let is_before = || self.writes_before(target, name, reader);
        match circumstance.depends_on(target) && is_before()? != Writes::None {
            true => Err(Unsaid::Between(name.clone())),
            false => Ok(()),
        }
    }

    /// The atom of what a copy copies.
    fn copied(&mut self, source: AtomId, reader: &Reader) -> Result<AtomId, Unsaid> {
        match self.atom(source, reader, true)? {
            None => Ok(source),
            Some(value) => match value.support() {
                [one] if value == Function::atom(*one) => Ok(*one),
                _ => Err(Unsaid::Written),
            },
        }
    }

    /// `function` over what `reader` sees.
    fn function(
        &mut self,
        function: &Function,
        target: AtomId,
        reader: &Reader,
        is_always: bool,
    ) -> Result<Function, Unsaid> {
        let mut by = Vec::new();
        for &atom in function.support() {
            // What a rung sees of what it writes itself is known where the
            // writes are folded.
            if atom == target || atom == AT_START {
                continue;
            }
            if let Some(value) = self.atom(atom, reader, is_always)? {
                by.push((atom, value));
            }
        }
        // What is between two writes may speak of the same atoms as the rest.
        by.sort_by_key(|(atom, value)| (value.support().len(), *atom));
        let mut seen = function.clone();
        for (atom, value) in by {
            let put = seen.substitute(atom, &value, &self.budget);
            seen = put.map_err(|_| Unsaid::TooLarge)?;
        }
        Ok(seen)
    }

    /// What `reader` sees of an atom, if it is not what it is after the scan.
    fn atom(
        &mut self,
        atom: AtomId,
        reader: &Reader,
        is_always: bool,
    ) -> Result<Option<Function>, Unsaid> {
        match self.seen.atoms.atom(atom).clone() {
            Atom::Variable(name) if self.seen.is_own(atom) => {
                let writes = self.writes_before(atom, &name, reader)?;
                Ok(match writes {
                    Writes::All => None,
                    Writes::None => Some(Function::atom(self.seen.before[&atom])),
                    Writes::Some(writes) => Some(self.after_writes(atom, writes)?),
                })
            }
            Atom::Rise(inner) => self.edge(&inner, Atom::Rise, reader, is_always),
            Atom::Fall(inner) => self.edge(&inner, Atom::Fall, reader, is_always),
            plain => Ok(match self.is_late(&plain, reader)? {
                false => None,
                true => Some(self.last(plain)?),
            }),
        }
    }

    fn writes_before(&self, atom: AtomId, name: &Name, reader: &Reader) -> Result<Writes, Unsaid> {
        let known = self.writes.get(&atom).map_or(&[][..], Vec::as_slice);
        let mut counts = self.order.readings(name, reader).into_iter().map(|place| {
            let before = known.partition_point(|(at, _)| *at < place);
            match before {
                all if all == known.len() => Writes::All,
                0 => Writes::None,
                some => Writes::Some(some),
            }
        });
        let first = counts.next().unwrap_or(Writes::All);
        match counts.all(|it| it == first) {
            true => Ok(first),
            false => Err(Unsaid::Between(name.clone())),
        }
    }

    /// Whether a number, a timer or the like is written only behind `reader`,
    /// which sees it as the last scan left it.
    fn is_late(&self, atom: &Atom, reader: &Reader) -> Result<bool, Unsaid> {
        let mut late = None;
        for name in names_in(&Expr::Atom(atom.clone())) {
            let is_late = match self.order.writings(&name) {
                Err(()) => return Err(Unsaid::Repeated),
                Ok(_) if self.order.is_constant(&name) => continue,
                // What nothing writes comes from the plant, in this scan.
                Ok(places) if places.is_empty() => false,
                Ok(places) => {
                    let readings = self.order.readings(&name, reader);
                    let pairs = || {
                        let pairs = readings.iter();
                        pairs.flat_map(|read| places.iter().map(move |written| written < read))
                    };
                    match (pairs().any(|it| it), pairs().all(|it| it)) {
                        (false, _) => true,
                        (_, true) => false,
                        _ => return Err(Unsaid::Between(name)),
                    }
                }
            };
            if late.is_some_and(|late| late != is_late) {
                return Err(Unsaid::Mixed(name));
            }
            late = Some(is_late);
        }
        Ok(late.unwrap_or(false))
    }

    /// What an atom that the spec reads from the ladder was in the last scan:
    /// what it is, but for the scans in which it has changed.
    fn last(&mut self, atom: Atom) -> Result<Function, Unsaid> {
        let was_on = self.begins_on(&atom);
        let now = Function::atom(self.seen.atoms.add(atom.clone()));
        let said = Box::new(match was_on {
            false => Expr::Atom(atom),
            true => Expr::Not(Box::new(Expr::Atom(atom))),
        });
        let rise = Function::atom(self.seen.atoms.add(Atom::Rise(said.clone())));
        let fall = Function::atom(self.seen.atoms.add(Atom::Fall(said)));
        let now = if was_on { now.not() } else { now };
        let last = now
            .and_not(&rise, &self.budget)
            .and_then(|same| same.or(&fall, &self.budget))
            .map_err(|_| Unsaid::TooLarge)?;
        Ok(if was_on { last.not() } else { last })
    }

    /// Whether an atom holds before the first scan.
    fn begins_on(&self, atom: &Atom) -> bool {
        match atom {
            Atom::Variable(name) => self.machine.is_on(name),
            Atom::Comparison(it) => {
                let value = |text: &str| {
                    let computed = self.machine.compute(text);
                    computed.unwrap_or_else(|| self.machine.value(text))
                };
                value(&it.left).compares(it.relation, value(&it.right))
            }
            Atom::Rise(_) | Atom::Fall(_) | Atom::Elapsed { .. } => false,
        }
    }

    /// The edge of an expression of which `reader` may see what the last scan
    /// left.
    fn edge(
        &mut self,
        inner: &Expr,
        of: fn(Box<Expr>) -> Atom,
        reader: &Reader,
        is_always: bool,
    ) -> Result<Option<Function>, Unsaid> {
        if !is_always {
            return Err(Unsaid::SkippedEdge);
        }
        let mut renamed: HashMap<Name, Name> = HashMap::new();
        for name in names_in(inner) {
            let plain = Atom::Variable(name.clone());
            match self
                .seen
                .atoms
                .find(&plain)
                .filter(|id| self.seen.is_own(*id))
            {
                Some(id) => match self.writes_before(id, &name, reader)? {
                    Writes::All => {}
                    Writes::None => {
                        if let Atom::Variable(before) = self.seen.atoms.atom(self.seen.before[&id])
                        {
                            renamed.insert(name, before.clone());
                        }
                    }
                    Writes::Some(_) => return Err(Unsaid::Edge(name)),
                },
                None if self.is_late(&plain, reader)? => return Err(Unsaid::Edge(name)),
                None => {}
            }
        }
        if renamed.is_empty() {
            return Ok(None);
        }
        let edge = of(Box::new(with_names(inner, &renamed)));
        Ok(Some(Function::atom(self.seen.atoms.add(edge))))
    }
}

/// How many of a variable's writes come before a contact.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Writes {
    None,
    Some(usize),
    All,
}

/// An expression with some variables under other names.
fn with_names(expr: &Expr, renamed: &HashMap<Name, Name>) -> Expr {
    let all = |parts: &[Expr]| parts.iter().map(|it| with_names(it, renamed)).collect();
    match expr {
        Expr::Constant(_) => expr.clone(),
        Expr::Not(inner) => Expr::Not(Box::new(with_names(inner, renamed))),
        Expr::And(parts) => Expr::And(all(parts)),
        Expr::Or(parts) => Expr::Or(all(parts)),
        Expr::Atom(Atom::Variable(name)) => {
            Expr::variable(renamed.get(name).unwrap_or(name).clone())
        }
        Expr::Atom(Atom::Rise(inner)) => {
            Expr::Atom(Atom::Rise(Box::new(with_names(inner, renamed))))
        }
        Expr::Atom(Atom::Fall(inner)) => {
            Expr::Atom(Atom::Fall(Box::new(with_names(inner, renamed))))
        }
        Expr::Atom(_) => expr.clone(),
    }
}
