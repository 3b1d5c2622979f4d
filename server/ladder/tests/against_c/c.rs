//! A program in C: what a controller does in a scan, one thing after another.
//!
//! Power is a variable. A contact or comparison is looked at when its turn
//! comes, with or without power; what keeps a value from scan to scan is in a
//! structure of the program. In a zone that is switched off nothing has power.

use crate::program::{Boxed, Coil, Condition, INPUTS, Output, Program, Rung, RungKind, Term};

/// What every program needs. Whole numbers wrap around at 64 bits.
const HEAD: &str = "\
#include <stdio.h>

typedef long long num;
static num now;

static num add(num a, num b) { return (num)((unsigned long long)a + (unsigned long long)b); }
static num sub(num a, num b) { return (num)((unsigned long long)a - (unsigned long long)b); }
static num mul(num a, num b) { return (num)((unsigned long long)a * (unsigned long long)b); }

/* The value went from off to on, or from on to off, since it was last seen. */
static int rose(int *seen, int on) { int was = *seen; *seen = on; return on && !was; }
static int fell(int *seen, int on) { int was = *seen; *seen = on; return !on && was; }

struct box { int in, q, runs; num since, solved, count; };

/* On after the input has been on for so long. */
static void TON(struct box *b, int in, num preset) {
  if (!in) { b->runs = 0; b->q = 0; return; }
  if (!b->runs) { b->runs = 1; b->since = now; }
  b->q = now - b->since >= preset;
}

/* On with the input, and for so long after it. */
static void TOF(struct box *b, int in, num preset) {
  if (in) { b->q = 1; b->runs = 0; return; }
  if (b->q && !b->runs) { b->runs = 1; b->since = now; }
  if (b->runs && now - b->since >= preset) { b->runs = 0; b->q = 0; }
}

/* On for so long once the input has risen. */
static void TP(struct box *b, int in, num preset) {
  if (!b->runs && in && !b->in) { b->runs = 1; b->since = now; }
  if (b->runs && now - b->since >= preset) b->runs = 0;
  b->q = b->runs;
  b->in = in;
}

/* On when the input has been on for so long in all, until it is reset. */
static void RTO(struct box *b, int in, num preset) {
  if (in && b->in) b->count += now - b->solved;
  if (b->count > preset) b->count = preset;
  if (in && b->count >= preset) b->q = 1;
  b->in = in;
  b->solved = now;
}

static void CTU(struct box *b, int in, num preset) {
  if (rose(&b->in, in)) b->count++;
  b->q = b->count >= preset;
}

/* Begins at 0 again after its preset. */
static void CTC(struct box *b, int in, num preset) {
  if (rose(&b->in, in)) b->count++;
  if (b->count > preset) b->count = 0;
  b->q = b->count >= preset;
}

static void RES(struct box *b) { b->in = 0; b->q = 0; b->runs = 0; b->count = 0; }

";

pub fn source(programs: &[Program]) -> String {
    let mut out = HEAD.to_owned();
    for (at, program) in programs.iter().enumerate() {
        out += &Printer::print(at, program);
    }
    out += "int main(void) {\n  int program, on;\n  num elapsed, times[";
    out += &format!("{}];\n", programs.len());
    out += &format!(
        "  for (int i = 0; i < {}; i++) times[i] = 0;\n",
        programs.len()
    );
    out += "  while (scanf(\"%d %lld\", &program, &elapsed) == 2) {\n    int in[4];\n";
    out += &format!(
        "    for (int i = 0; i < {}; i++) in[i] = scanf(\"%d\", &on) == 1 && on;\n",
        INPUTS.len()
    );
    out += "    times[program] += elapsed;\n    now = times[program];\n    switch (program) {\n";
    for at in 0..programs.len() {
        out += &format!("    case {at}: scan{at}(in); break;\n");
    }
    out + "    }\n  }\n  return 0;\n}\n"
}

struct Printer<'p> {
    program: &'p Program,
    at: usize,
    out: String,
    /// Memories of edges so far.
    seen: usize,
    /// Pieces of power so far.
    powers: usize,
}

impl<'p> Printer<'p> {
    fn print(at: usize, program: &'p Program) -> String {
        let mut printer = Printer {
            program,
            at,
            out: String::new(),
            seen: 0,
            powers: 0,
        };
        printer.function("sub_routine", &program.sub);
        printer.function("main_routine", &program.main);
        let functions = std::mem::take(&mut printer.out);
        let mut out = format!("static struct {{\n  num {};\n", names(program).join(", "));
        for it in &program.boxes {
            out += &format!("  struct box {};\n", it.name);
        }
        out += &format!(
            "  int seen[{}];\n}} s{at};\n\n{functions}",
            printer.seen + 1
        );
        out += &format!("static void scan{at}(const int *in) {{\n");
        for (nth, input) in INPUTS.iter().enumerate() {
            out += &format!("  s{at}.{input} = in[{nth}];\n");
        }
        out += &format!("  (void)sub_routine{at};\n  main_routine{at}();\n");
        let shown: Vec<String> = program
            .shown()
            .iter()
            .map(|it| printer.variable(it))
            .collect();
        let form = vec!["%lld"; shown.len()].join(" ");
        let values: Vec<String> = shown.iter().map(|it| format!("(num){it}")).collect();
        out + &format!("  printf(\"{form}\\n\", {});\n}}\n\n", values.join(", "))
    }

    /// A variable as C has it.
    fn variable(&self, name: &str) -> String {
        let member = name.replace(".Q", ".q");
        format!("s{}.{member}", self.at)
    }

    fn function(&mut self, name: &str, rungs: &[Rung]) {
        self.line(&format!("static void {name}{}(void) {{", self.at));
        self.line("  int live = 1;");
        for rung in rungs {
            if let Some(label) = rung.label {
                self.line(&format!("l{label}:;"));
            }
            match &rung.kind {
                RungKind::Plain(condition, outputs) => {
                    self.line("  {");
                    let power = self.power("live", condition);
                    self.outputs(&power, outputs);
                    self.line("  }");
                }
                RungKind::ZoneBegin(condition) => {
                    self.line("  {");
                    let power = self.power("live", condition);
                    self.line(&format!("  live = {power};"));
                    self.line("  }");
                }
                RungKind::ZoneEnd => self.line("  live = 1;"),
            }
        }
        self.line("  (void)live;\n}\n");
    }

    /// The power behind a condition that gets the power `from`.
    fn power(&mut self, from: &str, condition: &Condition) -> String {
        let value = self.value(condition);
        self.new_power(&format!("{from} && {value}"))
    }

    fn new_power(&mut self, value: &str) -> String {
        self.powers += 1;
        let name = format!("p{}", self.powers);
        self.line(&format!("  int {name} = {value};"));
        name
    }

    fn value(&mut self, condition: &Condition) -> String {
        match condition {
            Condition::Constant(value) => u8::from(*value).to_string(),
            Condition::Open(name) => {
                let value = format!("{} != 0", self.variable(name));
                self.new_power(&value)
            }
            Condition::Closed(name) => {
                let value = format!("{} == 0", self.variable(name));
                self.new_power(&value)
            }
            Condition::Edge { is_rising, of } => {
                let value = format!("{} != 0", self.variable(of));
                self.edge(*is_rising, &value)
            }
            Condition::OneShot { is_rising, of } => {
                let value = self.value(of);
                self.edge(*is_rising, &format!("live && {value}"))
            }
            Condition::Compare(left, relation, right) => {
                let sign = match *relation {
                    "=" => "==",
                    "<>" => "!=",
                    other => other,
                };
                let value = format!("{} {sign} {}", self.number(left), self.number(right));
                self.new_power(&value)
            }
            Condition::All(parts) => self.joined(parts, " && "),
            Condition::Any(parts) => self.joined(parts, " || "),
        }
    }

    fn edge(&mut self, is_rising: bool, value: &str) -> String {
        let function = if is_rising { "rose" } else { "fell" };
        let value = format!("{function}(&s{}.seen[{}], {value})", self.at, self.seen);
        self.seen += 1;
        self.new_power(&value)
    }

    fn joined(&mut self, parts: &[Condition], sign: &str) -> String {
        let parts: Vec<String> = parts.iter().map(|part| self.value(part)).collect();
        self.new_power(&parts.join(sign))
    }

    fn number(&self, text: &str) -> String {
        match text.starts_with('n') {
            true => self.variable(text),
            false => format!("{text}LL"),
        }
    }

    fn outputs(&mut self, power: &str, outputs: &[Output]) {
        for output in outputs {
            self.output(power, output);
        }
    }

    fn output(&mut self, power: &str, output: &Output) {
        let at = self.at;
        match output {
            Output::Coil(kind, name) => {
                let target = self.variable(name);
                let line = match kind {
                    Coil::Plain => format!("{target} = {power};"),
                    Coil::Negated => format!("{target} = !{power};"),
                    Coil::Set => format!("if ({power}) {target} = 1;"),
                    Coil::Reset => format!("if ({power}) {target} = 0;"),
                    Coil::Rising => format!("{target} = {};", self.edge(true, power)),
                    Coil::Falling => format!("{target} = {};", self.edge(false, power)),
                };
                self.line(&format!("  {line}"));
            }
            Output::Move(target, term) => {
                let value = match term {
                    Term::Value(value) => self.number(value),
                    Term::Sum(name, sign, number) => {
                        let function = if *sign == "+" { "add" } else { "sub" };
                        format!("{function}({}, {number})", self.variable(name))
                    }
                    Term::Product(name, minus, times) => {
                        format!("mul(sub({}, {minus}), {times})", self.variable(name))
                    }
                };
                let target = self.variable(target);
                self.line(&format!("  if ({power}) {target} = {value};"));
            }
            Output::Box(nth) => {
                let Boxed { name, kind, preset } = &self.program.boxes[*nth];
                self.line(&format!("  {kind}(&s{at}.{name}, {power}, {preset});"));
            }
            Output::Reset(nth) => {
                let name = &self.program.boxes[*nth].name;
                self.line(&format!("  if ({power}) RES(&s{at}.{name});"));
            }
            Output::Jump(label) => self.line(&format!("  if ({power}) goto l{label};")),
            Output::Call => self.line(&format!("  if ({power}) sub_routine{at}();")),
            Output::Return => self.line(&format!("  if ({power}) return;")),
            Output::Leg(condition, outputs) => {
                let power = self.power(power, condition);
                self.outputs(&power, outputs);
            }
        }
    }

    fn line(&mut self, text: &str) {
        self.out += text;
        self.out.push('\n');
    }
}

/// The variables that are no boxes.
fn names(program: &Program) -> Vec<String> {
    let inputs = INPUTS.iter().map(|it| (*it).to_owned());
    let others = program.shown().into_iter().filter(|it| !it.contains('.'));
    inputs.chain(others).collect()
}
