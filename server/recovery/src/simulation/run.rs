use logic::{Cancel, Datum, Name};
use scenario::{Passing, Scenario, Step, Timing};

use super::sides::{Ladder, Powers, Spec};
use super::{Extent, Failure, Moment, Row, Side, Simulation, Stop, Subject, Values, Wanted};

/// A step takes no more scans than this; a longer wait wants a longer cycle.
const MOST_SCANS: u64 = 100_000;

/// With `timing settled`, what has not come to rest after so many scans never
/// will.
const MOST_SETTLING: usize = 1_000;

/// Runs `scenario` on `subject`.
pub fn simulate(scenario: &Scenario, subject: Subject<'_>, cancel: &Cancel) -> Simulation {
    let extent = Extent {
        scans: u64::MAX,
        wanted: &|| !cancel.is_cancelled(),
    };
    simulate_within(scenario, subject, extent)
}

/// The same, as far as `extent` lets it go.
pub fn simulate_within(
    scenario: &Scenario,
    subject: Subject<'_>,
    extent: Extent<'_>,
) -> Simulation {
    let mut run = Run::new(scenario, subject, extent);
    run.go();
    run.simulation
}

/// What is in ladder and grafcet after the scan `number`, counted from 1.
/// `None` if the run does not come so far.
pub fn moment<'s>(
    scenario: &Scenario,
    subject: Subject<'s>,
    number: u64,
    wanted: &dyn Fn() -> bool,
) -> Option<Moment<'s>> {
    let extent = Extent {
        scans: number,
        wanted,
    };
    let mut run = Run::new(scenario, subject, extent);
    run.observed = Some(number);
    run.go();
    (run.scan == number && number > 0).then_some(Moment {
        ladder: run.ladder,
        spec: run.spec,
        powers: run.powers,
    })
}

struct Run<'r, 's> {
    scenario: &'r Scenario,
    extent: Extent<'r>,
    ladder: Option<Ladder<'s>>,
    spec: Option<Spec>,
    /// Outputs that both have.
    common: Vec<Name>,
    simulation: Simulation,
    scan: u64,
    time_ms: u64,
    /// The values at the end of the last step.
    before: Values,
    /// The scan that is looked at more closely.
    observed: Option<u64>,
    /// The power in the rungs in that scan.
    powers: Powers,
}

impl<'r, 's> Run<'r, 's> {
    fn new(scenario: &'r Scenario, subject: Subject<'s>, extent: Extent<'r>) -> Self {
        let ladder = subject.ladder.map(Ladder::new);
        let spec = subject.grafcet.map(Spec::new);
        let mut inputs: Vec<Name> = Vec::new();
        for change in scenario.steps.iter().flat_map(|step| &step.changes) {
            if !inputs.contains(&change.name) {
                inputs.push(change.name.clone());
            }
        }
        let outputs = spec.iter().flat_map(|spec| spec.machine.outputs());
        let grafcet: Vec<Name> = outputs.map(|(name, _)| name.clone()).collect();
        let mut shown = ladder
            .as_ref()
            .map_or_else(Vec::new, |ladder| ladder.names.outputs.clone());
        let mut common = Vec::new();
        for name in &grafcet {
            let Some(ladder) = &ladder else {
                continue;
            };
            if ladder.names.knows(name) {
                common.push(name.clone());
                let own = ladder.names.resolved(name);
                if !shown.iter().any(|shown| **shown == *own) {
                    shown.push(own.into());
                }
            }
        }
        let mut run = Self {
            scenario,
            extent,
            ladder,
            spec,
            common,
            simulation: Simulation {
                inputs,
                ladder: shown,
                grafcet,
                ..Simulation::default()
            },
            scan: 0,
            time_ms: 0,
            before: Values::default(),
            observed: None,
            powers: Powers::new(),
        };
        run.before = run.values();
        run.simulation.start = run.before.clone();
        run
    }

    /// Does all steps, as far as that can be.
    fn go(&mut self) {
        for (at, step) in self.scenario.steps.iter().enumerate() {
            if let Err(stop) = self.step(at, step) {
                self.simulation.stopped = Some((at, stop));
                break;
            }
        }
    }

    fn step(&mut self, at: usize, step: &Step) -> Result<(), Stop> {
        for change in &step.changes {
            if let Some(ladder) = &mut self.ladder {
                ladder.set_input(&change.name, change.value);
            }
            if let Some(spec) = &mut self.spec {
                spec.machine.set_input(&change.name, change.value);
            }
        }
        let cycle = self.scenario.cycle_ms.max(1);
        let (scans, mut left) = match step.passing {
            Passing::Scans(number) => {
                let number = u64::from(number.max(1));
                (number, number.saturating_mul(cycle))
            }
            Passing::Wait(length) => (length.div_ceil(cycle).max(1), length),
        };
        if scans > MOST_SCANS {
            return Err(Stop::TooLong(scans));
        }
        for _ in 0..scans {
            self.scan(at, cycle.min(left))?;
            left = left.saturating_sub(cycle);
        }
        if self.scenario.timing == Timing::Settled {
            self.settle(at)?;
        }
        self.end_step(at, step);
        Ok(())
    }

    /// Scans that take no time, until one changes nothing.
    fn settle(&mut self, at: usize) -> Result<(), Stop> {
        for _ in 0..MOST_SETTLING {
            let (ladder, spec) = (self.ladder.clone(), self.spec.clone());
            self.scan(at, 0)?;
            let ladder_rests = match (&self.ladder, &ladder) {
                (Some(now), Some(before)) => now.is_as_in(before),
                _ => true,
            };
            let spec_rests = match (&self.spec, &spec) {
                (Some(now), Some(before)) => now.machine.is_as_in(&before.machine),
                _ => true,
            };
            if ladder_rests && spec_rests {
                return Ok(());
            }
        }
        Err(Stop::Restless)
    }

    fn scan(&mut self, at: usize, elapsed_ms: u64) -> Result<(), Stop> {
        if !(self.extent.wanted)() {
            return Err(Stop::Cancelled);
        }
        if self.scan >= self.extent.scans {
            return Err(Stop::Enough(self.extent.scans));
        }
        self.scan += 1;
        self.time_ms = self.time_ms.saturating_add(elapsed_ms);
        if let Some(ladder) = &mut self.ladder {
            match self.observed == Some(self.scan) {
                true => self.powers = ladder.scan_for_powers(elapsed_ms),
                false => ladder.scan(elapsed_ms),
            }
        }
        if let Some(spec) = &mut self.spec {
            let evolved = spec.scan(elapsed_ms, self.ladder.as_ref());
            evolved.map_err(Stop::Unstable)?;
        }
        let values = self.values();
        if *self.last_values() != values {
            let row = self.row(at, values);
            self.simulation.rows.push(row);
        }
        Ok(())
    }

    /// The values of the last row.
    fn last_values(&self) -> &Values {
        let last = self.simulation.rows.last();
        last.map_or(&self.simulation.start, |row| &row.values)
    }

    fn row(&self, at: usize, values: Values) -> Row {
        let is_compared = self.scenario.timing == Timing::Scan;
        Row {
            step: at,
            is_last: false,
            scan: self.scan,
            time_ms: self.time_ms,
            values,
            differences: match is_compared {
                true => self.differences(),
                false => Vec::new(),
            },
            failures: Vec::new(),
        }
    }

    fn end_step(&mut self, at: usize, step: &Step) {
        let values = self.values();
        let (differences, failures) = (self.differences(), self.failures(step, &values));
        // With `timing settled` the last scan only shows that all is at rest.
        let is_settled = self.scenario.timing == Timing::Settled;
        let is_over = |row: &Row| {
            row.step == at && (row.scan == self.scan || is_settled && row.values == values)
        };
        if !self.simulation.rows.last().is_some_and(is_over) {
            let row = self.row(at, values.clone());
            self.simulation.rows.push(row);
        }
        if let Some(last) = self.simulation.rows.last_mut() {
            last.is_last = true;
            last.differences = differences;
            last.failures = failures;
        }
        self.before = values;
    }

    fn values(&self) -> Values {
        let ladder = self.ladder.as_ref();
        let machine = self.spec.as_ref().map(|spec| &spec.machine);
        let input = |name: &Name| {
            let of_ladder = ladder.and_then(|ladder| ladder.value(name));
            let of_spec = || machine.map(|machine| machine.value(name));
            of_ladder.or_else(of_spec).unwrap_or_default()
        };
        let of_ladder = |name: &Name| ladder.map(|ladder| ladder.shown(name));
        Values {
            inputs: self.simulation.inputs.iter().map(input).collect(),
            ladder: self
                .simulation
                .ladder
                .iter()
                .filter_map(of_ladder)
                .collect(),
            active: machine
                .into_iter()
                .flat_map(|machine| machine.active().cloned())
                .collect(),
            grafcet: machine
                .into_iter()
                .flat_map(|machine| machine.outputs().map(|(_, value)| value))
                .collect(),
        }
    }

    fn differences(&self) -> Vec<Name> {
        let (Some(ladder), Some(spec)) = (&self.ladder, &self.spec) else {
            return Vec::new();
        };
        let differs = |name: &&Name| {
            let other = spec.machine.value(name);
            let own = ladder.value(name);
            own.is_some_and(|own| !is_equal(own, other))
        };
        self.common.iter().filter(differs).cloned().collect()
    }

    fn failures(&self, step: &Step, values: &Values) -> Vec<Failure> {
        let mut failures = Vec::new();
        for (at, expectation) in step.expected.iter().enumerate() {
            let name = &expectation.name;
            for (side, value) in self.judged(name) {
                if !expectation.test.holds(value) {
                    failures.push(Failure {
                        side,
                        name: name.clone(),
                        wanted: Wanted::Test(at, expectation.test),
                        value,
                    });
                }
            }
        }
        if step.only {
            let own = (&self.simulation.ladder, &self.before.ladder, &values.ladder);
            let other = (
                &self.simulation.grafcet,
                &self.before.grafcet,
                &values.grafcet,
            );
            for (side, (names, before, now)) in [(Side::Ladder, own), (Side::Grafcet, other)] {
                let all = names.iter().zip(before.iter().zip(now));
                let changed = all.filter(|(_, (before, now))| !is_equal(**before, **now));
                let stray = changed.filter(|(name, _)| !self.is_named(step, name));
                failures.extend(stray.map(|(name, (before, now))| Failure {
                    side,
                    name: name.clone(),
                    wanted: Wanted::Unchanged(*before),
                    value: *now,
                }));
            }
        }
        failures
    }

    /// The value of `name` on each side that has a say about it.
    fn judged(&self, name: &str) -> Vec<(Side, Datum)> {
        let of_ladder = self.ladder.as_ref().and_then(|ladder| ladder.value(name));
        let machine = self.spec.as_ref().map(|spec| &spec.machine);
        let has_say = |machine: &&grafcet::evolution::Machine| {
            machine.decides(name) || of_ladder.is_none() && machine.knows(name)
        };
        let of_spec = machine.filter(has_say).map(|machine| machine.value(name));
        let ladder = of_ladder.map(|value| (Side::Ladder, value));
        let spec = of_spec.map(|value| (Side::Grafcet, value));
        ladder.into_iter().chain(spec).collect()
    }

    /// Whether the step expects something of the output, by its name or its
    /// address.
    fn is_named(&self, step: &Step, output: &str) -> bool {
        step.expected.iter().any(|expectation| {
            let name = &*expectation.name;
            let resolved = self
                .ladder
                .as_ref()
                .map(|ladder| ladder.names.resolved(name));
            name == output || resolved == Some(output)
        })
    }
}

/// Whether two values are equal as numbers; off is 0 and on is 1.
fn is_equal(one: Datum, other: Datum) -> bool {
    one.key() == other.key() || one.compares(logic::Relation::Equal, other)
}
