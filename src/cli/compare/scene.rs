//! `compare` on a scene: simulated by every solver, each answer judged.

use std::path::PathBuf;

use clap::Args;
use lcplab::error::{Error, Result};
use lcplab::file;
use lcplab::lcp::friction::Model;
use lcplab::memory::Memory;
use lcplab::report::study::comparison::{self, LeftOut, Sample};
use lcplab::report::study::families::Contender;
use lcplab::report::study::side_by_side::{self, AnimatedSolver};
use lcplab::report::{terminal, view, write};
use lcplab::scene::Scheme;
use lcplab::solver::{Method, Registry};
use serde_json::json;

use super::Compare;
use crate::cli::limits::Limits;
use crate::cli::scene::SceneArgs;
use crate::cli::{Outcome, bar, print, say};

/// Options of a comparison on a scene.
#[derive(Debug, Args)]
pub struct MotionArgs {
    /// Number of steps [default: the scene's]
    #[arg(long)]
    steps: Option<usize>,
    /// Folder for a page with animation, table and plots [default: no page]
    #[arg(long)]
    out: Option<PathBuf>,
    /// Show this solver in the animation, with another iteration limit after a colon (repeatable)
    #[arg(long, value_name = "SOLVER[:SWEEPS]", requires = "out")]
    show: Vec<String>,
}

impl MotionArgs {
    /// The first option that is given.
    pub fn given(&self) -> Option<&'static str> {
        let steps = self.steps.is_some().then_some("--steps");
        steps.or(self.out.is_some().then_some("--out"))
    }
}

impl Compare {
    pub(super) fn on_scene(self, name: String, limits: &Limits) -> Result<Outcome> {
        let Compare { solver, model, json, plugins, solve, step, motion, .. } = self;
        let ([] | [_]) = &model[..] else {
            return Err(Error::invalid(name, "--model", "a scene has one friction model"));
        };
        let only = if let [only] = &solver[..] { Some(only.clone()) } else { None };
        let model = model.first().copied();
        let args = SceneArgs { scene: name, solver: only, model, step, solve, plugins };
        let (plugins, registry) = args.plugins.start()?;
        let scene = args.load(args.solver.as_deref(), registry.clone())?;
        let steps = motion.steps.unwrap_or(scene.step.count);
        let schemes = match args.step.scheme {
            Some(scheme) => vec![scheme],
            None => Scheme::LEVELS.to_vec(),
        };
        let named = solver.iter().map(String::as_str);
        let named: Vec<&str> =
            named.chain(plugins.iter().map(|plugin| -> &str { plugin.name() })).collect();
        let mut solvers: Vec<Method> = match solver.is_empty() {
            true => Registry::standard().methods().cloned().collect(),
            false => Vec::new(),
        };
        let mut left_out = Vec::new();
        for name in &named {
            match takes_part(name, &registry, &schemes, scene.contact.model)? {
                Ok(method) => solvers.push(method),
                Err(reason) => left_out.push(LeftOut { solver: name.to_string(), reason }),
            }
        }
        let contenders = comparison::contenders(&scene, &schemes, &solvers);
        args.check(contenders.iter().map(|(_, solver)| solver), &scene)?;
        let shown = motion.show.iter().map(|name| AnimatedSolver::named(name, &scene, &registry));
        let shown = shown.collect::<Result<Vec<AnimatedSolver>>>()?;
        let what = format!("the motion of {} runs of {steps} steps", contenders.len());
        let samples = Memory::bytes(size_of::<Sample>() as u64).times(steps);
        scene.memory.check(what, samples.times(contenders.len()))?;
        if let Some(folder) = &motion.out {
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
        let written = motion.out.as_ref().filter(|_| has_runs).map(|folder| {
            let animated = match shown.is_empty() {
                true => side_by_side::alike(&contenders, &view::alike(&comparison.runs)),
                false => shown.into_iter().map(|solver| (solver.name(), solver)).collect(),
            };
            let animation = side_by_side::animation("animation", &scene, &animated, steps, stop);
            write::document(&view::comparison_document(&comparison, animation), folder)
        });
        if json {
            print(&format!(
                "{}\n",
                json!({ "answer": view::comparison_answer(&comparison), "comparison": comparison, "timings": timings })
            ))?;
        } else {
            print(&terminal::prose(&view::comparison_answer(&comparison)))?;
            print(&terminal::table(&view::comparison_table(&comparison)))?;
        }
        if let Some(page) = written {
            say(&page?.display().to_string());
        }
        let rejected = comparison
            .runs
            .iter()
            .any(|run| run.tally.rejected_claims > 0 || run.tally.unanswered > 0);
        let all_left_out = !named.is_empty() && comparison.left_out.len() == named.len();
        Ok(match stopped {
            Some(reason) => Outcome::Stopped(reason),
            None if rejected || all_left_out => Outcome::Rejected,
            None => Outcome::Good,
        })
    }
}

/// The method of a named solver, or the reason why it takes no part.
///
/// # Errors
/// If there is no solver of this name.
fn takes_part(
    name: &str,
    solvers: &Registry,
    schemes: &[Scheme],
    model: Model,
) -> Result<std::result::Result<Method, String>> {
    let Contender { methods, .. } = Contender::named(name, solvers)?;
    if let [scheme] = schemes
        && !scheme.solves_lcps()
    {
        return Ok(Err(format!("the scheme {} solves no LCP", scheme.name())));
    }
    let taking = methods.iter().find(|method| comparison::refusal(method, model).is_none());
    let reason = || methods.iter().find_map(|method| comparison::refusal(method, model));
    Ok(taking.cloned().ok_or_else(|| reason().unwrap_or_default()))
}
