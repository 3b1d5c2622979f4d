//! A drawn body: elements with ids, and connections between them.
//!
//! LD and FBD bodies are made of the same elements, and an SFC body may hold
//! them too, so one reader serves all three. An element's input names the
//! element it is fed by through its `localId`, often one that comes later;
//! [`read`] collects all elements first and resolves the ids then. What comes
//! out is a graph of places in [`Diagram::nodes`], as drawn: no order, no
//! meaning yet.

use std::collections::HashMap;

use source::{Diagnostic, Span, codes};

use super::xml::{Tag, Text};
use crate::{Edge, PinDirection};

/// The elements of a body, in document order.
pub(super) struct Diagram {
    pub(super) nodes: Vec<Node>,
    /// Comments and titles with their places.
    pub(super) comments: Vec<Comment>,
}

impl Diagram {
    /// A ladder that is the condition of a transition and has no coil hands
    /// the power at its right rail to the transition.
    pub(super) fn right_rail_is_condition(&mut self) {
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

/// A connection as written.
struct Connection {
    /// The input it arrives at: element and place among its inputs.
    node: usize,
    input: usize,
    id: String,
    pin: String,
    span: Span,
}

struct Drawing {
    diagram: Diagram,
    connections: Vec<Connection>,
    /// Connectors by name, and continuations with theirs.
    connectors: HashMap<String, usize>,
    continuations: Vec<(String, usize)>,
}

/// Reads the elements of an `LD`, `FBD` or `SFC` body.
pub(super) fn read(body: Tag<'_, '_>, diagnostics: &mut Vec<Diagnostic>) -> Diagram {
    let mut drawing = Drawing {
        diagram: Diagram {
            nodes: Vec::new(),
            comments: Vec::new(),
        },
        connections: Vec::new(),
        connectors: HashMap::new(),
        continuations: Vec::new(),
    };
    for tag in body.children() {
        drawing.element(tag, diagnostics);
    }
    drawing.resolve(diagnostics);
    drawing.diagram
}

impl Drawing {
    fn element(&mut self, tag: Tag<'_, '_>, diagnostics: &mut Vec<Diagnostic>) {
        let node = self.diagram.nodes.len();
        let (kind, operand) = match tag.name() {
            "comment" | "vendorElement" => return self.comment(tag),
            "position"
            | "addData"
            | "documentation"
            | "step"
            | "macroStep"
            | "jumpStep"
            | "selectionDivergence"
            | "selectionConvergence"
            | "simultaneousDivergence"
            | "simultaneousConvergence"
            | "actionBlock" => return,
            "transition" => {
                let Some(condition) = tag.child("condition") else {
                    return;
                };
                if condition.child("connectionPointIn").is_none() {
                    return;
                }
                let named = tag.attribute("name").cloned();
                let named = named.filter(|text| !text.value.trim().is_empty());
                self.add(NodeKind::Condition, tag, named);
                return self.point_in(node, condition, Pin::default());
            }
            "leftPowerRail" => (NodeKind::LeftRail, None),
            "rightPowerRail" => (NodeKind::RightRail, None),
            "contact" => (NodeKind::Contact(style(tag)), tag.child("variable")),
            "coil" => (NodeKind::Coil(style(tag)), tag.child("variable")),
            "block" => return self.block(tag, diagnostics),
            "inVariable" => (
                NodeKind::InVariable {
                    negated: tag.says("negated"),
                },
                tag.child("expression"),
            ),
            "outVariable" => (
                NodeKind::OutVariable {
                    negated: tag.says("negated"),
                },
                tag.child("expression"),
            ),
            "inOutVariable" => (
                NodeKind::InOutVariable {
                    negated_in: tag.says("negatedIn"),
                    negated_out: tag.says("negatedOut"),
                },
                tag.child("expression"),
            ),
            "connector" => {
                self.connectors.entry(name(tag)).or_insert(node);
                (NodeKind::Passage, None)
            }
            "continuation" => {
                self.continuations.push((name(tag), node));
                (NodeKind::Passage, None)
            }
            "label" => (NodeKind::Label, None),
            "jump" => (NodeKind::Jump, None),
            "return" => (NodeKind::Return, None),
            other => (NodeKind::Foreign(other.to_owned()), None),
        };
        let operand = match kind {
            NodeKind::Label | NodeKind::Jump => tag.attribute("label").cloned(),
            _ => operand.and_then(Tag::text),
        };
        self.add(kind, tag, operand);
        self.point_in(node, tag, Pin::default());
    }

    fn add(&mut self, kind: NodeKind, tag: Tag<'_, '_>, operand: Option<Text>) {
        let number = |at: Option<Tag<'_, '_>>, name: &str| {
            at.and_then(|tag| tag.attribute(name)?.value.trim().parse::<f64>().ok())
                .map_or(0, |value| value as i64)
        };
        let position = tag.child("position");
        let order = number(Some(tag), "executionOrderId");
        self.diagram.nodes.push(Node {
            kind,
            id: attribute(tag, "localId"),
            operand,
            inputs: Vec::new(),
            outputs: Vec::new(),
            position: Position {
                y: number(position, "y"),
                x: number(position, "x"),
            },
            order: u64::try_from(order).unwrap_or(0),
            span: tag.span(),
        });
    }

    /// All `connectionPointIn` of an element make one input: on a contact,
    /// coil or rail, several points mean what several connections mean.
    fn point_in(&mut self, node: usize, tag: Tag<'_, '_>, pin: Pin) {
        let points: Vec<_> = tag
            .children()
            .filter(|point| point.name() == "connectionPointIn")
            .collect();
        let Some(first) = points.first() else {
            return;
        };
        let input = match self.diagram.nodes.get_mut(node) {
            Some(node) => {
                node.inputs.push(Input {
                    span: if pin.name.is_empty() {
                        first.span()
                    } else {
                        tag.span()
                    },
                    pin: pin.name,
                    direction: pin.direction,
                    negated: pin.style.negated,
                    edge: pin.style.edge,
                    sources: Vec::new(),
                    broken: false,
                });
                node.inputs.len() - 1
            }
            None => return,
        };
        for point in points {
            for part in point.children() {
                match part.name() {
                    "connection" => self.connections.push(Connection {
                        node,
                        input,
                        id: attribute(part, "refLocalId"),
                        pin: attribute(part, "formalParameter"),
                        span: part.span(),
                    }),
                    "expression" => self.value_at(node, input, part),
                    _ => {}
                }
            }
        }
    }

    /// An expression written inside an input, in place of a connection.
    fn value_at(&mut self, node: usize, input: usize, tag: Tag<'_, '_>) {
        let source = self.diagram.nodes.len();
        self.add(NodeKind::InVariable { negated: false }, tag, tag.text());
        self.beside(source, node);
        if let Some(input) = input_of(&mut self.diagram, node, input) {
            input.sources.push(Source {
                node: source,
                pin: String::new(),
                span: tag.span(),
            });
        }
    }

    /// A variable written inside an output, in place of an `outVariable`.
    fn target_at(&mut self, node: usize, pin: &str, tag: Tag<'_, '_>) {
        let target = self.diagram.nodes.len();
        self.add(NodeKind::OutVariable { negated: false }, tag, tag.text());
        self.beside(target, node);
        if let Some(added) = self.diagram.nodes.get_mut(target) {
            added.inputs.push(Input {
                pin: String::new(),
                direction: PinDirection::Input,
                negated: false,
                edge: None,
                sources: vec![Source {
                    node,
                    pin: pin.to_owned(),
                    span: tag.span(),
                }],
                broken: false,
                span: tag.span(),
            });
        }
    }

    /// Puts an element that has no place of its own where `node` is.
    fn beside(&mut self, added: usize, node: usize) {
        let Some(position) = self.diagram.nodes.get(node).map(|node| node.position) else {
            return;
        };
        if let Some(added) = self.diagram.nodes.get_mut(added) {
            added.position = position;
        }
    }

    fn block(&mut self, tag: Tag<'_, '_>, diagnostics: &mut Vec<Diagnostic>) {
        let node = self.diagram.nodes.len();
        let named = |name: &str| {
            let text = tag.attribute(name)?;
            (!text.value.trim().is_empty()).then(|| text.clone())
        };
        let name = named("typeName").unwrap_or_else(|| {
            diagnostics.push(
                Diagnostic::new(codes::NAMELESS, tag.span(), "this block has no type")
                    .help("choose its type in the editor it comes from"),
            );
            Text {
                value: "unnamed".to_owned(),
                span: tag.span(),
            }
        });
        let block = BlockType {
            name,
            instance: named("instanceName"),
        };
        self.add(NodeKind::Block(block), tag, None);
        for (section, direction) in [
            ("inputVariables", PinDirection::Input),
            ("inOutVariables", PinDirection::InOut),
            ("outputVariables", PinDirection::Output),
        ] {
            let lists = tag.children().filter(|list| list.name() == section);
            let variables = lists.flat_map(Tag::children);
            for (at, variable) in variables.filter(|v| v.name() == "variable").enumerate() {
                self.pin(node, at, variable, direction);
            }
        }
    }

    fn pin(&mut self, node: usize, at: usize, tag: Tag<'_, '_>, direction: PinDirection) {
        let mut name = attribute(tag, "formalParameter");
        if name.is_empty() {
            name = match direction {
                PinDirection::Output => "OUT".to_owned(),
                _ => format!("IN{}", at + 1),
            };
        }
        let style = style(tag);
        if direction != PinDirection::Input {
            if let Some(node) = self.diagram.nodes.get_mut(node) {
                node.outputs.push(Output {
                    pin: name.clone(),
                    direction,
                    negated: style.negated,
                    edge: style.edge,
                    span: tag.span(),
                });
            }
            for point in tag.children().filter(|p| p.name() == "connectionPointOut") {
                if let Some(expression) = point.child("expression") {
                    self.target_at(node, &name, expression);
                }
            }
        }
        if direction != PinDirection::Output {
            let pin = Pin {
                name,
                direction,
                style,
            };
            self.point_in(node, tag, pin);
        }
    }

    fn comment(&mut self, tag: Tag<'_, '_>) {
        let content = tag
            .child("content")
            .or_else(|| tag.child("alternativeText"));
        let Some(text) = content.and_then(Tag::text) else {
            return;
        };
        let before = self.diagram.nodes.len();
        let number = |name: &str| {
            tag.child("position")
                .and_then(|at| at.attribute(name)?.value.trim().parse::<f64>().ok())
                .map_or(0, |value| value as i64)
        };
        self.diagram.comments.push(Comment {
            text: text.value,
            position: Position {
                y: number("y"),
                x: number("x"),
            },
            before,
        });
    }

    fn resolve(&mut self, diagnostics: &mut Vec<Diagnostic>) {
        let mut places = HashMap::new();
        for (at, node) in self.diagram.nodes.iter().enumerate() {
            if !node.id.is_empty() {
                places.entry(node.id.clone()).or_insert(at);
            }
        }
        for connection in &self.connections {
            let Some(&node) = places.get(&connection.id) else {
                let message = format!("no element of this body has the id `{}`", connection.id);
                diagnostics.push(
                    Diagnostic::new(codes::DANGLING_CONNECTION, connection.span, message)
                        .help("draw the connection again; it is taken as off"),
                );
                let input = input_of(&mut self.diagram, connection.node, connection.input);
                if let Some(input) = input {
                    input.broken = true;
                }
                continue;
            };
            let source = Source {
                node,
                pin: connection.pin.clone(),
                span: connection.span,
            };
            if let Some(input) = input_of(&mut self.diagram, connection.node, connection.input) {
                input.sources.push(source);
            }
        }
        self.join_continuations(diagnostics);
    }

    /// A continuation is fed by the connector that bears its name.
    fn join_continuations(&mut self, diagnostics: &mut Vec<Diagnostic>) {
        for (name, at) in &self.continuations {
            let Some(node) = self.diagram.nodes.get_mut(*at) else {
                continue;
            };
            let span = node.span;
            let connector = self.connectors.get(name);
            if connector.is_none() {
                let message = format!("no connector of this body is called `{name}`");
                diagnostics.push(
                    Diagnostic::new(codes::DANGLING_CONNECTION, span, message)
                        .help("draw the connector; the continuation is taken as off"),
                );
            }
            let sources = connector.map(|&node| Source {
                node,
                pin: String::new(),
                span,
            });
            node.inputs.push(Input {
                pin: String::new(),
                direction: PinDirection::Input,
                negated: false,
                edge: None,
                sources: sources.into_iter().collect(),
                broken: connector.is_none(),
                span,
            });
        }
    }
}

/// A pin that connections arrive at.
struct Pin {
    name: String,
    direction: PinDirection,
    style: Style,
}

impl Default for Pin {
    fn default() -> Self {
        Self {
            name: String::new(),
            direction: PinDirection::Input,
            style: Style::default(),
        }
    }
}

fn input_of(diagram: &mut Diagram, node: usize, input: usize) -> Option<&mut Input> {
    diagram.nodes.get_mut(node)?.inputs.get_mut(input)
}

fn style(tag: Tag<'_, '_>) -> Style {
    let word = |name: &str| tag.attribute(name).map(|text| text.value.trim());
    Style {
        negated: tag.says("negated"),
        edge: match word("edge") {
            Some("rising") => Some(Edge::Rising),
            Some("falling") => Some(Edge::Falling),
            _ => None,
        },
        storage: match word("storage") {
            Some("set") => Some(Storage::Set),
            Some("reset") => Some(Storage::Reset),
            _ => None,
        },
    }
}

fn attribute(tag: Tag<'_, '_>, name: &str) -> String {
    tag.attribute(name)
        .map_or_else(String::new, |text| text.value.trim().to_owned())
}

fn name(tag: Tag<'_, '_>) -> String {
    attribute(tag, "name").to_uppercase()
}
