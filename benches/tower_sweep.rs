//! What does a sweep over a tower of 700 cubes cost, and what does a tolerance? Colours need other numbers
//! of sweeps than the order of the rows, so both are counted. Friction follows the normal force.

#![allow(missing_docs)]

mod measure;

use lcplab::formulation::{Factors, Problem};
use lcplab::lcp::{Lcp, merit};
use lcplab::scene::Scene;
use lcplab::simulation::Simulation;
use lcplab::solver::kernel::Width;
use lcplab::solver::kernel::impulses::{EightPairs, RowByRow, System};
use lcplab::solver::{Options, Settings, by_name};
use measure::{Contender, interleaved, timed};

const ROUNDS: usize = 41;
/// Sweeps that are timed together.
const TOGETHER: usize = 10;
/// Part of the first residual that is asked for.
const TOLERANCES: [f64; 2] = [1e-2, 1e-3];
/// Sweeps between two looks at the residual.
const LOOK: usize = 20;
const MOST_SWEEPS: usize = 20_000;

/// One sweep of one kind.
type Sweeps<'a> = (String, Box<dyn FnMut() + 'a>, Box<dyn Fn() -> Vec<f64> + 'a>);

fn main() {
    let problem = tower();
    let factors = Factors::of(&problem.assembly);
    let rows = factors.scaled_rows();
    let system = System::new(factors.bodies(), &rows, &problem.lcp).expect("rows of contacts");
    println!("{} rows, {} entries of A", rows.len(), problem.lcp.matrix().stored());
    println!(
        "| sweep | ns a row: median | best | sweeps to {TOLERANCES:?} of the first residual, ms by the best |"
    );
    println!("|---|---|---|---|");
    let timed = kinds(&system, &problem.lcp).into_iter().map(contender);
    let mut contenders: Vec<Contender> = timed.collect();
    let times = interleaved(ROUNDS, &mut contenders);
    let kinds = kinds(&system, &problem.lcp);
    for ((time, contender), (_, sweep, x)) in times.iter().zip(&contenders).zip(kinds) {
        let name = &contender.name;
        let per_row = |seconds: f64| 1e9 * seconds / (TOGETHER * rows.len()) as f64;
        let sweeps = sweeps_to(&problem.lcp, sweep, x);
        let reached = sweeps.map(|sweeps| match sweeps {
            Some(n) => format!("{n}, {:.1}", 1e3 * time.best * n as f64 / TOGETHER as f64),
            None => "not reached".to_string(),
        });
        let (median, best) = (per_row(time.median), per_row(time.best));
        println!("| {name} | {median:.2} | {best:.2} | {} |", reached.join("; "));
    }
}

/// The third step of the tower.
fn tower() -> Problem {
    let settings = Settings { max_iterations: 20, ..Settings::default() };
    let pgs = by_name("pgs", &Options { settings, ..Options::default() }).expect("a solver");
    let mut simulation = Simulation::new(Scene::load("tower").expect("a scene"), pgs);
    let mut steps = (0..3).map(|_| simulation.step().expect("a step"));
    steps.next_back().expect("three steps").solves.remove(0).problem
}

fn kinds<'a>(system: &'a System<'a>, lcp: &'a Lcp) -> Vec<Sweeps<'a>> {
    fn kind<'a, K: 'a>(
        name: String,
        kernel: K,
        sweep: impl Fn(&mut K) + 'a,
        x: impl Fn(&K) -> Vec<f64> + 'a,
    ) -> Sweeps<'a> {
        let kernel = std::rc::Rc::new(std::cell::RefCell::new(kernel));
        let other = kernel.clone();
        (
            name,
            Box::new(move || sweep(&mut kernel.borrow_mut())),
            Box::new(move || x(&other.borrow())),
        )
    }
    let assembled = |x: &mut Vec<f64>| {
        for i in 0..x.len() {
            let unclamped = x[i] - lcp.row_w(i, x) / lcp.matrix().diagonal(i);
            x[i] = lcp.project(i, unclamped, x);
        }
    };
    let mut kinds = vec![
        kind("rows of A, assembled".into(), vec![0.0; lcp.len()], assembled, Vec::clone),
        kind("row by row".into(), RowByRow::new(system), RowByRow::sweep, |k| k.x().to_vec()),
    ];
    for width in Width::available() {
        let eight = EightPairs::new(system, width).expect("friction within pairs");
        kinds.push(kind(
            format!("eight pairs, {width:?}"),
            eight,
            EightPairs::sweep,
            EightPairs::x,
        ));
    }
    kinds
}

fn contender<'a>((name, mut sweep, _): Sweeps<'a>) -> Contender<'a> {
    Contender::new(name, move || timed(|| (0..TOGETHER).for_each(|_| sweep())))
}

/// The sweeps after which the residual is that part of the first one.
fn sweeps_to(
    lcp: &Lcp,
    mut sweep: Box<dyn FnMut() + '_>,
    x: Box<dyn Fn() -> Vec<f64> + '_>,
) -> [Option<usize>; 2] {
    let first = merit::natural_residual(lcp, &vec![0.0; lcp.len()]);
    let mut reached = [None; 2];
    for done in (LOOK..=MOST_SWEEPS).step_by(LOOK) {
        (0..LOOK).for_each(|_| sweep());
        let residual = merit::natural_residual(lcp, &x()) / first;
        for (reached, tolerance) in reached.iter_mut().zip(TOLERANCES) {
            *reached = reached.or((residual <= tolerance).then_some(done));
        }
        if reached.iter().all(Option::is_some) {
            break;
        }
    }
    reached
}
