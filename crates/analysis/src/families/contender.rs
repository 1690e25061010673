//! The solvers of a comparison.

use super::Row;
use lcplab_lcp::error::Result;
use lcplab_lcp::number::counted;
use lcplab_solver::{Method, Registry};

/// A solver in a comparison: its methods for boxes, for cones or for both.
#[derive(Debug, Clone)]
pub struct Contender {
    /// Its methods, which share a name.
    pub methods: Vec<Method>,
    /// Whether the user named it: then it has a row with the reason even if it does not support the
    /// problem.
    pub is_named: bool,
}

impl Contender {
    /// The solver that the user named.
    ///
    /// # Errors
    /// If there is none.
    pub fn named(name: &str, solvers: &Registry) -> Result<Self> {
        let own = |method: &&Method| method.name() == name;
        let methods: Vec<Method> = solvers.all().filter(own).cloned().collect();
        match methods.is_empty() {
            true => Err(solvers.unknown(name)),
            false => Ok(Contender { methods, is_named: true }),
        }
    }

    /// Methods that take part in what they are made for, and are not mentioned elsewhere.
    pub fn unnamed(methods: impl IntoIterator<Item = Method>) -> Vec<Self> {
        let one = |method| Contender { methods: vec![method], is_named: false };
        methods.into_iter().map(one).collect()
    }

    /// Its name.
    pub(crate) fn name(&self) -> &str {
        self.methods.first().map_or("", Method::name)
    }
}

/// Why a named solver was of no use in a comparison, a sentence each: it has not solved a single
/// problem that it might have solved.
///
/// A solver that always fails, or that is made for none of the problems, makes no false claim
/// either: a comparison that only counts false claims would pass it.
pub fn useless(rows: &[Row], contenders: &[Contender]) -> Vec<String> {
    let sentence = |contender: &Contender| {
        let name = contender.name();
        let own = || rows.iter().filter(|row| row.solver == name && row.known_failure.is_none());
        let problems: usize = own().map(|row| row.problems).sum();
        if problems == 0 || own().any(|row| row.accepted + row.denied > 0) {
            return None;
        }
        let why = own().find_map(|row| row.trouble.as_deref()).unwrap_or("it claims nothing");
        Some(format!(
            "{name} solves none of {}; reason for the first one: {why}",
            counted(problems, "problem")
        ))
    };
    contenders.iter().filter(|contender| contender.is_named).filter_map(sentence).collect()
}
