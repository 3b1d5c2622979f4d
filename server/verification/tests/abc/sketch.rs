//! Random charts, each written as a spec and as a ladder.

use crate::random::Random;

pub const INPUTS: [&str; 4] = ["a", "b", "c", "d"];

/// A chart: steps are numbers, step 0 is initial.
#[derive(Clone)]
pub struct Sketch {
    steps: usize,
    transitions: Vec<Transition>,
    outputs: Vec<Output>,
}

#[derive(Clone)]
struct Transition {
    from: Vec<usize>,
    to: Vec<usize>,
    /// The input whose edge clears it, and which edge.
    edge: (usize, bool),
    /// An input that must be on or off besides.
    level: Option<(usize, bool)>,
}

/// On while one of the steps is active, with an input besides.
#[derive(Clone)]
struct Output {
    steps: Vec<usize>,
    level: Option<(usize, bool)>,
}

fn level(random: &mut Random) -> Option<(usize, bool)> {
    (random.below(2) == 0).then(|| (random.below(INPUTS.len()), random.below(2) == 0))
}

fn literal((input, is_on): (usize, bool)) -> String {
    format!("{}{}", if is_on { "" } else { "/" }, INPUTS[input])
}

impl Transition {
    fn receptivity(&self) -> String {
        let (input, rises) = self.edge;
        let edge = if rises { "rise" } else { "fall" };
        let level = self.level.map(|it| format!("*{}", literal(it)));
        format!("{edge}({}){}", INPUTS[input], level.unwrap_or_default())
    }
}

impl Sketch {
    /// A circle of steps with shortcuts, and places where two branches begin or
    /// join.
    pub fn random(random: &mut Random) -> Self {
        let steps = 3 + random.below(5);
        let mut transitions = Vec::new();
        for at in 0..steps {
            transitions.push((vec![at], vec![(at + 1) % steps]));
        }
        for _ in 0..random.below(4) {
            let mut some = |most: usize| {
                let number = 1 + random.below(most);
                let mut all: Vec<usize> = (0..number).map(|_| random.below(steps)).collect();
                all.sort_unstable();
                all.dedup();
                all
            };
            transitions.push((some(2), some(2)));
        }
        let transitions = transitions.into_iter().map(|(from, to)| Transition {
            from,
            to,
            edge: (random.below(INPUTS.len()), random.below(3) > 0),
            level: level(random),
        });
        let transitions = transitions.collect();
        let outputs = (0..2 + random.below(3)).map(|_| {
            let mut on: Vec<usize> = (0..1 + random.below(2))
                .map(|_| random.below(steps))
                .collect();
            on.sort_unstable();
            on.dedup();
            Output {
                steps: on,
                level: level(random),
            }
        });
        Self {
            steps,
            transitions,
            outputs: outputs.collect(),
        }
    }

    /// The chart with one thing changed, which may or may not be seen.
    pub fn with_fault(&self, random: &mut Random) -> Self {
        let mut other = self.clone();
        let at = random.below(other.transitions.len());
        let transition = &mut other.transitions[at];
        match random.below(5) {
            0 => transition.edge.1 = !transition.edge.1,
            1 => transition.edge.0 = (transition.edge.0 + 1) % INPUTS.len(),
            2 => transition.to = vec![(transition.to[0] + 1) % self.steps],
            3 => {
                let output = random.below(other.outputs.len());
                let steps = &mut other.outputs[output].steps;
                *steps = vec![(steps[0] + 1) % self.steps];
            }
            _ => {
                transition.level = match transition.level {
                    None => Some((random.below(INPUTS.len()), true)),
                    Some((input, is_on)) => Some((input, !is_on)),
                }
            }
        }
        other
    }

    /// As a spec.
    pub fn spec(&self) -> String {
        let list = |prefix: &str, number: usize| {
            let names: Vec<String> = (0..number).map(|at| format!("{prefix}{at}")).collect();
            names.join(", ")
        };
        let mut out = format!(
            "Step {}\nTransition {}\nInput {}\nOutput {}\nMarking X0\nTransitions:\n",
            list("X", self.steps),
            list("t", self.transitions.len()),
            INPUTS.join(", "),
            list("o", self.outputs.len()),
        );
        for (at, transition) in self.transitions.iter().enumerate() {
            let from: Vec<String> = transition
                .from
                .iter()
                .map(|step| format!("X{step}"))
                .collect();
            let to: Vec<String> = transition
                .to
                .iter()
                .map(|step| format!("@X{step}"))
                .collect();
            let receptivity = transition.receptivity();
            out += &format!(
                "t{at}: {}*{receptivity} |- {}\n",
                from.join("*"),
                to.join("*")
            );
        }
        out += "Steps:\n";
        for (at, output) in self.outputs.iter().enumerate() {
            let level = output.level.map(|it| format!("{} ", literal(it)));
            for step in &output.steps {
                out += &format!("X{step}: {}|- o{at}\n", level.clone().unwrap_or_default());
            }
        }
        out
    }

    /// As a ladder: transitions first, then steps in one of two ways, then
    /// outputs.
    pub fn ladder(&self, random: &mut Random) -> String {
        let mut out = String::from("program Coded\n\n");
        for input in INPUTS {
            out += &format!("input {input}\n");
        }
        for at in 0..self.outputs.len() {
            out += &format!("output o{at}\n");
        }
        out += "\nrung: \"S:FS\" -> set x0\n";
        for (at, transition) in self.transitions.iter().enumerate() {
            let from: Vec<String> = transition
                .from
                .iter()
                .map(|step| format!("x{step}"))
                .collect();
            out += &format!(
                "rung: {} * {} -> t{at}\n",
                transition.receptivity().replace('*', " * "),
                from.join(" * ")
            );
        }
        let touching = |step: usize, side: fn(&Transition) -> &Vec<usize>| {
            let all = self.transitions.iter().enumerate();
            let names = all
                .filter(|(_, it)| side(it).contains(&step))
                .map(|(at, _)| format!("t{at}"));
            names.collect::<Vec<String>>()
        };
        let is_by_latches = random.below(2) == 0;
        for step in 0..self.steps {
            let (enters, leaves) = (touching(step, |it| &it.to), touching(step, |it| &it.from));
            let any = |bits: Vec<String>| match bits.is_empty() {
                true => "0".to_owned(),
                false => bits.join(" + "),
            };
            let (enter, leave) = (any(enters), any(leaves));
            out += &match is_by_latches {
                true => format!("rung: {leave} -> reset x{step}\nrung: {enter} -> set x{step}\n"),
                false => format!("rung: {enter} + x{step} * /({leave}) -> x{step}\n"),
            };
        }
        for (at, output) in self.outputs.iter().enumerate() {
            let steps: Vec<String> = output.steps.iter().map(|step| format!("x{step}")).collect();
            let level = output.level.map(|it| format!(" * {}", literal(it)));
            out += &format!(
                "rung: ({}){} -> o{at}\n",
                steps.join(" + "),
                level.unwrap_or_default()
            );
        }
        out
    }
}
