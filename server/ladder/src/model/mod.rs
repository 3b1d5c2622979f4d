//! The one model of ladder programs.
//!
//! From the outside in: a [`Program`] has [`Declaration`]s and [`Routine`]s;
//! a routine has [`Rung`]s; a rung has a [`Network`] of [`Element`]s joined by
//! [`Wire`]s; contacts, coils and boxes name [`Operand`]s.

mod chart;
mod declaration;
mod element;
mod network;
mod operand;
mod program;
mod within;

pub use chart::{Chart, ChartAction, ChartStep, ChartTransition};
pub use declaration::{Class, Declaration, Declarations};
pub use element::{
    Assignment, Block, Call, Coil, CoilKind, Comparison, Contact, ContactKind, Counter,
    CounterKind, Edge, Element, ElementKind, Familiarity, Gate, OneShot, Pin, PinDirection, Timer,
    TimerKind, Value,
};
pub use network::{Network, NetworkBuilder, Placed, Port, Wire};
pub use operand::Operand;
pub use program::{Format, Program, Role, Routine, Rung};
pub use within::Within;
