use logic::Name;

use super::{
    Action, Chart, Decision, EnvironmentRule, Instance, Part, PartKind, Property, Step, Transition,
    Variable,
};

/// All that a `.grafcet` file holds.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Spec {
    /// The grafcet.
    pub grafcet: Grafcet,
    /// What the plant can do.
    pub environment: Vec<EnvironmentRule>,
    /// What must never hold.
    pub never: Vec<Property>,
    /// What the expert decided, in the order of the file.
    pub decisions: Vec<Decision>,
}

/// A grafcet: its interface, its main chart, and its parts.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Grafcet {
    /// Its name, where it has one.
    pub name: Option<Name>,
    /// What it reads from the plant.
    pub inputs: Vec<Variable>,
    /// What it writes to the plant.
    pub outputs: Vec<Variable>,
    /// What it keeps for itself, or shares with programs beside it.
    pub internals: Vec<Variable>,
    /// The main chart.
    pub chart: Chart,
    /// Partial grafcets, expansions of macro-steps, reusable grafcets.
    pub parts: Vec<Part>,
    /// The reusable grafcets that run.
    pub instances: Vec<Instance>,
}

impl Grafcet {
    /// The main chart and those of the parts, each with the name of its part.
    pub fn charts(&self) -> impl Iterator<Item = (Option<&Name>, &Chart)> {
        let parts = self
            .parts
            .iter()
            .map(|part| (Some(&part.name), &part.chart));
        std::iter::once((None, &self.chart)).chain(parts)
    }

    /// The steps of all charts, reusable grafcets included.
    pub fn steps(&self) -> impl Iterator<Item = &Step> {
        self.charts().flat_map(|(_, chart)| &chart.steps)
    }

    /// The transitions of all charts.
    pub fn transitions(&self) -> impl Iterator<Item = &Transition> {
        self.charts().flat_map(|(_, chart)| &chart.transitions)
    }

    /// The actions of all charts.
    pub fn actions(&self) -> impl Iterator<Item = &Action> {
        self.charts().flat_map(|(_, chart)| &chart.actions)
    }

    /// The step called `name`, in whatever chart.
    pub fn step(&self, name: &str) -> Option<&Step> {
        self.charts().find_map(|(_, chart)| chart.step(name))
    }

    /// The transition called `name`, in whatever chart.
    pub fn transition(&self, name: &str) -> Option<&Transition> {
        self.charts().find_map(|(_, chart)| chart.transition(name))
    }

    /// The part called `name`.
    pub fn part(&self, name: &str) -> Option<&Part> {
        self.parts.iter().find(|part| &*part.name == name)
    }

    /// Inputs, outputs and internal variables.
    pub fn variables(&self) -> impl Iterator<Item = &Variable> {
        let all = [&self.inputs, &self.outputs, &self.internals];
        all.into_iter().flatten()
    }

    /// The input, output or internal variable called `name`.
    pub fn variable(&self, name: &str) -> Option<&Variable> {
        self.variables().find(|variable| &*variable.name == name)
    }

    /// The steps of the initial situation, reusable grafcets left out.
    pub fn initial_steps(&self) -> impl Iterator<Item = &Step> {
        let parts = self
            .parts
            .iter()
            .filter(|part| !matches!(part.kind, PartKind::Reusable { .. }))
            .map(|part| &part.chart);
        std::iter::once(&self.chart)
            .chain(parts)
            .flat_map(|chart| &chart.steps)
            .filter(|step| step.initial)
    }
}
