//! The mistakes behind an answer, as text and as JSON.

use lcplab::diagnosis::{Conclusion, Mistake, MistakeKind, MistakeSearch, Precision};
use lcplab::lcp::file::number;
use lcplab::number::{capitalized, count, counted, readable};
use serde_json::{Value, json};

/// Scaled residuals below this are compared with those of single precision.
const ROUNDING_LIKE: f64 = 1e-3;

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
            "lcplab names no mistake: it knows no solution of the problem to compare with x. \
             Without an answer, `lcplab diagnose` says whether the problem has one.\n"
                .into()
        }
        Conclusion::RoundedSolution { distance } => format!(
            "lcplab names no mistake: x is an exact solution rounded to {}; the difference is {}.\n",
            precision(search.precision),
            share(distance)
        ),
        Conclusion::Compared { solution_distance } => {
            let solution = format!(
                "x differs from the nearest exact solution found by up to {} % of its largest entry.\n",
                readable(100.0 * solution_distance, 2)
            );
            let is_found = !search.mistakes.is_empty();
            found(search) + &solution + &if is_found { String::new() } else { limits(search) }
        }
    };
    verdict + &conclusion + &single.map_or_else(String::new, single_precision)
}

/// The mistakes that give x.
fn found(search: &MistakeSearch) -> String {
    let agrees = |mistake: &Mistake| match mistake.distance {
        0.0 => "exactly".to_string(),
        distance => format!("to {} of the largest entry", readable(distance, 2)),
    };
    let may_be_chance = search.mistakes.iter().all(|mistake| mistake.may_be_chance);
    let named = match &search.mistakes[..] {
        [] => return none_found(search.redundant_rows),
        [only] => {
            let gives = if may_be_chance { "may have given" } else { "gives" };
            let this_x = match only.distance {
                0.0 => "exactly this x".to_string(),
                _ => format!("this x, {}", agrees(only)),
            };
            format!("A known mistake {gives} {this_x}: {}.\n", only.what)
        }
        all => {
            let line = |mistake: &Mistake| format!("  {} ({})\n", mistake.what, agrees(mistake));
            let lines: String = all.iter().map(line).collect();
            let give = if may_be_chance { "may have given" } else { "give" };
            format!("{} known mistakes {give} this x equally well:\n{lines}", all.len())
        }
    };
    let doubt = match may_be_chance {
        true => format!(
            "x has only {}, so the agreement may be chance, or another mistake gives the same x.\n",
            precision(search.precision)
        ),
        false => String::new(),
    };
    named + &doubt + &checks(&search.mistakes)
}

/// No mistake; with redundant rows one may remain unknown.
fn none_found(redundant_rows: usize) -> String {
    match redundant_rows {
        0 => "No known mistake was found that gives this x.\n".into(),
        rows => format!(
            "No known mistake was found that gives this x. The problem has {}, so forces need not be \
             unique: a solver with a mistake may return other forces than those that lcplab compared.\n",
            counted(rows, "redundant row")
        ),
    }
}

/// What to check for each kind of mistake, with its name in the list of known ones.
fn checks(mistakes: &[Mistake]) -> String {
    let mut kinds: Vec<MistakeKind> = Vec::new();
    for mistake in mistakes {
        if !kinds.contains(&mistake.kind) {
            kinds.push(mistake.kind);
        }
    }
    kinds.iter().map(|kind| format!("{}: {}\n", capitalized(kind.name()), kind.check())).collect()
}

/// The number of sweeps that were compared.
fn limits(search: &MistakeSearch) -> String {
    format!(
        "lcplab compared x with the first {} iterates of each method, and with the first {} on each problem changed \
         by a known mistake; `lcplab diagnose --mistakes` lists them.\n",
        count(search.limits.of_problem),
        count(search.limits.of_changed)
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

/// Whether single precision explains the residual; empty if it is obviously more than rounding.
pub fn single_precision([own, least]: [f64; 2]) -> String {
    if own >= ROUNDING_LIKE {
        return String::new();
    }
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
            "kind": own.kind.name(), "what": own.what, "distance": own.distance,
            "may_be_chance": own.may_be_chance, "check": own.kind.check(),
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
