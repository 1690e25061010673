//! `compare --profile`: a performance profile for a paper.

use std::path::Path;

use lcplab::csv;
use lcplab::error::Result;
use lcplab::file;
use lcplab::plot::profile::{Curve, Group as Line, Profiles};
use lcplab::plot::{Axis, Figure};
use lcplab::report::study::families::Row;
use lcplab::report::study::profiles::{Cost, Profile, of_all, profiles};

/// Writes NAME.svg, NAME.csv and NAME.tex: two of Dolan & Moré's profiles of the wall times. In the
/// first one, a problem that a solver did not attempt counts as unsolved; the second one has only
/// the problems that the solver attempted.
pub fn write(name: &Path, rows: &[Row]) -> Result<()> {
    let solvers = distinct(rows.iter().map(|row| row.solver.as_str()));
    let costs = costs(rows, &solvers);
    let (of_all, of_its_own) = (profiles(&of_all(&costs)), profiles(&costs));
    let figure = figure(&solvers, &of_all, &of_its_own);
    let (folder, stem) = (file::folder_of(name), name.file_stem().unwrap_or_default());
    let write = |ending: &str, text: String| {
        let mut own = stem.to_os_string();
        own.push(ending);
        file::write_in(&folder, own, text)
    };
    write(".svg", figure.svg())?;
    write(".csv", figure.csv())?;
    write(".tex", latex(&solvers, &of_all, &of_its_own, costs.len()))?;
    write("_problems.csv", problems(rows))
}

/// The result of every solver on every problem, as CSV.
fn problems(rows: &[Row]) -> String {
    let mut text = String::new();
    let columns = [
        "problem",
        "model",
        "solver",
        "solved",
        "iterations",
        "multiplications",
        "time (s)",
        "reason",
    ];
    csv::record(&mut text, columns);
    for row in rows {
        csv::record(
            &mut text,
            [
                row.family.clone(),
                row.model.clone().unwrap_or_default(),
                row.solver.clone(),
                format!("{} of {}", row.accepted.min(row.claimed), row.problems),
                row.iterations.to_string(),
                row.multiplications.map(csv::number).unwrap_or_default(),
                csv::number(row.seconds),
                row.trouble.clone().unwrap_or_default(),
            ],
        );
    }
    text
}

fn distinct<'a>(names: impl Iterator<Item = &'a str>) -> Vec<&'a str> {
    let mut found = Vec::new();
    for name in names {
        if !found.contains(&name) {
            found.push(name);
        }
    }
    found
}

/// The costs by problem or family under a model, and then by solver, without those that no solver
/// solved.
fn costs(rows: &[Row], solvers: &[&str]) -> Vec<Vec<Cost>> {
    let mut posings: Vec<(&str, Option<&str>)> = Vec::new();
    for row in rows {
        let posing = (row.family.as_str(), row.model.as_deref());
        if !posings.contains(&posing) {
            posings.push(posing);
        }
    }
    let cost = |posing: &(&str, Option<&str>), solver: &str| {
        let is_it = |row: &&Row| {
            (row.family.as_str(), row.model.as_deref()) == *posing && row.solver == solver
        };
        match rows.iter().find(is_it) {
            None => Cost::NotTried,
            Some(row) if row.outside == row.problems => Cost::NotTried,
            Some(row) if row.claimed == row.problems && row.accepted == row.problems => {
                Cost::Solved(row.seconds.max(f64::MIN_POSITIVE))
            }
            Some(_) => Cost::Failed,
        }
    };
    let of = |posing: &(&str, Option<&str>)| -> Vec<Cost> {
        solvers.iter().map(|solver| cost(posing, solver)).collect()
    };
    let costs = posings.iter().map(of);
    costs.filter(|row| row.iter().any(|cost| matches!(cost, Cost::Solved(_)))).collect()
}

fn figure(solvers: &[&str], of_all: &[Profile], of_its_own: &[Profile]) -> Profiles {
    let curve = |solver: usize| Curve {
        name: solvers[solver].to_string(),
        columns: [of_all, of_its_own]
            .map(|profiles| (profiles[solver].steps.clone(), profiles[solver].attempted))
            .into(),
    };
    let all = Line { name: String::new(), curves: (0..solvers.len()).map(curve).collect() };
    Profiles {
        id: "profile".into(),
        title: "Performance profiles of the wall times".into(),
        caption: String::new(),
        x: Axis::log("τ: wall time relative to the fastest solver", ""),
        y: Axis::linear("share solved", ""),
        columns: vec!["of all problems".into(), "of the problems attempted".into()],
        groups: vec![all],
    }
}

/// The ends of the profiles as a table.
fn latex(solvers: &[&str], of_all: &[Profile], of_its_own: &[Profile], problems: usize) -> String {
    let at_most = |profile: &Profile, tau: f64| {
        let steps = profile.steps.iter().take_while(|(at, _)| *at <= tau);
        100.0 * steps.last().map_or(0.0, |(_, share)| *share)
    };
    let mut text = "% Percent of the PROBLEMS problems that each solver solved: faster than all others, within ten times the time\n\
                    % of the fastest, and at all; the number of problems that it attempted, and the percent of these solved.\n\
                    \\begin{tabular}{lrrrrr}\n\
                    solver & fastest & within 10$\\times$ & solved & attempted & solved of these \\\\\n\
                    \\hline\n"
        .replace("PROBLEMS", &problems.to_string());
    for ((name, all), own) in solvers.iter().zip(of_all).zip(of_its_own) {
        let [fastest, near, solved] = [1.0, 10.0, f64::INFINITY].map(|tau| at_most(all, tau));
        let of_these = at_most(own, f64::INFINITY);
        let name = name.replace('_', "\\_");
        text += &format!(
            "{name} & {fastest:.0} & {near:.0} & {solved:.0} & {} & {of_these:.0} \\\\\n",
            own.attempted
        );
    }
    text + "\\end{tabular}\n"
}
