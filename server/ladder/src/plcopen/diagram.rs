//! A drawn body: elements with ids, and connections between them.
//!
//! LD and FBD bodies are made of the same elements, and an SFC body may hold
//! them too, so one reader serves all three. An element's input names the
//! element it is fed by through its `localId`, often one that comes later;
//! here the ids are resolved, and sources are places in [`Diagram::nodes`]. It
//! is a graph as drawn: no order, no meaning yet.

use std::borrow::Cow;

use source::Span;

use super::xml::Text;
use crate::{Edge, PinDirection};

/// The elements of a body, in document order.
pub(super) struct Diagram<'t> {
    pub(super) nodes: Vec<Node<'t>>,
    /// Comments and titles with their places.
    pub(super) comments: Vec<Comment<'t>>,
}

impl<'t> Diagram<'t> {
    /// A ladder that is the condition of a transition and has no coil hands
    /// the power at its right rail to the transition, which is known by its
    /// name or its id.
    pub(super) fn right_rail_is_condition(&mut self, name: Option<&Text<'t>>, id: Cow<'t, str>) {
        let written = |node: &Node<'_>| {
            matches!(
                node.kind,
                NodeKind::Coil(_) | NodeKind::OutVariable { .. } | NodeKind::InOutVariable { .. }
            )
        };
        if self.nodes.iter().any(written) {
            return;
        }
        for node in &mut self.nodes {
            let fed = node.inputs.iter().any(|input| !input.sources.is_empty());
            if node.kind == NodeKind::RightRail && fed {
                node.kind = NodeKind::Condition;
                node.operand = name.cloned();
                node.id = id.clone();
            }
        }
    }
}

/// A drawn element.
pub(super) struct Node<'t> {
    pub(super) kind: NodeKind<'t>,
    /// Its `localId` as written.
    pub(super) id: Cow<'t, str>,
    /// The variable, expression or label at it.
    pub(super) operand: Option<Text<'t>>,
    pub(super) inputs: Vec<Input<'t>>,
    pub(super) outputs: Vec<Output<'t>>,
    pub(super) position: Position,
    /// Its `executionOrderId`, 0 where it has none.
    pub(super) order: u64,
    pub(super) span: Span,
}

/// Where an element is drawn, by rows: y first.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Position {
    pub(super) y: i64,
    pub(super) x: i64,
}

/// What an element is.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum NodeKind<'t> {
    LeftRail,
    RightRail,
    Contact(Style),
    Coil(Style),
    Block(BlockType<'t>),
    InVariable {
        negated: bool,
    },
    OutVariable {
        negated: bool,
    },
    InOutVariable {
        negated_in: bool,
        negated_out: bool,
    },
    /// A connector or the continuation of one: power and values pass.
    Passage,
    Label,
    Jump,
    Return,
    /// A condition of a transition, which is fed by what is drawn around it.
    Condition,
    /// An element that the format does not have.
    Foreign(&'t str),
}

/// The marks on a contact or coil.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Style {
    pub(super) negated: bool,
    pub(super) edge: Option<Edge>,
    pub(super) storage: Option<Storage>,
}

/// What a coil keeps.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Storage {
    Set,
    Reset,
}

/// A block's type and instance.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct BlockType<'t> {
    pub(super) name: Text<'t>,
    pub(super) instance: Option<Text<'t>>,
}

/// Where connections arrive.
#[derive(Clone, Debug)]
pub(super) struct Input<'t> {
    /// The pin's name; empty on contacts, coils and variables.
    pub(super) pin: Cow<'t, str>,
    pub(super) direction: PinDirection,
    pub(super) negated: bool,
    pub(super) edge: Option<Edge>,
    pub(super) sources: Vec<Source<'t>>,
    /// Whether a connection to it was reported as leading nowhere.
    pub(super) broken: bool,
    pub(super) span: Span,
}

/// Where connections leave.
#[derive(Clone, Debug)]
pub(super) struct Output<'t> {
    pub(super) pin: Cow<'t, str>,
    pub(super) direction: PinDirection,
    pub(super) negated: bool,
    pub(super) edge: Option<Edge>,
    pub(super) span: Span,
}

/// The element and the output that a connection comes from.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Source<'t> {
    pub(super) node: usize,
    pub(super) pin: Cow<'t, str>,
    pub(super) span: Span,
}

/// A comment, or the title of a network.
pub(super) struct Comment<'t> {
    pub(super) text: Cow<'t, str>,
    pub(super) position: Position,
    /// Number of elements that come before it in the document.
    pub(super) before: usize,
}
