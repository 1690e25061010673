//! A measure of a grid across its first axis.

use super::curves::{Curve, Curves};
use crate::number::{capitalized, readable};
use crate::plot::{Axis, Lines, Scale, Series};
use crate::report::grid::file::{Grid, REPEAT};
use crate::report::grid::measure::{ITERATIONS, Measure};
use crate::report::grid::plan::plain;
use crate::report::view::attempt::listed;
use crate::solver::Registry;
use crate::solver::theory::sor_radius;

/// Maximum number of curves that are still readable.
const MOST_CURVES: usize = 12;
/// A larger ratio of the values selects a logarithmic axis,
const WIDE: f64 = 50.0;
/// as do values whose logarithms are spaced this evenly.
const EVEN: f64 = 1.1;
/// A closed form is drawn in this number of parts.
const FINE: usize = 400;
/// The least number of positions whose distance is stated.
const MANY: usize = 10;
/// A least value inside a curve is a finding if both ends are more than this many times as large.
const DIP: f64 = 1.03;

/// The figure of a measure; names of its files begin with `id`. `None` if it was not taken
/// anywhere.
pub(super) fn figure(
    grid: &Grid,
    curves: &Curves<'_>,
    measure: &Measure,
    id: &str,
) -> Option<Lines> {
    let shown = &curves.curves[..curves.curves.len().min(MOST_CURVES)];
    // On a linear axis an error is a part of the solution.
    let (scale, unit) = match measure.name == "error" && grid.scale == Some(Scale::Linear) {
        true => (100.0, "%"),
        false => (1.0, measure.unit),
    };
    let scaled = |points: Vec<(f64, f64)>| -> Vec<(f64, f64)> {
        points.into_iter().map(|(x, y)| (x, scale * y)).collect()
    };
    let drawn = |curve: &Curve| {
        Series::measured(curve.name.clone(), scaled(curve.measured(measure))).labeled(&curve.name)
    };
    let is_taken = |own: &Series| own.points.iter().any(|(_, y)| y.is_finite());
    let mut series: Vec<Series> = shown.iter().map(drawn).filter(is_taken).collect();
    let all: Vec<(f64, f64)> = series.iter().flat_map(|own| own.points.iter().copied()).collect();
    let (x, y) = (Spread::of(all.iter().map(|(x, _)| *x)), Spread::of(all.iter().map(|(_, y)| *y)));
    y.most.is_finite().then_some(())?;
    let finding = finding(grid, curves, measure, &series)
        .unwrap_or_else(|| format!("{} against {}", measure.words, curves.across));
    let mut words = vec![format!("{}.", about(grid, measure))];
    if let Some(limit) = grid.limit.filter(|_| measure == grid.measures[0]) {
        let ends = [x.least, x.most].map(|x| (x, limit));
        series.push(Series::reference("limit", ends.into()).labeled("limit"));
    }
    let label = &counted(grid, measure);
    let y_wide = grid.scale.map_or(y.wide, |scale| scale == Scale::Log);
    let bands = match *measure == ITERATIONS {
        true => "if all error decayed at ρ",
        false => "closed form",
    };
    let theory = |curve: &Curve| {
        let points = fine(curves, curve, measure).map(|fine| fine.points);
        let points = scaled(points.unwrap_or_else(|| curve.predicted(measure)));
        let name = format!("theory, {}: {bands}", curve.name);
        points.iter().any(|(_, y)| y.is_finite()).then(|| Series::theory(name, points).labeled(""))
    };
    let theory: Vec<Series> = shown.iter().filter_map(theory).collect();
    if !theory.is_empty() {
        series.extend(theory);
        let theory = match *measure == ITERATIONS {
            true => "Pale bands: if all of the error decayed at the slowest rate, ρ per sweep.",
            false => "Pale bands: the closed form.",
        };
        words.push(theory.into());
        let spots = shown.iter().filter_map(|curve| {
            let least = fine(curves, curve, measure)?.least;
            Some((&curve.name, Series::spot(&curve.name, "ω*", least).labeled(&curve.name)))
        });
        let spots: Vec<_> = spots.collect();
        if !spots.is_empty() {
            words.push("Rings: the best ω, by the closed form.".into());
            if measure.is_rate() {
                words.push(
                    "Near the best ω two eigenvalues coincide, and the factor measured over the sweeps of a run deviates \
                     from ρ."
                        .into(),
                );
            }
        }
        for (name, spot) in spots {
            // Its label names the curve where it is apart from the others.
            let curve = series.iter_mut().find(|own| own.name == *name);
            curve.into_iter().for_each(|own| own.end = Some(String::new()));
            series.push(spot);
        }
    }
    words.extend(step(shown).map(|step| format!("{} in steps of {step}.", curves.across)));
    if grid.axes.iter().any(|axis| axis.paths == [REPEAT]) {
        words.push("Each point is the median of its repetitions.".into());
    }
    if shown.len() < curves.curves.len() {
        words.push(format!("The first {} of {} curves.", shown.len(), curves.curves.len()));
    }
    let axis = |wide: bool, label: &str, unit: &str| match wide {
        true => Axis::log(label, unit),
        false => Axis::linear(label, unit),
    };
    let figure = Lines::new(
        format!("{id}{}", measure.name),
        capitalized(&finding),
        words.join(" "),
        axis(x.is_wide(), &curves.across, curves.unit()),
        match (y_wide, grid.scale) {
            (false, None) => Axis::fitting(label, unit, all.iter().map(|(_, y)| y.abs())),
            _ => axis(y_wide, label, unit),
        },
        series,
    );
    Some(figure.with_scales_explained())
}

/// A measure in words; of iterations only the kinds that the solvers count.
fn about(grid: &Grid, measure: &Measure) -> String {
    if *measure != ITERATIONS {
        return capitalized(measure.about);
    }
    let kinds = units(grid).join(", ");
    capitalized(&format!("{kinds} until the residual is within the tolerance"))
}

/// A measure in a few words; iterations as the solvers call them, if all use the same word.
fn counted(grid: &Grid, measure: &Measure) -> String {
    match units(grid)[..] {
        [unit] => measure.words.replace("iteration", unit.trim_end_matches('s')),
        _ => measure.words.into(),
    }
}

/// What the solvers of a grid count, each once.
fn units(grid: &Grid) -> Vec<&'static str> {
    let named = grid.values_of("solver.name").into_iter().map(plain);
    let mut units: Vec<&str> = named.map(|solver| unit(&solver)).collect();
    units.sort_unstable();
    units.dedup();
    if units.is_empty() { vec!["iterations"] } else { units }
}

/// Young's closed form of a curve at close positions, and its minimum.
struct Fine {
    points: Vec<(f64, f64)>,
    least: (f64, f64),
}

fn fine(curves: &Curves<'_>, curve: &Curve<'_>, measure: &Measure) -> Option<Fine> {
    let best = curves.optimum(curve)?;
    let predicted = curve.predicted(measure);
    let (x, y) = *predicted.iter().find(|(_, y)| y.is_finite())?;
    // ω* = 2/(1 + √(1 − ρ_J²))
    let jacobi = (1.0 - (2.0 / best - 1.0).powi(2)).sqrt();
    let rate = |omega: f64| sor_radius(jacobi, omega);
    let value = |omega: f64| match measure.is_rate() {
        true => rate(omega),
        false => y * rate(x).ln() / rate(omega).ln(),
    };
    let (from, to) = (predicted.first()?.0, predicted.last()?.0);
    let mut places: Vec<f64> =
        (0..=FINE).map(|k| from + (to - from) * k as f64 / FINE as f64).chain([best]).collect();
    places.sort_by(f64::total_cmp);
    let points = places.into_iter().map(|omega| (omega, value(omega))).collect();
    Some(Fine { points, least: (best, value(best)) })
}

/// The distance between positions, if there are many and it is always the same.
fn step(curves: &[Curve<'_>]) -> Option<String> {
    let places: Vec<f64> = curves.first()?.places().collect();
    let step = places.get(1)? - places[0];
    let is_even = places.windows(2).all(|pair| (pair[1] - pair[0] - step).abs() < 1e-9);
    (is_even && places.len() >= MANY).then(|| readable(step, 3))
}

/// The finding: the curves that end within the limit, if there is one; where the measure is least,
/// if every curve has its least value inside the axis; otherwise how the last values compare with
/// the first ones; where these have no ratio, as values of both signs, the largest value.
fn finding(
    grid: &Grid,
    curves: &Curves<'_>,
    measure: &Measure,
    series: &[Series],
) -> Option<String> {
    within(grid, curves, measure, series)
        .or_else(|| least(grid, curves, measure, series))
        .or_else(|| last_and_first(grid, curves, measure, series))
        .or_else(|| largest(curves, measure, series))
}

/// The curves that end within the limit of the grid.
fn within(grid: &Grid, curves: &Curves<'_>, measure: &Measure, all: &[Series]) -> Option<String> {
    let limit = grid.limit.filter(|_| measure == grid.measures[0])?;
    let (end, _) = all.first()?.points.last()?;
    let good = all.iter().filter(|own| own.points.last().is_some_and(|(_, y)| *y <= limit));
    let good: Vec<String> = good.map(|own| own.name.clone()).collect();
    let [end, limit] = [*end, limit].map(|value| readable(value, 2));
    (!good.is_empty()).then(|| {
        let (across, unit) = (&curves.across, curves.unit());
        let within = format!("the {} stays within {limit} {}", measure.words, measure.unit);
        format!("at {across} = {end} {unit} {within} with {}", listed(&good))
    })
}

/// How the place of the curves' least values moves from the first curve to the last one; of a rate,
/// how these values change, by the closed form if there is one. `None` for values of both signs,
/// whose least is the most negative, and where the ends of a curve are hardly larger.
fn least(grid: &Grid, curves: &Curves<'_>, measure: &Measure, series: &[Series]) -> Option<String> {
    let inside = |own: &Series| {
        let finite = || own.points.iter().filter(|(x, y)| x.is_finite() && y.is_finite());
        let (x, least) = finite().min_by(|a, b| a.1.total_cmp(&b.1))?;
        let ends = [finite().next()?.1, finite().next_back()?.1];
        let is_inside = *least >= 0.0 && ends.iter().all(|end| *end > DIP * least);
        let exact = curves.curves.iter().find(|curve| curve.name == own.name);
        let exact = exact.and_then(|curve| fine(curves, curve, measure));
        let least = exact.map_or(*least, |exact| exact.least.1);
        is_inside.then(|| (if measure.is_rate() { least } else { *x }, own.name.clone()))
    };
    let mut places: Vec<_> = series.iter().map(inside).collect::<Option<_>>()?;
    let across = &curves.across;
    let least = if *measure == ITERATIONS { "fewest" } else { "smallest" };
    let what = format!("{least} {}", counted(grid, measure));
    let rises = places.is_sorted_by(|a, b| a.0 <= b.0);
    let falls = places.is_sorted_by(|a, b| a.0 >= b.0);
    if !rises && !falls {
        places.sort_by(|a, b| a.0.total_cmp(&b.0));
    }
    let (first, last) = (places.first()?, places.last()?);
    let moves = match (rises, falls) {
        (true, true) if !measure.is_rate() => {
            return Some(format!("{what} at {across} = {}", readable(first.0, 3)));
        }
        (true, true) => return Some(format!("the {what} is {}", readable(first.0, 2))),
        (true, false) => "rises from",
        (false, true) => "falls from",
        (false, false) => "is between",
    };
    let to = if rises || falls { "to" } else { "and" };
    let place = |(x, name): &(f64, String)| format!("{} ({name})", readable(*x, 3));
    let is_exact = curves.curves.iter().any(|curve| fine(curves, curve, measure).is_some());
    let who = match measure.is_rate() {
        true if is_exact => format!("in theory the {what}"),
        true => format!("the {what}"),
        false => format!("the {across} with the {what}"),
    };
    Some(format!("{who} {moves} {} {to} {}", place(first), place(last)))
}

/// How the last value compares with the first one: on the curve of the largest ratio and on that of
/// the least, or where all values shrink, on the middle one.
fn last_and_first(
    grid: &Grid,
    curves: &Curves<'_>,
    measure: &Measure,
    series: &[Series],
) -> Option<String> {
    let ratio = |own: &Series| {
        let mut finite = own.points.iter().filter(|(x, y)| x.is_finite() && *y > 0.0);
        let (first, last) = (finite.next()?, finite.next_back()?);
        Some((last.1 / first.1, (first.0, last.0), own.name.clone()))
    };
    let mut ratios: Vec<_> = series.iter().filter_map(ratio).collect();
    ratios.sort_by(|a, b| a.0.total_cmp(&b.0));
    let [(least, _, lowest), .., (most, (from, to), highest)] = &ratios[..] else { return None };
    let (what, across) = (measure.words, &curves.across);
    if measure.is_rate() {
        let own = series.iter().find(|own| own.name == *highest)?;
        let mut finite = own.points.iter().filter(|(x, y)| x.is_finite() && *y > 0.0);
        let [first, last] = [finite.next()?.1, finite.next_back()?.1].map(|rate| readable(rate, 3));
        let moves = if *most > 1.0 { "rises" } else { "falls" };
        return Some(format!("the {what} of {highest} {moves} from {first} to {last}"));
    }
    let [start, end] = [*from, *to].map(|x| readable(x, 3));
    if *most < 1.0 {
        let after = match *from == 0.0 {
            true => format!("after {end} {across}"),
            false => format!("from {across} {start} to {end}"),
        };
        let (middle, _, between) = &ratios[ratios.len() / 2];
        let [middle, most] = [middle, most].map(|ratio| readable(100.0 * ratio, 3));
        return Some(format!(
            "{after} {middle} % of the {what} is left with {between}, {most} % with {highest}"
        ));
    }
    let range = match across.strip_prefix("number of ") {
        Some(things) => format!("from {start} to {end} {things}"),
        None => format!("from {across} {start} to {end}"),
    };
    if measure.is_cost() {
        let counted = |solver: &str| match *measure == ITERATIONS && units(grid).len() > 1 {
            true => unit(solver).into(),
            false => counted(grid, measure),
        };
        let other = match readable(*least, 2).as_str() {
            _ if *least < 1.05 => format!("no more {}", counted(lowest)),
            "2" => format!("twice the {}", counted(lowest)),
            ratio => format!("{ratio} times the {}", counted(lowest)),
        };
        return Some(format!(
            "{range} {highest} needs {} times the {}, {lowest} {other}",
            readable(*most, 2),
            counted(highest)
        ));
    }
    let grows = if what.ends_with('s') { "grow" } else { "grows" };
    let other = match readable(*least, 2).as_str() {
        "1" => format!("that of {lowest} stays the same"),
        ratio => format!("that of {lowest} {ratio} times"),
    };
    Some(format!("{range} the {what} of {highest} {grows} {} times; {other}", readable(*most, 2)))
}

/// What a solver counts: `sweeps`, `steps` or `pivots`.
fn unit(solver: &str) -> &'static str {
    Registry::standard().entry(solver).map_or("iterations", |entry| entry.group.unit())
}

/// The largest value.
fn largest(curves: &Curves<'_>, measure: &Measure, series: &[Series]) -> Option<String> {
    let values = series.iter().flat_map(|own| own.points.iter().map(move |point| (point, own)));
    let finite = values.filter(|((_, y), _)| y.is_finite());
    let ((x, y), own) = finite.max_by(|((_, a), _), ((_, b), _)| a.abs().total_cmp(&b.abs()))?;
    Some(format!(
        "the largest {} is {} ({}, {} {})",
        measure.words,
        format!("{} {}", readable(*y, 2), measure.unit).trim(),
        own.name,
        curves.across,
        readable(*x, 3)
    ))
}

/// The spread of values.
struct Spread {
    least: f64,
    most: f64,
    /// Whether they suggest a logarithmic axis.
    wide: bool,
}

impl Spread {
    /// The spread of these values.
    fn of(values: impl Iterator<Item = f64>) -> Self {
        let mut values: Vec<f64> = values.filter(|value| value.is_finite()).collect();
        values.sort_by(f64::total_cmp);
        values.dedup();
        let least = values.first().copied().unwrap_or(f64::INFINITY);
        let most = values.last().copied().unwrap_or(f64::NEG_INFINITY);
        let smallest = values.iter().copied().find(|value| *value > 0.0).unwrap_or(f64::INFINITY);
        let ratios = values.windows(2).map(|pair| (pair[1] / pair[0]).ln());
        let (closest, widest) = ratios
            .fold((f64::INFINITY, 0.0_f64), |(closest, widest), ratio| {
                (closest.min(ratio), widest.max(ratio))
            });
        let is_geometric = values.len() > 2 && least > 0.0 && widest <= EVEN * closest;
        let wide = least >= 0.0 && (most / smallest >= WIDE || is_geometric);
        Spread { least, most, wide }
    }

    /// Whether the values suggest a logarithmic axis and allow one.
    fn is_wide(&self) -> bool {
        self.wide && self.least > 0.0
    }
}
