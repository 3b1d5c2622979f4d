//! The boxes that the notation knows by name; every other name is a box too,
//! whose effect is not known.

use logic::notation::{Token, TokenKind, milliseconds};
use source::Span;

use super::findings::{Refusal, syntax};
use super::syntax::{Argument, OutputKind, Preset, Term};
use crate::{CounterKind, TimerKind};

/// The box `name(handed)`, written at `whole`. Known names are read in
/// capital or small letters.
pub(super) fn known(
    text: &str,
    name: Token,
    handed: Vec<Argument>,
    whole: Span,
) -> Result<OutputKind, Refusal> {
    let mnemonic = match name.kind {
        TokenKind::Name => name.text(text).to_ascii_uppercase(),
        _ => String::new(),
    };
    let timer = |kind| timer(text, kind, &handed, whole);
    let counter = |kind| counter(text, kind, &handed, whole);
    match mnemonic.as_str() {
        "TON" => timer(TimerKind::OnDelay),
        "TOF" => timer(TimerKind::OffDelay),
        "TP" => timer(TimerKind::Pulse),
        "RTO" => timer(TimerKind::Retentive),
        "CTU" => counter(CounterKind::Up),
        "CTD" => counter(CounterKind::Down),
        "CTC" => counter(CounterKind::Circular),
        "RES" => match handed.as_slice() {
            [
                Argument {
                    pin: None,
                    value: Some(instance),
                },
            ] => Ok(OutputKind::Reset(name_of(instance, RESET)?)),
            _ => Err(syntax(whole, format!("expected {RESET}")).into()),
        },
        "MCR" if handed.is_empty() => Ok(OutputKind::Zone),
        "MCR" => Err(syntax(whole, "expected `MCR()`, which takes nothing").into()),
        _ => Ok(OutputKind::Box(name, handed)),
    }
}

const TIMER: &str = "a timer and its time, as in `TON(t1, 5s)`";
const COUNTER: &str = "a counter and its preset, as in `CTU(c1, 10)`";
const RESET: &str = "a timer or counter, as in `RES(t1)`";

fn timer(
    text: &str,
    kind: TimerKind,
    handed: &[Argument],
    whole: Span,
) -> Result<OutputKind, Refusal> {
    let (instance, preset) = instance_and_preset(handed, whole, TIMER)?;
    let Some(preset) = preset else {
        return Ok(OutputKind::Timer(kind, instance, None));
    };
    match preset.tokens.as_slice() {
        [time] if time.kind == TokenKind::Time => {
            let preset = milliseconds(time.text(text)).map(Preset::Constant);
            Ok(OutputKind::Timer(kind, instance, preset))
        }
        [name] if is_name(name) => {
            let preset = Some(Preset::Variable(*name));
            Ok(OutputKind::Timer(kind, instance, preset))
        }
        _ => Err(syntax(
            preset.span,
            "expected a time such as `5s`, `250ms` or `1m30s`, or the variable that holds it",
        )
        .into()),
    }
}

fn counter(
    text: &str,
    kind: CounterKind,
    handed: &[Argument],
    whole: Span,
) -> Result<OutputKind, Refusal> {
    let (instance, preset) = instance_and_preset(handed, whole, COUNTER)?;
    let Some(preset) = preset else {
        return Ok(OutputKind::Counter(kind, instance, None));
    };
    match preset.tokens.as_slice() {
        [name] if is_name(name) => {
            let preset = Some(Preset::Variable(*name));
            Ok(OutputKind::Counter(kind, instance, preset))
        }
        tokens => match integer(text, tokens) {
            Some(number) => {
                let preset = Some(Preset::Constant(number));
                Ok(OutputKind::Counter(kind, instance, preset))
            }
            None => Err(syntax(
                preset.span,
                "expected a whole number, or the variable that holds it",
            )
            .into()),
        },
    }
}

fn instance_and_preset<'a>(
    handed: &'a [Argument],
    whole: Span,
    form: &str,
) -> Result<(Token, Option<&'a Term>), Refusal> {
    let plain = handed.iter().all(|argument| argument.pin.is_none());
    match handed {
        [
            Argument {
                value: Some(instance),
                ..
            },
            preset @ ..,
        ] if plain && preset.len() <= 1 => {
            let preset = preset.first().and_then(|preset| preset.value.as_ref());
            Ok((name_of(instance, form)?, preset))
        }
        _ => Err(syntax(whole, format!("expected {form}")).into()),
    }
}

fn name_of(term: &Term, form: &str) -> Result<Token, Refusal> {
    match term.tokens.as_slice() {
        [name] if is_name(name) => Ok(*name),
        _ => Err(syntax(term.span, format!("expected {form}")).into()),
    }
}

/// Whether the token writes a name.
pub(super) fn is_name(token: &Token) -> bool {
    matches!(token.kind, TokenKind::Name | TokenKind::Quoted)
}

/// The whole number that the tokens write: `5`, `-5`, `16#FF`, `1_000`.
pub(super) fn integer(text: &str, tokens: &[Token]) -> Option<i64> {
    let (negative, number) = match tokens {
        [number] => (false, number),
        [minus, number] if minus.kind == TokenKind::Minus => (true, number),
        _ => return None,
    };
    if number.kind != TokenKind::Number {
        return None;
    }
    let plain = number.text(text).replace('_', "");
    let (base, digits) = match plain.split_once('#') {
        Some((base, digits)) => (base.parse().ok().filter(|b| (2..=36).contains(b))?, digits),
        None => (10, plain.as_str()),
    };
    // Read with its sign: the smallest number has no positive counterpart.
    let signed = if negative {
        format!("-{digits}")
    } else {
        digits.to_owned()
    };
    i64::from_str_radix(&signed, base).ok()
}
