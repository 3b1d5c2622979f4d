//! Reads an edited text again, as far as the edit can have changed what its
//! statements say.
//!
//! The two texts are compared from both ends. A statement that begins with its
//! keyword in what they have in common, and so does the next, says what it
//! said. The stretch between is cut and read, that of the old text too: what a
//! stretch says to the rest of the text must be the same in both. That is
//!
//! - which pins of timers and counters are named anywhere, since they decide
//!   what the output of a timer is called;
//! - which addresses without a declaration are met, since the first to spell
//!   one names it;
//! - declarations and the beginnings of programs and routines;
//! - the comment lines that stand above what follows.
//!
//! Where it is not the same the answer is `None`, and all has to be read. That
//! is rare: somebody types one rung for minutes before declaring something.

use std::collections::HashMap;
use std::sync::Arc;

use source::Diagnostic;

use super::names::Spellings;
use super::statement::{Item, Keyword};
use super::stretch::{Head, Said, head};
use crate::reading::{Reading, Source};
use crate::shift::Shift;
use crate::{Program, Routine, Rung};

/// What reading the next edition of a text needs to know of this one.
#[derive(Clone, Debug)]
pub(crate) struct Traces {
    /// Where statements with a keyword begin.
    heads: Vec<Head>,
    spellings: Spellings,
    /// How many statements were read.
    pub(crate) read: usize,
}

impl Traces {
    pub(super) fn new(items: &[Item], spellings: Spellings) -> Self {
        let statements = items.iter().filter_map(Item::statement);
        Self {
            heads: statements.clone().filter_map(|it| head(it, 0)).collect(),
            spellings,
            read: statements.count(),
        }
    }
}

/// Reads `after`, of which `before` was the edition before, if what was read
/// then is true of the statements that did not change.
pub(crate) fn reread(
    before: Source<'_>,
    previous: &Reading,
    traces: &Traces,
    after: Source<'_>,
) -> Option<(Reading, Traces)> {
    let common = Common::of(before.text.as_bytes(), after.text.as_bytes());
    let edit = Edit {
        before,
        after,
        previous,
        traces,
        start: Start::find(traces, before.text, &common),
        by: after.text.len() as i64 - before.text.len() as i64,
    };
    let end = edit.first_head_behind(&common);
    let further = (end < traces.heads.len()).then_some(end + 1);
    // Where the comments above the statement behind have changed it is read
    // too.
    edit.up_to(end).or_else(|| edit.up_to(further?))
}

/// How many bytes two texts have in common at each of their ends. The two may
/// overlap: a line put between others like it has both neighbours in common.
struct Common {
    start: usize,
    end: usize,
}

impl Common {
    fn of(one: &[u8], other: &[u8]) -> Self {
        const PIECE: usize = 256;
        let pairs = one.chunks_exact(PIECE).zip(other.chunks_exact(PIECE));
        let start = PIECE * pairs.take_while(|(one, other)| one == other).count();
        let pairs = one[start..].iter().zip(&other[start..]);
        let start = start + pairs.take_while(|(one, other)| one == other).count();
        let pairs = one.rchunks_exact(PIECE).zip(other.rchunks_exact(PIECE));
        let end = PIECE * pairs.take_while(|(one, other)| one == other).count();
        let rest = one[..one.len() - end].iter().rev();
        let pairs = rest.zip(other[..other.len() - end].iter().rev());
        let end = end + pairs.take_while(|(one, other)| one == other).count();
        Self { start, end }
    }
}

const LINE_ENDS: [char; 2] = ['\r', '\n'];

/// Where the stretch begins that is read again: at a place where both texts
/// have the same before it.
struct Start {
    /// The first byte that is cut into tokens.
    context: usize,
    /// Statements that begin before this byte stand there for the comments
    /// between them and the next.
    from: usize,
    /// The first head that may have changed.
    head: usize,
    /// The first byte that the next head may begin at.
    least: usize,
}

impl Start {
    fn find(traces: &Traces, before: &str, common: &Common) -> Self {
        let heads = &traces.heads;
        let same = heads.partition_point(|head| head.reach(before) <= common.start);
        let Some(last) = same.checked_sub(1) else {
            return Self {
                context: 0,
                from: 0,
                head: 0,
                least: 0,
            };
        };
        // What is no rung ends with its line.
        let rest = before.get(heads[last].start()..).unwrap_or_default();
        let end = rest.find(LINE_ENDS).map(|at| heads[last].start() + at + 1);
        match end.filter(|end| heads[last].keyword != Keyword::Rung && *end <= common.start) {
            Some(end) => Self {
                context: heads[last].start(),
                from: end,
                head: same,
                least: end,
            },
            None => Self {
                context: last.checked_sub(1).map_or(0, |at| heads[at].start()),
                from: heads[last].start(),
                head: last,
                least: heads[last].reach(before),
            },
        }
    }
}

/// A text before and after an edit.
struct Edit<'e> {
    before: Source<'e>,
    after: Source<'e>,
    previous: &'e Reading,
    traces: &'e Traces,
    start: Start,
    /// How many bytes longer the text has become.
    by: i64,
}

impl Edit<'_> {
    /// The first head that stands behind the start, and in the common end with
    /// the end of the line above it. The number of heads if there is none.
    fn first_head_behind(&self, common: &Common) -> usize {
        let text = self.before.text;
        let is_behind = |head: &Head| {
            let above = text.get(..head.start()).unwrap_or_default();
            let line_end = above.rfind(LINE_ENDS);
            let moved = self.moved(head.start());
            line_end.is_some_and(|at| at >= text.len() - common.end)
                && self.start.least <= head.start()
                && moved.is_some_and(|moved| self.start.least <= moved)
        };
        self.traces.heads.partition_point(|head| !is_behind(head))
    }

    /// Where a byte behind the edit is after it.
    fn moved(&self, place: usize) -> Option<usize> {
        usize::try_from(place as i64 + self.by).ok()
    }

    /// Reads the stretch up to the head `end`.
    fn up_to(&self, end: usize) -> Option<(Reading, Traces)> {
        let Traces {
            heads, spellings, ..
        } = self.traces;
        let program = &*self.previous.program;
        let by = self.by;
        let is_last = end >= heads.len();
        let until = heads
            .get(end)
            .map_or(self.before.text.len(), |head| head.start());
        let until_after = self.moved(until)?;
        let declared = &program.declarations;
        let said = |source, until| {
            let stretch = self.start.context..until;
            Said::in_stretch(source, stretch, self.start.from, declared, spellings)
        };
        let old = said(self.before, until)?;
        let new = said(self.after, until_after)?;
        if old.undeclared != new.undeclared || !is_last && old.comments != new.comments {
            return None;
        }
        let pins = counted(&spellings.pins, &old.pins, &new.pins)?;
        let shift = Shift {
            from: match is_last {
                true => u32::MAX,
                false => u32::try_from(self.before.base + until).ok()?,
            },
            by,
        };
        let behind = heads.get(end..).unwrap_or_default();
        let in_text = Shift { from: 0, by };
        let moved = behind.iter().map(|head| Head {
            start: in_text.place(head.start),
            ..*head
        });
        let all_heads = heads[..self.start.head].iter().copied();
        let traces = Traces {
            heads: all_heads.chain(new.heads).chain(moved).collect(),
            spellings: spellings.with_pins(pins),
            read: new.statements,
        };
        let is_above_a_rung = behind.first().is_some_and(|it| it.keyword == Keyword::Rung);
        let routines = self.routines(old.rungs.len(), new.rungs, is_above_a_rung, shift)?;
        let mut changed = Program::empty(program.format);
        changed.name = program.name.clone();
        changed.declarations = declared.shifted(shift);
        changed.routines = routines;
        let reading = Reading {
            program: Arc::new(changed),
            diagnostics: self.diagnostics(new.findings, shift),
        };
        Some((reading, traces))
    }

    /// The routines with `new` rungs where `old` stood. Rungs where none was
    /// belong to the routine of the rung behind.
    fn routines(
        &self,
        old: usize,
        new: Vec<Rung>,
        is_above_a_rung: bool,
        shift: Shift,
    ) -> Option<Vec<Routine>> {
        let routines = &self.previous.program.routines;
        let before = self.traces.heads[..self.start.head].iter();
        let before = before.filter(|head| head.keyword == Keyword::Rung).count();
        let target = match (old, new.len()) {
            (0, 0) => None,
            (0, _) if !is_above_a_rung => return None,
            _ => Some(rung_at(routines, before)?),
        };
        let mut new = Some(new);
        let edited = routines
            .iter()
            .enumerate()
            .map(|(at, routine)| match target {
                Some((edited, first)) if edited == at => {
                    replaced(routine, first, old, new.take().unwrap_or_default(), shift)
                }
                _ => Some(Routine {
                    rungs: shifted(&routine.rungs, 0, shift).collect(),
                    span: shift.span(routine.span),
                    ..headed(routine)
                }),
            });
        edited.collect()
    }

    /// The findings about the other statements, and `new` ones between them.
    fn diagnostics(&self, mut new: Vec<Diagnostic>, shift: Shift) -> Vec<Diagnostic> {
        let from = self.before.base + self.start.from;
        let all = &self.previous.diagnostics;
        let before = all.partition_point(|it| (it.span.start as usize) < from);
        let behind = all.partition_point(|it| !shift.moves(it.span.start));
        new.sort_by_key(|it| (it.span, it.code));
        let kept =
            |all: &[Diagnostic]| -> Vec<_> { all.iter().map(|it| shift.diagnostic(it)).collect() };
        [kept(&all[..before]), new, kept(&all[behind..])].concat()
    }
}

/// The routine that holds the rung of this number in the whole program, and
/// the rung's place there.
fn rung_at(routines: &[Routine], mut number: usize) -> Option<(usize, usize)> {
    for (at, routine) in routines.iter().enumerate() {
        match number.checked_sub(routine.rungs.len()) {
            Some(rest) => number = rest,
            None => return Some((at, number)),
        }
    }
    None
}

/// A routine whose rungs from `first` on are new, instead of `old` ones. One
/// that loses all its rungs may be none any more.
fn replaced(
    routine: &Routine,
    first: usize,
    old: usize,
    mut new: Vec<Rung>,
    shift: Shift,
) -> Option<Routine> {
    let (before, rest) = routine.rungs.split_at_checked(first)?;
    let (old, behind) = rest.split_at_checked(old)?;
    Rung::keep_networks(old, &mut new);
    for (at, rung) in new.iter_mut().enumerate() {
        rung.number = number(first + at);
    }
    let has_header = routine.span.start < routine.rungs.first()?.span.start;
    let next = first + new.len();
    let mut rungs = Vec::with_capacity(next + behind.len());
    rungs.extend_from_slice(before);
    rungs.append(&mut new);
    rungs.extend(shifted(behind, next, shift));
    let mut span = rungs.first()?.span.cover(rungs.last()?.span);
    if has_header {
        span.start = shift.place(routine.span.start);
    }
    Some(Routine {
        rungs,
        span,
        ..headed(routine)
    })
}

/// Rungs that an edit of others moved, numbered from `first` on.
fn shifted(rungs: &[Rung], first: usize, shift: Shift) -> impl Iterator<Item = Rung> {
    let numbered = rungs.iter().enumerate();
    numbered.map(move |(at, rung)| rung.shifted(shift, number(first + at)))
}

fn number(place: usize) -> u32 {
    u32::try_from(place).unwrap_or(u32::MAX)
}

/// The routine without its rungs.
fn headed(routine: &Routine) -> Routine {
    Routine {
        scope: routine.scope.clone(),
        unit: routine.unit.clone(),
        name: routine.name.clone(),
        role: routine.role,
        rungs: Vec::new(),
        span: routine.span,
    }
}

/// How often pins are spelled in the whole text after the edit; `None` if one
/// is spelled for the first time, or no more.
fn counted(
    all: &Arc<HashMap<String, usize>>,
    old: &HashMap<String, usize>,
    new: &HashMap<String, usize>,
) -> Option<Arc<HashMap<String, usize>>> {
    if old == new {
        return Some(all.clone());
    }
    let count = |pins: &HashMap<String, usize>, pin: &str| pins.get(pin).copied().unwrap_or(0);
    let mut counted = (**all).clone();
    for pin in old.keys().chain(new.keys()) {
        let before = count(all, pin);
        let after = (before + count(new, pin)).checked_sub(count(old, pin))?;
        if (before == 0) != (after == 0) {
            return None;
        }
        if after > 0 {
            counted.insert(pin.clone(), after);
        }
    }
    Some(Arc::new(counted))
}
