//! The step details that a solver reports agree with its iterates.

use std::ops::ControlFlow;

use lcplab_lcp::{Lcp, library};
use lcplab_solver::{
    Event, Iterate, Observer, Options, Registry, Side, Solution, Start, StepDetail, Variable,
};
use proptest::prelude::*;

use lcplab_testing::{cases, manufactured, stack};

/// Follows the step details, and compares each iterate with their result.
struct Follower {
    x: Vec<f64>,
    parts: usize,
    worst: f64,
    last_values: Vec<(Variable, f64)>,
}

impl Follower {
    fn of(lcp: &Lcp, solver: &str) -> (Self, Solution) {
        let (x, last_values) = (vec![0.0; lcp.len()], Vec::new());
        let mut follower = Follower { x, parts: 0, worst: 0.0, last_values };
        let solver = Registry::standard().entry(solver).unwrap().build(&Options::default());
        let solution = solver.solve(lcp, &Start::default(), &mut follower);
        (follower, solution)
    }
}

impl Observer for Follower {
    fn observe(&mut self, iterate: &Iterate<'_>) -> ControlFlow<()> {
        if iterate.event != Event::Start {
            let off = self.x.iter().zip(iterate.x).map(|(a, b)| (a - b).abs());
            self.worst = off.fold(self.worst, f64::max);
        }
        self.x = iterate.x.to_vec();
        ControlFlow::Continue(())
    }

    fn wants_details(&self) -> bool {
        true
    }

    fn part(&mut self, part: &StepDetail<'_>) {
        self.parts += 1;
        match part {
            StepDetail::Row(row) => {
                assert_eq!(row.before, self.x[row.row]);
                self.x[row.row] = row.after;
            }
            StepDetail::Move(own) => {
                self.x[own.driven] += own.sign * own.length;
                for (&j, d) in own.free.iter().zip(own.direction) {
                    assert_eq!(own.side[j], Side::Free);
                    self.x[j] += own.sign * own.length * d;
                }
            }
            StepDetail::Centering(own) => {
                self.x[own.row] += own.length();
                for (&j, d) in own.free.iter().zip(own.direction) {
                    self.x[j] += own.length() * d;
                }
            }
            StepDetail::Tableau(own) => {
                let values = own.basic.iter().copied().zip(own.constant.iter().copied());
                self.last_values = values.collect();
            }
            StepDetail::Satisfied { .. } | StepDetail::Frozen(_) => {}
        }
    }
}

proptest! {
    #![proptest_config(cases(40))]

    #[test]
    fn the_rows_of_a_sweep_lead_to_its_iterate_bit_by_bit(
        problem in manufactured(5, 5, 1.0), solver in prop_oneof![Just("pgs"), Just("sor")],
    ) {
        let (follower, solution) = Follower::of(&problem.lcp, solver);
        prop_assert_eq!(follower.worst, 0.0);
        prop_assert_eq!(follower.parts, 5 * solution.iterations);
    }

    #[test]
    fn the_moves_of_dantzig_lead_to_its_iterates(problem in manufactured(5, 5, 1.0)) {
        let (follower, _) = Follower::of(&problem.lcp, "dantzig");
        prop_assert!(follower.worst < 1e-12, "{}", follower.worst);
    }
}

#[test]
fn the_moves_of_dantzig_on_redundant_contacts_lead_to_its_answer() {
    let family = library::by_name("box-stack").unwrap();
    for mu in [0.0, 0.5] {
        let lcp = family.generate(&[("boxes", 10.0), ("mu", mu)]).unwrap().lcp;
        let (follower, solution) = Follower::of(&lcp, "dantzig");
        assert!(follower.worst < 1e-12, "{}", follower.worst);
        let off = follower.x.iter().zip(&solution.x).map(|(told, x)| (told - x).abs());
        assert!(off.fold(0.0, f64::max) < 1e-9); // what is left is refinement
    }
}

#[test]
fn the_last_tableau_of_lemke_has_the_solution() {
    let lcp = library::by_name("kostreva-1").unwrap().generate(&[]).unwrap().lcp;
    let (follower, solution) = Follower::of(&lcp, "lemke");
    assert_eq!(follower.parts, solution.iterations + 1); // one before each pivot, and the last
    let value = |v| follower.last_values.iter().find(|(name, _)| *name == v).map_or(0.0, |v| v.1);
    for i in 0..lcp.len() {
        assert!((value(Variable::Y(i)) - solution.x[i]).abs() < 1e-12);
        assert!((value(Variable::W(i)) - solution.w[i]).abs() < 1e-12);
    }
}

/// Does not want details, and must not receive any.
struct Deaf;

impl Observer for Deaf {
    fn observe(&mut self, _: &Iterate<'_>) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }

    fn part(&mut self, part: &StepDetail<'_>) {
        panic!("told of {part:?}");
    }
}

#[test]
fn only_an_observer_that_asks_receives_parts() {
    for entry in Registry::standard().entries() {
        let solver = entry.build(&Options::default());
        let heard = solver.solve(&stack(4), &Start::default(), &mut Deaf);
        assert_eq!(heard, solver.solve(&stack(4), &Start::default(), &mut ()), "{}", entry.name);
    }
}
