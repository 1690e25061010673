//! Reads the problems of Siconos' files; every number in a file must be understood.

use super::kind::{self, Kind};
use super::{cones, generic, matrix, mixed};
use crate::Input;
use crate::contacts::{coulomb, law};
use crate::delassus::Motion;
use crate::table::Table;
use crate::words::{Words, brief};
use lcplab_lcp::error::{Error, Result};
use lcplab_lcp::file::{Parts, Problem};
use lcplab_lcp::friction::Model;
use lcplab_lcp::memory::Memory;

pub(super) fn read(input: &Input) -> Result<Problem> {
    let (text, name) = (input.text()?, input.name());
    let (numbers, comment) = split(&text);
    let mut words = Words::new(numbers, &name);
    if words.is_empty() {
        return Err(Error::invalid(name, "file", "has no numbers"));
    }
    let dimension = words.clone().next().and_then(|word| word.parse().ok()).unwrap_or_default();
    let kind = kind::kind(&words)?;
    let mut answer = 0;
    let (parts, end) = match kind {
        Kind::Boxes => (boxes(&mut words, &name)?, "an LCP or a relay problem"),
        Kind::Mixed => {
            let (parts, count) = mixed::read(&mut words, &name)?;
            answer = count;
            (parts, "a mixed LCP (MLCP)")
        }
        Kind::Contacts => (contacts(&mut words, &name, input.most())?, "contacts, behind mu"),
        Kind::Cones => (cones::read(&mut words, &name)?, "a problem over second-order cones"),
        Kind::Generic => (generic::read(&mut words, &name)?, "a generic mechanical problem (GMP)"),
    };
    if !words.is_empty() {
        let reason = format!("not understood: {} numbers after {end}", words.count());
        return Err(words.fault_ahead(reason));
    }
    let lcp = parts.into_lcp().map_err(|error| error.within(&name))?;
    let model = match kind {
        Kind::Cones => lcp.coupling().map(|_| Model::AssociatedCone),
        Kind::Generic => law(&lcp, 3),
        Kind::Boxes | Kind::Mixed | Kind::Contacts => law(&lcp, dimension),
    };
    let mut problem = Problem { model, ..Problem::new(input.stem(), lcp) };
    problem.warnings = comment_found(numbers, comment, &name).into_iter().collect();
    if answer > 0 {
        let what = format!("the last {answer} numbers, a known answer");
        problem.warnings.push(format!("{name}: not part of the problem: {what}"));
    }
    Ok(problem)
}

/// The text with the numbers, and the lines of text after it.
fn split(text: &str) -> (&str, &str) {
    let mut end = text.len();
    for line in text.split_inclusive('\n').rev() {
        if !line.trim().is_empty() && !is_comment(line) {
            break;
        }
        end -= line.len();
    }
    text.split_at(end)
}

/// Whether a line starts with a word and has more words than numbers; a name followed by numbers is
/// data.
fn is_comment(line: &str) -> bool {
    let is_number = |word: &str| word.parse::<f64>().is_ok();
    let count = line.split_whitespace().count();
    let numbers = line.split_whitespace().filter(|word| is_number(word)).count();
    line.split_whitespace().next().is_some_and(|first| !is_number(first)) && count > 2 * numbers
}

/// The warning about a comment.
fn comment_found(numbers: &str, comment: &str, input: &str) -> Option<String> {
    let lines = comment.lines().enumerate();
    let (k, text) = lines.map(|(k, line)| (k, line.trim())).find(|(_, line)| !line.is_empty())?;
    let line = numbers.lines().count() + k + 1;
    Some(format!("{input}: line {line}: text taken as a comment: {:?}", brief(text)))
}

/// An LCP, or a relay problem if lb and ub follow.
fn boxes(words: &mut Words, input: &str) -> Result<Parts> {
    let n = words.whole("the number of rows")?;
    let entries = matrix::read(words, "M")?.square(n, input)?;
    let b = words.numbers(n, "q")?;
    let (mut lo, mut hi, left) = (None, None, words.count());
    if left > 0 && Some(left) == n.checked_mul(2) {
        lo = Some(words.numbers(n, "lb")?);
        hi = Some(words.numbers(n, "ub")?);
    } else if left > 0 {
        return Err(words.fault_ahead(format!(
            "not understood: {left} numbers after q, with which an LCP ends; in a relay problem of \
             {n} rows {n} of lb and {n} of ub follow"
        )));
    }
    Ok(Parts { entries, b, lo, hi, index: None, mu: None })
}

/// Contacts: without their bodies, or with them if a second matrix follows.
fn contacts(words: &mut Words, input: &str, most: Memory) -> Result<Parts> {
    let dimension = words.whole("the dimension")?;
    let contacts = words.whole("the number of contacts")?;
    let Some(n) = contacts.checked_mul(dimension) else {
        return Err(words.fault(format!("{contacts} contacts are more than can be counted")));
    };
    let first = matrix::read(words, "M")?;
    let left = words.count();
    let is_local =
        [first.rows, first.cols] == [n, n] && (left == n + contacts || left == n + contacts + 1);
    let parts = match matrix::size_ahead(words, 0) {
        Some(size) if !is_local && size == [first.rows, n] => {
            global(words, first, [dimension, contacts], input, most)?
        }
        _ => local(words, first, [dimension, contacts], input)?,
    };
    flag(words, contacts)?;
    Ok(parts)
}

/// q and mu, after M.
fn local(
    words: &mut Words,
    matrix: Table,
    [dimension, contacts]: [usize; 2],
    input: &str,
) -> Result<Parts> {
    let n = dimension * contacts;
    if [matrix.rows, matrix.cols] != [n, n] {
        let reason = format!("{contacts} contacts have not {} rows", matrix.rows);
        return Err(words.fault(reason));
    }
    let b = words.numbers(n, "q")?;
    let mu = words.numbers(contacts, "mu")?;
    Ok(coulomb(matrix.square(n, input)?, b, &mu, dimension))
}

/// H, q, b and mu, after M: converted to the problem in impulses only.
fn global(
    words: &mut Words,
    mass: Table,
    [dimension, contacts]: [usize; 2],
    input: &str,
    most: Memory,
) -> Result<Parts> {
    let (k, n) = (mass.rows, dimension * contacts);
    if mass.cols != k {
        return Err(
            words.fault(format!("M is {k} × {}: the matrix of bodies is square", mass.cols))
        );
    }
    let columns = matrix::read(words, "H")?;
    let force = words.numbers(k, "q")?;
    let bias = words.numbers(n, "b")?;
    let mu = words.numbers(contacts, "mu")?;
    let mut jacobian = vec![Vec::new(); n];
    for (i, row, value) in columns.triplets() {
        jacobian[row].push((i, value));
    }
    let motion = Motion { mass: mass.triplets(), jacobian, force };
    let (entries, free) = motion.dual(&vec![0.0; n], "M", input, most)?;
    let b = free.iter().zip(&bias).map(|(free, bias)| free + bias).collect();
    Ok(coulomb(entries, b, &mu, dimension))
}

/// The number 0 or 1 after mu at the end of many of Siconos' own files; Siconos does not read it.
pub(super) fn flag(words: &mut Words, contacts: usize) -> Result<()> {
    let left = words.count();
    let is_flag = || matches!(words.clone().next(), Some("0" | "1"));
    if left == 1 && is_flag() {
        words.next();
    } else if left > 0 && left == contacts {
        return Err(words.fault_ahead(format!(
            "not understood: {left} numbers after mu; this seems to be contacts with rolling friction \
             in the plane, where mu_r follows, or plasticity with eta and theta, which are not read"
        )));
    }
    Ok(())
}
