//! A drawn body: elements with ids, and connections between them.
//!
//! LD and FBD bodies are made of the same elements, and an SFC body may hold
//! them too, so one reader serves all three. An element's input names the
//! element it is fed by through its `localId`, often one that comes later;
//! here the ids are resolved, and sources are places in [`Diagram::nodes`]. It
//! is a graph as drawn: no order, no meaning yet.

use source::Span;

use super::xml::Text;
use crate::{Edge, PinDirection};

/// The elements of a body, in document order.
pub(super) struct Diagram {
    pub(super) nodes: Vec<Node>,
    /// Comments and titles with their places.
    pub(super) comments: Vec<Comment>,
}

impl Diagram {
    /// A ladder that is the condition of a transition and has no coil hands
    /// the power at its right rail to the transition, which is known by its
    /// name or its id.
    pub(super) fn right_rail_is_condition(&mut self, name: Option<&Text>, id: &str) {
        let written = |node: &Node| {
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
                id.clone_into(&mut node.id);
            }
        }
    }
}

/// A drawn element.
pub(super) struct Node {
    pub(super) kind: NodeKind,
    /// Its `localId` as written.
    pub(super) id: String,
    /// The variable, expression or label at it.
    pub(super) operand: Option<Text>,
    pub(super) inputs: Vec<Input>,
    pub(super) outputs: Vec<Output>,
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
pub(super) enum NodeKind {
    LeftRail,
    RightRail,
    Contact(Style),
    Coil(Style),
    Block(BlockType),
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
    Foreign(String),
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
pub(super) struct BlockType {
    pub(super) name: Text,
    pub(super) instance: Option<Text>,
}

/// Where connections arrive.
#[derive(Clone, Debug)]
pub(super) struct Input {
    /// The pin's name; empty on contacts, coils and variables.
    pub(super) pin: String,
    pub(super) direction: PinDirection,
    pub(super) negated: bool,
    pub(super) edge: Option<Edge>,
    pub(super) sources: Vec<Source>,
    /// Whether a connection to it was reported as leading nowhere.
    pub(super) broken: bool,
    pub(super) span: Span,
}

/// Where connections leave.
#[derive(Clone, Debug)]
pub(super) struct Output {
    pub(super) pin: String,
    pub(super) direction: PinDirection,
    pub(super) negated: bool,
    pub(super) edge: Option<Edge>,
    pub(super) span: Span,
}

/// The element and the output that a connection comes from.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Source {
    pub(super) node: usize,
    pub(super) pin: String,
    pub(super) span: Span,
}

/// A comment, or the title of a network.
pub(super) struct Comment {
    pub(super) text: String,
    pub(super) position: Position,
    /// Number of elements that come before it in the document.
    pub(super) before: usize,
}
