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

use std::borrow::Cow;

use foldhash::HashMap;
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
    scopes: Vec<ScopeNames>,
    /// By name in lower case, the first scope that bears it.
    scopes_by_name: HashMap<String, Scope>,
    roots: Vec<Root>,
    /// Whether some alias stands for an address or a part of a tag.
    aliased: bool,
    /// Every variable by its name, with the key and place of its first use.
    first_uses: Vec<FirstUse>,
}

/// The names within a scope.
#[derive(Debug, Default)]
struct ScopeNames {
    /// The scope's own name.
    name: String,
    /// The roots by their names in lower case.
    places: HashMap<String, usize>,
    /// Every spelling that was noted and, once asked for, its canonical name:
    /// a program writes few names very often.
    spellings: HashMap<String, Option<Name>>,
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
    spelling: Name,
    /// As operands give it; set by `settle`.
    display: Name,
    alias_for: Option<String>,
    declared: bool,
    /// The aliases that stand for it or a part of it, by the tail's key.
    aliases: HashMap<String, usize>,
    /// The canonical names of it and its parts, by the tail's key.
    used: HashMap<String, Name>,
}

/// A path with its aliases followed: the root and what comes after it.
struct Located {
    root: usize,
    tail: Tail,
}

/// What comes after the root of a path. Most paths have nothing there.
#[derive(Default)]
struct Tail {
    /// To show.
    shown: String,
    /// To compare: in lower case.
    key: String,
    /// Where each of its parts ends, in the key and as shown.
    ends: Vec<(usize, usize)>,
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
        if self.find_in(scope, &tag.name).is_none() {
            let at = self.add_root(scope, &tag.name, tag.name.clone());
            let root = &mut self.roots[at];
            root.alias_for.clone_from(&tag.alias_for);
            root.declared = true;
        }
    }

    /// Adds the root that is found by `name`.
    fn add_root(&mut self, scope: Scope, name: &str, spelling: Name) -> usize {
        let at = self.roots.len();
        let key = lower(name).into_owned();
        self.scopes[scope].places.insert(key, at);
        self.roots.push(Root {
            scope,
            display: spelling.clone(),
            spelling,
            alias_for: None,
            declared: false,
            aliases: HashMap::default(),
            used: HashMap::default(),
        });
        at
    }

    /// Learns the undeclared tags in `text`, an operand in `scope`. They count
    /// as the controller's.
    pub(super) fn note(&mut self, scope: Scope, text: &str) {
        let noted = &mut self.scopes[scope].spellings;
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
                let spelling = if lower(path.root).starts_with("s:") {
                    path.root.to_uppercase().into()
                } else {
                    path.root.into()
                };
                self.add_root(owner, path.root, spelling);
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
        self.scopes.push(ScopeNames {
            name: name.to_owned(),
            ..ScopeNames::default()
        });
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
        let key = lower(path.root);
        match path.program {
            Some(program) => self.find_key(self.scope_named(program)?, &key),
            None => self
                .find_key(scope, &key)
                .or_else(|| self.find_key(0, &key)),
        }
    }

    fn find_in(&self, scope: Scope, root: &str) -> Option<usize> {
        self.find_key(scope, &lower(root))
    }

    fn find_key(&self, scope: Scope, key: &str) -> Option<usize> {
        self.scopes.get(scope)?.places.get(key).copied()
    }

    /// Decides on prefixes and aliases. From here on no root is added.
    pub(super) fn settle(&mut self) {
        let Self { scopes, roots, .. } = &mut *self;
        let mut scopes_with: HashMap<&str, usize> = HashMap::default();
        for key in scopes.iter().flat_map(|scope| scope.places.keys()) {
            *scopes_with.entry(key).or_default() += 1;
        }
        for scope in scopes.iter().skip(1) {
            // A tag called like the scope would make `Scope.name` its member.
            let taken = scopes_with.contains_key(&*lower(&scope.name));
            let mark = if taken { "\\" } else { "" };
            for (key, &at) in &scope.places {
                if scopes_with.get(key.as_str()) > Some(&1) {
                    let root = &mut roots[at];
                    root.display = format!("{mark}{}.{}", scope.name, root.spelling).into();
                }
            }
        }
        for place in 0..self.roots.len() {
            if self.roots[place].alias_for.is_none() {
                continue;
            }
            let located = self.follow_aliases(place, Tail::default());
            if located.root != place {
                let aliases = &mut self.roots[located.root].aliases;
                aliases.entry(located.tail.key).or_insert(place);
                self.aliased = true;
            }
        }
    }

    /// Whether some alias stands for an address or a part of a tag.
    pub(super) fn has_aliases(&self) -> bool {
        self.aliased
    }

    /// The canonical name of `text`, an operand in `scope`. A constant keeps its
    /// notation; in an expression the tags are made canonical.
    pub(super) fn canonical(&mut self, scope: Scope, text: &str, span: Span) -> Name {
        if let Some(Some(name)) = self.scopes[scope].spellings.get(text) {
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
        let known = &mut self.scopes[scope].spellings;
        match known.get_mut(text) {
            Some(noted) => *noted = Some(name.clone()),
            None => {
                known.insert(text.to_owned(), Some(name.clone()));
            }
        }
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
        let Located { root, tail } = &located;
        if let Some(name) = self.roots[*root].used.get(&tail.key) {
            return name.clone();
        }
        let name = self.shown(&located);
        let Located { root, tail } = located;
        self.roots[root].used.insert(tail.key, name.clone());
        self.first_uses.push(FirstUse {
            name: name.clone(),
            root,
            span,
        });
        name
    }

    fn locate(&self, scope: Scope, path: &operand::Path<'_>, depth: usize) -> Option<Located> {
        let root = self.find(scope, path)?;
        let mut tail = Tail::default();
        for part in &path.tail {
            self.locate_part(scope, part, depth, &mut tail);
        }
        Some(self.follow_aliases(root, tail))
    }

    /// Adds a part of a path to what is before it.
    fn locate_part(&self, scope: Scope, part: &Part<'_>, depth: usize, tail: &mut Tail) {
        match part {
            Part::Member(member) => tail.push(&[".", &plain_number(member)]),
            Part::Index(inside) => tail.push(&["[", &self.index(scope, inside, depth), "]"]),
            Part::Bit(inside) => tail.push(&[".[", &self.index(scope, inside, depth), "]"]),
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
                _ => None,
            };
            match (tag, token) {
                (Some(tag), _) => shown.push_str(&tag),
                (None, Token::Constant(_)) => shown.push_str(&plain_number(piece)),
                (None, _) => shown.push_str(piece),
            }
        }
        shown
    }

    /// Puts what an alias stands for in its place, again and again.
    fn follow_aliases(&self, root: usize, tail: Tail) -> Located {
        let mut located = Located { root, tail };
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
            let mut tail = Tail::default();
            for part in &target.tail {
                self.locate_part(at.scope, part, DEEPEST, &mut tail);
            }
            tail.append(&located.tail);
            located = Located { root: next, tail };
        }
        located
    }

    /// The name of a located variable: the alias that stands for the longest
    /// part of its path, and the rest.
    fn shown(&self, located: &Located) -> Name {
        let Located { root, tail } = located;
        let aliases = &self.roots[*root].aliases;
        let mut best = aliases.get("").map(|&alias| (alias, 0));
        if !aliases.is_empty() {
            for &(key_end, shown_end) in &tail.ends {
                let key = tail.key.get(..key_end).unwrap_or_default();
                if let Some(&alias) = aliases.get(key) {
                    best = Some((alias, shown_end));
                }
            }
        }
        let (root, skipped) = best.unwrap_or((*root, 0));
        let rest = tail.shown.get(skipped..).unwrap_or_default();
        let display = &self.roots[root].display;
        match rest {
            "" => display.clone(),
            rest => format!("{display}{rest}").into(),
        }
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
        let tag = lower(&root.spelling).into_owned();
        Some((root.scope, tag, located.tail.key))
    }

    /// The name under which a tag of `scope` is used, as far as it is known
    /// from its declaration.
    pub(super) fn of_declaration(&self, scope: Scope, tag: &str) -> Name {
        match self.find_in(scope, tag) {
            Some(root) => self.roots[root].display.clone(),
            None => tag.into(),
        }
    }

    /// The name of a part of a tag, if some operand uses it.
    pub(super) fn used_part(&self, scope: Scope, tag: &str, part: &str) -> Option<Name> {
        // Projects comment far more parts than their rungs use.
        let root = &self.roots[self.find_in(scope, tag)?];
        if root.alias_for.is_none() && is_plain_tail(part) {
            return root.used.get(&*lower(part)).cloned();
        }
        let text = format!("{tag}{part}");
        let located = self.locate(scope, &operand::path(&text)?, 0)?;
        self.roots[located.root]
            .used
            .get(&located.tail.key)
            .cloned()
    }

    /// The address that the alias `tag` of `scope` leads to in the end.
    pub(super) fn aliased_root(&self, scope: Scope, tag: &str) -> Option<&str> {
        let root = self.find_in(scope, tag)?;
        let located = self.follow_aliases(root, Tail::default());
        Some(&*self.roots[located.root].spelling)
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

impl Tail {
    /// Adds a part, itself written in pieces.
    fn push(&mut self, pieces: &[&str]) {
        for piece in pieces {
            self.shown.push_str(piece);
            self.key.push_str(&lower(piece));
        }
        self.ends.push((self.key.len(), self.shown.len()));
    }

    /// Adds the parts of another.
    fn append(&mut self, other: &Self) {
        let (key, shown) = (self.key.len(), self.shown.len());
        self.key.push_str(&other.key);
        self.shown.push_str(&other.shown);
        let ends = other.ends.iter();
        self.ends
            .extend(ends.map(|end| (key + end.0, shown + end.1)));
    }
}

/// A name without its case, by which names are compared.
pub(super) fn lower(name: &str) -> Cow<'_, str> {
    if name
        .bytes()
        .any(|byte| byte.is_ascii_uppercase() || !byte.is_ascii())
    {
        Cow::Owned(name.to_lowercase())
    } else {
        Cow::Borrowed(name)
    }
}

/// Whether a path's tail is shown and compared as it is written: of members
/// and constant indices, no number with zeros before it.
fn is_plain_tail(tail: &str) -> bool {
    let is_plain = |part: &str| {
        let (name, allowed): (_, fn(&u8) -> bool) = match part.strip_suffix(']') {
            Some(index) => (index, u8::is_ascii_digit),
            None => (part, |byte| byte.is_ascii_alphanumeric() || *byte == b'_'),
        };
        name.as_bytes().iter().all(allowed) && (name == "0" || !name.starts_with('0'))
    };
    tail.starts_with(['.', '[']) && tail.split(['.', '[']).all(is_plain)
}

/// A whole number without the zeros before it; anything else as it is.
fn plain_number(text: &str) -> Cow<'_, str> {
    match text.parse::<u32>() {
        Ok(number) if text.len() > 1 && text.starts_with(['0', '+']) => {
            Cow::Owned(number.to_string())
        }
        _ => Cow::Borrowed(text),
    }
}
