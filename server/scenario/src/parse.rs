//! The grammar of one line.

use logic::notation::{Lexer, Problem, TokenKind, milliseconds, quoted};
use logic::{Datum, Name, Relation};
use source::Span;

use crate::lines::Line;
use crate::{Change, Expectation, FileName, Passing, Step, Test, Timing};

/// What a line says.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Statement {
    Title(Name),
    Files(Vec<FileName>),
    Timing(Timing),
    /// In milliseconds.
    Cycle(u64),
    Step(Step),
}

impl Statement {
    /// The word that begins a line of the head.
    pub(crate) fn word(&self) -> Option<&'static str> {
        match self {
            Self::Title(_) => Some("scenario"),
            Self::Files(_) => Some("for"),
            Self::Timing(_) => Some("timing"),
            Self::Cycle(_) => Some("cycle"),
            Self::Step(_) => None,
        }
    }
}

/// Words of the notation. A variable that is called so is written in quotes.
pub const WORDS: [&str; 9] = [
    "cycle", "for", "off", "on", "only", "scan", "scenario", "timing", "wait",
];

/// A name as scenarios write it.
pub fn spelled(name: &str) -> String {
    match WORDS.contains(&name) {
        true => format!("\"{name}\""),
        false => quoted(name),
    }
}

/// Reads a line that has tokens.
pub(crate) fn statement(text: &str, line: &Line) -> Result<Statement, Problem> {
    let mut parser = Parser {
        lexer: Lexer::over(text, line.tokens.clone()),
    };
    let statement = parser.statement(line)?;
    match parser.lexer.peek() {
        None => Ok(statement),
        Some(_) => Err(parser.expected(match statement {
            Statement::Step(_) => "`,`, `=>` or the end of the line",
            _ => "the end of the line",
        })),
    }
}

struct Parser<'t> {
    lexer: Lexer<'t>,
}

impl Parser<'_> {
    fn statement(&mut self, line: &Line) -> Result<Statement, Problem> {
        Ok(if self.word("scenario") {
            Statement::Title(self.name("the title, in double quotes")?.0)
        } else if self.word("for") {
            Statement::Files(self.files()?)
        } else if self.word("timing") {
            Statement::Timing(self.timing()?)
        } else if self.word("cycle") {
            let (time, span) = self.time("a time such as `10ms`")?;
            if time == 0 {
                let message = "a cycle takes some time, at least 1ms".to_owned();
                return Err(Problem { span, message });
            }
            Statement::Cycle(time)
        } else {
            Statement::Step(self.step(line)?)
        })
    }

    fn files(&mut self) -> Result<Vec<FileName>, Problem> {
        let mut files = Vec::new();
        loop {
            let (path, span) = self.name("the name of a file")?;
            files.push(FileName { path, span });
            if self.lexer.take_if(TokenKind::Comma).is_none() {
                return Ok(files);
            }
        }
    }

    fn timing(&mut self) -> Result<Timing, Problem> {
        if self.word("scan") {
            Ok(Timing::Scan)
        } else if self.word("settled") {
            Ok(Timing::Settled)
        } else {
            Err(self.expected("`scan` or `settled`"))
        }
    }

    fn step(&mut self, line: &Line) -> Result<Step, Problem> {
        let mut step = Step {
            span: line.statement_span(),
            ..Step::default()
        };
        let mut passes = false;
        loop {
            match self.passing()? {
                Some((_, span)) if passes => {
                    let message = "a step has one `wait` or `scan`; begin another line".to_owned();
                    return Err(Problem { span, message });
                }
                Some((passing, _)) => {
                    passes = true;
                    step.passing = passing;
                }
                None => step.changes.push(self.change()?),
            }
            if self.lexer.take_if(TokenKind::Comma).is_none() {
                break;
            }
        }
        if self.lexer.take_if(TokenKind::DoubleArrow).is_some() {
            step.only = self.word("only");
            while self.lexer.peek().is_some() {
                step.expected.push(self.expectation()?);
                if self.lexer.take_if(TokenKind::Comma).is_none() {
                    break;
                }
            }
        }
        Ok(step)
    }

    /// `wait 5s`, `scan` or `scan 3`, if one stands next.
    fn passing(&mut self) -> Result<Option<(Passing, Span)>, Problem> {
        let start = self.lexer.here();
        let passing = if self.word("wait") {
            Passing::Wait(self.time("a time such as `5s`")?.0)
        } else if self.word("scan") {
            match self.lexer.take_if(TokenKind::Number) {
                None => Passing::Scans(1),
                Some(number) => {
                    let number: Option<u32> = number.text(self.lexer.text()).parse().ok();
                    let scans = number.filter(|number| *number > 0);
                    Passing::Scans(scans.ok_or_else(|| Problem {
                        span: self.lexer.previous().map_or(start, |token| token.span),
                        message: "expected a number of scans, at least 1".to_owned(),
                    })?)
                }
            }
        } else {
            return Ok(None);
        };
        let span = self.lexer.since(start.range().start);
        Ok(Some((passing, span)))
    }

    fn change(&mut self) -> Result<Change, Problem> {
        if let Some(is_on) = self.on_or_off() {
            let (name, span) = self.name("the name of an input")?;
            let value = is_on.into();
            return Ok(Change { name, value, span });
        }
        let (name, span) = self.name("`on`, `off`, `wait`, `scan` or the name of an input")?;
        let sign = self.lexer.take_if(TokenKind::Equal);
        if sign.is_none() {
            return Err(self.expected("`=` and a value"));
        }
        let value = self.value()?;
        Ok(Change { name, value, span })
    }

    fn expectation(&mut self) -> Result<Expectation, Problem> {
        let start = self.lexer.here().range().start;
        let (name, named, test) = match self.on_or_off() {
            Some(is_on) => {
                let (name, named) = self.name("the name of an output")?;
                (name, named, if is_on { Test::On } else { Test::Off })
            }
            None => {
                let (name, named) = self.name("`on`, `off` or the name of an output")?;
                let relation = self.relation()?;
                (name, named, Test::Compares(relation, self.value()?))
            }
        };
        let span = self.lexer.since(start);
        Ok(Expectation {
            name,
            test,
            span,
            named,
        })
    }

    fn relation(&mut self) -> Result<Relation, Problem> {
        let relation = match self.lexer.peek_kind() {
            Some(TokenKind::Equal) => Relation::Equal,
            Some(TokenKind::NotEqual) => Relation::NotEqual,
            Some(TokenKind::Less) => Relation::Less,
            Some(TokenKind::LessOrEqual) => Relation::LessOrEqual,
            Some(TokenKind::Greater) => Relation::Greater,
            Some(TokenKind::GreaterOrEqual) => Relation::GreaterOrEqual,
            _ => return Err(self.expected("`=` or another relation, and a value")),
        };
        self.lexer.take();
        Ok(relation)
    }

    /// A number, or a time, which counts milliseconds.
    fn value(&mut self) -> Result<Datum, Problem> {
        let start = self.lexer.mark();
        let is_negative = self.lexer.take_if(TokenKind::Minus).is_some();
        let text = self.lexer.text();
        let value = match self.lexer.peek() {
            Some(token) if matches!(token.kind, TokenKind::Number | TokenKind::Time) => {
                let sign = if is_negative { "-" } else { "" };
                Datum::constant(&format!("{sign}{}", token.text(text)))
            }
            _ => None,
        };
        match value {
            Some(value) => {
                self.lexer.take();
                Ok(value)
            }
            None => {
                self.lexer.rewind(start);
                Err(self.expected("a number"))
            }
        }
    }

    fn time(&mut self, what: &str) -> Result<(u64, Span), Problem> {
        let text = self.lexer.text();
        let token = self.lexer.peek();
        let time = token
            .filter(|token| token.kind == TokenKind::Time)
            .and_then(|token| Some((milliseconds(token.text(text))?, token.span)));
        let time = time.ok_or_else(|| self.expected(what))?;
        self.lexer.take();
        Ok(time)
    }

    fn on_or_off(&mut self) -> Option<bool> {
        if self.word("on") {
            Some(true)
        } else {
            self.word("off").then_some(false)
        }
    }

    /// Takes a word, unless it is the name of a variable: then a relation
    /// follows.
    fn word(&mut self, word: &str) -> bool {
        let is_word = self.lexer.peek().is_some_and(|token| {
            token.kind == TokenKind::Name && token.text(self.lexer.text()) == word
        });
        let is_name = matches!(
            self.lexer.peek_at(1),
            Some(
                TokenKind::Equal
                    | TokenKind::NotEqual
                    | TokenKind::Less
                    | TokenKind::LessOrEqual
                    | TokenKind::Greater
                    | TokenKind::GreaterOrEqual
            )
        );
        let found = is_word && !is_name;
        if found {
            self.lexer.take();
        }
        found
    }

    fn name(&mut self, what: &str) -> Result<(Name, Span), Problem> {
        match self.lexer.peek() {
            Some(token) if matches!(token.kind, TokenKind::Name | TokenKind::Quoted) => {
                self.lexer.take();
                Ok((token.name(self.lexer.text()).into(), token.span))
            }
            _ => Err(self.expected(what)),
        }
    }

    fn expected(&self, what: &str) -> Problem {
        Problem {
            span: self.lexer.here(),
            message: format!("expected {what}, found {}", self.lexer.found()),
        }
    }
}
