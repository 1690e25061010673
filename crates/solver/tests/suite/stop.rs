//! External stop conditions of a solve.

use std::ops::ControlFlow;
use std::time::Duration;

use lcplab_solver::{Iterate, Observer, Pgs, Reason, Solver, Start, Status, StepDetail, Stop};

use lcplab_testing::stack;

/// Counts the iterates it receives.
#[derive(Default)]
struct Count {
    iterates: usize,
    parts: usize,
    asks: bool,
    most: usize,
}

impl Observer for Count {
    fn observe(&mut self, _: &Iterate<'_>) -> ControlFlow<()> {
        self.iterates += 1;
        if self.iterates > self.most { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }

    fn wants_details(&self) -> bool {
        self.asks
    }

    fn part(&mut self, _: &StepDetail<'_>) {
        self.parts += 1;
    }
}

fn solve(stop: &Stop, count: &mut Count) -> Status {
    Pgs::default().solve(&stack(20), &Start::default(), &mut stop.watch(count)).status
}

#[test]
fn a_limit_that_is_over_stops_at_the_first_iterate_and_one_that_is_not_never_does() {
    let mut count = Count { most: usize::MAX, ..Count::default() };
    assert_eq!(solve(&Stop::after(Duration::ZERO), &mut count), Status::Stopped);
    assert_eq!(count.iterates, 1);
    for stop in
        [Stop::after(Duration::MAX), Stop::after(Duration::from_secs(3600)), Stop::default()]
    {
        assert_eq!(solve(&stop, &mut count), Status::Solved);
        assert_eq!(stop.reason(), None);
    }
}

#[test]
fn a_raised_flag_is_seen_by_every_clone_and_comes_before_the_limit() {
    let stop = Stop::after(Duration::ZERO);
    let limit = Reason::TimeLimit(Duration::ZERO);
    assert_eq!(stop.reason(), Some(limit));
    stop.clone().raise();
    assert_eq!(stop.reason(), Some(Reason::Interrupted));
    assert_eq!(Reason::Interrupted.to_string(), "interrupted");
    let limit = Reason::TimeLimit(Duration::from_millis(1500));
    assert_eq!(limit.to_string(), "stopped by the time limit of 1.5 s");
}

#[test]
fn the_observer_behind_it_sees_everything_and_may_stop_first() {
    let mut count = Count { most: 3, asks: true, ..Count::default() };
    assert_eq!(solve(&Stop::default(), &mut count), Status::Stopped);
    assert_eq!((count.iterates, count.parts), (4, 60)); // the start, and three sweeps of 20 rows
    let stop = Stop::default();
    let mut watched = stop.watch(&mut count);
    assert!(watched.wants_details());
    watched.part(&StepDetail::Frozen(&stack(1)));
    assert_eq!(count.parts, 61);
    assert!(!stop.watch(&mut Count::default()).wants_details());
}
