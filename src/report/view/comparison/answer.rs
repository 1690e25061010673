//! What a comparison measured, in sentences.

use crate::number::readable;
use crate::report::study::comparison::{
    ASKEW, Comparison, EXACT, Energy, HELD, KEPT, Laws, Level, Levels, Phase, Run, Sample,
};

/// Significant digits.
const DIGITS: usize = 2;

/// What was measured of each level, and where it is exact.
pub fn answer(comparison: &Comparison) -> String {
    let Comparison { runs, steps, thinnest, levels, .. } = comparison;
    if runs.is_empty() {
        return "None of the named solvers supports this scene.".into();
    }
    let lead = format!(
        "Measured over {steps} steps. For each solver: whether every answer is accepted, and whether gaps \
         and joints stay closed to within {} m. For the solver with the most accepted answers: energy, \
         momentum, restitution and friction.",
        readable(HELD * thinnest, DIGITS)
    );
    let of_scheme = runs.chunk_by(|a, b| a.scheme == b.scheme);
    let schemes = of_scheme.map(|runs| of_scheme_in_words(runs, *steps, *thinnest));
    let levels = levels.iter().map(|levels| levels_in_words(levels, *thinnest));
    std::iter::once(lead).chain(schemes).chain(levels).collect::<Vec<_>>().join(" ")
}

/// The runs of one scheme.
fn of_scheme_in_words(runs: &[Run], steps: usize, thinnest: f64) -> String {
    let scheme = &runs[0].scheme;
    let candidates: Vec<&Run> = runs.iter().filter(|run| run.is_candidate()).collect();
    let most = candidates
        .iter()
        .copied()
        .reduce(|best, run| if run.accepted > best.accepted { run } else { best });
    let Some(best) = most else { return format!("{scheme}: no solver supports its problems.") };
    let says: Vec<String> =
        [closure(&candidates, steps, thinnest)].into_iter().chain(laws(best)).collect();
    let cause = best.laws.impact.as_ref().filter(|_| !keeps_energy(best));
    let cause = cause.map_or(String::new(), |impact| format!(" First, {impact}"));
    format!("{scheme}: {}.{cause}", says.join("; "))
}

/// How many solvers keep gaps and joints closed.
fn closure(runs: &[&Run], steps: usize, thinnest: f64) -> String {
    let closes: Vec<&Run> =
        runs.iter().copied().filter(|run| run.closes(steps, thinnest)).collect();
    let passages = runs.iter().map(|run| run.laws.passages).max().unwrap_or(0);
    let by = match (closes.len(), runs.len()) {
        (1, 1) => "closed".to_string(),
        (0, 1) => "not closed".to_string(),
        (closed, all) => format!("closed by {closed} of {all} solvers"),
    };
    let worst = |measure: fn(&Sample) -> f64| {
        closes.iter().map(|run| run.worst(measure)).fold(0.0, f64::max)
    };
    let error = worst(|sample| sample.drift.max(sample.penetration));
    let carried = closes.iter().filter_map(|run| run.carried).reduce(f64::min);
    let carried = carried.map_or(String::new(), |part| {
        format!(", {} % of the weight supported", readable(100.0 * part, 3))
    });
    let errors = match closes.len() {
        0 => String::new(),
        _ => format!(" (errors up to {} m{carried})", readable(error, DIGITS)),
    };
    let passed = match passages {
        0 => String::new(),
        1 => ", a body passed through another one".into(),
        count => format!(", bodies passed through each other {count} times"),
    };
    format!("{by}{errors}{passed}")
}

fn keeps_energy(run: &Run) -> bool {
    run.laws.keeps_energy(run.energy_at_end())
}

/// What one run kept of the laws.
fn laws(run: &Run) -> Vec<String> {
    let Laws { momentum, angular_momentum, restitution, askew, beyond, .. } = &run.laws;
    let kept = |what: &str, missing: f64, allowed: f64, of: &str| match missing <= allowed {
        true => format!("{what} kept"),
        false => format!("{what} off by {} %{of}", readable(100.0 * missing, DIGITS)),
    };
    let mut says = vec![energy(run)];
    says.extend(momentum.map(|missing| kept("momentum", missing, EXACT, "")));
    says.extend(angular_momentum.map(|missing| kept("angular momentum", missing, EXACT, "")));
    says.extend(restitution.map(|missing| kept("restitution", missing, KEPT, " of the approach")));
    says.extend(askew.map(|angle| match angle > ASKEW {
        true => format!("friction up to {angle:.0}° away from the slip"),
        false => "friction along the slip".into(),
    }));
    if *beyond > KEPT {
        says.push(format!("friction up to {:.0} % outside the cone", 100.0 * beyond));
    }
    says
}

/// The change of energy, whether it may be, and which account has most of it if not.
fn energy(run: &Run) -> String {
    let [end, most] =
        [run.energy_at_end(), run.energy_change()].map(|change| joules(change, run.laws.kinetic));
    let change = format!("energy change {end} J at the end, at most {most} J");
    let due = match (run.laws.energy, keeps_energy(run)) {
        (Energy::Stays, true) => return format!("{change}, conserved"),
        (_, true) => return change,
        (Energy::Stays, false) => "although the scene conserves energy",
        (_, false) => "although nothing adds energy",
    };
    match &run.laws.account {
        Some((account, part)) => {
            let part = joules(*part, run.laws.kinetic);
            format!("{change}, {due}; the largest part is due to {account} ({part} J)")
        }
        None => format!("{change}, {due}; the scheme {} records no energy ledger", run.scheme),
    }
}

/// A change of energy, 0 where it is rounding beside the kinetic energy.
fn joules(change: f64, kinetic: f64) -> String {
    match change.abs() <= 1e-12 * kinetic {
        true => "0".into(),
        false if change > 0.0 => format!("+{}", readable(change, DIGITS)),
        false => readable(change, DIGITS),
    }
}

/// The levels beside each other, and where each is exact.
fn levels_in_words(levels: &Levels, thinnest: f64) -> String {
    let length = |value: f64| match value <= 1e-12 * thinnest {
        true => "0 m".to_string(),
        false => format!("{} m", readable(value, DIGITS)),
    };
    let mut says = Vec::new();
    if let [first, .., last] = &levels.levels[..] {
        let apart = length(levels.apart);
        says.push(format!(
            "The final positions under {} and {} differ by {apart}.",
            first.scheme, last.scheme
        ));
    }
    let own = |level: &Level| format!("{} at {}", length(level.halved), level.scheme);
    let own = levels.levels.iter().map(own).collect::<Vec<_>>();
    says.push(format!("Half the step changes the final positions by {}.", own.join(", by ")));
    says.extend(Phase::ALL.into_iter().filter_map(|phase| phase_in_words(levels, phase)));
    says.join(" ")
}

/// Who is exact where bodies do this; nothing where they never do.
fn phase_in_words(levels: &Levels, phase: Phase) -> Option<String> {
    let errors = levels.levels.iter().filter_map(|level| {
        level.errors[phase as usize].map(|error| (level.scheme.as_str(), error))
    });
    let errors: Vec<(&str, f64)> = errors.collect();
    if errors.is_empty() {
        return None;
    }
    let own = |(scheme, error): &(&str, f64)| match *error <= EXACT {
        true => format!("{scheme} is exact"),
        false => format!("{scheme} is off by {} %", readable(100.0 * error, DIGITS)),
    };
    let is_off = errors.iter().any(|(_, error)| *error > EXACT);
    let of = if is_off { format!(" {}", phase.of()) } else { String::new() };
    let own = errors.iter().map(own).collect::<Vec<_>>();
    Some(format!("When bodies {}, {}{of}.", phase.verb(), own.join(", ")))
}
