//! What must hold for every text.

use std::fmt::Write;

use ladder::Reading;
use proptest::prelude::*;

use crate::evaluation::coils;
use crate::places::{repository, xml_files};

const VARIABLES: [&str; 5] = ["a", "b", "c", "d", "e"];

/// A series-parallel circuit of contacts.
#[derive(Clone, Debug)]
enum Circuit {
    Contact { variable: usize, closed: bool },
    Series(Vec<Circuit>),
    Parallel(Vec<Circuit>),
}

impl Circuit {
    fn conducts(&self, bits: u32) -> bool {
        match self {
            Self::Contact { variable, closed } => (bits >> variable & 1 == 1) != *closed,
            Self::Series(parts) => parts.iter().all(|part| part.conducts(bits)),
            Self::Parallel(parts) => parts.iter().any(|part| part.conducts(bits)),
        }
    }
}

fn circuit() -> impl Strategy<Value = Circuit> {
    let contact = (0..VARIABLES.len(), any::<bool>())
        .prop_map(|(variable, closed)| Circuit::Contact { variable, closed });
    contact.prop_recursive(4, 16, 4, |inner| {
        let parts = prop::collection::vec(inner, 1..4);
        prop_oneof![
            parts.clone().prop_map(Circuit::Series),
            parts.prop_map(Circuit::Parallel),
        ]
    })
}

/// A body while it is drawn: its elements as XML, to be shuffled.
#[derive(Default)]
struct Drawing {
    elements: Vec<String>,
    last_id: usize,
}

impl Drawing {
    fn id(&mut self) -> usize {
        // Ids need neither follow each other nor stand in any order.
        self.last_id = (self.last_id + 7_919) % 1_000_003;
        self.last_id
    }

    fn ladder_element(&mut self, tag: &str, style: &str, variable: &str, from: &[usize]) -> usize {
        let id = self.id();
        self.elements.push(format!(
            "<{tag} localId=\"{id}\" {style}><position x=\"{}\" y=\"10\"/>{}<variable>{variable}</variable></{tag}>",
            self.elements.len() * 20,
            point(from),
        ));
        id
    }

    /// Contacts after `from`; what power leaves from.
    fn contacts(&mut self, circuit: &Circuit, from: Vec<usize>) -> Vec<usize> {
        match circuit {
            Circuit::Contact { variable, closed } => {
                let style = format!("negated=\"{closed}\"");
                vec![self.ladder_element("contact", &style, VARIABLES[*variable], &from)]
            }
            Circuit::Series(parts) => parts
                .iter()
                .fold(from, |from, part| self.contacts(part, from)),
            Circuit::Parallel(parts) => parts
                .iter()
                .flat_map(|part| self.contacts(part, from.clone()))
                .collect(),
        }
    }

    /// The same circuit as gates; the element whose output it is.
    fn gates(&mut self, circuit: &Circuit) -> usize {
        let (kind, parts) = match circuit {
            Circuit::Contact { variable, closed } => {
                let id = self.id();
                self.elements.push(format!(
                    "<inVariable localId=\"{id}\" negated=\"{closed}\"><position x=\"0\" y=\"0\"/><expression>{}</expression></inVariable>",
                    VARIABLES[*variable],
                ));
                return id;
            }
            Circuit::Series(parts) => ("AND", parts),
            Circuit::Parallel(parts) => ("OR", parts),
        };
        let sources: Vec<_> = parts.iter().map(|part| self.gates(part)).collect();
        let id = self.id();
        let mut block = format!(
            "<block localId=\"{id}\" typeName=\"{kind}\"><position x=\"0\" y=\"0\"/><inputVariables>"
        );
        for (at, source) in sources.iter().enumerate() {
            write!(
                block,
                "<variable formalParameter=\"IN{}\">{}</variable>",
                at + 1,
                point(&[*source])
            )
            .unwrap();
        }
        block += "</inputVariables><inOutVariables/><outputVariables><variable formalParameter=\"OUT\"/></outputVariables></block>";
        self.elements.push(block);
        id
    }

    fn project(&self, order: &[usize]) -> String {
        let mut elements: Vec<_> = self.elements.iter().enumerate().collect();
        elements.sort_by_key(|(at, _)| order.get(*at).copied().unwrap_or(*at));
        let elements: String = elements
            .into_iter()
            .map(|(_, text)| text.as_str())
            .collect();
        let variables: String = VARIABLES
            .iter()
            .chain(&["q"])
            .map(|name| format!("<variable name=\"{name}\"><type><BOOL/></type></variable>"))
            .collect();
        format!(
            "<project><types><pous><pou name=\"P\" pouType=\"program\"><interface><localVars>{variables}</localVars></interface><body><LD>{elements}</LD></body></pou></pous></types></project>"
        )
    }
}

fn point(from: &[usize]) -> String {
    let connections: String = from
        .iter()
        .map(|id| format!("<connection refLocalId=\"{id}\"/>"))
        .collect();
    format!("<connectionPointIn>{connections}</connectionPointIn>")
}

/// Whether the one rung's coil `q` gets what the circuit says.
fn same_function(reading: &Reading, circuit: &Circuit) -> Result<(), TestCaseError> {
    prop_assert_eq!(&reading.diagnostics, &[]);
    let rungs: Vec<_> = reading.program.rungs().collect();
    prop_assert_eq!(rungs.len(), 1);
    for bits in 0..1u32 << VARIABLES.len() {
        let value = |name: &str| {
            let place = VARIABLES.iter().position(|known| *known == name);
            bits >> place.expect("a variable of the circuit") & 1 == 1
        };
        let found = coils(&rungs[0].1.network, &value);
        prop_assert_eq!(found.get("q"), Some(&circuit.conducts(bits)));
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(128))]

    #[test]
    fn a_drawn_circuit_means_what_it_meant_in_any_document_order(
        circuit in circuit(),
        order in prop::collection::vec(0..100usize, 40),
    ) {
        let mut drawing = Drawing::default();
        let rail = drawing.id();
        drawing.elements.push(format!(
            "<leftPowerRail localId=\"{rail}\"><position x=\"0\" y=\"0\"/></leftPowerRail>"
        ));
        let ends = drawing.contacts(&circuit, vec![rail]);
        drawing.ladder_element("coil", "", "q", &ends);
        let text = drawing.project(&order);
        same_function(&ladder::read(text.as_bytes()), &circuit)?;
    }

    #[test]
    fn gates_mean_what_contacts_mean(
        circuit in circuit(),
        order in prop::collection::vec(0..100usize, 40),
    ) {
        let mut drawing = Drawing::default();
        let end = drawing.gates(&circuit);
        let id = drawing.id();
        drawing.elements.push(format!(
            "<outVariable localId=\"{id}\"><position x=\"0\" y=\"0\"/>{}<expression>Q</expression></outVariable>",
            point(&[end]),
        ));
        let text = drawing.project(&order);
        same_function(&ladder::read(text.as_bytes()), &circuit)?;
    }

    #[test]
    fn no_damage_makes_the_reader_fall(
        which in any::<prop::sample::Index>(),
        damages in prop::collection::vec(damage(), 1..6),
    ) {
        let files = fixtures();
        let mut text = which.get(&files).clone();
        for damage in &damages {
            damage.apply(&mut text);
        }
        well_placed(&text)?;
    }

    #[test]
    fn no_heap_of_tags_makes_the_reader_fall(tags in prop::collection::vec(tag(), 0..60)) {
        let text = format!("<project><pou name=\"p\"><body><LD>{}", tags.concat());
        well_placed(&text)?;
    }
}

/// Whether every place that a reading names lies in the text.
fn well_placed(text: &str) -> Result<(), TestCaseError> {
    let reading = ladder::read(text.as_bytes());
    let inside = |span: source::Span| text.get(span.range()).is_some();
    for diagnostic in &reading.diagnostics {
        prop_assert!(inside(diagnostic.span), "{:?}", diagnostic);
        for related in &diagnostic.related {
            prop_assert!(inside(related.span), "{:?}", diagnostic);
        }
    }
    for (_, rung) in reading.program.rungs() {
        prop_assert!(inside(rung.span));
        for (_, element) in rung.network.elements() {
            prop_assert!(inside(rung.place(element.within)));
            let kind = &element.kind;
            for operand in kind.reads().into_iter().chain(kind.writes()) {
                prop_assert!(inside(rung.place(operand.within)), "{}", operand.name);
            }
        }
    }
    Ok(())
}

fn fixtures() -> Vec<String> {
    let mut files = xml_files(&repository("fixtures/plcopen"));
    files.extend(xml_files(&repository("fixtures/neutralization")));
    files
        .iter()
        .map(|file| std::fs::read_to_string(file).expect("a fixture"))
        .collect()
}

/// Something that may happen to a text.
#[derive(Clone, Debug)]
enum Damage {
    CutOff(prop::sample::Index),
    Remove(prop::sample::Index, usize),
    Repeat(prop::sample::Index, usize),
    Insert(prop::sample::Index, String),
    /// An id becomes another.
    Rejoin(prop::sample::Index, u8),
}

fn damage() -> impl Strategy<Value = Damage> {
    let index = any::<prop::sample::Index>;
    prop_oneof![
        index().prop_map(Damage::CutOff),
        (index(), 1..200usize).prop_map(|(at, length)| Damage::Remove(at, length)),
        (index(), 1..400usize).prop_map(|(at, length)| Damage::Repeat(at, length)),
        (index(), "[<>/\"&;=a-z\\[\\]#('é ]{1,6}").prop_map(|(at, text)| Damage::Insert(at, text)),
        (index(), 1..12u8).prop_map(|(at, id)| Damage::Rejoin(at, id)),
    ]
}

impl Damage {
    fn apply(&self, text: &mut String) {
        let boundary = |text: &str, mut at: usize| {
            at = at.min(text.len());
            while !text.is_char_boundary(at) {
                at -= 1;
            }
            at
        };
        let place = |text: &str, at: &prop::sample::Index| boundary(text, at.index(text.len() + 1));
        match self {
            Self::CutOff(at) => text.truncate(place(text, at)),
            Self::Remove(at, length) => {
                let start = place(text, at);
                let end = boundary(text, start + length);
                text.replace_range(start..end, "");
            }
            Self::Repeat(at, length) => {
                let start = place(text, at);
                let end = boundary(text, start + length);
                let part = text[start..end].to_owned();
                text.insert_str(end, &part);
            }
            Self::Insert(at, part) => {
                let start = place(text, at);
                text.insert_str(start, part);
            }
            Self::Rejoin(at, id) => {
                let start = place(text, at);
                let Some(found) = text[start..].find("refLocalId=\"") else {
                    return;
                };
                let start = start + found + "refLocalId=\"".len();
                let end = start + text[start..].find('"').unwrap_or(0);
                text.replace_range(start..end, &id.to_string());
            }
        }
    }
}

/// A tag of the format, open, closed or whole, with few ids so that they meet.
fn tag() -> impl Strategy<Value = String> {
    let names = prop::sample::select(vec![
        "contact",
        "coil",
        "leftPowerRail",
        "rightPowerRail",
        "inVariable",
        "outVariable",
        "inOutVariable",
        "connector",
        "continuation",
        "jump",
        "label",
        "return",
        "transition",
        "step",
        "jumpStep",
        "selectionDivergence",
        "simultaneousConvergence",
        "actionBlock",
    ]);
    let types = prop::sample::select(vec![
        "TON", "CTUD", "SR", "RS", "R_TRIG", "AND", "XOR", "NOT", "EQ", "LT", "MOVE", "ADD", "SEL",
        "nobodys", "p",
    ]);
    let marks = prop::sample::select(vec![
        "",
        "negated=\"true\"",
        "edge=\"rising\"",
        "edge=\"falling\" negated=\"true\"",
        "storage=\"set\"",
        "storage=\"reset\" edge=\"rising\"",
    ]);
    let texts = prop::sample::select(vec![
        "",
        "a",
        "TRUE",
        "5",
        "NOT a",
        "a > 5",
        "f(a) OR b",
        "a[i].x",
        "%IX0.0",
        "T#5s",
        "'x'",
        "((",
    ]);
    let ids = || prop::collection::vec(0..6usize, 0..3);
    let plain = (names, 0..6usize, marks.clone(), ids(), texts.clone()).prop_map(
        |(name, id, mark, from, text)| {
            format!(
                "<{name} localId=\"{id}\" name=\"n\" label=\"l\" targetName=\"n\" {mark}>{}<condition>{}</condition><variable>{text}</variable><expression>{text}</expression></{name}>",
                point(&from), point(&from),
            )
        },
    );
    let block = (types, 0..6usize, marks, ids(), ids(), texts).prop_map(
        |(name, id, mark, first, second, text)| {
            let pins = ["IN", "PT", "EN", "IN1", "IN2", "S1", "R", "CU"];
            let pin = |at: usize, from: &[usize]| {
                format!("<variable formalParameter=\"{}\" {mark}>{}</variable>", pins[(at + id) % 8], point(from))
            };
            format!(
                "<block localId=\"{id}\" typeName=\"{name}\" instanceName=\"{text}\"><inputVariables>{}{}{}</inputVariables><outputVariables><variable formalParameter=\"Q\" {mark}><connectionPointOut><expression>{text}</expression></connectionPointOut></variable><variable formalParameter=\"ENO\"/></outputVariables></block>",
                pin(0, &first), pin(1, &second), pin(3, &first),
            )
        },
    );
    let loose = prop::sample::select(vec![
        "<LD>",
        "</LD>",
        "</pou>",
        "<pou>",
        "&x;",
        "<![CDATA[",
        "]]>",
        "<SFC>",
        "</body>",
    ]);
    prop_oneof![4 => plain, 4 => block, 1 => loose.prop_map(str::to_owned)]
}
