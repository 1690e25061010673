//! A quadratic program as its sections are read.

use std::collections::{HashMap, HashSet};

use super::constraints::Constraints;
use crate::multipliers::{Multipliers, label, limit};
use crate::words::brief;
use lcplab_lcp::error::{Error, Result};
use lcplab_lcp::file::{Entries, Parts, Problem};

/// A result whose error is the reason that a line is invalid.
pub(super) type Checked<T = ()> = std::result::Result<T, String>;

/// The program read so far.
#[derive(Default)]
pub(super) struct Program {
    name: String,
    objective: Option<String>,
    constraints: Constraints,
    /// The names of the right-hand side and of the ranges in use.
    sets: HashMap<&'static str, String>,
    columns: HashMap<String, usize>,
    /// The cost of each column, if given.
    c: Vec<Option<f64>>,
    lo: Vec<f64>,
    hi: Vec<f64>,
    /// Columns with an explicit lower bound.
    has_lower: HashSet<usize>,
    /// The name of the bound set in use.
    bounds: Option<String>,
    q: Vec<(usize, usize, f64)>,
    /// The positions of Q's entries read so far.
    places: HashSet<(usize, usize)>,
    is_full: bool,
}

impl Program {
    /// A program without rows; its file may rename it.
    pub fn new(name: String) -> Self {
        Program { name, ..Program::default() }
    }

    /// Reads a line that starts a section; returns true for the last one.
    pub fn section(&mut self, fields: &[&str]) -> Checked<bool> {
        match fields {
            ["ENDATA"] => return Ok(true),
            ["NAME", name @ ..] if !name.is_empty() => self.name = name.join(" "),
            ["NAME" | "ROWS" | "COLUMNS" | "RHS" | "RANGES" | "BOUNDS" | "OBJSENSE"] => {}
            ["OBJSENSE", _] => {}
            ["QUADOBJ" | "QMATRIX"] if !self.q.is_empty() => {
                return Err("Q has been given already".into());
            }
            ["QUADOBJ"] => self.is_full = false,
            ["QMATRIX"] => self.is_full = true,
            _ => return Err(format!("there is no section {:?}", brief(&fields.join(" ")))),
        }
        match fields {
            ["OBJSENSE", sense] => minimised(sense).map(|()| false),
            _ => Ok(false),
        }
    }

    pub fn data(&mut self, section: &str, fields: &[&str]) -> Checked {
        match (section, fields) {
            ("OBJSENSE", [sense]) => minimised(sense),
            ("ROWS", [kind, name]) => self.row(kind, name),
            ("COLUMNS", [_, marker, _]) if marker.contains("MARKER") => {
                Err("integers are not read".into())
            }
            ("COLUMNS", [column, entries @ ..]) if !entries.is_empty() => {
                let i = self.column(column);
                for (row, value) in pairs(entries)? {
                    if !self.is_objective(row) {
                        self.constraints.entry(row, i, value)?;
                    } else if self.c[i].replace(value).is_some() {
                        return Err(format!("a second cost of {:?}", brief(column)));
                    }
                }
                Ok(())
            }
            ("RHS", entries) => {
                for (row, value) in self.of_one_set("RHS", entries)? {
                    // The objective's is minus its constant.
                    if !self.is_objective(row) {
                        self.constraints.rhs(row, value)?;
                    }
                }
                Ok(())
            }
            ("RANGES", entries) => {
                for (row, value) in self.of_one_set("RANGES", entries)? {
                    self.constraints.range(row, value)?;
                }
                Ok(())
            }
            ("BOUNDS", [kind, rest @ ..]) => self.bound(kind, rest),
            ("QUADOBJ" | "QMATRIX", [column, entries @ ..]) if !entries.is_empty() => {
                let i = self.known(column)?;
                for (other, value) in pairs(entries)? {
                    let j = self.known(other)?;
                    self.quadratic(i, j, value)?;
                }
                Ok(())
            }
            ("", _) => Err("is before the first section".into()),
            _ => Err(format!("is not a line of {section}: {:?}", brief(&fields.join(" ")))),
        }
    }

    fn row(&mut self, kind: &str, name: &str) -> Checked {
        if !kind.eq_ignore_ascii_case("N") {
            return self.constraints.add(kind, name);
        }
        match self.objective.replace(name.to_string()) {
            None => Ok(()),
            Some(_) => Err("there are two objectives".into()),
        }
    }

    fn is_objective(&self, row: &str) -> bool {
        self.objective.as_deref() == Some(row)
    }

    /// The pairs of a line that may start with the name of its set, of which there is only one.
    fn of_one_set<'a>(
        &mut self,
        section: &'static str,
        fields: &[&'a str],
    ) -> Checked<Vec<(&'a str, f64)>> {
        let (name, entries) = fields.split_at(fields.len() % 2);
        let name = name.first().copied().unwrap_or_default();
        if self.sets.entry(section).or_insert_with(|| name.to_string()) != name {
            return Err(format!("a second set of {section}, {:?}", brief(name)));
        }
        pairs(entries)
    }

    /// The index of a column; a new name gets the next index.
    fn column(&mut self, name: &str) -> usize {
        if let Some(i) = self.columns.get(name) {
            return *i;
        }
        self.columns.insert(name.to_string(), self.c.len());
        self.c.push(None);
        self.lo.push(0.0);
        self.hi.push(f64::INFINITY);
        self.c.len() - 1
    }

    fn known(&self, column: &str) -> Checked<usize> {
        let i = self.columns.get(column).copied();
        i.ok_or_else(|| format!("there is no column {:?}", brief(column)))
    }

    fn bound(&mut self, kind: &str, rest: &[&str]) -> Checked {
        let (set, column, value) = match (kind, rest) {
            ("UP" | "LO" | "FX", [column, value]) => ("", column, number(value)?),
            ("UP" | "LO" | "FX", [set, column, value]) => (*set, column, number(value)?),
            ("FR" | "MI" | "PL", [column]) => ("", column, 0.0),
            ("FR" | "MI" | "PL", [set, column] | [set, column, _]) => (*set, column, 0.0),
            ("BV" | "LI" | "UI" | "SC", _) => return Err("integers are not read".into()),
            _ => return Err(format!("is not a bound: {:?}", brief(kind))),
        };
        if self.bounds.get_or_insert_with(|| set.to_string()) != set {
            return Err(format!("a second set of bounds, {:?}", brief(set)));
        }
        let i = self.known(column)?;
        let value = limit(value);
        if matches!(kind, "LO" | "FX" | "MI" | "FR") {
            self.lo[i] = if matches!(kind, "MI" | "FR") { -f64::INFINITY } else { value };
            self.has_lower.insert(i);
        }
        if matches!(kind, "UP" | "FX") {
            self.hi[i] = value;
        }
        if matches!(kind, "PL" | "FR") {
            self.hi[i] = f64::INFINITY;
        }
        Ok(())
    }

    fn quadratic(&mut self, i: usize, j: usize, value: f64) -> Checked {
        let place = if self.is_full { (i, j) } else { (i.min(j), i.max(j)) };
        if !self.places.insert(place) {
            return Err("this entry of Q was there already, perhaps in the other triangle".into());
        }
        self.q.push((i, j, value));
        if !self.is_full && i != j {
            self.q.push((j, i, value));
        }
        Ok(())
    }

    /// The problem, after the last line.
    pub fn finish(self, input: &str) -> Result<Problem> {
        let fault = |place: String, reason: &str| Err(Error::invalid(input, place, reason));
        let below = |i: &usize| self.hi[*i] < 0.0 && !self.has_lower.contains(i);
        if let Some(i) = (0..self.c.len()).find(below) {
            let reason = "has an upper bound below 0 and no lower one, which readers understand in \
                          two ways: give it LO or MI";
            return fault(format!("column {i} (from 0)"), reason);
        }
        if self.is_full {
            let entries: HashMap<_, _> = self.q.iter().map(|(i, j, v)| ((*i, *j), *v)).collect();
            let differs = |(i, j, v): &&(usize, usize, f64)| {
                entries.get(&(*j, *i)).copied().unwrap_or(0.0) != *v
            };
            if let Some((i, j, _)) = self.q.iter().find(differs) {
                return fault(format!("Q[{i}][{j}]"), "is not that of the other triangle");
            }
        }
        let added = Multipliers::of(&self.constraints.rows(), self.c.len());
        let costs: Vec<f64> = self.c.iter().map(|cost| cost.unwrap_or_default()).collect();
        let parts = Parts {
            entries: Entries::Sparse([self.q, added.entries].concat()),
            b: [costs, added.b].concat(),
            lo: Some([self.lo, added.lo].concat()),
            hi: Some([self.hi, added.hi].concat()),
            index: None,
            mu: None,
        };
        let lcp = parts.into_lcp().map_err(|error| error.within(input))?;
        let mut problem = Problem::new(self.name, lcp);
        problem.extra.insert("objective".into(), true.into());
        if !self.constraints.is_empty() {
            let mut columns: Vec<(String, usize)> = self.columns.into_iter().collect();
            columns.sort_by_key(|(_, column)| *column);
            let columns = columns.iter().map(|(name, _)| label(name, "column"));
            let labels = columns.chain(added.labels).collect();
            problem.extra.insert("rows".into(), labels);
        }
        Ok(problem)
    }
}

fn minimised(sense: &str) -> Checked {
    match sense.to_ascii_uppercase().as_str() {
        "MIN" | "MINIMIZE" | "MINIMISE" => Ok(()),
        _ => Err(format!("{:?} is not read: only MIN", brief(sense))),
    }
}

/// Pairs of a name and a number.
fn pairs<'a>(fields: &[&'a str]) -> Checked<Vec<(&'a str, f64)>> {
    if fields.len() % 2 == 1 {
        return Err(format!("must be names with a number each: {:?}", brief(&fields.join(" "))));
    }
    fields.chunks_exact(2).map(|pair| Ok((pair[0], number(pair[1])?))).collect()
}

fn number(word: &str) -> Checked<f64> {
    match word.parse::<f64>() {
        Ok(value) if !value.is_nan() => Ok(value),
        _ => Err(format!("must be a number, is {:?}", brief(word))),
    }
}
