//! Bytes as one contact whose A is diagonal, so that its laws are solved by hand: the judge accepts
//! that answer and none that is far from it, and no solver claims another one.

use arbitrary::{Result, Unstructured};
use lcplab::judge::{Demand, judge_cone, judge_friction};
use lcplab::lcp::friction::{ConeProblem, Contact, FrictionProblem, Law, Model};
use lcplab::lcp::{Lcp, Matrix};
use lcplab::solver::{Registry, Settings, Start, Status};

use crate::problem::numbers;

/// An answer may be so far off, of what pushes the row and of what friction may hold.
const SLACK: f64 = 1e-4;

/// w = a x + b in each row, with friction μ.
#[derive(Debug)]
struct One {
    a: [f64; 3],
    b: [f64; 3],
    mu: f64,
}

impl One {
    fn new(u: &mut Unstructured<'_>) -> Result<Self> {
        let scales = [1e-8, 1e-3, 1.0, 3.0, 1e4, 1e8];
        let (n, t) = (*u.choose(&scales)?, *u.choose(&scales)?);
        let b = numbers(u, 3)?.into_iter().map(|b| b.clamp(-1e12, 1e12));
        let b: Vec<f64> = b.map(|b| if b.abs() < 1e-12 { 0.0 } else { b }).collect();
        Ok(One { a: [n, t, t], b: [b[0], b[1], b[2]], mu: *u.choose(&[0.0, 0.25, 0.5, 1.0, 2.0])? })
    }

    fn friction(&self) -> FrictionProblem {
        let (free, inf) = (f64::NEG_INFINITY, f64::INFINITY);
        let a: Vec<f64> = (0..9).map(|k| if k % 4 == 0 { self.a[k / 4] } else { 0.0 }).collect();
        let lcp =
            Lcp::new(Matrix::dense(3, &a), self.b.to_vec(), vec![0.0, free, free], vec![inf; 3]);
        let contact = Contact { rows: [0, 1, 2], mu: self.mu };
        FrictionProblem::new(lcp.expect("finite"), vec![contact]).expect("one contact")
    }

    /// What holds the rows in place, and no more than friction can: of each tangent in a box, of
    /// both together in Coulomb's cone.
    fn answer(&self, is_cone: bool) -> [f64; 3] {
        let [n, t1, t2] = [0, 1, 2].map(|i| -self.b[i] / self.a[i]);
        let (n, most) = (n.max(0.0), self.mu * n.max(0.0));
        let long = t1.hypot(t2);
        match is_cone {
            true if long > most => [n, t1 / long * most, t2 / long * most],
            true => [n, t1, t2],
            false => [n, t1.clamp(-most, most), t2.clamp(-most, most)],
        }
    }

    fn is_near(&self, x: &[f64], truth: [f64; 3]) -> bool {
        let [n, t1, t2] = [0, 1, 2].map(|i| (self.b[i] / self.a[i]).abs());
        let room = [n, t1.hypot(t2) + self.mu * n, t1.hypot(t2) + self.mu * n];
        x.iter().zip(truth).zip(room).all(|((x, t), room)| (x - t).abs() <= SLACK * room)
    }
}

/// Makes a contact and an x of the bytes.
pub fn judged(u: &mut Unstructured<'_>) -> Result<()> {
    let one = One::new(u)?;
    let asked = [u.arbitrary()?, u.arbitrary()?, u.arbitrary()?];
    let part: [f64; 3] = [0; 3].map(|_| *u.choose(&[0.0, 1.0, 1.1, -1.0, 1e3]).unwrap_or(&1.0));
    for (model, is_cone) in [(Model::CoupledBox, false), (Model::CoulombCone, true)] {
        let posed = model.pose(&one.friction(), None).expect("a model of any contact");
        let accepts =
            |x: &[f64; 3]| judge_friction(&posed, x, &Demand::default()).verdict.is_solution();
        let truth = one.answer(is_cone);
        assert!(accepts(&truth), "{model}, {one:?} at {truth:?}");
        let scaled = [0, 1, 2].map(|i| part[i] * truth[i]);
        for x in [asked, scaled].iter().filter(|x| accepts(x)) {
            assert!(one.is_near(x, truth), "{model}, {one:?}: {x:?}, not {truth:?}");
        }
    }
    Ok(())
}

/// Makes a contact of the bytes and gives it to every solver for cones.
pub fn solved(u: &mut Unstructured<'_>) -> Result<()> {
    let one = One::new(u)?;
    let settings = Settings::default().with_max_iterations(200);
    for (entry, law) in Registry::standard()
        .cone_entries()
        .flat_map(|entry| entry.laws.iter().map(move |law| (entry, *law)))
    {
        let problem = ConeProblem::new(one.friction(), law);
        let solution = entry.build(&settings).solve(&problem, &Start::default(), &mut ());
        if solution.status != Status::Solved {
            continue;
        }
        let verdict = judge_cone(&problem, &solution.x, &Demand::default()).verdict;
        let is_near = law != Law::Coulomb || one.is_near(&solution.x, one.answer(true));
        let claim = format!("{} on {law:?}, {one:?}: {:?}", entry.name, solution.x);
        assert!(verdict.is_solution() && is_near, "{claim}, {verdict}");
    }
    Ok(())
}
