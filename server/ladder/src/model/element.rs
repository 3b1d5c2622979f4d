use logic::{Name, Relation};

use super::{Operand, Within};

/// One thing on a rung, with the bytes it was read from.
#[derive(Clone, Debug, PartialEq)]
pub struct Element {
    /// What it is.
    pub kind: ElementKind,
    /// Where it is written, the whole of it.
    pub within: Within,
}

/// What an element is, and so how power passes it.
#[derive(Clone, Debug, PartialEq)]
pub enum ElementKind {
    /// The left power rail: always on. Element 0 of every network.
    Rail,
    /// Passes power while its variable says so.
    Contact(Contact),
    /// Writes power to its variable, and passes it on unchanged.
    Coil(Coil),
    /// Passes power while the comparison holds.
    Comparison(Comparison),
    /// Passes power exactly when it gets none (`NOT` on the wire).
    Invert,
    /// Never passes power (`AFI`).
    Open,
    /// Passes power for one scan when the power it gets rises or falls (`ONS`,
    /// `OSR` with a storage bit, `R_TRIG` in the flow).
    OneShot(OneShot),
    /// Joins named Boolean input pins: `AND`, `OR`, `XOR` blocks. Its inputs are the
    /// wires that arrive at distinct ports.
    Gate(Gate),
    /// A timer. Its Boolean outputs are the atoms `T.Q`, `T.DN` and so on.
    Timer(Timer),
    /// A counter. Its Boolean outputs are atoms too.
    Counter(Counter),
    /// Writes a value to a variable while powered; passes power on unchanged.
    Assign(Assignment),
    /// Resets a timer or counter while powered (`RES`).
    ResetBox(Operand),
    /// Runs another routine while powered (`JSR`).
    Call(Call),
    /// Goes on at a label while powered (`JMP`).
    Jump(Operand),
    /// Where a jump arrives (`LBL`); passes power on.
    Label(Operand),
    /// Leaves the routine while powered: `RET`, and `TND`, which Rockwell's
    /// reference calls an end of the routine too ("if the TND instruction is in
    /// a subroutine, control returns to the calling routine").
    Return {
        /// Whether the whole program ends for this scan, whatever called the
        /// routine.
        program: bool,
    },
    /// Begins or ends a zone under master control (`MCR`, master relay): while
    /// its begin is unpowered, plain coils inside are written 0 and set or
    /// reset coils and assignments do nothing.
    Zone,
    /// Anything else: a call of a block, or an instruction whose effect is not
    /// modelled. Passes power on unchanged where the source does so; its
    /// Boolean output pins are atoms `instance.pin`.
    Block(Block),
}

/// How a contact looks at its variable.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ContactKind {
    /// Normally open: on while the variable is.
    Open,
    /// Normally closed: on while the variable is not.
    Closed,
    /// On for the one evaluation in which the variable has risen.
    Rising,
    /// On for the one evaluation in which the variable has fallen.
    Falling,
}

/// A contact.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Contact {
    /// What it looks at.
    pub operand: Operand,
    /// How.
    pub kind: ContactKind,
}

/// How a coil writes its variable.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum CoilKind {
    /// Writes power as it is (`OTE`).
    Plain,
    /// Writes the complement of power.
    Negated,
    /// Writes 1 when powered, else nothing (`OTL`).
    Set,
    /// Writes 0 when powered, else nothing (`OTU`).
    Reset,
    /// Writes 1 for the scan in which power rises, else 0.
    Rising,
    /// Writes 1 for the scan in which power falls, else 0.
    Falling,
}

/// A coil.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Coil {
    /// What it writes.
    pub operand: Operand,
    /// How.
    pub kind: CoilKind,
}

/// A comparison in the power flow.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Comparison {
    /// Left side: a variable, constant or arithmetic term.
    pub left: Operand,
    /// How they compare.
    pub relation: Relation,
    /// Right side.
    pub right: Operand,
}

/// A rise or a fall.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Edge {
    /// From 0 to 1.
    Rising,
    /// From 1 to 0.
    Falling,
}

/// An edge of the power flow.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct OneShot {
    /// Which edge.
    pub edge: Edge,
    /// The bit or instance that remembers the power of the last evaluation.
    pub memory: Option<Operand>,
}

/// A logic gate with named inputs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Gate {
    /// All inputs.
    And,
    /// Any input.
    Or,
    /// An odd number of inputs.
    Xor,
}

/// Which law a timer obeys.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum TimerKind {
    /// On-delay: the output implies the input.
    OnDelay,
    /// Off-delay: the input implies the output.
    OffDelay,
    /// Pulse: a rise of the input starts the output for the time.
    Pulse,
    /// Retentive on-delay: keeps its time and its output until reset.
    Retentive,
}

/// A timer.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Timer {
    /// Its law.
    pub kind: TimerKind,
    /// The instance, such as `T1`.
    pub instance: Operand,
    /// The atom of its output: `T1.Q` (IEC) or `T1.DN` (Rockwell). Wires
    /// leave from [`Port::Power`](super::Port::Power) where power passes it
    /// unchanged, from `Port::Pin("Q")` where the output feeds the rung.
    pub output: Name,
    /// Preset time in milliseconds, where the source gives a constant.
    pub preset_ms: Option<u64>,
    /// The variable that holds the preset, where the source names one: read
    /// each time the timer is solved.
    pub preset_from: Option<Operand>,
}

/// How a counter counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum CounterKind {
    /// Upwards.
    Up,
    /// Downwards.
    Down,
    /// Both, by two inputs.
    UpDown,
    /// Upwards, and round to the start (LDmicro's `CTC`).
    Circular,
}

/// A counter.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Counter {
    /// How it counts.
    pub kind: CounterKind,
    /// The instance, such as `C1`.
    pub instance: Operand,
    /// The atom of its output: `C1.Q` or `C1.DN`.
    pub output: Name,
    /// Preset, where the source gives a constant.
    pub preset: Option<i64>,
    /// The variable that holds the preset, where the source names one: read
    /// each time the counter is solved.
    pub preset_from: Option<Operand>,
}

/// A value written to a variable.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Assignment {
    /// The variable written; a whole word where its bits have names of their
    /// own.
    pub target: Operand,
    /// What is written.
    pub value: Value,
    /// The instruction as the source names it: `MOV`, `ADD`.
    pub mnemonic: Name,
}

/// What an assignment writes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Value {
    /// A constant.
    Constant(i64),
    /// The value of a variable.
    Copy(Operand),
    /// The target's own value plus a constant, which may be negative:
    /// `ADD(R,1,R)`.
    Increment(i64),
    /// Anything else, with the variables that it reads.
    Term {
        /// The term in the source's notation.
        text: Name,
        /// Variables that occur in it.
        reads: Vec<Operand>,
    },
}

/// A call of a routine.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Call {
    /// The routine, by the name it is declared with in the caller's unit.
    pub routine: Operand,
    /// Values handed over.
    pub arguments: Vec<Operand>,
}

/// How well the tool knows a box.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Familiarity {
    /// In the catalogue: what it reads and writes is known, and the power it
    /// passes on.
    Known,
    /// Defined by the user, in the same file (AOI, function block).
    Defined,
    /// Not known: its outputs are opaque.
    Unknown,
}

/// Which way a pin points.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum PinDirection {
    /// Read by the box.
    Input,
    /// Written by the box.
    Output,
    /// Both, or not known.
    InOut,
}

/// A pin of a box with the value at it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Pin {
    /// Its name, where the source gives one.
    pub name: Option<Name>,
    /// Which way it points.
    pub direction: PinDirection,
    /// The variable, constant or term at it; `None` where a wire arrives or
    /// nothing is connected.
    pub operand: Option<Operand>,
}

/// A block that is none of the special kinds.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Block {
    /// The type or mnemonic: `PID`, `MSG`, `Analog_Input`.
    pub name: Name,
    /// The instance, if the type has instances.
    pub instance: Option<Operand>,
    /// Its pins in the order of the source.
    pub pins: Vec<Pin>,
    /// How well it is known.
    pub familiarity: Familiarity,
    /// Whether it decides itself if it passes on the power that it gets: then
    /// it conducts while the atom `instance.ENO` is on, or, without an
    /// instance, one of its own. Without power it passes on none.
    pub shapes_power: bool,
}

impl Block {
    /// Whether only its place tells it from others: it has no instance, and
    /// no inputs or one that comes by wire.
    pub(crate) fn is_nameless(&self) -> bool {
        let mut inputs = self
            .pins
            .iter()
            .filter(|pin| pin.direction != PinDirection::Output)
            .peekable();
        self.instance.is_none()
            && (inputs.peek().is_none()
                || inputs.any(|pin| pin.operand.as_ref().is_none_or(|it| &*it.name == "_")))
    }
}

impl ElementKind {
    /// The variables that the element writes when it is solved. Bits and words
    /// are given as written; a whole word stands for its bits too.
    pub fn writes(&self) -> Vec<&Operand> {
        match self {
            Self::Coil(coil) => vec![&coil.operand],
            Self::Assign(assignment) => vec![&assignment.target],
            Self::ResetBox(operand) => vec![operand],
            Self::OneShot(shot) => shot.memory.iter().collect(),
            Self::Timer(timer) => vec![&timer.instance],
            Self::Counter(counter) => vec![&counter.instance],
            Self::Block(block) => {
                let pins = block
                    .pins
                    .iter()
                    .filter(|pin| pin.direction != PinDirection::Input)
                    .filter_map(|pin| pin.operand.as_ref());
                block.instance.iter().chain(pins).collect()
            }
            _ => Vec::new(),
        }
    }

    /// The variables that the element reads when it is solved.
    pub fn reads(&self) -> Vec<&Operand> {
        match self {
            Self::Contact(contact) => vec![&contact.operand],
            Self::Comparison(comparison) => vec![&comparison.left, &comparison.right],
            Self::Assign(assignment) => match &assignment.value {
                Value::Constant(_) => Vec::new(),
                Value::Copy(operand) => vec![operand],
                Value::Increment(_) => vec![&assignment.target],
                Value::Term { reads, .. } => reads.iter().collect(),
            },
            Self::Call(call) => call.arguments.iter().collect(),
            Self::Timer(timer) => timer.preset_from.iter().collect(),
            Self::Counter(counter) => counter.preset_from.iter().collect(),
            Self::Block(block) => block
                .pins
                .iter()
                .filter(|pin| pin.direction != PinDirection::Output)
                .filter_map(|pin| pin.operand.as_ref())
                .collect(),
            _ => Vec::new(),
        }
    }

    /// Every operand that names a variable, to change its name or its place.
    pub fn variables_mut(&mut self) -> Vec<&mut Operand> {
        let mut all = Vec::new();
        self.each_variable(|variable| all.push(variable));
        all
    }

    /// Visits every operand that names a variable.
    pub(super) fn each_variable<'e>(&'e mut self, mut visit: impl FnMut(&'e mut Operand)) {
        match self {
            Self::Rail
            | Self::Invert
            | Self::Open
            | Self::Gate(_)
            | Self::Jump(_)
            | Self::Label(_)
            | Self::Return { .. }
            | Self::Zone => {}
            Self::Contact(contact) => visit(&mut contact.operand),
            Self::Coil(coil) => visit(&mut coil.operand),
            Self::Comparison(comparison) => {
                visit(&mut comparison.left);
                visit(&mut comparison.right);
            }
            Self::OneShot(shot) => shot.memory.iter_mut().for_each(visit),
            Self::Timer(timer) => {
                timer.preset_from.iter_mut().for_each(&mut visit);
                visit(&mut timer.instance);
            }
            Self::Counter(counter) => {
                counter.preset_from.iter_mut().for_each(&mut visit);
                visit(&mut counter.instance);
            }
            Self::Assign(assignment) => {
                match &mut assignment.value {
                    Value::Constant(_) | Value::Increment(_) => {}
                    Value::Copy(operand) => visit(operand),
                    Value::Term { reads, .. } => reads.iter_mut().for_each(&mut visit),
                }
                visit(&mut assignment.target);
            }
            Self::ResetBox(operand) => visit(operand),
            Self::Call(call) => call.arguments.iter_mut().for_each(visit),
            Self::Block(block) => {
                block.instance.iter_mut().for_each(&mut visit);
                let pins = block.pins.iter_mut();
                pins.filter_map(|pin| pin.operand.as_mut()).for_each(visit);
            }
        }
    }

    /// The label or routine that the element names, to change its name or its
    /// place.
    pub fn destination_mut(&mut self) -> Option<&mut Operand> {
        match self {
            Self::Jump(label) | Self::Label(label) => Some(label),
            Self::Call(call) => Some(&mut call.routine),
            _ => None,
        }
    }
}
