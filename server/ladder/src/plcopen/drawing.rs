//! Reads the elements of a body and resolves the ids that join them.

use std::borrow::Cow;

use foldhash::HashMap;
use source::{Diagnostic, Span, codes};

use super::diagram::{
    BlockType, Comment, Diagram, Input, Node, NodeKind, Output, Position, Source, Storage, Style,
};
use super::xml::{Tag, Text};
use crate::{Edge, PinDirection};

/// A connection as written.
struct Connection<'t> {
    /// The input it arrives at: element and place among its inputs.
    node: usize,
    input: usize,
    id: Cow<'t, str>,
    pin: Cow<'t, str>,
    span: Span,
}

struct Drawing<'t> {
    diagram: Diagram<'t>,
    connections: Vec<Connection<'t>>,
    /// Connectors by name, and continuations with theirs.
    connectors: HashMap<String, usize>,
    continuations: Vec<(String, usize)>,
}

/// Reads the elements of an `LD`, `FBD` or `SFC` body.
pub(super) fn read<'t>(body: Tag<'_, 't>, diagnostics: &mut Vec<Diagnostic>) -> Diagram<'t> {
    let mut drawing = Drawing {
        diagram: Diagram {
            nodes: Vec::new(),
            comments: Vec::new(),
        },
        connections: Vec::new(),
        connectors: HashMap::default(),
        continuations: Vec::new(),
    };
    for tag in body.children() {
        drawing.element(tag, diagnostics);
    }
    drawing.resolve(diagnostics);
    drawing.diagram
}

impl<'t> Drawing<'t> {
    fn element(&mut self, tag: Tag<'_, 't>, diagnostics: &mut Vec<Diagnostic>) {
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
                let named = tag.attribute("name");
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
            other => (NodeKind::Foreign(other), None),
        };
        let operand = match kind {
            NodeKind::Label | NodeKind::Jump => tag.attribute("label"),
            _ => operand.and_then(Tag::text),
        };
        self.add(kind, tag, operand);
        self.point_in(node, tag, Pin::default());
    }

    fn add(&mut self, kind: NodeKind<'t>, tag: Tag<'_, 't>, operand: Option<Text<'t>>) {
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
    fn point_in(&mut self, node: usize, tag: Tag<'_, 't>, pin: Pin<'t>) {
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
    fn value_at(&mut self, node: usize, input: usize, tag: Tag<'_, 't>) {
        let source = self.diagram.nodes.len();
        self.add(NodeKind::InVariable { negated: false }, tag, tag.text());
        self.beside(source, node);
        if let Some(input) = input_of(&mut self.diagram, node, input) {
            input.sources.push(Source {
                node: source,
                pin: Cow::Borrowed(""),
                span: tag.span(),
            });
        }
    }

    /// A variable written inside an output, in place of an `outVariable`.
    fn target_at(&mut self, node: usize, pin: Cow<'t, str>, tag: Tag<'_, 't>) {
        let target = self.diagram.nodes.len();
        self.add(NodeKind::OutVariable { negated: false }, tag, tag.text());
        self.beside(target, node);
        if let Some(added) = self.diagram.nodes.get_mut(target) {
            added.inputs.push(Input {
                pin: Cow::Borrowed(""),
                direction: PinDirection::Input,
                negated: false,
                edge: None,
                sources: vec![Source {
                    node,
                    pin,
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

    fn block(&mut self, tag: Tag<'_, 't>, diagnostics: &mut Vec<Diagnostic>) {
        let node = self.diagram.nodes.len();
        let named = |name: &str| {
            let text = tag.attribute(name)?;
            (!text.value.trim().is_empty()).then_some(text)
        };
        let name = named("typeName").unwrap_or_else(|| {
            diagnostics.push(
                Diagnostic::new(codes::NAMELESS, tag.span(), "this block has no type")
                    .help("choose its type in the editor it comes from"),
            );
            Text {
                value: Cow::Borrowed("unnamed"),
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

    fn pin(&mut self, node: usize, at: usize, tag: Tag<'_, 't>, direction: PinDirection) {
        let mut name = attribute(tag, "formalParameter");
        if name.is_empty() {
            name = match direction {
                PinDirection::Output => Cow::Borrowed("OUT"),
                _ => Cow::Owned(format!("IN{}", at + 1)),
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
                    self.target_at(node, name.clone(), expression);
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

    fn comment(&mut self, tag: Tag<'_, 't>) {
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
        let mut places = HashMap::default();
        for (at, node) in self.diagram.nodes.iter().enumerate() {
            if !node.id.is_empty() {
                places.entry(node.id.clone()).or_insert(at);
            }
        }
        for connection in std::mem::take(&mut self.connections) {
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
                pin: connection.pin,
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
                pin: Cow::Borrowed(""),
                span,
            });
            node.inputs.push(Input {
                pin: Cow::Borrowed(""),
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
struct Pin<'t> {
    name: Cow<'t, str>,
    direction: PinDirection,
    style: Style,
}

impl Default for Pin<'_> {
    fn default() -> Self {
        Self {
            name: Cow::Borrowed(""),
            direction: PinDirection::Input,
            style: Style::default(),
        }
    }
}

fn input_of<'d, 't>(
    diagram: &'d mut Diagram<'t>,
    node: usize,
    input: usize,
) -> Option<&'d mut Input<'t>> {
    diagram.nodes.get_mut(node)?.inputs.get_mut(input)
}

fn style(tag: Tag<'_, '_>) -> Style {
    let word = |name: &str| attribute(tag, name);
    Style {
        negated: tag.says("negated"),
        edge: match &*word("edge") {
            "rising" => Some(Edge::Rising),
            "falling" => Some(Edge::Falling),
            _ => None,
        },
        storage: match &*word("storage") {
            "set" => Some(Storage::Set),
            "reset" => Some(Storage::Reset),
            _ => None,
        },
    }
}

fn attribute<'t>(tag: Tag<'_, 't>, name: &str) -> Cow<'t, str> {
    tag.attribute(name).map_or(Cow::Borrowed(""), Text::trimmed)
}

fn name(tag: Tag<'_, '_>) -> String {
    attribute(tag, "name").to_uppercase()
}
