//! Explains Dantzig's method: which row is driven, along which direction, how far, and what stops
//! it.

use std::ops::ControlFlow;

use super::answer::Reading;
use super::solve::{self, Scribe};
use super::units::{headed, with_unit};
use lcplab_page::document::notation::{bracketed, indexed, interval, plain, set, vector};
use lcplab_page::document::{Formula, SHOWN, Section};
use lcplab_solver::{Centering, Event, Iterate, Move, Observer, Side, Solution, StepDetail};

pub(super) struct Moves<'a> {
    reading: &'a Reading<'a>,
    section: Section,
    moves: usize,
    /// Rounds of frozen bounds.
    rounds: usize,
    /// lo and hi; of friction rows, as frozen.
    bounds: Vec<(f64, f64)>,
    /// Whether the current move is written.
    writes: bool,
    /// The end of the move and what its row does then, unless x moves to the middle.
    end: Option<[String; 2]>,
}

impl<'a> Moves<'a> {
    pub fn of(reading: &'a Reading<'a>) -> Self {
        let mut section = Section::new("Dantzig's method, move by move");
        if !reading.is_again {
            section.say(
                "Dantzig's method satisfies the rows one after another. To bring wₖ to 0, it changes xₖ, and the free \
                 rows F change with it so that their w stays 0. The move ends when wₖ is 0, when some x reaches a \
                 bound, or when the w of a row at a bound reaches 0. The row that ends it enters or leaves F, or \
                 changes its bound: this is a pivot. d and Δw are the changes of x and w per unit of the length t \
                 of the move.",
            );
            section.formula(Formula::default().symbols(
                "d_k = 1,   d_F = −A_FF⁻¹ A_Fk,   Δw = A d",
                "d_k = 1, \\qquad d_F = -A_{FF}^{-1} A_{Fk}, \\qquad \\Delta w = A d",
            ));
        }
        let bounds =
            reading.lcp.lo().iter().copied().zip(reading.lcp.hi().iter().copied()).collect();
        Moves { reading, section, moves: 0, rounds: 0, bounds, writes: true, end: None }
    }

    fn write(&mut self, own: &Move<'_>) {
        let (i, n) = (own.driven, own.x.len());
        let (x, w) = (indexed("x", i), indexed("w", i));
        let units = &self.reading.units;
        let at = with_unit(&vector(own.x), &units.of_x());
        let has = with_unit(&plain(own.w[i]), &units.w[i]);
        let verb = if own.sign > 0.0 { "increases" } else { "decreases" };
        self.section.say(format!(
            "Move {}: row {i}. At x = {at} it has {w} = {has}, so {x} {verb}. The free rows are \
             F = {}.",
            self.moves,
            set(own.free),
        ));
        let mut direction = vec![0.0; n];
        direction[i] = own.sign;
        for (&j, d) in own.free.iter().zip(own.direction) {
            direction[j] = own.sign * d;
        }
        let mut change: Vec<f64> = own.delta_w.iter().map(|delta| own.sign * delta).collect();
        change[i] = own.sign * own.schur;
        self.section.formula(
            Formula::default()
                .symbols("d =", "d =")
                .vector(&direction)
                .symbols(",   Δw =", ", \\quad \\Delta w =")
                .vector(&change),
        );
        let title = format!("move {}, lengths at which it may end", self.moves);
        let mut ends = ends(own, &direction, &change);
        ends.sort_by(|a, b| a.0.total_cmp(&b.0));
        let lines = ends.into_iter().map(|(_, what, length)| vec![what, length]).collect();
        let length = headed("t", &self.reading.units.x[i]);
        self.section.table(&title, &["what", &length], lines);
    }

    /// x with its unit.
    fn x(&self, x: &[f64]) -> String {
        with_unit(&vector(x), &self.reading.units.of_x())
    }

    /// Why a row need not be driven.
    fn satisfied(&self, row: usize, w: f64, side: Side) -> String {
        let (lo, hi) = self.bounds[row];
        let (x, bounds) = (indexed("x", row), interval(lo, hi));
        let w = with_unit(&plain(w), &self.reading.units.w[row]);
        let reason = match side {
            _ if lo == hi => format!("any w is allowed, because {bounds} fixes {x}"),
            Side::Lower => {
                format!("w may be positive, because {x} is at the lower end of {bounds}")
            }
            Side::Upper => {
                format!("w may be negative, because {x} is at the upper end of {bounds}")
            }
            _ => "the row is satisfied".to_string(),
        };
        format!("Row {row} has {} = {w}: {reason}.", indexed("w", row))
    }

    fn end(&self, own: &Move<'_>) -> [String; 2] {
        let row = own.blocking;
        let exchange = match (own.side[row], own.to) {
            (_, Side::Free) => "enters F",
            (Side::Free, Side::Lower) => "leaves F to its lower bound",
            (Side::Free, _) => "leaves F to its upper bound",
            (_, Side::Upper) => "changes to its upper bound",
            _ => "changes to its lower bound",
        };
        let length = with_unit(&plain(own.length), &self.reading.units.x[own.driven]);
        [format!("The move ends at t = {length}: "), format!("row {row} {exchange}.")]
    }

    /// Why x moves to the middle of its range, and how far.
    fn centering(&mut self, own: &Centering<'_>) -> String {
        let (j, w) = (own.row, indexed("w", own.row));
        let why = match (own.keeps, self.end.take()) {
            (Some(row), Some([after, _])) => format!(
                "{after}{} reaches a bound. But row {row} need not leave F: {w} = 0, and row {j} depends on F.",
                indexed("x", row)
            ),
            _ => format!("Row {j} has {w} = 0 and depends on F."),
        };
        let mut direction = vec![0.0; own.x.len()];
        direction[j] = 1.0;
        for (&k, d) in own.free.iter().zip(own.direction) {
            direction[k] = *d;
        }
        let [forward, back, length] = [own.forward, own.back, own.length()]
            .map(|length| with_unit(&plain(length), &self.reading.units.x[j]));
        format!(
            "{why} Along d = {} no w changes. x could change by {forward} forward and by {back} backward; \
             it moves to the middle, by {length}. Row {j} is now dependent: its w stays 0 together with \
             that of F.",
            vector(&direction),
        )
    }
}

/// The possible ends of a move: length, text, and the length as computed, with signs in mind.
fn ends(own: &Move<'_>, direction: &[f64], change: &[f64]) -> Vec<(f64, String, String)> {
    let mut ends = Vec::new();
    let mut add = |what: String, distance: f64, rate: f64| {
        let length = distance / rate;
        if length.is_finite() {
            let words =
                format!("{}/{} = {}", plain(distance), bracketed(rate), plain(length.max(0.0)));
            ends.push((length.max(0.0), what, words));
        }
    };
    let (lo, hi) = (own.lcp.lo(), own.lcp.hi());
    for j in 0..direction.len() {
        let (x, w) = (indexed("x", j), indexed("w", j));
        let moves = j == own.driven || own.side[j] == Side::Free;
        if moves && direction[j] > 0.0 {
            add(format!("{x} reaches its upper bound"), hi[j] - own.x[j], direction[j]);
        }
        if moves && direction[j] < 0.0 {
            add(format!("{x} reaches its lower bound"), lo[j] - own.x[j], direction[j]);
        }
        let nears = match own.side[j] {
            _ if j == own.driven => true,
            Side::Lower => change[j] < 0.0 && lo[j] < hi[j],
            Side::Upper => change[j] > 0.0 && lo[j] < hi[j],
            _ => false,
        };
        if nears && change[j] != 0.0 {
            add(format!("{w} reaches 0"), -own.w[j], change[j]);
        }
    }
    ends
}

impl Observer for Moves<'_> {
    fn observe(&mut self, iterate: &Iterate<'_>) -> ControlFlow<()> {
        if iterate.event == Event::Start {
            self.section.say(format!("The start is x = {}, and F is empty.", self.x(iterate.x)));
        } else if self.writes {
            if let Some(end) = self.end.take() {
                self.section.say(end.concat());
            }
            self.section.say(format!("Now x = {}.", self.x(iterate.x)));
        }
        ControlFlow::Continue(())
    }

    fn wants_details(&self) -> bool {
        true
    }

    fn part(&mut self, part: &StepDetail<'_>) {
        match part {
            StepDetail::Frozen(lcp) => {
                self.rounds += 1;
                self.bounds = lcp.lo().iter().copied().zip(lcp.hi().iter().copied()).collect();
                if self.moves < SHOWN {
                    solve::frozen(&mut self.section, self.reading, self.rounds, lcp);
                }
            }
            StepDetail::Satisfied { row, w, side } if self.moves <= SHOWN => {
                let words = self.satisfied(*row, *w, *side);
                self.section.say(words);
            }
            StepDetail::Move(own) => {
                self.moves += 1;
                self.writes = self.moves <= SHOWN && own.w[own.driven] != 0.0;
                if !self.writes && self.moves <= SHOWN {
                    let (row, w) = (own.driven, indexed("w", own.driven));
                    self.section.say(format!(
                        "Move {}: row {row} already has {w} = 0, and x is between its bounds. It enters F \
                         without a change of x.",
                        self.moves
                    ));
                }
                if self.writes {
                    self.write(own);
                    self.end = Some(self.end(own));
                }
            }
            StepDetail::Centering(own) => {
                self.writes = self.moves <= SHOWN;
                if self.writes {
                    let words = self.centering(own);
                    self.section.say(words);
                }
            }
            _ => {}
        }
    }
}

impl Scribe for Moves<'_> {
    fn section(mut self: Box<Self>, _: &Solution) -> Section {
        if self.moves > SHOWN {
            self.section.say(format!("{} more moves follow.", self.moves - SHOWN));
        }
        self.section
    }
}
