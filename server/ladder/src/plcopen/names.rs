//! One name for every variable.
//!
//! The standard ignores case, lets every unit declare names of its own, and
//! lets an element name a variable or the address that it lies at. The model
//! wants equal names for equal variables, so names are folded here:
//!
//! * onto the spelling of the declaration, or the first spelling met;
//! * onto the variable, where an address is named that one is declared at;
//! * a variable keeps its bare name if no other unit declares it, else it is
//!   `unit.name`.

use std::ops::Range;

use foldhash::{HashMap, HashSet};
use logic::Name;

use super::expression;
use super::interface::{Globals, Owner, Structure, Unit, UnitKind, Variable};
use super::standard;
use crate::{Declaration, Declarations};
use source::{Diagnostic, Severity, Span, codes};

/// The type of a step: it has the members `X` and `T`.
const STEP: &str = "STEP";

/// Indices nest this deep at most; what lies deeper keeps its spelling.
const DEEPEST_INDEX: usize = 8;

/// What every name of the project stands for.
pub(super) struct Names {
    /// By place of the unit.
    scopes: Vec<Scope>,
    globals: HashMap<String, Symbol>,
    lists: HashSet<String>,
    /// Names that units declare for themselves.
    owned: HashSet<String>,
    /// Variables by the address they lie at.
    addresses: HashMap<String, Symbol>,
    /// Members by type.
    types: HashMap<String, HashMap<String, Symbol>>,
    /// What kind of unit a name is.
    kinds: HashMap<String, UnitKind>,
    /// The first spelling of every name, by its form without case.
    spelt: HashMap<String, Name>,
}

struct Scope {
    name: Name,
    symbols: HashMap<String, Symbol>,
}

#[derive(Clone)]
struct Symbol {
    name: Name,
    data_type: Option<Name>,
}

/// A term with its variables folded.
pub(super) struct Term {
    pub(super) text: String,
    /// Variables in it, with the bytes of the original text.
    pub(super) reads: Vec<(Name, Range<usize>)>,
}

impl Names {
    /// The names of a project, and its declarations.
    pub(super) fn new(
        units: &[Unit<'_, '_>],
        globals: &[Globals],
        structures: &[Structure],
        diagnostics: &mut Vec<Diagnostic>,
    ) -> (Self, Declarations) {
        let mut names = Self {
            scopes: Vec::new(),
            globals: HashMap::default(),
            lists: HashSet::default(),
            owned: HashSet::default(),
            addresses: HashMap::default(),
            types: types(units, structures),
            kinds: units.iter().map(|u| (key(&u.name), u.kind)).collect(),
            spelt: HashMap::default(),
        };
        let mut declarations = Declarations::default();
        for list in globals {
            names.declare_globals(list, &mut declarations);
        }
        let shared = shared_names(units);
        for unit in units {
            let scope = names.declare_unit(unit, &shared, &mut declarations, diagnostics);
            names.scopes.push(scope);
        }
        (names, declarations)
    }

    fn declare_globals(&mut self, list: &Globals, declarations: &mut Declarations) {
        if !list.list.is_empty() {
            self.lists.insert(key(&list.list));
        }
        for variable in list.variables.iter().filter(|v| !v.name.is_empty()) {
            let bare = key(&variable.name);
            let taken = self.globals.contains_key(&bare);
            let name: Name = if taken && !list.list.is_empty() {
                format!("{}.{}", list.list, variable.name).into()
            } else {
                variable.name.clone()
            };
            let symbol = self.declare(variable, name, declarations);
            if !list.list.is_empty() {
                let qualified = format!("{}.{bare}", key(&list.list));
                self.globals.insert(qualified, symbol.clone());
            }
            self.globals.entry(bare).or_insert(symbol);
        }
    }

    fn declare_unit(
        &mut self,
        unit: &Unit<'_, '_>,
        shared: &HashSet<String>,
        declarations: &mut Declarations,
        diagnostics: &mut Vec<Diagnostic>,
    ) -> Scope {
        let mut scope = Scope {
            name: unit.name.clone(),
            symbols: HashMap::default(),
        };
        let mut places: HashMap<String, Span> = HashMap::default();
        for variable in unit.variables.iter().filter(|v| !v.name.is_empty()) {
            let bare = key(&variable.name);
            if let Some(first) = places.get(&bare) {
                let message = format!("`{}` is declared twice in `{}`", variable.name, unit.name);
                diagnostics.push(
                    Diagnostic::new(codes::DECLARED_TWICE, variable.span, message)
                        .help("keep one of them; the first is used")
                        .related(*first, "declared here first"),
                );
                continue;
            }
            places.insert(bare.clone(), variable.span);
            let symbol = match (variable.owner, self.globals.get(&bare)) {
                (Owner::External, Some(global)) => global.clone(),
                (Owner::External, None) => {
                    let symbol = self.declare(variable, variable.name.clone(), declarations);
                    self.globals.insert(bare.clone(), symbol.clone());
                    symbol
                }
                (Owner::Unit, _) => {
                    let name = self.own_name(unit, &variable.name, shared);
                    self.declare(variable, name, declarations)
                }
            };
            if let Some(address) = variable.address.as_deref().and_then(address_key) {
                match places.get(&address) {
                    Some(first) => diagnostics.push(one_address(variable, &symbol.name, *first)),
                    None => {
                        places.insert(address, variable.span);
                    }
                }
            }
            scope.symbols.insert(bare, symbol);
        }
        let implied = |data_type: &str, list: &[Name]| {
            list.iter()
                .map(|name| (name.clone(), Name::from(data_type)))
                .collect::<Vec<_>>()
        };
        let mut charted = implied(STEP, &unit.steps);
        charted.extend(implied("BOOL", &unit.transitions));
        for (name, data_type) in charted {
            let bare = key(&name);
            let folded = self.own_name(unit, &name, shared);
            self.owned.insert(bare.clone());
            scope.symbols.entry(bare).or_insert(Symbol {
                name: folded,
                data_type: Some(data_type),
            });
        }
        scope
    }

    /// The name of a unit's own variable in the whole program.
    fn own_name(&self, unit: &Unit<'_, '_>, name: &Name, shared: &HashSet<String>) -> Name {
        let bare = key(name);
        if shared.contains(&bare) || self.globals.contains_key(&bare) {
            format!("{}.{name}", unit.name).into()
        } else {
            name.clone()
        }
    }

    /// Declares `variable` as `name`, or as the variable that already lies at
    /// its address.
    fn declare(
        &mut self,
        variable: &Variable,
        name: Name,
        declarations: &mut Declarations,
    ) -> Symbol {
        if variable.owner == Owner::Unit {
            self.owned.insert(key(&variable.name));
        }
        let address = variable.address.as_deref().and_then(address_key);
        if let Some(symbol) = address.as_ref().and_then(|at| self.addresses.get(at)) {
            return symbol.clone();
        }
        let symbol = Symbol {
            name: name.clone(),
            data_type: variable.data_type.clone(),
        };
        if let Some(address) = address {
            self.addresses.insert(address, symbol.clone());
        }
        self.spelt.entry(key(&name)).or_insert_with(|| name.clone());
        declarations.add(Declaration {
            name,
            address: variable.address.clone(),
            description: variable.description.clone(),
            class: variable.class,
            data_type: variable.data_type.clone(),
            initial: variable.initial.clone(),
            span: variable.span,
        });
        symbol
    }

    /// The name of the variable that `path` means in a unit.
    pub(super) fn fold(&mut self, unit: usize, path: &str) -> Name {
        self.fold_at_depth(unit, path, 0)
    }

    fn fold_at_depth(&mut self, unit: usize, path: &str, depth: usize) -> Name {
        let path = path.trim();
        let folded = match self.find(unit, path) {
            Some((symbol, rest)) => {
                let symbol = symbol.clone();
                let (rest, _) = self.fold_members(unit, symbol.data_type, rest, depth);
                format!("{}{rest}", symbol.name)
            }
            None => self.undeclared(unit, path, depth),
        };
        self.spell(&folded)
    }

    /// A folded name in the spelling in which it was met first.
    pub(super) fn spell(&mut self, name: &str) -> Name {
        let spelling = self.spelt.entry(key(name));
        spelling.or_insert_with(|| name.into()).clone()
    }

    /// A name that nobody declares where it is used. It must not become equal
    /// to one that another unit declares for itself.
    fn undeclared(&mut self, unit: usize, path: &str, depth: usize) -> String {
        let (head, rest) = first_name(path);
        let (rest, _) = self.fold_members(unit, None, rest, depth);
        match self.scopes.get(unit) {
            Some(scope) if self.owned.contains(&key(head)) => {
                format!("{}.{head}{rest}", scope.name)
            }
            _ => format!("{head}{rest}"),
        }
    }

    /// What follows a variable of a type: members spelt as declared, variables
    /// inside of brackets folded. With it the type of the whole.
    fn fold_members(
        &mut self,
        unit: usize,
        data_type: Option<Name>,
        mut rest: &str,
        depth: usize,
    ) -> (String, Option<Name>) {
        let mut folded = String::new();
        let mut found = data_type;
        while !rest.is_empty() {
            if let Some(after) = rest.strip_prefix('^') {
                folded.push('^');
                found = found.and_then(|found| Some(found.strip_prefix("POINTER TO ")?.into()));
                rest = after;
            } else if let Some(index) = index_range(rest) {
                let inner = rest.get(index.clone()).unwrap_or_default().trim();
                let inner = if depth < DEEPEST_INDEX {
                    self.rewrite_at_depth(unit, inner, depth + 1).text
                } else {
                    inner.to_owned()
                };
                folded += &format!("[{inner}]");
                found = found.and_then(|found| Some(found.split_once(" OF ")?.1.into()));
                rest = rest.get(index.end + 1..).unwrap_or_default();
            } else if let Some(after) = rest.strip_prefix('.') {
                let (member, further) = first_name(after);
                let bit = member.trim_start_matches(['%', 'X', 'x']);
                let (name, inner) = if is_number(bit) {
                    (bit.into(), Some("BOOL".into()))
                } else {
                    let member_of = found.and_then(|found| self.member_of(&found, member));
                    member_of.map_or_else(|| (member.into(), None), |(name, found)| (name, found))
                };
                folded.push('.');
                folded += &name;
                found = inner;
                rest = further;
            } else {
                folded += rest;
                return (folded, None);
            }
        }
        (folded, found)
    }

    /// `text` with its variables folded.
    pub(super) fn rewrite(&mut self, unit: usize, text: &str) -> Term {
        self.rewrite_at_depth(unit, text, 0)
    }

    fn rewrite_at_depth(&mut self, unit: usize, text: &str, depth: usize) -> Term {
        let mut term = Term {
            text: String::new(),
            reads: Vec::new(),
        };
        let mut copied = 0;
        for range in expression::variables(text) {
            let Some(path) = text.get(range.clone()) else {
                continue;
            };
            let name = self.fold_at_depth(unit, path, depth);
            term.text += text.get(copied..range.start).unwrap_or_default();
            term.text += &name;
            copied = range.end;
            term.reads.push((name, range));
        }
        term.text += text.get(copied..).unwrap_or_default();
        term
    }

    /// Whether the variable that `path` means is Boolean; `None` if that is
    /// not known.
    pub(super) fn is_boolean(&mut self, unit: usize, path: &str) -> Option<bool> {
        let path = path.trim();
        let found = match self.find(unit, path) {
            Some((symbol, rest)) => {
                let data_type = symbol.data_type.clone();
                self.fold_members(unit, data_type, rest, 0).1
            }
            None => address_type(path).map(Name::from),
        };
        found.map(|found| found.eq_ignore_ascii_case("BOOL"))
    }

    /// What kind of unit the project defines under that name.
    pub(super) fn unit_kind(&self, name: &str) -> Option<UnitKind> {
        self.kinds.get(&key(name)).copied()
    }

    /// The name of a unit.
    pub(super) fn unit_name(&self, unit: usize) -> Name {
        let scope = self.scopes.get(unit);
        scope.map_or_else(|| "".into(), |scope| scope.name.clone())
    }

    /// The type of a member of a structure or of a pin of a function block.
    pub(super) fn member(&self, data_type: &str, member: &str) -> Option<Name> {
        self.member_of(data_type, member)?.1
    }

    /// The spelling and the type of a member.
    fn member_of(&self, data_type: &str, member: &str) -> Option<(Name, Option<Name>)> {
        if let Some(members) = self.types.get(&key(data_type)) {
            let symbol = members.get(&key(member))?;
            return Some((symbol.name.clone(), symbol.data_type.clone()));
        }
        let found = standard::pin_type(data_type, member)?;
        Some((member.to_ascii_uppercase().into(), Some(found.into())))
    }

    /// The variable that `path` begins with, and the rest of it.
    fn find<'p>(&self, unit: usize, path: &'p str) -> Option<(&Symbol, &'p str)> {
        if path.starts_with('%') {
            return Some((self.addresses.get(&address_key(path)?)?, ""));
        }
        let (head, rest) = first_name(path);
        let bare = key(head);
        let own = self.scopes.get(unit).and_then(|s| s.symbols.get(&bare));
        if let Some(symbol) = own.or_else(|| self.globals.get(&bare)) {
            return Some((symbol, rest));
        }
        if self.lists.contains(&bare) {
            let (member, rest) = first_name(rest.strip_prefix('.')?);
            let qualified = format!("{bare}.{}", key(member));
            return Some((self.globals.get(&qualified)?, rest));
        }
        None
    }
}

fn one_address(variable: &Variable, other: &str, first: Span) -> Diagnostic {
    let address = variable.address.as_deref().unwrap_or_default();
    let message = format!("`{}` lies at {address}, as `{other}` does", variable.name);
    let mut diagnostic = Diagnostic::new(codes::DECLARED_TWICE, variable.span, message)
        .help("give it an address of its own; until then both are one variable")
        .related(first, "declared there first");
    diagnostic.severity = Severity::Warning;
    diagnostic
}

/// Names that more than one unit declares for itself. Variables at the same
/// address are one, however many units declare them.
fn shared_names(units: &[Unit<'_, '_>]) -> HashSet<String> {
    let mut first: HashMap<String, String> = HashMap::default();
    let mut shared = HashSet::default();
    let mut note = |name: &Name, identity: String| {
        let bare = key(name);
        let seen = first
            .entry(bare.clone())
            .or_insert_with(|| identity.clone());
        if *seen != identity {
            shared.insert(bare);
        }
    };
    for (at, unit) in units.iter().enumerate() {
        for variable in &unit.variables {
            if variable.owner == Owner::Unit {
                let address = variable.address.as_deref().and_then(address_key);
                note(&variable.name, address.unwrap_or_else(|| at.to_string()));
            }
        }
        for name in unit.steps.iter().chain(&unit.transitions) {
            note(name, at.to_string());
        }
    }
    shared
}

fn types(
    units: &[Unit<'_, '_>],
    structures: &[Structure],
) -> HashMap<String, HashMap<String, Symbol>> {
    let symbol = |name: &Name, data_type: &Option<Name>| {
        let data_type = data_type.clone();
        let name = name.clone();
        (key(&name), Symbol { name, data_type })
    };
    let mut types = HashMap::default();
    for structure in structures {
        let members = structure.members.iter();
        let members = members.map(|(name, found)| symbol(name, &Some(found.clone())));
        types.insert(key(&structure.name), members.collect());
    }
    for unit in units.iter().filter(|u| u.kind != UnitKind::Program) {
        let members = unit.variables.iter();
        let members = members.map(|variable| symbol(&variable.name, &variable.data_type));
        types.insert(key(&unit.name), members.collect());
    }
    let step = [("X", "BOOL"), ("T", "TIME")];
    let step = step.map(|(name, found)| symbol(&name.into(), &Some(found.into())));
    types.insert(STEP.to_owned(), step.into_iter().collect());
    types
}

/// A name without its case.
pub(super) fn key(name: &str) -> String {
    name.to_uppercase()
}

/// An address in one form: without case, without the `X` that a bit may bear.
/// `None` where the address is left open (`%I*`).
fn address_key(address: &str) -> Option<String> {
    let address = address.trim().to_ascii_uppercase();
    if address.contains('*') {
        return None;
    }
    let rest = address.strip_prefix('%')?;
    let area = rest.get(..1)?;
    let rest = rest.get(1..)?;
    Some(format!("%{area}{}", rest.strip_prefix('X').unwrap_or(rest)))
}

/// The type of what lies at an address that nobody declares.
fn address_type(path: &str) -> Option<&'static str> {
    let rest = path.strip_prefix('%')?;
    Some(match rest.chars().nth(1)?.to_ascii_uppercase() {
        'X' | '0'..='9' => "BOOL",
        'B' => "BYTE",
        'W' => "WORD",
        'D' => "DWORD",
        'L' => "LWORD",
        _ => return None,
    })
}

/// The name that a path begins with, and what follows.
fn first_name(path: &str) -> (&str, &str) {
    let end = path
        .find(['.', '[', '^'])
        .filter(|_| !path.starts_with('%'))
        .unwrap_or(path.len());
    path.split_at(end)
}

fn is_number(text: &str) -> bool {
    !text.is_empty() && text.chars().all(|c| c.is_ascii_digit())
}

/// What stands inside the brackets that a path's rest begins with.
fn index_range(rest: &str) -> Option<Range<usize>> {
    let mut depth = 0usize;
    for (at, c) in rest.char_indices() {
        match c {
            '[' => depth += 1,
            ']' if depth == 1 => return Some(1..at),
            ']' => depth -= 1,
            _ if depth == 0 => return None,
            _ => {}
        }
    }
    None
}
