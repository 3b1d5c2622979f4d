use std::sync::Arc;

use logic::Name;
use source::Span;

use super::{Chart, Declarations, Network, Placed, Within};
use crate::shift::Shift;

/// Which form a program was read from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Format {
    /// The project's own rung notation.
    Ladder,
    /// Rockwell L5X (XML).
    L5x,
    /// Rockwell L5K (text).
    L5k,
    /// Bare Rockwell neutral text.
    NeutralText,
    /// PLCopen TC6 XML.
    Plcopen,
    /// A ladder drawn with characters.
    Ascii,
    /// None that is known.
    Unknown,
}

impl Format {
    /// The name used in answers: `l5x`, `plcopen`.
    pub fn word(self) -> &'static str {
        match self {
            Self::Ladder => "ladder",
            Self::L5x => "l5x",
            Self::L5k => "l5k",
            Self::NeutralText => "neutral-text",
            Self::Plcopen => "plcopen",
            Self::Ascii => "ascii",
            Self::Unknown => "unknown",
        }
    }
}

/// A ladder program.
#[derive(Clone, Debug, PartialEq)]
pub struct Program {
    /// The form it was read from.
    pub format: Format,
    /// Its name in the source, empty where it has none.
    pub name: Name,
    /// Variables that the source declares.
    pub declarations: Declarations,
    /// Routines, in the order in which their units are solved; those reached
    /// by calls are solved where they are called.
    pub routines: Vec<Routine>,
    /// Charts that the source holds beside its ladders.
    pub charts: Vec<Chart>,
}

impl Program {
    /// A program that holds nothing.
    pub fn empty(format: Format) -> Self {
        Self {
            format,
            name: "".into(),
            declarations: Declarations::default(),
            routines: Vec::new(),
            charts: Vec::new(),
        }
    }

    /// Whether the file holds nothing but definitions of blocks. Then they are
    /// what there is to solve, as if there were one instance of each.
    pub fn is_only_definitions(&self) -> bool {
        let mut with_rungs = self.routines.iter().filter(|it| !it.rungs.is_empty());
        with_rungs.all(|routine| routine.role == Role::Definition)
    }

    /// All rungs with their routines, in the order of the source.
    pub fn rungs(&self) -> impl Iterator<Item = (&Routine, &Rung)> {
        self.routines
            .iter()
            .flat_map(|routine| routine.rungs.iter().map(move |rung| (routine, rung)))
    }
}

/// When a routine is solved.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Role {
    /// Every scan, in the order of the list.
    Main,
    /// When a call leads to it.
    Called,
    /// Once for every instance of a block that the user defines (AOI, function
    /// block, function): its variables are the instance's.
    Definition,
}

/// A list of rungs that are solved one after the other.
#[derive(Clone, Debug, PartialEq)]
pub struct Routine {
    /// `Program/Routine`, or the POU: what answers call `scope`.
    pub scope: Name,
    /// The unit that calls are resolved in: the program or POU.
    pub unit: Name,
    /// Its own name.
    pub name: Name,
    /// When it is solved.
    pub role: Role,
    /// Its rungs, in the order of solving.
    pub rungs: Vec<Rung>,
    /// Where it stands.
    pub span: Span,
}

/// A rung.
#[derive(Clone, Debug, PartialEq)]
pub struct Rung {
    /// The number that the source gives it, else its place from 0.
    pub number: u32,
    /// Its title or comment.
    pub comment: Option<Name>,
    /// Its power flow.
    pub network: Arc<Network>,
    /// Where it stands, the whole of it.
    pub span: Span,
    /// The byte of the file that the places in its network count from.
    origin: u32,
}

impl Routine {
    /// One of its rungs as people name it: `rung 3 of Main`, or `rung 3` where
    /// the source has no name for what is around it.
    pub fn name_of(&self, rung: &Rung) -> String {
        match self.scope.is_empty() {
            true => format!("rung {}", rung.number),
            false => format!("rung {} of {}", rung.number, self.scope),
        }
    }
}

impl Rung {
    /// A rung that stands at `span`.
    pub fn new(number: u32, comment: Option<Name>, drawn: Placed, span: Span) -> Self {
        Self {
            number,
            comment,
            network: drawn.network,
            span,
            origin: drawn.origin,
        }
    }

    /// Where in the file an element of the rung, or an operand of one, is
    /// written.
    pub fn place(&self, within: Within) -> Span {
        within.from(self.origin)
    }

    /// The rung after an edit of other statements, as the one of this number.
    pub(crate) fn shifted(&self, shift: Shift, number: u32) -> Self {
        let origin = shift.place(self.origin);
        Self {
            number,
            comment: self.comment.clone(),
            network: match origin == self.origin {
                true => self.network.clone(),
                false => Network::at(&self.network, origin),
            },
            span: shift.span(self.span),
            origin,
        }
    }

    /// Gives rungs the networks that those before them had, where they are the
    /// same: paired from the start, and what is left from the end.
    pub(crate) fn keep_networks(before: &[Self], after: &mut [Self]) {
        let mut kept = 0;
        while let (Some(old), Some(new)) = (before.get(kept), after.get_mut(kept))
            && new.keep(old)
        {
            kept += 1;
        }
        let before = before.get(kept..).unwrap_or_default();
        let after = after.get_mut(kept..).unwrap_or_default();
        let as_many = before.len() == after.len();
        for (old, new) in before.iter().rev().zip(after.iter_mut().rev()) {
            // Of as many rungs each has its own counterpart.
            if !new.keep(old) && !as_many {
                break;
            }
        }
    }

    /// Takes over the network of `before` if its own is the same. Whether it
    /// is.
    fn keep(&mut self, before: &Self) -> bool {
        let is_same = self.network == before.network;
        if is_same {
            self.network = before.network.clone();
        }
        is_same
    }
}
