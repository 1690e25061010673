//! `diagnose`: explains what is wrong with a scene or a problem.

use std::path::{Path, PathBuf};

use clap::{Arg, Args};
use lcplab::diagnosis::unsupported::{
    Examination, UserSolver, examine_scene, examine_sequence, main_solve, user_solver,
};
use lcplab::diagnosis::{self, Cause, Diagnosis, find_mistakes, problem, single_precision};
use lcplab::document::Document;
use lcplab::error::{Error, Result};
use lcplab::file;
use lcplab::files;
use lcplab::lcp::Question;
use lcplab::lcp::file::Problem;
use lcplab::memory::Memory;
use lcplab::report::motion_error::MotionError;
use lcplab::report::view::diagnosis_page;
use lcplab::scene::Scene;
use lcplab::simulation::Simulation;
use lcplab::solver::{Group, Options, Pgs, Registry};

use super::form::Writing;
use super::loads::{self, Summed};
use super::mistake;
use super::options::iterations;
use super::plugin::Plugins;
use super::scene::Changes;
use super::{Outcome, bar, print, read_problem, say};

/// Explain why bodies sink, why a problem has no solution or several, or which mistake produced an
/// answer
#[derive(Debug, Args)]
#[command(mut_args(without_answer))]
#[command(after_help = "\
Examples:
  lcplab diagnose mass_ratio3 --solver pgs --sweeps 10   # why do the boxes sink, and what helps?
  lcplab diagnose frames/ --solver pgs --sweeps 10       # the same for problem files, one per step
  lcplab diagnose fig8                      # proves that three rows contradict each other
  lcplab diagnose stack --step 10
  lcplab diagnose mass_ratio3 --solver pgs --sweeps 10 --out why.html # a page with an animation
  lcplab diagnose fig8 --json
  lcplab problems fathi | lcplab diagnose - --format markdown
  lcplab diagnose problem.json answer.json  # which known mistake produces exactly this x?
  lcplab diagnose problem.json answer.json --last before.json
  lcplab diagnose --mistakes                # lists the known mistakes

INPUT is read as a problem if it is \"-\" or a file with an extension that `convert --list` shows; as a \
sequence of problems if it is a folder of such files; otherwise as a scene.

For each input lcplab reports rank, condition number and degrees of freedom, and lists zero rows, dependent \
rows, contradictory rows, constraints whose direction is undefined (such as a rod of length 0), drift, overlap, and sign errors in A. \
Problems of more than 2,000 rows are not examined.

lcplab simulates a scene twice, with its solver and with an exact solver, and measures the unsupported weight. \
Each simulation lasts one second, or as long as the scene file states if that is shorter. lcplab removes each possible cause in turn to see whether that helps, and tries remedies. If the \
solver's error is at least twice that of plain Gauss-Seidel after the same number of sweeps, the solver is \
listed as the first cause. A problem file does not name a solver: for the same analysis, choose one with --solver, or give --sweeps to use \
pgs. Every error of a motion is its distance from the exact motion, divided by the change of motion that the \
constraints cause; it can exceed 100 %.

With an answer, lcplab compares it with the result of each known mistake; for a mistake of a sweep method, with \
the result after each of up to 2,000 sweeps. It names a mistake only if one of these results, \
rounded to the precision of x, is at least a hundred times closer to x than the exact solution is. If the judge \
accepts the answer, lcplab names no mistake.

Exit codes:
  0  the problem has a solution (in a folder: lcplab found an accepted answer to each problem), and the judge \
accepts ANSWER, if given
  1  otherwise
  2  invalid input or usage")]
pub struct Diagnose {
    /// Scene file, name of a shipped scene, problem file, folder of problem files, or - for a JSON
    /// problem from standard input
    #[arg(
        required = false,
        required_unless_present = "mistakes",
        default_value_if("mistakes", "true", "")
    )]
    input: String,
    /// Answer to the problem, a file with the key x: find the known mistakes that produce it
    #[arg(conflicts_with_all = ["step", "format", "out"])]
    answer: Option<PathBuf>,
    /// Answer to the previous step, from which the solver should have started: a file with the key
    /// x
    #[arg(long, value_name = "ANSWER", requires = "answer")]
    last: Option<PathBuf>,
    /// List the known mistakes: what each computes, and what to check
    #[arg(long, conflicts_with_all = ["input", "solver", "max_iterations", "step", "format", "out", "plugin", "set"])]
    mistakes: bool,
    /// Examine the scene at the beginning of this step, counted from 1; not with ANSWER [default:
    /// 1]
    #[arg(long, value_parser = clap::value_parser!(u64).range(1..))]
    step: Option<u64>,
    /// Solver to examine [default: the scene's; for a problem none]
    #[arg(long)]
    solver: Option<String>,
    /// Maximum number of sweeps or pivots in a solve; without --solver it implies pgs if the scene
    /// has a direct solver [default: the scene's; for problems 10000]
    #[arg(long, visible_alias = "sweeps", allow_negative_numbers = true, value_parser = iterations)]
    max_iterations: Option<usize>,
    #[command(flatten)]
    plugins: Plugins,
    #[command(flatten)]
    changes: Changes,
    /// Also list the forces for each pair of bodies and for each contact, and mark the unique ones
    #[arg(long, conflicts_with = "answer")]
    loads: bool,
    /// Print one JSON object
    #[arg(long, conflicts_with_all = ["format", "out"])]
    json: bool,
    #[command(flatten)]
    writing: Writing,
}

/// The option, whose help says if it does not apply with ANSWER.
fn without_answer(option: Arg) -> Arg {
    if !matches!(option.get_id().as_str(), "format" | "out") {
        return option;
    }
    let help = option.get_help().map(ToString::to_string).unwrap_or_default();
    option.help(help.replacen(" [default:", "; not with ANSWER [default:", 1))
}

impl Diagnose {
    pub fn run(&self) -> Result<Outcome> {
        if self.mistakes {
            print(&mistake::known(self.json))?;
            return Ok(Outcome::Good);
        }
        let is_problem = files::is_problem(Path::new(&self.input));
        if let Some(answer) = &self.answer {
            if !is_problem {
                return Err(Error::invalid(
                    &self.input,
                    "ANSWER",
                    "applies to problems, but the input is a scene",
                ));
            }
            return self.mistake(&read_problem(Path::new(&self.input), Memory::default())?, answer);
        }
        let (plugins, solvers) = self.plugins.start()?;
        let solver = Plugins::sole(self.solver.as_deref(), &plugins)?;
        if !is_problem && Path::new(&self.input).is_dir() {
            if self.loads {
                let reason = "applies to a scene or a problem, but the input is a folder";
                return Err(Error::invalid(&self.input, "--loads", reason));
            }
            return self.sequence(solver, &solvers);
        }
        let Diagnosed { mut found, examined, loads } = match is_problem {
            true => self.problem(solver, &solvers)?,
            false => self.of_scene(solver, &solvers)?,
        };
        if self.json {
            let mut object = found.to_json();
            if let Some(examined) = &examined {
                object["examination"] = examined.found.to_json();
            }
            if let Some(loads) = &loads {
                object["loads"] = loads::to_json(loads);
            }
            print(&format!("{object:#}\n"))?;
            return Ok(if found.is_sound() { Outcome::Good } else { Outcome::Rejected });
        }
        if examined.as_ref().is_some_and(|examined| {
            examined.found.unsupported.as_ref().is_some_and(|found| found.pace().is_some())
        }) {
            // The rate of the active rows is stated; that of all rows would be a second one.
            found.causes.retain(|cause| !matches!(cause, Cause::Slow { .. }));
        }
        if examined.as_ref().is_some_and(|examined| {
            examined.found.ruled_out.iter().any(|what| what.contains("redundant"))
        }) {
            found.causes.retain(|cause| !matches!(cause, Cause::Redundant { .. }));
        }
        self.write(found.document(), examined.as_ref(), loads.as_ref())
    }

    /// Diagnoses a problem, and its solve if a solver is given.
    fn problem(&self, solver: Option<&str>, solvers: &Registry) -> Result<Diagnosed> {
        let refuse = |option| {
            Error::invalid(&self.input, option, "applies to scenes, but the input is a problem")
        };
        if self.step.is_some() {
            return Err(refuse("--step"));
        }
        if !self.changes.is_empty() {
            return Err(refuse("--set"));
        }
        let read = read_problem(Path::new(&self.input), Memory::default())?;
        let found = problem(&read)?;
        let summed = || -> Result<_> {
            loads::of_problem(&Question::new(&read, None, &self.input)?, &self.input)
        };
        let loads = self.loads.then(summed).transpose()?;
        if solver.is_none() && self.max_iterations.is_none() {
            return Ok(Diagnosed { found, examined: None, loads });
        }
        let user_solver = self.user_solver(solver, solvers)?;
        let examination = examine_sequence(&[as_box(read, &self.input)?], &user_solver);
        let examined = Some(ExaminedInput { found: examination, user_solver, scene: None });
        Ok(Diagnosed { found, examined, loads })
    }

    /// Diagnoses a scene, and its solve if possible.
    fn of_scene(&self, solver: Option<&str>, solvers: &Registry) -> Result<Diagnosed> {
        let scene = self.scene(solver, solvers)?;
        let step = self.step.map(|step| step as usize);
        let number = step.unwrap_or(1);
        let progress = bar(number.saturating_sub(1) as u64, "steps before it");
        let found = diagnosis::observed_scene(&scene, number, &|| progress.inc(1))?;
        progress.finish_and_clear();
        let loads = self.loads.then(|| loads::of_scene(&scene, number));
        if !found.is_sound() || solvers.entry(&scene.solver.name).is_err() {
            return Ok(Diagnosed { found, examined: None, loads });
        }
        let (examination, user_solver) = (examine_scene(&scene, step)?, user_solver(&scene)?);
        let examined = Some(ExaminedInput { found: examination, user_solver, scene: Some(scene) });
        Ok(Diagnosed { found, examined, loads })
    }

    /// Writes the result as text, or as a page with pictures and the problems of the worst steps
    /// next to it.
    fn write(
        &self,
        mut document: Document,
        examined: Option<&ExaminedInput>,
        loads: Option<&Summed>,
    ) -> Result<Outcome> {
        if let Some(loads) = loads {
            document.add("", loads::section(loads));
        }
        let Some(ExaminedInput { found, user_solver, scene }) = examined else {
            return self.writing.write(&document);
        };
        found.open(&mut document);
        let Some(path) = self.writing.page() else { return self.writing.write(&document) };
        let problems = match scene {
            Some(scene) => worst_problems(scene, found, path)?,
            None => Vec::new(),
        };
        let page = diagnosis_page(&document, found, user_solver, scene.as_ref(), &problems)?;
        file::write(path, &page.render()?)?;
        Ok(if document.is_accepted { Outcome::Good } else { Outcome::Rejected })
    }

    /// The scene with the options of its solver.
    fn scene(&self, solver: Option<&str>, solvers: &Registry) -> Result<Scene> {
        let mut scene = self.changes.load(&self.input)?;
        scene.solvers = solvers.clone();
        if let Some(name) = solver {
            let scheme = scene.step.scheme;
            if !scheme.solves_lcps() {
                let reason =
                    format!("cannot run {name}: the scheme {} solves no LCP", scheme.name());
                return Err(Error::invalid(&self.input, "solver", reason));
            }
            scene.solver.name = solvers.entry(name)?.name.to_string();
        } else if self.max_iterations.is_some() && scene.step.scheme.solves_lcps() {
            // As for problems: the number of sweeps of a direct method means nothing.
            let group = solvers.entry(&scene.solver.name).map(|entry| entry.group);
            if matches!(group, Ok(Group::Pivoting | Group::Newton)) {
                let own = &scene.solver.name;
                say(&format!(
                    "note: {own} is a direct method; pgs is examined (--solver {own} for it)"
                ));
                scene.solver.name = Pgs::NAME.into();
            }
        }
        scene.solver.max_iterations = self.max_iterations.unwrap_or(scene.solver.max_iterations);
        Ok(scene)
    }

    /// The solver and options for a problem.
    fn user_solver(&self, solver: Option<&str>, solvers: &Registry) -> Result<UserSolver> {
        let entry = solvers.entry(solver.unwrap_or(Pgs::NAME))?.clone();
        let mut options = Options::default();
        if let Some(most) = self.max_iterations {
            options.settings.max_iterations = most;
        }
        Ok(UserSolver { entry, options })
    }

    /// Diagnoses the problems of a folder, in the order of their names.
    fn sequence(&self, solver: Option<&str>, solvers: &Registry) -> Result<Outcome> {
        let paths = file::list(Path::new(&self.input))?;
        let paths = paths.iter().filter(|path| files::is_problem(path) && !files::is_answer(path));
        let problems = paths.map(|path| {
            let mut problem = read_problem(path, Memory::default())?;
            problem.name =
                path.file_name().map_or(String::new(), |name| name.to_string_lossy().into());
            let place = path.display().to_string();
            as_box(problem, &place)
        });
        let problems = problems.collect::<Result<Vec<Problem>>>()?;
        if problems.is_empty() {
            return Err(Error::invalid(&self.input, "the folder", "contains no problem files"));
        }
        let user_solver = self.user_solver(solver, solvers)?;
        let found = examine_sequence(&problems, &user_solver);
        let tolerance = user_solver.options.settings.tolerance;
        let unsolved = found.unsolved(tolerance);
        let is_accepted = unsolved.is_empty();
        if self.json {
            let mut object = found.to_json();
            object["unsolved"] = unsolved.into();
            print(&format!("{object:#}\n"))?;
            return Ok(if is_accepted { Outcome::Good } else { Outcome::Rejected });
        }
        let title = format!("Diagnosis of {}", self.input);
        let lead = found.unsolved_in_words(tolerance);
        let document = Document { title, lead, is_accepted, ..Document::default() };
        self.write(document, Some(&ExaminedInput { found, user_solver, scene: None }), None)
    }

    /// Finds the known mistakes that give an answer.
    fn mistake(&self, problem: &Problem, answer: &Path) -> Result<Outcome> {
        let question = Question::new(problem, None, &self.input)?;
        let rows = problem.lcp.len();
        let read = |path: &PathBuf| files::read_answers(path, rows, Memory::default());
        let x = files::read_answers(answer, rows, Memory::default())?.x;
        let last = self.last.as_ref().map(read).transpose()?.map(|last| last.x);
        let search = find_mistakes(question.posed(), &x, last.as_deref());
        let single = question.boxed().and_then(|lcp| single_precision(lcp, &x));
        if self.json {
            let mut object = mistake::to_json(&search, single);
            for (key, value) in MotionError::json(&question, &x) {
                object[key] = value;
            }
            print(&format!("{object:#}\n"))?;
        } else {
            print(&(mistake::words(&search, single) + &MotionError::text(&question, &x)))?;
        }
        Ok(if search.verdict.is_solution() { Outcome::Good } else { Outcome::Rejected })
    }
}

/// The problem with the bounds of its friction model.
///
/// # Errors
/// If the model has cones or polygons.
fn as_box(problem: Problem, place: &str) -> Result<Problem> {
    let question = Question::new(&problem, None, place)?;
    let lcp = question.require_boxed("examinations of a solver are", place)?.clone();
    Ok(Problem { lcp, ..problem })
}

/// What was found about an input.
struct Diagnosed {
    found: Diagnosis,
    examined: Option<ExaminedInput>,
    /// The forces by bodies, if they are printed.
    loads: Option<Summed>,
}

/// An examination and its subject.
struct ExaminedInput {
    found: Examination,
    user_solver: UserSolver,
    scene: Option<Scene>,
}

/// Writes the problems of the worst steps next to a page; returns the name of each file, and the
/// reason for it.
fn worst_problems(
    scene: &Scene,
    found: &Examination,
    page: &Path,
) -> Result<Vec<(String, String)>> {
    let mut wanted = vec![(found.place, "examined above".to_string())];
    for (why, place) in found.worst() {
        match wanted.iter_mut().find(|(own, _)| *own == place) {
            Some((_, words)) => *words += &format!(", worst by {why}"),
            None => wanted.push((place, format!("worst by {why}"))),
        }
    }
    let stem = page.file_stem().unwrap_or_default().to_string_lossy();
    let mut simulation = Simulation::of(scene)?;
    let mut written = Vec::new();
    while let Some(step) = simulation.step().ok().filter(|step| step.number <= found.notes.len()) {
        let Some((_, why)) = wanted.iter().find(|(place, _)| place + 1 == step.number) else {
            continue;
        };
        let Some(solve) = main_solve(&step) else { continue };
        let name = format!("{stem}-step-{}.json", step.number);
        let text = format!("{}\n", solve.exported(scene, step.number).to_json());
        file::write_in(&file::folder_of(page), &name, &text)?;
        written.push((name, format!("step {}: {why}", step.number)));
    }
    Ok(written)
}
