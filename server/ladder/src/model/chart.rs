use logic::Name;
use source::Span;

/// A sequential function chart that the source holds beside its ladders, as
/// drawn: read to compare with, never to recover from.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Chart {
    /// `Program/Routine` or the POU.
    pub scope: Name,
    /// Steps in the order of the source.
    pub steps: Vec<ChartStep>,
    /// Transitions in the order of the source.
    pub transitions: Vec<ChartTransition>,
    /// Where it stands.
    pub span: Span,
}

/// A step of a chart.
#[derive(Clone, Debug, PartialEq)]
pub struct ChartStep {
    /// Its name.
    pub name: Name,
    /// Whether it is active at the start.
    pub initial: bool,
    /// Its actions.
    pub actions: Vec<ChartAction>,
    /// Where it stands.
    pub span: Span,
}

/// An action of a step.
#[derive(Clone, Debug, PartialEq)]
pub struct ChartAction {
    /// The qualifier: `N`, `S`, `R`, `P1`; empty where none is given.
    pub qualifier: Name,
    /// Its body or variable in the source's notation.
    pub body: Name,
}

/// A transition of a chart, with divergences and convergences resolved.
#[derive(Clone, Debug, PartialEq)]
pub struct ChartTransition {
    /// Its name, where it has one.
    pub name: Name,
    /// The steps before it, as places in [`Chart::steps`].
    pub from: Vec<usize>,
    /// The steps after it.
    pub to: Vec<usize>,
    /// Its condition in the source's notation.
    pub condition: Name,
    /// Where it stands.
    pub span: Span,
}
