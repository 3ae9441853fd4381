//! Expressions of named numbers, such as `speed * (inside + outside)`.
//!
//! They are parsed here and not by `exmex` 0.20, which takes `-x ^ 2` for `(-x) ^ 2` and does not read `1.5e-1`.

use std::collections::BTreeMap;

use anyhow::{Context, Result, bail, ensure};

/// Names and their values.
pub(super) type Row = BTreeMap<String, f64>;

/// Names and what they stand for.
pub(super) type Definitions = BTreeMap<String, String>;

/// An expression: numbers, names, `+ - * / ^`, comparisons (1 or 0), `&`, `|`, and the functions of [`FUNCTIONS`].
#[derive(Debug, Clone)]
pub(super) enum Expression {
    Number(f64),
    Name(String),
    Function(Function, Box<Expression>),
    Pair(Operator, Box<[Expression; 2]>),
}

type Function = fn(f64) -> f64;
type Operator = fn(f64, f64) -> f64;

const FUNCTIONS: [(&str, Function); 5] =
    [("abs", f64::abs), ("sqrt", f64::sqrt), ("exp", f64::exp), ("ln", f64::ln), ("cos", f64::cos)];

/// Operators with their precedence, those with more characters first.
const OPERATORS: [(&str, u8, Operator); 13] = [
    ("==", 3, |a, b| f64::from((a - b).abs() <= 1e-9 * a.abs().max(b.abs()))),
    ("!=", 3, |a, b| f64::from((a - b).abs() > 1e-9 * a.abs().max(b.abs()))),
    ("<=", 3, |a, b| f64::from(a <= b)),
    (">=", 3, |a, b| f64::from(a >= b)),
    ("<", 3, |a, b| f64::from(a < b)),
    (">", 3, |a, b| f64::from(a > b)),
    ("|", 1, |a, b| f64::from(a != 0.0 || b != 0.0)),
    ("&", 2, |a, b| f64::from(a != 0.0 && b != 0.0)),
    ("+", 4, |a, b| a + b),
    ("-", 4, |a, b| a - b),
    ("*", 5, |a, b| a * b),
    ("/", 5, |a, b| a / b),
    ("^", 6, f64::powf),
];
const POWER: u8 = 6;
/// How often a definition may lead to another.
const DEPTH: usize = 20;

impl Expression {
    /// The expression of a text, with the names that are defined replaced by what they stand for.
    ///
    /// # Errors
    /// A text that is none, definitions that lead to each other.
    pub(super) fn parse(text: &str, definitions: &Definitions) -> Result<Self> {
        Self::resolved(text, definitions, DEPTH)
    }

    fn resolved(text: &str, definitions: &Definitions, depth: usize) -> Result<Self> {
        ensure!(depth > 0, "{text}: definitions that go in a circle");
        let mut parser = Parser { rest: text.trim_start(), definitions, depth };
        let parse = |parser: &mut Parser<'_>| {
            let found = parser.chain(0)?;
            ensure!(parser.rest.is_empty(), "'{}' is left over", parser.rest);
            Ok(found)
        };
        parse(&mut parser).with_context(|| format!("expression '{text}'"))
    }

    /// Its value; not a number where a name has no value.
    pub(super) fn value(&self, row: &Row) -> f64 {
        match self {
            Self::Number(number) => *number,
            Self::Name(name) => row.get(name).copied().unwrap_or(f64::NAN),
            Self::Function(f, of) => f(of.value(row)),
            Self::Pair(f, of) => f(of[0].value(row), of[1].value(row)),
        }
    }

    /// The names that it has.
    pub(super) fn names(&self) -> Vec<&str> {
        match self {
            Self::Number(_) => Vec::new(),
            Self::Name(name) => vec![name],
            Self::Function(_, of) => of.names(),
            Self::Pair(_, of) => [of[0].names(), of[1].names()].concat(),
        }
    }
}

struct Parser<'a> {
    rest: &'a str,
    definitions: &'a Definitions,
    depth: usize,
}

impl Parser<'_> {
    fn skip(&mut self, bytes: usize) {
        self.rest = self.rest[bytes..].trim_start();
    }

    /// Operands joined by operators of at least this precedence.
    fn chain(&mut self, least: u8) -> Result<Expression> {
        let mut left = self.operand()?;
        while let Some((sign, precedence, f)) = OPERATORS.iter().find(|(sign, ..)| self.rest.starts_with(sign)) {
            if *precedence < least {
                break;
            }
            self.skip(sign.len());
            left = Expression::Pair(*f, Box::new([left, self.chain(precedence + 1)?]));
        }
        Ok(left)
    }

    fn operand(&mut self) -> Result<Expression> {
        if let Some(inner) = self.rest.strip_prefix('(') {
            self.rest = inner.trim_start();
            let found = self.chain(0)?;
            ensure!(self.rest.starts_with(')'), "')' is missing");
            self.skip(1);
            return Ok(found);
        }
        if self.rest.starts_with('-') {
            self.skip(1);
            return Ok(Expression::Pair(|a, b| a * b, Box::new([Expression::Number(-1.0), self.chain(POWER)?])));
        }
        let end = |others: &[char]| {
            let part = |c: char| c.is_alphanumeric() || c == '_' || others.contains(&c);
            self.rest.find(|c| !part(c)).unwrap_or(self.rest.len())
        };
        let word = self.rest[..end(&[])].to_owned();
        if self.rest.starts_with(|c: char| c.is_ascii_digit()) {
            let mut length = end(&['.']);
            // The sign of an exponent.
            if self.rest[..length].ends_with('e') && self.rest[length..].starts_with(['-', '+']) {
                length += 1 + self.rest[length + 1..]
                    .find(|c: char| !c.is_ascii_digit())
                    .unwrap_or(self.rest.len() - length - 1);
            }
            let number = self.rest[..length].parse().with_context(|| format!("'{}'", &self.rest[..length]))?;
            self.skip(length);
            return Ok(Expression::Number(number));
        }
        ensure!(!word.is_empty(), "a number, a name or '(' is missing before '{}'", self.rest);
        self.skip(word.len());
        if self.rest.starts_with('(') {
            let Some((_, f)) = FUNCTIONS.iter().find(|(name, _)| *name == word) else {
                bail!("there is no function {word}: give {}", FUNCTIONS.map(|(name, _)| name).join(", "))
            };
            return Ok(Expression::Function(*f, Box::new(self.operand()?)));
        }
        match self.definitions.get(&word) {
            Some(text) => Expression::resolved(text, self.definitions, self.depth - 1),
            None => Ok(Expression::Name(word)),
        }
    }
}

#[cfg(test)]
mod tests;
