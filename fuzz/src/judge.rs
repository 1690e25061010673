//! The judge on any x, NaN and infinity too, against all solutions in exact arithmetic.

use arbitrary::{Result, Unstructured};
use lcplab::judge::ray::refute;
use lcplab::judge::{Demand, Verdict, judge as verdict_on};
use lcplab::lcp::Lcp;
use lcplab::solver::all_solutions;

use crate::contact;
use crate::problem::problem;

/// Makes a problem and an x of the bytes, and a contact of what is left.
pub fn judge(bytes: &[u8]) -> Result<()> {
    let mut u = Unstructured::new(bytes);
    of_problem(&mut u)?;
    contact::judged(&mut u)
}

fn of_problem(u: &mut Unstructured<'_>) -> Result<()> {
    let lcp = problem(u)?;
    let x = (0..lcp.len()).map(|_| u.arbitrary()).collect::<Result<Vec<f64>>>()?;
    let verdict = word(&lcp, &x);
    let all = all_solutions(&lcp).expect("few pieces");
    if let Verdict::Proved { distance } = verdict {
        assert!(distance >= 0.0 && !all.is_empty(), "{verdict:?} of {lcp:?} at {x:?}");
    }
    for solution in all.iter().filter(|x| x.iter().all(|x| x.to_f64().error().is_none())) {
        let x: Vec<f64> = solution.iter().map(|x| x.to_f64().value()).collect();
        assert!(word(&lcp, &x).is_solution(), "{} of {lcp:?} at {x:?}", word(&lcp, &x));
    }
    for row in 0..lcp.len() {
        assert!(refute(&lcp, row, &x).is_none() || all.is_empty(), "{lcp:?} has a solution: {x:?}");
    }
    Ok(())
}

fn word(lcp: &Lcp, x: &[f64]) -> Verdict {
    verdict_on(lcp, x, &Demand::default()).verdict
}
