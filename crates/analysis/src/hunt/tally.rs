//! The result of a hunt, solver by solver.

use serde::Serialize;

use super::{Claim, FalseClaim};

/// Maximum number of false claims kept per solver; all are counted.
const KEPT: usize = 20;

/// The result of a hunt.
#[derive(Debug, Clone, PartialEq, Default, Serialize)]
pub struct Record {
    /// The number of problems that all solvers have answered.
    pub problems: usize,
    /// The solvers were given all problems of the hunt with numbers below this one.
    pub given: usize,
    /// The numbers of the given problems that were not finished.
    pub unfinished: Vec<usize>,
    /// The number of contacts with a cone.
    pub contacts: usize,
    /// The tallies of the solvers in the given order, followed by the cone solvers.
    pub tallies: Vec<Tally>,
}

/// The claims of a solver on all problems.
#[derive(Debug, Clone, PartialEq, Default, Serialize)]
pub struct Tally {
    /// The solver.
    pub solver: String,
    /// Answers that were proved.
    pub proved: usize,
    /// Answers within the tolerance.
    pub within: usize,
    /// Answers within the tolerance to problems that the judge proves to have no solution.
    pub refused: usize,
    /// Problems proved to have no solution.
    pub impossible: usize,
    /// No answer, with a reason.
    pub unsolved: usize,
    /// Problems outside its class.
    pub outside: usize,
    /// False claims.
    pub false_claim_count: usize,
    /// The first of those: the problem's number, its kind, and what is wrong.
    pub false_claims: Vec<(usize, &'static str, String)>,
}

impl Record {
    /// What follows the name of a solver in its tally on contacts with cones.
    pub const ON_CONES: &str = " on cones";

    /// A record without problems.
    pub(super) fn empty<'s>(solvers: impl Iterator<Item = &'s str>) -> Record {
        let tally = |name: &str| Tally { solver: name.to_string(), ..Tally::default() };
        Record { tallies: solvers.map(tally).collect(), ..Record::default() }
    }

    /// The record of one problem of a kind.
    pub(super) fn of(number: usize, kind: &'static str, claims: &[(&str, Claim)]) -> Record {
        let tally = |(solver, claim): &(&str, Claim)| Tally::of(number, kind, solver, claim);
        let tallies = claims.iter().map(tally).collect();
        Record { problems: 1, tallies, ..Record::default() }
    }

    /// This record with the claims of another.
    pub(super) fn and(self, other: Record) -> Record {
        let tallies = self.tallies.into_iter().zip(other.tallies);
        Record {
            problems: self.problems + other.problems,
            tallies: tallies.map(|(one, other)| one.and(other)).collect(),
            ..self
        }
    }

    /// Whether there are no false claims.
    pub fn has_no_false_claims(&self) -> bool {
        self.tallies.iter().all(|tally| tally.false_claim_count == 0)
    }
}

impl Tally {
    /// The number of problems that the solver answered correctly.
    pub fn right(&self) -> usize {
        self.proved + self.within + self.refused + self.impossible
    }

    fn of(number: usize, kind: &'static str, solver: &str, claim: &Claim) -> Tally {
        let mut tally = Tally { solver: solver.to_string(), ..Tally::default() };
        match claim {
            Claim::Proved => tally.proved = 1,
            Claim::Within => tally.within = 1,
            Claim::Refused => tally.refused = 1,
            Claim::Impossible => tally.impossible = 1,
            Claim::Unsolved => tally.unsolved = 1,
            Claim::Outside => tally.outside = 1,
            Claim::FalseClaim(lie) => tally.add_false_claim(number, kind, *lie),
        }
        tally
    }

    fn add_false_claim(&mut self, number: usize, kind: &'static str, lie: FalseClaim) {
        self.false_claim_count = 1;
        self.false_claims.push((number, kind, lie.to_string()));
    }

    pub(super) fn and(mut self, other: Tally) -> Tally {
        self.false_claims.extend(other.false_claims);
        // The first ones, regardless of which thread finished first.
        self.false_claims.sort_by_key(|lie| lie.0);
        self.false_claims.truncate(KEPT);
        Tally {
            proved: self.proved + other.proved,
            within: self.within + other.within,
            refused: self.refused + other.refused,
            impossible: self.impossible + other.impossible,
            unsolved: self.unsolved + other.unsolved,
            outside: self.outside + other.outside,
            false_claim_count: self.false_claim_count + other.false_claim_count,
            ..self
        }
    }
}
