//! Which variable an operand means, and the one name it goes by.
//!
//! The model wants equal names for equal variables. Rockwell gives one variable
//! many: `start` and `Start` are the same, a tag of a program hides the
//! controller's tag of that name, and an alias stands for an address or another
//! tag, whole or in part. So the names are settled in two passes over the
//! operands: [`Names::note`] sees every operand once and so learns which
//! undeclared names there are, [`Names::settle`] decides on prefixes and
//! aliases, and then [`Names::canonical`] answers.
//!
//! A path is compared by its key: the place of its root, and the tail in lower
//! case. A name that only one scope has stays bare; where several have it, the
//! local ones are written `Scope.name`.

use std::collections::HashMap;

use logic::Name;
use source::Span;

use super::operand::{self, Part, Token};
use super::project::{Project, Tag};

/// A scope: 0 is the controller's, then one for every unit.
pub(super) type Scope = usize;

/// Longest chain of aliases, and deepest nesting of indices, that is followed.
const DEEPEST: usize = 8;

/// The names of a project.
#[derive(Debug, Default)]
pub(super) struct Names {
    /// Names of the scopes.
    scopes: Vec<String>,
    /// By name in lower case, the first scope that bears it.
    scopes_by_name: HashMap<String, Scope>,
    roots: Vec<Root>,
    places: HashMap<(Scope, String), usize>,
    /// The key of an aliased address and the alias.
    aliases: HashMap<String, usize>,
    interned: HashMap<String, Name>,
    /// By scope, every spelling that was noted and, once asked for, its
    /// canonical name: a program writes few names very often.
    spellings: HashMap<Scope, HashMap<String, Option<Name>>>,
    /// Every variable by its name, with the key and place of its first use.
    first_uses: Vec<FirstUse>,
}

/// A variable where it is first used.
#[derive(Clone, Debug)]
pub(super) struct FirstUse {
    pub(super) name: Name,
    pub(super) root: usize,
    pub(super) span: Span,
}

#[derive(Debug)]
struct Root {
    scope: Scope,
    spelling: String,
    /// As operands give it; set by `settle`.
    display: String,
    alias_for: Option<String>,
    declared: bool,
}

/// A path with its aliases followed: the root and the parts after it.
struct Located {
    root: usize,
    parts: Vec<LocatedPart>,
}

/// A part of a path, to compare and to show.
struct LocatedPart {
    key: String,
    shown: String,
}

impl Names {
    /// The names that a project declares.
    pub(super) fn declared(project: &Project<'_>) -> Self {
        let mut names = Self::default();
        names.add_scope("");
        for tag in &project.tags {
            names.declare(0, tag);
        }
        for unit in &project.units {
            let scope = names.add_scope(&unit.name);
            for tag in &unit.tags {
                names.declare(scope, tag);
            }
        }
        for place in 0..names.roots.len() {
            let root = &names.roots[place];
            if let Some(target) = root.alias_for.clone() {
                names.note(root.scope, &target);
            }
        }
        names
    }

    fn declare(&mut self, scope: Scope, tag: &Tag) {
        let key = (scope, tag.name.to_lowercase());
        if self.places.contains_key(&key) {
            return;
        }
        self.places.insert(key, self.roots.len());
        self.roots.push(Root {
            scope,
            spelling: tag.name.clone(),
            display: tag.name.clone(),
            alias_for: tag.alias_for.clone(),
            declared: true,
        });
    }

    /// Learns the undeclared tags in `text`, an operand in `scope`. They count
    /// as the controller's.
    pub(super) fn note(&mut self, scope: Scope, text: &str) {
        let noted = self.spellings.entry(scope).or_default();
        if !noted.contains_key(text) {
            noted.insert(text.to_owned(), None);
            self.note_nested(scope, text, 0);
        }
    }

    fn note_nested(&mut self, scope: Scope, text: &str, depth: usize) {
        for token in operand::tokens(text, 0..text.len()) {
            let Token::Tag(place) = token else {
                continue;
            };
            let Some(path) = text.get(place).and_then(operand::path) else {
                continue;
            };
            let owner = path.program.map_or(0, |name| self.scope_named_or_new(name));
            if self.find(scope, &path).is_none() {
                let spelling = if path.root.to_lowercase().starts_with("s:") {
                    path.root.to_uppercase()
                } else {
                    path.root.to_owned()
                };
                let key = (owner, path.root.to_lowercase());
                self.places.insert(key, self.roots.len());
                self.roots.push(Root {
                    scope: owner,
                    display: spelling.clone(),
                    spelling,
                    alias_for: None,
                    declared: false,
                });
            }
            for part in &path.tail {
                if let (Part::Index(inside) | Part::Bit(inside), true) = (part, depth < DEEPEST) {
                    self.note_nested(scope, inside, depth + 1);
                }
            }
        }
    }

    fn scope_named(&self, name: &str) -> Option<Scope> {
        self.scopes_by_name.get(&name.to_ascii_lowercase()).copied()
    }

    /// Adds a scope. Of several with one name the first is found by it.
    fn add_scope(&mut self, name: &str) -> Scope {
        let scope = self.scopes.len();
        self.scopes.push(name.to_owned());
        let by_name = self.scopes_by_name.entry(name.to_ascii_lowercase());
        by_name.or_insert(scope);
        scope
    }

    /// The scope of a program, which may not be in the file.
    fn scope_named_or_new(&mut self, name: &str) -> Scope {
        self.scope_named(name)
            .unwrap_or_else(|| self.add_scope(name))
    }

    /// The root of a path written in `scope`: of the program that it names, else
    /// local, else the controller's.
    fn find(&self, scope: Scope, path: &operand::Path<'_>) -> Option<usize> {
        match path.program {
            Some(program) => self.find_in(self.scope_named(program)?, path.root),
            None => self
                .find_in(scope, path.root)
                .or_else(|| self.find_in(0, path.root)),
        }
    }

    fn find_in(&self, scope: Scope, root: &str) -> Option<usize> {
        self.places.get(&(scope, root.to_lowercase())).copied()
    }

    /// Decides on prefixes and aliases. From here on no root is added.
    pub(super) fn settle(&mut self) {
        let mut scopes_with: HashMap<String, usize> = HashMap::new();
        for root in &self.roots {
            *scopes_with.entry(root.spelling.to_lowercase()).or_default() += 1;
        }
        for root in &mut self.roots {
            let ambiguous = scopes_with.get(&root.spelling.to_lowercase()) > Some(&1);
            let Some(scope) = self.scopes.get(root.scope).filter(|_| root.scope > 0) else {
                continue;
            };
            if ambiguous {
                // A tag called like the scope would make `Scope.name` its member.
                let taken = scopes_with.contains_key(&scope.to_lowercase());
                let mark = if taken { "\\" } else { "" };
                root.display = format!("{mark}{scope}.{}", root.spelling);
            }
        }
        for place in 0..self.roots.len() {
            if self.roots[place].alias_for.is_none() {
                continue;
            }
            let located = self.follow_aliases(place, Vec::new());
            if located.root != place {
                let key = located.key(located.parts.len());
                self.aliases.entry(key).or_insert(place);
            }
        }
    }

    /// Whether some alias stands for an address or a part of a tag.
    pub(super) fn has_aliases(&self) -> bool {
        !self.aliases.is_empty()
    }

    /// The canonical name of `text`, an operand in `scope`. A constant keeps its
    /// notation; in an expression the tags are made canonical.
    pub(super) fn canonical(&mut self, scope: Scope, text: &str, span: Span) -> Name {
        let known = self.spellings.get(&scope).and_then(|known| known.get(text));
        if let Some(Some(name)) = known {
            return name.clone();
        }
        let trimmed = text.trim();
        let name = if operand::is_constant(trimmed) {
            trimmed.into()
        } else {
            match operand::path(trimmed) {
                Some(path) => self.canonical_path(scope, &path, trimmed, span),
                None => self.canonical_expression(scope, trimmed, span).into(),
            }
        };
        let known = self.spellings.entry(scope).or_default();
        known.insert(text.to_owned(), Some(name.clone()));
        name
    }

    fn canonical_path(
        &mut self,
        scope: Scope,
        path: &operand::Path<'_>,
        text: &str,
        span: Span,
    ) -> Name {
        let Some(located) = self.locate(scope, path, 0) else {
            return text.into();
        };
        let key = located.key(located.parts.len());
        if let Some(name) = self.interned.get(&key) {
            return name.clone();
        }
        let name: Name = self.shown(&located).into();
        self.interned.insert(key, name.clone());
        self.first_uses.push(FirstUse {
            name: name.clone(),
            root: located.root,
            span,
        });
        name
    }

    fn locate(&self, scope: Scope, path: &operand::Path<'_>, depth: usize) -> Option<Located> {
        let root = self.find(scope, path)?;
        let parts = path
            .tail
            .iter()
            .map(|part| self.locate_part(scope, part, depth))
            .collect();
        Some(self.follow_aliases(root, parts))
    }

    fn locate_part(&self, scope: Scope, part: &Part<'_>, depth: usize) -> LocatedPart {
        let shown = match part {
            Part::Member(member) => match member.parse::<u32>() {
                Ok(bit) => format!(".{bit}"),
                Err(_) => format!(".{member}"),
            },
            Part::Index(inside) => format!("[{}]", self.index(scope, inside, depth)),
            Part::Bit(inside) => format!(".[{}]", self.index(scope, inside, depth)),
        };
        LocatedPart {
            key: shown.to_lowercase(),
            shown,
        }
    }

    /// An index without blanks, tags inside it canonical.
    fn index(&self, scope: Scope, text: &str, depth: usize) -> String {
        let mut shown = String::new();
        for token in operand::tokens(text, 0..text.len()) {
            let piece = text.get(token.place()).unwrap_or_default();
            let tag = match &token {
                Token::Tag(_) if depth < DEEPEST => operand::path(piece)
                    .and_then(|path| self.locate(scope, &path, depth + 1))
                    .map(|located| self.shown(&located)),
                Token::Constant(_) => piece.parse::<u32>().ok().map(|number| number.to_string()),
                _ => None,
            };
            shown.push_str(tag.as_deref().unwrap_or(piece));
        }
        shown
    }

    /// Puts what an alias stands for in its place, again and again.
    fn follow_aliases(&self, root: usize, parts: Vec<LocatedPart>) -> Located {
        let mut located = Located { root, parts };
        for _ in 0..DEEPEST {
            let at = &self.roots[located.root];
            let Some(target) = at.alias_for.as_deref().and_then(operand::path) else {
                break;
            };
            // A local alias may bear the name of the controller's tag behind it.
            let next = self
                .find(at.scope, &target)
                .filter(|&next| next != located.root)
                .or_else(|| self.find_in(0, target.root))
                .filter(|&next| next != located.root);
            let Some(next) = next else {
                break;
            };
            let mut parts: Vec<LocatedPart> = target
                .tail
                .iter()
                .map(|part| self.locate_part(at.scope, part, DEEPEST))
                .collect();
            parts.append(&mut located.parts);
            located = Located { root: next, parts };
        }
        located
    }

    /// The name of a located variable: the alias that stands for the longest
    /// part of its path, and the rest.
    fn shown(&self, located: &Located) -> String {
        let mut key = located.root.to_string();
        let mut best = self.aliases.get(&key).map(|&alias| (alias, 0));
        for (count, part) in located.parts.iter().enumerate() {
            key.push_str(&part.key);
            if let Some(&alias) = self.aliases.get(&key) {
                best = Some((alias, count + 1));
            }
        }
        let (root, skipped) = best.unwrap_or((located.root, 0));
        let mut shown = self.roots[root].display.clone();
        for part in located.parts.iter().skip(skipped) {
            shown.push_str(&part.shown);
        }
        shown
    }

    /// An expression in one notation: operators between blanks, tags canonical.
    pub(super) fn canonical_expression(&mut self, scope: Scope, text: &str, span: Span) -> String {
        let mut shown = String::new();
        let mut operand_before = false;
        for token in operand::tokens(text, 0..text.len()) {
            let piece = text.get(token.place()).unwrap_or_default();
            match token {
                Token::Tag(_) => {
                    let name = match operand::path(piece) {
                        Some(path) => self.canonical_path(scope, &path, piece, span),
                        None => piece.into(),
                    };
                    shown.push_str(&name);
                    operand_before = true;
                }
                Token::Constant(_) => {
                    shown.push_str(piece);
                    operand_before = true;
                }
                Token::Sign(_) if matches!(piece, "(" | ")" | ",") => {
                    shown.push_str(piece);
                    operand_before = piece == ")";
                }
                Token::Sign(_) | Token::Word(_) if operand_before => {
                    shown.push(' ');
                    shown.push_str(piece);
                    shown.push(' ');
                    operand_before = false;
                }
                Token::Sign(_) => shown.push_str(piece),
                Token::Word(_) => {
                    shown.push_str(piece);
                    if piece.eq_ignore_ascii_case("NOT") {
                        shown.push(' ');
                    }
                }
            }
        }
        shown
    }

    /// The scope and tag that a path leads to when aliases are followed, and the
    /// rest of it in lower case.
    pub(super) fn place_of(&self, scope: Scope, text: &str) -> Option<(Scope, String, String)> {
        let located = self.locate(scope, &operand::path(text.trim())?, 0)?;
        let root = &self.roots[located.root];
        let tail = located.parts.iter().map(|part| part.key.as_str()).collect();
        Some((root.scope, root.spelling.to_lowercase(), tail))
    }

    /// The name under which a tag of `scope` is used, as far as it is known
    /// from its declaration.
    pub(super) fn of_declaration(&self, scope: Scope, tag: &str) -> Name {
        match self.find_in(scope, tag) {
            Some(root) => self.roots[root].display.as_str().into(),
            None => tag.into(),
        }
    }

    /// The name of a part of a tag, if some operand uses it.
    pub(super) fn used_part(&self, scope: Scope, tag: &str, part: &str) -> Option<Name> {
        let text = format!("{tag}{part}");
        let located = self.locate(scope, &operand::path(&text)?, 0)?;
        self.interned
            .get(&located.key(located.parts.len()))
            .cloned()
    }

    /// The address that the alias `tag` of `scope` leads to in the end.
    pub(super) fn aliased_root(&self, scope: Scope, tag: &str) -> Option<&str> {
        let root = self.find_in(scope, tag)?;
        let located = self.follow_aliases(root, Vec::new());
        Some(self.roots[located.root].spelling.as_str())
    }

    /// The root of a module's tag that nothing declares: `Local:1:I`.
    pub(super) fn undeclared_root(&self, first_use: &FirstUse) -> Option<&str> {
        let root = self
            .roots
            .get(first_use.root)
            .filter(|root| !root.declared)?;
        Some(&root.spelling)
    }

    /// Every variable in the order of its first use.
    pub(super) fn first_uses(&self) -> &[FirstUse] {
        &self.first_uses
    }
}

impl Located {
    /// What the root and its first `count` parts are compared by.
    fn key(&self, count: usize) -> String {
        let mut key = self.root.to_string();
        for part in self.parts.iter().take(count) {
            key.push_str(&part.key);
        }
        key
    }
}
