//! Rules: a label, a colon, and what the section says.

use logic::notation::{Node, NodeKind, Problem, TokenKind, expression};
use logic::{Expr, Name};

use super::next_scan;
use super::parse::Parser;
use super::spell;
use super::syntax::{Factor, Kind, TransitionRule, Usage};
use super::words::Section;
use crate::{Action, ActionKind, Effect, EnvironmentRule, Property, Situation, Trigger};

/// Reads a rule of `section`, which bears this comment.
pub(crate) fn read(
    parser: &mut Parser<'_>,
    section: Section,
    comment: Option<Name>,
) -> Result<Kind, Problem> {
    let usage = match section {
        Section::Transitions => Usage::Transition,
        Section::Steps => Usage::Step,
        Section::Environment | Section::Never => Usage::DeclaresRule,
    };
    let (name, _) = parser.name(usage, "the label of a rule")?;
    parser.token(TokenKind::Colon)?;
    let kind = match section {
        Section::Transitions => Kind::Transition(TransitionRule {
            name,
            left: left(parser)?,
            to: downstream(parser)?,
            comment,
        }),
        Section::Steps => {
            let condition = condition(parser)?;
            let (kind, output) = effect(parser)?;
            Kind::Action(Action {
                step: name,
                kind,
                output,
                condition,
                comment,
            })
        }
        Section::Environment => {
            let left = condition(parser)?.unwrap_or(Expr::Constant(true));
            Kind::Environment(EnvironmentRule {
                name,
                left,
                right: next_scan::read(parser)?,
                comment,
            })
        }
        Section::Never => Kind::Never(Property {
            name,
            condition: value(parser)?.to_expr(),
            comment,
        }),
    };
    parser.end(match section {
        Section::Transitions => "`*` and another step, or the end of the line",
        _ => "the end of the line",
    })?;
    Ok(kind)
}

/// An expression, its names noted.
fn value(parser: &mut Parser<'_>) -> Result<Node, Problem> {
    let node = expression(&mut parser.lexer)?;
    note(parser, &node);
    Ok(node)
}

/// Notes the names of an expression.
pub(crate) fn note(parser: &mut Parser<'_>, node: &Node) {
    node.each_name(&mut |name, span| parser.mark(name, span, Usage::Value));
}

/// What stands left of `|-`, if anything does.
fn condition(parser: &mut Parser<'_>) -> Result<Option<Expr>, Problem> {
    if parser.lexer.take_if(TokenKind::Yields).is_some() {
        return Ok(None);
    }
    let node = value(parser)?;
    yields(parser)?;
    Ok(Some(node.to_expr()))
}

fn yields(parser: &mut Parser<'_>) -> Result<(), Problem> {
    match parser.lexer.take_if(TokenKind::Yields) {
        Some(_) => Ok(()),
        None => Err(parser.expected("an operator or `|-`")),
    }
}

/// The factors left of `|-`.
fn left(parser: &mut Parser<'_>) -> Result<Vec<Factor>, Problem> {
    if parser.lexer.take_if(TokenKind::Yields).is_some() {
        return Ok(Vec::new());
    }
    let enclosed = Enclosed::before(parser);
    let node = value(parser)?;
    let enclosed = enclosed.after(parser);
    yields(parser)?;
    let factor = |node: &Node| Factor {
        expr: node.to_expr(),
        plain: match &node.kind {
            NodeKind::Variable(name) if !enclosed.contains(node) => Some(name.clone()),
            _ => None,
        },
    };
    Ok(match &node.kind {
        NodeKind::And(parts) if !enclosed.contains(&node) => parts.iter().map(factor).collect(),
        _ => vec![factor(&node)],
    })
}

/// Where opening parentheses stand: a node's span leaves out those around it.
struct Enclosed {
    mark: usize,
    opened_before: Vec<u32>,
}

impl Enclosed {
    /// Remembers the place where the expression starts.
    fn before(parser: &Parser<'_>) -> Self {
        Self {
            mark: parser.lexer.mark(),
            opened_before: Vec::new(),
        }
    }

    /// Collects the places that come right after a parenthesis, ascending.
    fn after(mut self, parser: &mut Parser<'_>) -> Self {
        let end = parser.lexer.mark();
        parser.lexer.rewind(self.mark);
        while parser.lexer.mark() < end {
            let opened = parser.lexer.take_if(TokenKind::Open).is_some();
            if opened {
                self.opened_before.push(parser.lexer.here().start);
            } else if parser.lexer.take().is_none() {
                break;
            }
        }
        self
    }

    fn contains(&self, node: &Node) -> bool {
        self.opened_before.binary_search(&node.span.start).is_ok()
    }
}

/// `@p2*@p3`, or nothing.
fn downstream(parser: &mut Parser<'_>) -> Result<Vec<Name>, Problem> {
    let mut steps = Vec::new();
    if parser.lexer.peek().is_none() {
        return Ok(steps);
    }
    loop {
        if parser.lexer.take_if(TokenKind::At).is_none() {
            return Err(parser.expected("`@` and a step, or the end of the line"));
        }
        steps.push(parser.name(Usage::Step, "the name of a step")?.0);
        if parser.lexer.take_if(TokenKind::Star).is_none() {
            return Ok(steps);
        }
    }
}

/// What an action does, and to what.
fn effect(parser: &mut Parser<'_>) -> Result<(ActionKind, Name), Problem> {
    let is_name = |kind| matches!(kind, Some(TokenKind::Name | TokenKind::Quoted));
    let two_names = is_name(parser.lexer.peek_at(1));
    let effect = match two_names {
        true if parser.word("set") => Some(Effect::Set),
        true if parser.word("reset") => Some(Effect::Reset),
        true if parser.word("force") => return forcing(parser),
        _ => None,
    };
    let (output, _) = parser.name(Usage::Output, "an output, `set`, `reset` or `force`")?;
    if let Some(effect) = effect {
        let on = trigger(parser)?;
        return Ok((ActionKind::Stored { effect, on }, output));
    }
    if parser.lexer.take_if(TokenKind::Assign).is_some() {
        let effect = Effect::Assign(term(parser)?);
        let on = trigger(parser)?;
        return Ok((ActionKind::Stored { effect, on }, output));
    }
    let (mut delay, mut limit) = (None, None);
    loop {
        if delay.is_none() && parser.word("after") {
            delay = Some(time(parser)?);
        } else if limit.is_none() && parser.word("until") {
            limit = Some(time(parser)?);
        } else {
            return Ok((ActionKind::Continuous { delay, limit }, output));
        }
    }
}

fn time(parser: &mut Parser<'_>) -> Result<Name, Problem> {
    let token = parser.lexer.take_if(TokenKind::Time);
    let token = token.ok_or_else(|| parser.expected("a time such as `5s`"))?;
    Ok(token.text(parser.lexer.text()).into())
}

/// `on activation`, `on deactivation`, `on` and an event, or nothing.
fn trigger(parser: &mut Parser<'_>) -> Result<Trigger, Problem> {
    if !parser.word("on") {
        return Ok(Trigger::Activation);
    }
    if parser.lexer.peek_at(1).is_none() {
        if parser.word("activation") {
            return Ok(Trigger::Activation);
        }
        if parser.word("deactivation") {
            return Ok(Trigger::Deactivation);
        }
    }
    Ok(Trigger::Event(value(parser)?.to_expr()))
}

/// The value of an assignment: names and numbers with `+` and `-` between.
fn term(parser: &mut Parser<'_>) -> Result<Name, Problem> {
    let mut text = String::new();
    loop {
        if parser.lexer.take_if(TokenKind::Minus).is_some() {
            text.push('-');
        }
        match parser.lexer.take_if(TokenKind::Number) {
            Some(number) => text.push_str(number.text(parser.lexer.text())),
            None => {
                let (name, _) = parser.name(Usage::Value, "a number or a name")?;
                text.push_str(&spell::name(&name));
            }
        }
        let sign = match parser.lexer.peek_kind() {
            Some(TokenKind::Plus) => " + ",
            Some(TokenKind::Minus) => " - ",
            _ => return Ok(text.into()),
        };
        parser.lexer.take();
        text.push_str(sign);
    }
}

/// `G2{p20, p21}`, `G2{*}`, `G2{INIT}` or `G2{}`.
fn forcing(parser: &mut Parser<'_>) -> Result<(ActionKind, Name), Problem> {
    let (part, _) = parser.name(Usage::Part, "the name of a partial grafcet")?;
    parser.token(TokenKind::OpenBrace)?;
    let closes = |parser: &Parser<'_>| parser.lexer.peek_at(1) == Some(TokenKind::CloseBrace);
    let situation = if parser.lexer.take_if(TokenKind::Star).is_some() {
        Situation::Current
    } else if closes(parser) && parser.word("INIT") {
        Situation::Initial
    } else {
        let mut steps = Vec::new();
        while parser.lexer.peek_kind() != Some(TokenKind::CloseBrace) {
            steps.push(parser.name(Usage::Step, "a step, `*`, `INIT` or `}`")?.0);
            if parser.lexer.take_if(TokenKind::Comma).is_none() {
                break;
            }
        }
        Situation::Steps(steps)
    };
    parser.token(TokenKind::CloseBrace)?;
    Ok((ActionKind::Forcing(situation), part))
}
