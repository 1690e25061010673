//! What a comparison measured, in sentences.

use crate::number::{capitalized, readable};
use crate::report::study::comparison::{
    Comparison, EXACT, Energy, FRICTION_ANGLE, HELD, LAW_TOLERANCE, LevelRefinement, Levels, Phase,
    Run, RunLaws, Sample, best,
};
use crate::scene::Scheme;

/// Significant digits.
const DIGITS: usize = 2;

/// What was measured of each level, of both levels together, and how: a paragraph each.
pub fn answer(comparison: &Comparison) -> String {
    let Comparison { runs, steps, thinnest, levels, .. } = comparison;
    if runs.is_empty() {
        return "None of the named solvers supports this scene.".into();
    }
    let method = format!(
        "Measured over {steps} steps. For each solver: whether the judge accepts every answer, and \
         whether drift and penetration stay within {} m. For the solver with the most steps and the \
         fewest rejected answers: energy, momentum, restitution and friction.",
        readable(HELD * thinnest, DIGITS)
    );
    let of_scheme = runs.chunk_by(|a, b| a.scheme == b.scheme);
    let schemes = of_scheme.map(|runs| of_scheme_in_words(runs, *steps, *thinnest));
    let levels = levels.iter().map(|levels| levels_in_words(levels, *thinnest));
    schemes.chain(levels).chain([method]).collect::<Vec<_>>().join("\n\n")
}

/// The runs of one scheme.
fn of_scheme_in_words(runs: &[Run], steps: usize, thinnest: f64) -> String {
    let scheme = &runs[0].scheme;
    let Some(best) = best(runs) else {
        return format!("{scheme}: no solver supports its problems.");
    };
    let mut says = vec![closure(runs, steps, thinnest)];
    match best.steps {
        0 => {}
        taken if taken < steps => says.push(format!("in {taken} steps: {}", laws(best).join("; "))),
        _ => says.extend(laws(best)),
    }
    let cause = best.laws.impact.as_ref().filter(|_| !best.laws.keeps_energy());
    let cause = cause.map_or(String::new(), |impact| format!(" First, {impact}"));
    let lost =
        best.laws.lost_bounces.as_ref().map_or(String::new(), |lost| format!(" Note: {lost}."));
    format!("{scheme}: {}.{cause}{lost}", says.join("; "))
}

/// How many solvers keep gaps and joints within tolerance, and why the others do not.
fn closure(runs: &[Run], steps: usize, thinnest: f64) -> String {
    let runs: Vec<&Run> = runs.iter().filter(|run| run.is_candidate()).collect();
    let mut criteria: Vec<(&str, usize)> = Vec::new();
    let (mut closed, mut error) = (0, 0.0_f64);
    for run in &runs {
        match run.failing_criterion(steps, thinnest) {
            None => {
                closed += 1;
                error =
                    error.max(run.worst(|sample: &Sample| sample.drift.max(sample.penetration)));
            }
            Some(criterion) => match criteria.iter_mut().find(|own| own.0 == criterion) {
                Some(known) => known.1 += 1,
                None => criteria.push((criterion, 1)),
            },
        }
    }
    let mut notes = Vec::new();
    if closed > 0 {
        notes.push(format!("errors up to {} m", readable(error, DIGITS)));
    }
    notes.extend(criteria.iter().map(|(criterion, count)| format!("{criterion}: {count}")));
    let all = runs.len();
    let solvers = if all == 1 { "solver" } else { "solvers" };
    let notes = notes.join(", ");
    format!("gaps and joints within tolerance for {closed} of {all} {solvers} ({notes})")
}

/// What one run kept of the laws.
fn laws(run: &Run) -> Vec<String> {
    let RunLaws { momentum, angular_momentum, restitution, friction_angle, cone_excess, .. } =
        &run.laws;
    let kept = |what: &str, error: f64, allowed: f64, of: &str| match error <= allowed {
        true => format!("{what} kept"),
        false => format!("{what} off by up to {} %{of}", readable(100.0 * error, DIGITS)),
    };
    let support = run.carried.map(|part| {
        format!(
            "average support force {} % of the weight",
            readable((1e4 * part).round() / 100.0, 4)
        )
    });
    let mut says: Vec<String> = support.into_iter().chain([energy(run)]).collect();
    says.extend(momentum.map(|error| kept("momentum", error, EXACT, "")));
    says.extend(angular_momentum.map(|error| kept("angular momentum", error, EXACT, "")));
    says.extend(
        restitution.map(|error| kept("restitution", error, LAW_TOLERANCE, " of the approach")),
    );
    says.extend(friction_angle.map(|angle| match angle > FRICTION_ANGLE {
        true => format!("friction up to {angle:.0}° from the direction opposite to sliding"),
        false => "friction opposite to sliding".into(),
    }));
    if *cone_excess > LAW_TOLERANCE {
        says.push(format!("friction up to {:.0} % outside the cone", 100.0 * cone_excess));
    }
    says
}

/// The change of energy, whether it is allowed, and the account that explains it if not.
fn energy(run: &Run) -> String {
    let own = &run.laws;
    let joules = |change: f64| joules(change, own.kinetic);
    let [end, most] = [run.energy_at_end(), run.energy_change()].map(joules);
    let change = format!("energy change {end} J at the end (largest: {most} J)");
    let at_end = if run.scheme == Scheme::Penalty.name() { " at the end" } else { "" };
    let error = readable(own.energy_error.abs(), DIGITS);
    let fault = match (own.energy, own.keeps_energy()) {
        (Energy::Changes, _) => {
            return format!("{change}; not judged, because a motor, force or moving support acts");
        }
        (Energy::Stays, true) => return format!("{change}; energy is conserved{at_end}"),
        (Energy::Falls, true) => return format!("{change}; no energy was added{at_end}"),
        _ if own.energy_error > 0.0 => {
            format!("{error} J were added{at_end}, although nothing drives the bodies")
        }
        _ => format!("{error} J were lost{at_end}, although nothing dissipates energy"),
    };
    let cause = match &own.account {
        Some((account, part)) => {
            format!("the largest contribution is the account {account}: {} J", joules(*part))
        }
        None if own.has_ledger => "no single account explains it".into(),
        None => format!("{} has no energy ledger", run.scheme),
    };
    format!("{change}; {fault}; {cause}")
}

/// A change of energy, 0 where it is rounding compared with the kinetic energy.
fn joules(change: f64, kinetic: f64) -> String {
    match change.abs() <= 1e-12 * kinetic {
        true => "0".into(),
        false if change > 0.0 => format!("+{}", readable(change, DIGITS)),
        false => readable(change, DIGITS),
    }
}

/// The levels compared with each other and with a divided step.
fn levels_in_words(levels: &Levels, thinnest: f64) -> String {
    let length = |value: f64| match value <= 1e-12 * thinnest {
        true => "0 m".to_string(),
        false => format!("{} m", readable(value, DIGITS)),
    };
    let mut says = Vec::new();
    if let [first, .., last] = &levels.levels[..] {
        let apart = length(levels.apart);
        let (first, last) = (at(&first.scheme), at(&last.scheme));
        says.push(format!("The final positions {first} and {last} differ by {apart}."));
    }
    let own =
        |level: &LevelRefinement| format!("by {} {}", length(level.halved), at(&level.scheme));
    let own = levels.levels.iter().map(own).collect::<Vec<_>>();
    says.push(format!("Halving the step changes the final positions {}.", own.join(" and ")));
    says.extend(Phase::ALL.into_iter().filter_map(|phase| phase_in_words(levels, phase)));
    says.join(" ")
}

/// A scheme in a sentence.
fn at(scheme: &str) -> String {
    match scheme {
        "velocity" | "acceleration" => format!("at {scheme} level"),
        scheme => format!("with the scheme {scheme}"),
    }
}

/// How large the error of each level is where bodies do this; nothing where they never do. Levels
/// with the same error share a sentence.
fn phase_in_words(levels: &Levels, phase: Phase) -> Option<String> {
    let (subject, passes, fails) = match phase {
        Phase::Meet => (
            "impacts",
            "do not change when the step is divided (to 1e-6)",
            "of the approach in a step",
        ),
        Phase::Spin => (
            "bodies that spin freely",
            "keep their angular momentum and energy (to 1e-6)",
            "of the angular momentum or energy in a step",
        ),
        Phase::Rest => (
            "resting bodies",
            "stay in contact (to 1e-6)",
            "of the thinnest body, by gaps or overlaps",
        ),
    };
    let mut said: Vec<(String, Vec<String>)> = Vec::new();
    for level in &levels.levels {
        let Some(error) = level.errors[phase as usize] else { continue };
        let mistimed = level.mistimed.filter(|&time| phase == Phase::Meet && time > EXACT);
        let time = mistimed.map(|time| {
            let part = readable(100.0 * time, DIGITS);
            format!("come up to {part} % of a step too early or too late")
        });
        let rest = match error <= EXACT {
            true if time.is_some() => None,
            true => Some(passes.to_string()),
            false => Some(format!("are off by {} % {fails}", readable(100.0 * error, DIGITS))),
        };
        let words: Vec<String> = time.into_iter().chain(rest).collect();
        let (words, place) = (words.join(" and "), at(&level.scheme));
        match said.iter_mut().find(|(known, _)| *known == words) {
            Some((_, places)) => places.push(place),
            None => said.push((words, vec![place])),
        }
    }
    let sentence = |(words, places): (String, Vec<String>)| {
        let place = match &places[..] {
            [one, other] if [one, other].iter().all(|own| own.ends_with(" level")) => {
                "at both levels".into()
            }
            places => places.join(" and "),
        };
        format!("{}, {subject} {words}.", capitalized(&place))
    };
    let sentences: Vec<String> = said.into_iter().map(sentence).collect();
    (!sentences.is_empty()).then(|| sentences.join(" "))
}
