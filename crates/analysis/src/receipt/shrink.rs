//! Shrinks a rejected step: fewer rows that show the same error.

use std::cmp::Ordering;

use super::definite::first_not_definite;
use super::{EngineStep, Expected, FrictionRows, Receipt};

/// The number of smaller steps that are tried.
const MOST_TRIED: usize = 200;

impl Receipt {
    /// A step with fewer rows and at least half of the error, which is rejected at the same stage;
    /// `None` if there is none.
    ///
    /// The forces of the removed rows become a part of the motion without constraints. Errors of
    /// collision, and of assembly unless an adapter's expected values show them, are those of the
    /// model and the state: their steps are not shrunk.
    pub fn shrunk(&self) -> Option<EngineStep> {
        if first_not_definite(&self.step).is_some() || !self.shows(&self.step) {
            return None;
        }
        let found = fewest_rows(&self.step, |step| self.shows(step));
        (found.len() < self.step.len()).then_some(found)
    }

    /// Whether a step is rejected at the same stage, with at least half of the error.
    fn shows(&self, step: &EngineStep) -> bool {
        let Some(error) = self.rejected().map(|finding| finding.error * self.effect) else {
            return false;
        };
        let Ok(own) = Receipt::new(step.clone(), None, Some(self.limit)) else { return false };
        let is_large = |own: f64| own.partial_cmp(&(error / 2.0)) != Some(Ordering::Less);
        own.stage() == self.stage()
            && own.rejected().is_some_and(|finding| is_large(finding.error * own.effect))
    }
}

/// The step with as few rows as this search finds that still shows it: halves, quarters and so on
/// are removed. The rows of a contact are removed together.
fn fewest_rows(step: &EngineStep, shows_it: impl Fn(&EngineStep) -> bool) -> EngineStep {
    let index = &step.friction.index;
    let group = |row: usize| index[row].unwrap_or(row);
    let mut groups: Vec<usize> = (0..step.len()).filter(|&row| index[row].is_none()).collect();
    let rest_of =
        |groups: &[usize]| without(step, |row| groups.binary_search(&group(row)).is_err());
    let (mut tried, mut size) = (0, (groups.len() / 2).max(1));
    loop {
        let mut start = 0;
        let mut has_shrunk = false;
        while start < groups.len() && tried < MOST_TRIED {
            let end = (start + size).min(groups.len());
            let rest = [&groups[..start], &groups[end..]].concat();
            start = end;
            if rest.is_empty() {
                continue;
            }
            tried += 1;
            if shows_it(&rest_of(&rest)) {
                (groups, has_shrunk) = (rest, true);
                break;
            }
        }
        match has_shrunk {
            true => continue,
            false if size == 1 => return rest_of(&groups),
            false => size /= 2,
        }
    }
}

/// The step without some rows, whose forces become a part of the motion without constraints: motion
/// and forces of the other rows stay as they are, and obey or violate their laws as before.
fn without(step: &EngineStep, is_removed: impl Fn(usize) -> bool) -> EngineStep {
    let kept: Vec<usize> = (0..step.len()).filter(|&row| !is_removed(row)).collect();
    let of = |values: &[f64]| kept.iter().map(|&row| values[row]).collect::<Vec<f64>>();
    let lines =
        |rows: &[Vec<(usize, f64)>]| kept.iter().map(|&row| rows[row].clone()).collect::<Vec<_>>();
    let mut removed = step.answer.forces.clone();
    kept.iter().for_each(|&row| removed[row] = 0.0);
    let push = step.push(&removed);
    let mut smaller = step.clone();
    let gauss = &mut smaller.gauss;
    gauss.target = step.motion_of(&removed);
    gauss.jacobian = lines(&step.gauss.jacobian);
    for (own, all) in [
        (&mut gauss.bias, &step.gauss.bias),
        (&mut gauss.compliance, &step.gauss.compliance),
        (&mut gauss.lo, &step.gauss.lo),
        (&mut gauss.hi, &step.gauss.hi),
    ] {
        *own = of(all);
    }
    let place = |row: usize| kept.binary_search(&row).ok();
    smaller.friction = FrictionRows {
        index: kept.iter().map(|&row| step.friction.index[row].and_then(place)).collect(),
        mu: of(&step.friction.mu),
        model: step.friction.model,
    };
    smaller.answer.forces = of(&step.answer.forces);
    if let Some(reported) = &mut smaller.answer.reported_push {
        reported.iter_mut().zip(&push).for_each(|(own, push)| *own -= push);
    }
    smaller.expected = Expected {
        jacobian: step.expected.jacobian.as_ref().map(|rows| lines(rows)),
        bias: step.expected.bias.as_ref().map(|bias| of(bias)),
        target: None,
    };
    if step.rows.len() == step.len() {
        smaller.rows = kept.iter().map(|&row| step.rows[row].clone()).collect();
    } else {
        smaller.rows.clear();
    }
    smaller
}
