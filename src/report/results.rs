//! Everything a report found out, as plain data: what `results.json` holds.
//!
//! All of it but `machine` is the same in every run on the same kind of processor.

use serde::{Deserialize, Serialize};

use super::experiment::Experiment;
use super::study::comparison::{Comparison, Timing};
use super::study::{
    convergence, cross_check, drift, merits, rates, sliding, sparsity, storage, verification,
    worst_cases,
};

/// The results of a report.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Results {
    /// The version of lcplab.
    pub version: String,
    /// The versions of the libraries that compute, as `name version`.
    pub libraries: Vec<String>,
    /// What was run.
    pub experiment: Experiment,
    /// Known numbers beside measured ones.
    pub verification: Vec<verification::Row>,
    /// Scenes with all solvers at all levels.
    pub comparisons: Vec<Comparison>,
    /// LCPs solved in three ways.
    pub cross_checks: Vec<cross_check::CrossCheck>,
    /// Residuals by sweep.
    pub convergence: Vec<convergence::Study>,
    /// Rates in closed form, as eigenvalues and measured.
    pub rates: Vec<rates::System>,
    /// What one LCP costs each method.
    pub worst_cases: Option<worst_cases::Study>,
    /// Friction models on a sliding block.
    pub friction: Option<sliding::Study>,
    /// Merit functions by sweep.
    pub merits: Vec<merits::Study>,
    /// Patterns of J and A.
    pub sparsity: Vec<sparsity::Patterns>,
    /// Energy and constraint errors by step length.
    pub drift: Vec<drift::Study>,
    /// The storages of sparse matrices.
    #[serde(default)]
    pub storage: Option<storage::Study>,
    /// What differs from machine to machine.
    pub machine: Machine,
}

impl Results {
    /// Whether every known number came out, every cost and sweep count is the one of theory, and no
    /// claim of a solver was refuted, and all storages gave the same matrices.
    pub fn is_good(&self) -> bool {
        let (costs, sweeps) = (self.costs(), self.sweep_counts());
        self.verification.iter().all(verification::Row::passes)
            && costs.0 == costs.1
            && sweeps.0 == sweeps.1
            && self.refuted_claims() == 0
            && self.storage.iter().all(storage::Study::agrees)
    }

    /// How many methods cost what theory says on one LCP, and how many there are.
    fn costs(&self) -> (usize, usize) {
        let cases = || self.worst_cases.iter().flat_map(|study| &study.cases);
        let sizes =
            self.worst_cases.iter().flat_map(|study| study.sizes.clone()).collect::<Vec<_>>();
        (cases().filter(|case| case.agrees(&sizes)).count(), cases().count())
    }

    /// How many columns take as many sweeps as predicted, and how many there are.
    fn sweep_counts(&self) -> (usize, usize) {
        (self.rates.iter().filter(|system| system.sweeps.agree()).count(), self.rates.len())
    }

    /// The outcome in a few lines.
    pub fn summary(&self) -> String {
        let runs = || self.comparisons.iter().flat_map(|comparison| &comparison.runs);
        let passed = self.verification.iter().filter(|row| row.passes()).count();
        let mut text = String::new();
        for (name, (agree, all), what) in [
            ("rates", self.sweep_counts(), "columns take as many sweeps as predicted"),
            ("five costs", self.costs(), "methods cost what theory says"),
        ] {
            if all > 0 {
                text += &format!("{name:<14} {agree} of {all} {what}\n");
            }
        }
        if let Some(study) = &self.storage {
            let asked: Vec<bool> = study.structures.iter().filter_map(|s| s.agree).collect();
            let (agree, all) = (asked.iter().filter(|agree| **agree).count(), asked.len());
            text += &format!(
                "storage        {agree} of {all} scenes have the same A in every storage\n\
                 claims         {} of the chapter's {} on storage hold as they stand\n",
                study.claims.iter().filter(|claim| claim.holds()).count(),
                study.claims.len(),
            );
        }
        if !self.experiment.solves() {
            return text.trim_end().to_string();
        }
        text + &format!(
            "closed forms   {passed} of {} as theory says\n\
             comparison     {} problems, {} claimed solved, {} accepted by the judge, {} claims refuted",
            self.verification.len(),
            runs().map(|run| run.solves).sum::<usize>(),
            runs().map(|run| run.claimed).sum::<usize>(),
            runs().map(|run| run.accepted).sum::<usize>(),
            self.refuted_claims(),
        )
    }

    fn refuted_claims(&self) -> usize {
        let runs = self.comparisons.iter().flat_map(|comparison| &comparison.runs);
        runs.map(|run| run.refuted_claims).sum()
    }
}

/// The versions of the libraries that compute, from the lock file of this build.
pub fn libraries() -> Vec<String> {
    const LOCK: &str = include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/Cargo.lock"));
    let version = |name: &&str| {
        let entry =
            LOCK.split("[[package]]").find(|e| e.contains(&format!("name = \"{name}\"\n")))?;
        let version = entry.split("version = \"").nth(1)?.split('"').next()?;
        Some(format!("{name} {version}"))
    };
    ["nalgebra", "faer", "clarabel", "parry3d-f64", "dashu-ratio", "plotters"]
        .iter()
        .filter_map(version)
        .collect()
}

/// What differs from machine to machine.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Machine {
    /// Operating system and processor family.
    pub platform: String,
    /// Threads that ran the comparison; they share the processor, so times are upper bounds.
    pub threads: usize,
    /// Wall time of the whole report (s).
    pub seconds: f64,
    /// Wall time of each run of the comparison.
    pub timings: Vec<Timing>,
    /// Times of storages.
    #[serde(default)]
    pub storage: Option<storage::time::Times>,
}

/// Numbers that JSON has no word for, as "nan", "inf" and "-inf".
pub mod number {
    use serde::{Deserialize, Deserializer, Serialize, Serializer, de::Error};
    use serde_json::Value;

    /// A number, or a word for one that is not finite.
    ///
    /// # Errors
    /// As the serializer.
    pub fn serialize<S: Serializer>(value: &f64, serializer: S) -> Result<S::Ok, S::Error> {
        crate::lcp::file::number(*value).serialize(serializer)
    }

    /// A number, or a word for one that is not finite.
    ///
    /// # Errors
    /// Anything else.
    pub fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<f64, D::Error> {
        let value = Value::deserialize(deserializer)?;
        crate::lcp::file::as_number(&value).ok_or_else(|| D::Error::custom("not a number"))
    }
}
