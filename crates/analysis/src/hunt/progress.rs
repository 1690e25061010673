//! The record of a hunt while it runs.

use std::mem;
use std::ops::Range;
use std::sync::{Mutex, MutexGuard, PoisonError};

use rayon::prelude::*;

use super::{Record, Tally};
use lcplab_solver::Stop;

/// What a hunt has found so far; any thread can read it while the hunt runs.
#[derive(Debug, Default)]
pub struct Progress(Mutex<Record>);

impl Progress {
    /// The record of the problems that are finished.
    pub fn record(&self) -> Record {
        let mut record = self.lock().clone();
        record.unfinished.sort_unstable();
        record
    }

    /// Gives the problems with these numbers to all threads, in this order, until the stop
    /// condition; `one` returns none for a problem that it gives up.
    pub(super) fn work<'s>(
        &self,
        names: impl Iterator<Item = &'s str>,
        numbers: Range<usize>,
        stop: &Stop,
        one: &(dyn Fn(usize) -> Option<Record> + Sync),
    ) -> Record {
        *self.lock() = Record { given: numbers.start, ..Record::empty(names) };
        let next = || {
            let mut record = self.lock();
            let number = record.given;
            (number < numbers.end && stop.reason().is_none()).then(|| {
                record.given += 1;
                record.unfinished.push(number);
                number
            })
        };
        let worker = |_| {
            while let Some(number) = next() {
                let Some(found) = one(number) else { continue };
                let mut record = self.lock();
                record.unfinished.retain(|&other| other != number);
                *record = mem::take(&mut *record).and(found);
            }
        };
        (0..rayon::current_num_threads()).into_par_iter().for_each(worker);
        self.record()
    }

    /// Adds the record of contacts with cones.
    pub(super) fn add_cones(&self, cones: Record) {
        let mut record = self.lock();
        record.contacts += cones.problems;
        record.tallies.extend(
            cones
                .tallies
                .into_iter()
                .map(|tally| Tally { solver: tally.solver + Record::ON_CONES, ..tally }),
        );
    }

    fn lock(&self) -> MutexGuard<'_, Record> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
