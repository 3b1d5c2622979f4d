//! From a ladder and the expert's decisions to a spec (semantics, section 5).
//!
//! [`spec`] is a function of the ladder and the decisions, and of nothing
//! else. Before anything is accepted it gives the product form: every state a
//! partial grafcet of two steps, off and on, which shows no sequence but does
//! what the ladder does. Each accepted succession merges states into a
//! sequence. [`update`] brings a spec that already exists, with what people
//! changed in it by hand, up to new decisions.

mod actions;
mod astray;
mod base;
mod branches;
mod decisions;
mod findings;
mod forms;
mod interface;
mod known;
mod naming;
mod product;
mod register;
mod seen;
mod sequence;
mod sums;
mod unsaid;
mod update;
mod wording;

use grafcet::{Chart, Decision, Grafcet, Spec};
use logic::{Budget, Name};

pub use decisions::{Accept, Accepted, decide};
pub use findings::spec_findings;
pub(crate) use known::KnownForms;
pub(crate) use sums::Sums;
pub use unsaid::Unsaid;
pub use update::{Departure, Update, update};

use crate::Analysis;
use forms::Forms;
use naming::Names;
use product::Product;
use wording::Wording;

/// The spec that the ladder and the decisions give.
pub fn spec(analysis: &Analysis, decisions: &[Decision], budget: &Budget) -> Spec {
    let accepted = Accepted::new(analysis, decisions);
    let mut names = Names::new(analysis);
    let forms = Forms::of_spec(analysis, &accepted, budget);
    let mut wording = Wording::new(analysis, &forms.seen.atoms, budget);
    let mut chart = Chart::default();

    register::name_steps(analysis, &mut names, &mut wording);
    let sequences = sequence::plans(analysis, &accepted, &mut names, &mut wording, budget);
    let product = Product::new(analysis, &forms, &mut names, &mut wording);

    // All steps are named by now, so that every receptivity can speak of them.
    register::draw(analysis, &accepted, &mut names, &wording, &mut chart);
    for plan in &sequences {
        plan.draw(analysis, &mut names, &wording, &mut chart);
    }
    product.draw(analysis, &mut names, &wording, &mut chart);
    actions::add(
        analysis, &sequences, &product, &mut names, &wording, &mut chart,
    );
    product.draw_followers(&mut names, &mut chart);

    let mut grafcet = Grafcet {
        name: (!analysis.program.name.is_empty()).then(|| analysis.program.name.clone()),
        chart,
        ..Grafcet::default()
    };
    interface::declare(analysis, &mut grafcet);
    Spec {
        grafcet,
        decisions: decisions.to_vec(),
        ..Spec::default()
    }
}

/// The variables that [`spec`] does not say exactly, each with the reason; in
/// the order of the ladder. Those that a sequence decides are none of them: a
/// sequence says what the expert has accepted.
pub fn unsaid(analysis: &Analysis, decisions: &[Decision], budget: &Budget) -> Vec<(Name, Unsaid)> {
    let accepted = Accepted::new(analysis, decisions);
    let forms = Forms::of_spec(analysis, &accepted, budget);
    let names = actions::own_variables(analysis);
    names
        .filter_map(|it| Some((it.name.clone(), forms.unsaid.get(&it.atom)?.clone())))
        .collect()
}
