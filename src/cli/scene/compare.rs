//! `compare`: a scene stepped by every solver, each answer judged.

use std::path::PathBuf;

use clap::Args;
use lcplab::error::Result;
use lcplab::file;
use lcplab::lcp::friction::Model;
use lcplab::memory::Memory;
use lcplab::report::study::comparison::{self, LeftOut, Sample};
use lcplab::report::study::film::{self, Actor};
use lcplab::report::{methods, text, view, write};
use lcplab::scene::Scheme;
use lcplab::solver::{self, Method};
use serde_json::json;

use super::SceneArgs;
use crate::cli::limits::Limits;
use crate::cli::{Outcome, bar, print, say};

/// Step a scene with every solver, and judge every answer
#[derive(Debug, Args)]
#[command(after_help = "\
Example:
  lcplab compare stack --steps 20 --out stack-report

By default all solvers step the scene, at the velocity and at the acceleration level; --solver and --scheme
select one. Schemes that solve no LCP have one row. Only solvers that can handle the friction model run,
and only levels that know it; a solver that you name and that cannot has a row with the reason.
It measures whether gaps and joints stay closed, energy, momentum, restitution and the direction of friction, and
compares the levels with each other and with half the step: where bodies meet, spin and rest.
With --out the folder gets a page with a film of the solvers side by side, the table and the plots.
The film shows one solver of each set with the same motion, or those named by --show:
  lcplab compare stack --show pgs:5 --show dantzig --out stack-report   # five sweeps beside exact
Exit code 1 if the judge rejects a solver's claim or if none of the solvers that you name takes part, 2 for
bad input; a solver that admits failure is a row of the table.")]
pub struct Compare {
    #[command(flatten)]
    scene: SceneArgs,
    /// Number of steps [default: the scene's]
    #[arg(long)]
    steps: Option<usize>,
    /// Folder for a page with film, table and plots
    #[arg(long)]
    out: Option<PathBuf>,
    /// Solver in the film, with its most sweeps after a colon if they are not the scene's; repeatable
    #[arg(long, value_name = "SOLVER[:SWEEPS]", requires = "out")]
    show: Vec<String>,
    /// Print one JSON object
    #[arg(long)]
    json: bool,
}

impl Compare {
    pub fn run(&self, limits: &Limits) -> Result<Outcome> {
        let plugins = self.scene.plugins.start()?;
        let scene = self.scene.load(self.scene.solver.as_deref())?;
        let steps = self.steps.unwrap_or(scene.step.count);
        let schemes = match self.scene.scheme {
            Some(scheme) => vec![scheme],
            None => Scheme::LEVELS.to_vec(),
        };
        let named = self.scene.solver.as_deref().into_iter();
        let named: Vec<&str> =
            named.chain(plugins.iter().map(|plugin| -> &str { plugin.name() })).collect();
        let (mut solvers, mut left_out) = match self.scene.solver {
            Some(_) => (Vec::new(), Vec::new()),
            None => (solver::methods(), Vec::new()),
        };
        for name in &named {
            match takes_part(name, &schemes, scene.contact.model)? {
                Ok(method) => solvers.push(method),
                Err(reason) => left_out.push(LeftOut { solver: name.to_string(), reason }),
            }
        }
        let contenders = comparison::contenders(&scene, &schemes, &solvers);
        let running: Vec<Method> = contenders.iter().map(|(_, solver)| *solver).collect();
        self.scene.check(&running, &scene)?;
        let shown = self.show.iter().map(|name| Actor::named(name, &scene));
        let shown = shown.collect::<Result<Vec<Actor>>>()?;
        let what = format!("the motion of {} runs of {steps} steps", contenders.len());
        let samples = Memory::bytes(size_of::<Sample>() as u64).times(steps);
        scene.memory.check(what, samples.times(contenders.len()))?;
        if let Some(folder) = &self.out {
            file::prepare(folder, &write::WRITTEN)?;
        }
        let progress = bar(contenders.len() as u64, &scene.name);
        let stop = limits.stop();
        let (mut comparison, timings) = comparison::compare_families(
            &scene,
            &schemes,
            &solvers,
            steps,
            &|| progress.inc(1),
            stop,
        )?;
        comparison.left_out = left_out;
        comparison.add_levels(&scene, &solvers, stop);
        let is_whole = comparison.runs.len() == contenders.len()
            && comparison.runs.iter().all(|run| run.steps == steps);
        let stopped = stop.reason().filter(|_| !is_whole);
        limits.over();
        progress.finish_and_clear();
        let has_runs = !comparison.runs.is_empty();
        let written = self.out.as_ref().filter(|_| has_runs).map(|folder| {
            let actors = match shown.is_empty() {
                true => film::alike(&contenders, &view::alike(&comparison.runs)),
                false => shown.into_iter().map(|actor| (actor.name(), actor)).collect(),
            };
            let film = film::film("film", &scene, &actors, steps, stop);
            write::document(&view::comparison_document(&comparison, film), folder)
        });
        if self.json {
            print(&format!(
                "{}\n",
                json!({ "answer": view::comparison_answer(&comparison), "comparison": comparison, "timings": timings })
            ))?;
        } else {
            print(&format!("{}\n", view::comparison_answer(&comparison)))?;
            print(&text::table(&view::comparison_table(&comparison)))?;
        }
        if let Some(page) = written {
            say(&page?.display().to_string());
        }
        let refuted =
            comparison.runs.iter().any(|run| run.refuted_claims > 0 || run.unanswered > 0);
        let all_left_out = !named.is_empty() && comparison.left_out.len() == named.len();
        Ok(match stopped {
            Some(reason) => Outcome::Stopped(reason),
            None if refuted || all_left_out => Outcome::Refuted,
            None => Outcome::Good,
        })
    }
}

/// The method of a solver that was named, or why it takes no part.
///
/// # Errors
/// If there is no solver of this name.
fn takes_part(
    name: &str,
    schemes: &[Scheme],
    model: Model,
) -> Result<std::result::Result<Method, String>> {
    let methods = methods::named(name)?;
    if let [scheme] = schemes
        && !scheme.solves_lcps()
    {
        return Ok(Err(format!("the scheme {} solves no LCP", scheme.name())));
    }
    let taking = methods.iter().find(|method| comparison::refusal(method, model).is_none());
    let reason = || methods.iter().find_map(|method| comparison::refusal(method, model));
    Ok(taking.copied().ok_or_else(|| reason().unwrap_or_default()))
}
