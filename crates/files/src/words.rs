//! Splits text into words and keeps their line numbers.

use std::fmt::Display;
use std::str::FromStr;

use lcplab_lcp::error::{Error, Result};

/// The words of a text that are still unread.
#[derive(Clone)]
pub(super) struct Words<'a> {
    input: &'a str,
    lines: std::iter::Enumerate<std::str::Lines<'a>>,
    words: std::str::SplitWhitespace<'a>,
    /// The line of the last word, counted from 1.
    line: usize,
}

impl<'a> Words<'a> {
    /// The words of the text of a file called `input`.
    pub fn new(text: &'a str, input: &'a str) -> Self {
        Words { input, lines: text.lines().enumerate(), words: "".split_whitespace(), line: 0 }
    }

    /// The rest of the line, or the next line if nothing is left.
    pub fn line(&mut self) -> Option<&'a str> {
        let (index, line) = self.lines.next()?;
        (self.line, self.words) = (index + 1, "".split_whitespace());
        Some(line)
    }

    /// The next word.
    pub fn next(&mut self) -> Option<&'a str> {
        loop {
            if let Some(word) = self.words.next() {
                return Some(word);
            }
            self.words = self.line()?.split_whitespace();
        }
    }

    /// Whether no words are left.
    pub fn is_empty(&self) -> bool {
        self.clone().next().is_none()
    }

    /// The number of words left.
    pub fn count(&self) -> usize {
        let mut rest = self.clone();
        std::iter::from_fn(|| rest.next()).count()
    }

    /// The next word as a number; messages refer to it as `what`.
    pub fn number(&mut self, what: impl Display) -> Result<f64> {
        self.parse(what, "a number")
    }

    /// The next `count` numbers.
    pub fn numbers(&mut self, count: usize, what: &str) -> Result<Vec<f64>> {
        let mut numbers = Vec::new();
        for i in 0..count {
            numbers.push(self.number(format_args!("{what}[{i}]"))?);
        }
        Ok(numbers)
    }

    /// The next word as a nonnegative integer.
    pub fn whole(&mut self, what: impl Display) -> Result<usize> {
        self.parse(what, "a whole number")
    }

    /// The next `count` nonnegative integers.
    pub(crate) fn wholes(&mut self, count: usize, what: &str) -> Result<Vec<usize>> {
        let mut numbers = Vec::new();
        for i in 0..count {
            numbers.push(self.whole(format_args!("{what}[{i}]"))?);
        }
        Ok(numbers)
    }

    fn parse<T: FromStr>(&mut self, what: impl Display, kind: &str) -> Result<T> {
        match self.next() {
            None => Err(self.fault(format!("the file ends before {what}"))),
            Some(word) => word
                .parse()
                .map_err(|_| self.fault(format!("{what} must be {kind}, is {:?}", brief(word)))),
        }
    }

    /// An error at the next word.
    pub(crate) fn fault_ahead(&self, reason: impl Into<String>) -> Error {
        let mut ahead = self.clone();
        ahead.next();
        ahead.fault(reason)
    }

    /// An error at the last word.
    pub fn fault(&self, reason: impl Into<String>) -> Error {
        Error::invalid(self.input, format!("line {}", self.line), reason)
    }
}

/// A word for an error message, shortened.
pub(super) fn brief(word: &str) -> String {
    if word.chars().count() <= 40 {
        return word.to_string();
    }
    word.chars().take(37).chain("...".chars()).collect()
}
