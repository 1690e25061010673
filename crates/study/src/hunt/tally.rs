//! What came of a hunt, solver by solver.

use serde::Serialize;

use super::{Claim, Lie, cone};
use lcplab_solver::Settings;

/// At most this many lies of a solver are kept; all are counted.
const KEPT: usize = 20;

/// What came of a hunt.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Record {
    /// How many problems there were.
    pub problems: usize,
    /// How many contacts with a cone.
    pub contacts: usize,
    /// Solver by solver, in the order they were given; those of cones after them.
    pub tallies: Vec<Tally>,
}

/// What a solver said of all problems.
#[derive(Debug, Clone, PartialEq, Default, Serialize)]
pub struct Tally {
    /// The solver.
    pub solver: String,
    /// Answers that were proved.
    pub proved: usize,
    /// Answers within the tolerance.
    pub within: usize,
    /// Answers within the tolerance to problems of which the judge proves that they have no
    /// solution.
    pub refused: usize,
    /// Problems of which it was proved that they have no solution.
    pub impossible: usize,
    /// No answer, for a reason that was given.
    pub unsolved: usize,
    /// Problems that are not of its class.
    pub outside: usize,
    /// Claims that are not true.
    pub lied: usize,
    /// The first of those: the problem's number, its kind, and what is wrong.
    pub lies: Vec<(usize, &'static str, String)>,
}

impl Record {
    /// Of no problem.
    pub(super) fn empty(solvers: impl Iterator<Item = &'static str>) -> Record {
        let tally = |name: &str| Tally { solver: name.to_string(), ..Tally::default() };
        Record { problems: 0, contacts: 0, tallies: solvers.map(tally).collect() }
    }

    /// Of one problem of a kind.
    pub(super) fn of(
        number: usize,
        kind: &'static str,
        claims: &[(&'static str, Claim)],
    ) -> Record {
        let tally =
            |(solver, claim): &(&'static str, Claim)| Tally::of(number, kind, solver, claim);
        Record { problems: 1, contacts: 0, tallies: claims.iter().map(tally).collect() }
    }

    /// Of both.
    pub(super) fn and(self, other: Record) -> Record {
        let tallies = self.tallies.into_iter().zip(other.tallies);
        Record {
            problems: self.problems + other.problems,
            contacts: self.contacts + other.contacts,
            tallies: tallies.map(|(one, other)| one.and(other)).collect(),
        }
    }

    /// With what the solvers of cones say of the first contacts of a seed.
    #[must_use]
    pub fn with_cones(mut self, seed: u64, contacts: usize, settings: &Settings) -> Record {
        self.contacts += contacts;
        self.tallies.extend(cone::tallies(seed, contacts, settings));
        self
    }

    /// Whether nobody lied.
    pub fn is_honest(&self) -> bool {
        self.tallies.iter().all(|tally| tally.lied == 0)
    }
}

impl Tally {
    /// How many problems the solver answered rightly.
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
            Claim::Lie(lie) => tally.add_lie(number, kind, *lie),
        }
        tally
    }

    fn add_lie(&mut self, number: usize, kind: &'static str, lie: Lie) {
        self.lied = 1;
        self.lies.push((number, kind, lie.to_string()));
    }

    pub(super) fn and(mut self, other: Tally) -> Tally {
        self.lies.extend(other.lies);
        self.lies.sort_by_key(|lie| lie.0); // the first ones, whoever was done first
        self.lies.truncate(KEPT);
        Tally {
            proved: self.proved + other.proved,
            within: self.within + other.within,
            refused: self.refused + other.refused,
            impossible: self.impossible + other.impossible,
            unsolved: self.unsolved + other.unsolved,
            outside: self.outside + other.outside,
            lied: self.lied + other.lied,
            ..self
        }
    }
}
