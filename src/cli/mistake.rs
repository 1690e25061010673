//! The mistakes behind an answer, as text and as JSON.

use lcplab::diagnosis::{Conclusion, Mistake, MistakeKind, MistakeSearch, Precision};
use lcplab::lcp::file::number;
use lcplab::number::readable;
use serde_json::{Value, json};

/// An answer with at most this many digits may come from a mistake that lcplab does not know.
const FEW_DIGITS: i32 = 3;

/// The list of known mistakes.
pub fn known(as_json: bool) -> String {
    if as_json {
        let entry = |kind: &MistakeKind| json!({ "name": kind.name(), "computes": kind.computes(), "check": kind.check() });
        let all: Vec<Value> = MistakeKind::ALL.iter().map(entry).collect();
        return format!("{:#}\n", json!({ "mistakes": all }));
    }
    let entry = |kind: &MistakeKind| {
        format!("{}\n  {}\n  {}\n", kind.name(), kind.computes(), kind.check())
    };
    MistakeKind::ALL.iter().map(entry).collect()
}

/// The result of the search, as text.
pub fn words(search: &MistakeSearch, single: Option<[f64; 2]>) -> String {
    let verdict = format!("{}\n", search.verdict);
    let share = |distance: f64| format!("{} of the largest entry", readable(distance, 2));
    let conclusion = match search.conclusion {
        Conclusion::Accepted => return verdict,
        Conclusion::NotFinite { row } => {
            return format!(
                "{verdict}lcplab did not look for mistakes: entry {row} of x is not a finite number.\n"
            );
        }
        Conclusion::TooManyRows { limit } => {
            format!("lcplab did not look for mistakes: the problem has more than {limit} rows.\n")
        }
        Conclusion::NoSolutionKnown => {
            "lcplab names no mistake: it found no solution of the problem to compare with x.\n"
                .into()
        }
        Conclusion::RoundedSolution { distance } => format!(
            "lcplab names no mistake: x is an exact solution rounded to {}; the difference is {}.\n",
            precision(search.precision),
            share(distance)
        ),
        Conclusion::Compared { solution_distance } => {
            let solution = format!(
                "The nearest exact solution differs from x by {}.\n",
                share(solution_distance)
            );
            found(&search.mistakes) + &few_digits(search) + &solution + &limits(search)
        }
    };
    verdict + &conclusion + &single.map_or_else(String::new, single_precision)
}

/// The mistakes that give x.
fn found(mistakes: &[Mistake]) -> String {
    let agrees = |mistake: &Mistake| match mistake.distance {
        0.0 => "exactly".to_string(),
        distance => format!("to {} of the largest entry", readable(distance, 2)),
    };
    let named = match mistakes {
        [] => "No known mistake gives this x.\n".into(),
        [only] => format!("A known mistake gives this x, {}: {}.\n", agrees(only), only.what),
        all => {
            let line = |mistake: &Mistake| format!("  {} ({})\n", mistake.what, agrees(mistake));
            let lines: String = all.iter().map(line).collect();
            format!("{} known mistakes give this x equally well:\n{lines}", all.len())
        }
    };
    named + &checks(mistakes)
}

/// What to check for each kind of mistake, with its name in the list of known ones.
fn checks(mistakes: &[Mistake]) -> String {
    let mut kinds: Vec<MistakeKind> = Vec::new();
    for mistake in mistakes {
        if !kinds.contains(&mistake.kind) {
            kinds.push(mistake.kind);
        }
    }
    kinds.iter().map(|kind| format!("{}: {}\n", sentence(kind.name()), kind.check())).collect()
}

/// A phrase with a capital letter at its beginning.
fn sentence(phrase: &str) -> String {
    let mut letters = phrase.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}

/// A note that an answer with few digits may have other causes.
fn few_digits(search: &MistakeSearch) -> String {
    match search.precision {
        Precision::Decimal { digits, .. }
            if digits <= FEW_DIGITS && !search.mistakes.is_empty() =>
        {
            format!(
                "x has only {}: other mistakes may also give it.\n",
                precision(search.precision)
            )
        }
        _ => String::new(),
    }
}

/// The number of sweeps that were compared.
fn limits(search: &MistakeSearch) -> String {
    format!(
        "lcplab compared x with the first {} iterates of each method, and with the first {} on each problem changed \
         by a known mistake; `lcplab diagnose --mistakes` lists them.\n",
        search.limits.of_problem, search.limits.of_changed
    )
}

fn precision(precision: Precision) -> String {
    match precision {
        Precision::Double => "double precision".into(),
        Precision::Single => "single precision".into(),
        Precision::Decimal { digits: 1, .. } => "1 significant digit".into(),
        Precision::Decimal { digits, .. } => format!("{digits} significant digits"),
    }
}

/// Whether single precision explains the residual.
fn single_precision([own, least]: [f64; 2]) -> String {
    // Even if the solution is representable in single precision, sums can be rounded.
    let limit = 10.0 * least.max(f64::from(f32::EPSILON));
    let word = if own <= limit { "as good as" } else { "worse than" };
    format!(
        "The scaled residual {} is {word} single precision allows: the solution rounded to single precision has {}.\n",
        readable(own, 2),
        readable(least, 2)
    )
}

/// The result of the search, as JSON.
pub fn to_json(search: &MistakeSearch, single: Option<[f64; 2]>) -> Value {
    let mistake = |own: &Mistake| {
        json!({
            "kind": own.kind.name(), "what": own.what, "distance": own.distance, "check": own.kind.check(),
        })
    };
    let (conclusion, solution_distance) = match search.conclusion {
        Conclusion::Accepted => ("accepted", None),
        Conclusion::NotFinite { .. } => ("not finite", None),
        Conclusion::TooManyRows { .. } => ("too many rows", None),
        Conclusion::NoSolutionKnown => ("no solution known", None),
        Conclusion::RoundedSolution { distance } => ("rounded solution", Some(distance)),
        Conclusion::Compared { solution_distance } => ("compared", Some(solution_distance)),
    };
    json!({
        "verdict": search.verdict.word(),
        "conclusion": conclusion,
        "precision": precision(search.precision),
        "solution_distance": solution_distance,
        "sweeps_compared": { "problem": search.limits.of_problem, "changed": search.limits.of_changed },
        "mistakes": search.mistakes.iter().map(mistake).collect::<Vec<_>>(),
        "single_precision": single.map(|[own, least]| {
            json!({ "residual": number(own), "rounded_solution": number(least) })
        }),
    })
}
