//! The examination of a scene or a sequence of problems: symptoms, causes and remedies.

use lcplab_page::document::{Document, Section};
use lcplab_page::number::{capitalized, readable};
use serde_json::{Value, json};

use super::cause::{Moving, Slow};
use super::examine::UnsupportedLoad;
use super::frame::Frame;
use super::remedy::RemedyEffect;
use super::remedy_table;
use super::thresholds::{HEALTHY, LARGE_PART, REPORTED_DEPTH};

/// Significant digits of measured values.
const DIGITS: usize = 2;

/// The text if no cause was found but the motion has errors that no residual shows.
const WARNED_WORDS: &str =
    "The problem of this step has a solution, but the motion has errors: see the warnings.";

/// The measure of overlap among the worst steps.
pub const OVERLAP: &str = "overlap";

/// What is not examined.
const NOT_EXAMINED: &str = "contacts that open and close repeatedly, closed loops, restitution of resting \
 contacts, fast rotation";

/// A summary of one step or one file of a sequence.
#[derive(Debug, Clone, PartialEq)]
pub struct StepSummary {
    /// The step, or the file.
    pub name: String,
    /// The error of its answer, as a fraction of the constraints' effect; `None` if it was not
    /// compared with a solution.
    pub missing: Option<f64>,
    /// The upward impulse (N s) or force (N) that is missing, summed over all bodies.
    pub unsupported: f64,
    /// The scaled residual of its answer.
    pub residual: f64,
    /// The largest velocity (m/s, rad/s) that feedback of errors requests.
    pub bias: f64,
    /// The deepest overlap at its end (m), if it is known.
    pub penetration: Option<f64>,
    /// Kinetic and potential energy at its end (J), if it is known.
    pub energy: Option<f64>,
}

/// The step to examine: the first whose error is a large part of the largest error, because later
/// errors follow from it. The first step if there is no error.
pub(crate) fn first_bad_step(notes: &[StepSummary]) -> usize {
    let most = notes.iter().filter_map(|note| note.missing).fold(HEALTHY, f64::max);
    let is_bad =
        |note: &StepSummary| note.missing.is_some_and(|missing| missing >= LARGE_PART * most);
    notes.iter().position(is_bad).unwrap_or(0)
}

/// The result of the examination of a scene or a sequence.
///
/// ```
/// use lcplab_analysis::diagnosis::unsupported::{Load, Slow, UnsupportedLoad};
/// use lcplab_analysis::diagnosis::unsupported::{examine_scene, examine_sequence, user_solver};
/// use lcplab_mechanics::scene::Scene;
/// use lcplab_mechanics::simulation::Step;
/// use lcplab_page::document::Document;
///
/// // Three balls in a stack by one sweep of PGS: much of the weight is not supported.
/// let changes = [
///     ("solver.name".into(), "\"pgs\"".into()),
///     ("solver.max_iterations".into(), "1".into()),
/// ];
/// let scene = Scene::load_with("fig7", &changes)?;
/// let found = examine_scene(&scene, None)?;
/// let load: &UnsupportedLoad = found.unsupported.as_ref().unwrap();
/// assert!(load.is_short() && load.part() > 0.1);
/// assert!(load.headline().contains("pgs"));
/// assert!(load.whole.as_ref().map(Load::missing).is_none_or(|part| part > 0.1));
/// assert!(load.to_json()["solver"].is_string());
/// println!("{:?}", load.pace()); // the rate of the slowest pattern, if that is the reason
/// let names: Vec<&str> = load.causes.iter().map(Slow::name).collect();
/// assert!(names.iter().all(|name| found.causes().contains(name)));
/// assert!(!found.headline().is_empty() && found.to_json().is_object());
/// // The first cause, and the best remedy with its cost.
/// assert!(found.conclusion().contains(" the error with "), "{}", found.conclusion());
/// assert!(found.worst().iter().any(|(measure, _)| *measure == "residual"));
/// // A reference solution is known for every step.
/// assert!(found.unsolved(1e-8).is_empty() && found.unsolved_in_words(1e-8).is_empty());
/// let mut document = Document::default();
/// found.open(&mut document); // its beginning
/// assert!(!document.lead.is_empty());
///
/// // The same for problem files, here that of the first step.
/// let solve = &Step::of(&scene, 1)?.solves[0];
/// let found = examine_sequence(&[solve.exported(&scene, 1)], &user_solver(&scene)?);
/// assert!(found.unsupported.unwrap().is_short());
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
#[derive(Debug, Clone, Default)]
pub struct Examination {
    /// The summaries of the steps.
    pub notes: Vec<StepSummary>,
    /// Why there is no run with exact answers to compare the motion with, if there is none.
    pub no_reference: Option<String>,
    /// The step that could not be computed and why, if the run ended there.
    pub ended: Option<String>,
    /// The first step in which the solver gave up, and its message, if it did.
    pub gave_up: Option<String>,
    /// Why the answer of the step was not measured, if there was a problem but no measurement.
    pub unmeasured: Option<String>,
    /// The duration of the motion (s), if it was one.
    pub time: Option<f64>,
    /// The body that ends farthest below its position with exact answers, and by how much (m).
    pub sunk: Option<(String, f64)>,
    /// Defects of steps although every problem was solved: bodies that overlap or passed through
    /// each other, impacts whose energy contradicts the coefficient of restitution.
    pub warnings: Vec<String>,
    /// The impacts that lost their bounce because they were too slow for it, in words.
    pub lost_bounces: Option<String>,
    /// Causes of wrong motion even if every problem is solved, the strongest first.
    pub moving: Vec<Moving>,
    /// The step that was examined, and the result; `None` if no solution is known.
    pub unsupported: Option<UnsupportedLoad>,
    /// The frame that was examined.
    pub frame: Option<Frame>,
    /// The index of the examined frame among the summaries.
    pub place: usize,
    /// Possible causes that were ruled out.
    pub ruled_out: Vec<String>,
    /// The effect of remedies over the whole run, the best first.
    pub remedy_effects: Vec<RemedyEffect>,
}

/// The largest number of problems that a sentence names.
const LISTED: usize = 10;
/// The name of the cause that the solver gave up in a step.
const GAVE_UP: &str = "the solver gave up";
/// The name of the cause that a step could not be taken.
const ENDED: &str = "the run ended";

impl Examination {
    /// The names of the causes, in order.
    pub fn causes(&self) -> Vec<&'static str> {
        let ended = self.ended.as_ref().map(|_| ENDED);
        let gave_up = self.gave_up.as_ref().map(|_| GAVE_UP).into_iter().chain(ended);
        let slow =
            self.unsupported.iter().flat_map(|found| &found.causes).map(|cause| cause.name());
        let moving = self.moving.iter().map(Moving::name);
        // If the solver gives up or is worse than plain sweeps, all other results are doubtful. A
        // cold start gives every step an error that a warm start avoids, and added energy spoils
        // all later steps: these come before causes of slow sweeps.
        let place = |name: &str| match name {
            GAVE_UP | ENDED | "suspect the solver" => 0,
            "cold start" | "energy from Baumgarte feedback" => 1,
            _ => 2,
        };
        let mut all: Vec<&str> = gave_up.chain(slow).chain(moving).collect();
        // The sort is stable: the strongest first.
        all.sort_by_key(|name| place(name));
        all
    }

    /// The names of the problems without a known answer that the judge accepts: no method found a
    /// reference solution, and the solver's answer is outside the tolerance.
    pub fn unsolved(&self, tolerance: f64) -> Vec<&str> {
        let is_unsolved =
            |note: &&StepSummary| note.missing.is_none() && !(note.residual <= tolerance);
        self.notes.iter().filter(is_unsolved).map(|note| note.name.as_str()).collect()
    }

    /// The same as a sentence; empty if there are none.
    pub fn unsolved_in_words(&self, tolerance: f64) -> String {
        let unsolved = self.unsolved(tolerance);
        match unsolved[..] {
            [] => String::new(),
            [one] => format!("No accepted answer to {one} is known."),
            _ => {
                let (named, rest) = unsolved.split_at(unsolved.len().min(LISTED));
                let more = match rest.len() {
                    0 => String::new(),
                    rest => format!(" and {rest} more"),
                };
                format!(
                    "No accepted answer to {} of {} problems is known: {}{more}.",
                    unsolved.len(),
                    self.notes.len(),
                    named.join(", ")
                )
            }
        }
    }

    /// The first sentences.
    pub fn headline(&self) -> String {
        let mut words = match (&self.unsupported, &self.unmeasured) {
            (Some(found), _) => found.headline(),
            (None, Some(reason)) => format!("The error was not measured: {reason}."),
            (None, None) if self.ended.is_some() => "The run ended.".into(),
            (None, None) => {
                "No LCP was solved in these steps, so the solver has no influence.".into()
            }
        };
        let depth = self.notes.iter().filter_map(|note| note.penetration).fold(0.0, f64::max);
        let has_sunk = self.sunk.as_ref().is_some_and(|(_, sunk)| *sunk > REPORTED_DEPTH);
        if let Some(time) = self.time.filter(|_| has_sunk && depth > 0.0) {
            let [time, depth] = [time, depth].map(|value| readable(value, DIGITS));
            words += &format!(" Within {time} s bodies overlap by up to {depth} m.");
        }
        words
    }

    /// The step that was examined, for the start of the first sentence, if the title names another.
    fn place_in_words(&self, title: &str) -> String {
        let is_short = self.unsupported.as_ref().is_some_and(UnsupportedLoad::is_short);
        match self.notes.get(self.place) {
            Some(note) if is_short && self.notes.len() > 1 && !title.ends_with(&note.name) => {
                format!("In {}, ", note.name)
            }
            _ => String::new(),
        }
    }

    /// The text if nothing is wrong; later steps of a scene are not examined.
    fn healthy_words(&self) -> String {
        match self.notes.len() {
            0 | 1 => "No cause of errors was found.".into(),
            steps => format!("No cause of errors was found in the {steps} steps."),
        }
    }

    /// The causes and the best remedy, in a sentence; empty if there is no cause.
    pub fn conclusion(&self) -> String {
        let causes = self.causes();
        let is_plural = |name: &str| name.ends_with('s') && !name.ends_with("ss");
        let noun = |name: &&str| match *name {
            "feedback increases errors" => "feedback that increases errors".into(),
            many if is_plural(many) => many.into(),
            one => format!("the {one}{}", self.masses(one).unwrap_or_default()),
        };
        let nouns: Vec<String> = causes.iter().map(noun).collect();
        let cause = match (&causes[..], &nouns[..]) {
            ([first @ (GAVE_UP | ENDED), ..], _) => capitalized(first),
            (["suspect the solver", ..], _) => "The solver is suspect".into(),
            ([one], [noun]) => {
                let verb = if is_plural(one) { "are" } else { "is" };
                format!("{} {verb} the cause", capitalized(noun))
            }
            (_, [nouns @ .., last]) => {
                format!("The causes are {} and {last}", nouns.join(", "))
            }
            _ => return String::new(),
        };
        let remedy = self.unsupported.as_ref().and_then(|found| {
            Some(format!("; {}{}", found.remedy_in_words()?, found.remedy_cost()))
        });
        format!("{cause}{}.", remedy.unwrap_or_default())
    }

    /// The masses of this cause in words, if it is their ratio: of up to four bodies all, otherwise
    /// the largest and the least of the slowest pattern.
    fn masses(&self, cause: &str) -> Option<String> {
        let mass = |mass: f64| readable(mass, DIGITS);
        let bodies = self.frame.iter().flat_map(|frame| &frame.bodies);
        let mut all: Vec<f64> = bodies.map(|body| body.mass).collect();
        all.sort_by(f64::total_cmp);
        self.unsupported.as_ref()?.causes.iter().filter(|own| own.name() == cause).find_map(|own| {
            let Slow::MassRatio { heavy, light, .. } = own else { return None };
            Some(match &all[..] {
                [first, middle @ .., last] if (1..=2).contains(&middle.len()) => {
                    let first = [first].into_iter().chain(middle).map(|own| mass(*own));
                    let first = first.collect::<Vec<_>>().join(", ");
                    format!(" ({first} and {} kg)", mass(*last))
                }
                _ => format!(" of {} kg to {} kg", mass(heavy.1), mass(light.1)),
            })
        })
    }

    /// Inserts it at the beginning of a document.
    pub fn open(&self, document: &mut Document) {
        let is_well = self.causes().is_empty()
            && self.warnings.is_empty()
            && document.is_accepted
            && self.unmeasured.is_none();
        let rest = match document.is_accepted {
            true if is_well => self.healthy_words(),
            true if !self.causes().is_empty() => String::new(),
            true if !self.warnings.is_empty() => WARNED_WORDS.into(),
            _ => document.lead.clone(),
        };
        let conclusion = if document.is_accepted { self.conclusion() } else { String::new() };
        let headline = self.place_in_words(&document.title) + &self.headline();
        let words = [conclusion, headline, rest];
        document.lead =
            words.into_iter().filter(|words| !words.is_empty()).collect::<Vec<_>>().join(" ");
        let found = self.unsupported.as_ref();
        let mut sections: Vec<Section> = self.why().into_iter().collect();
        sections.extend(remedy_table::section(self.unsupported.as_ref(), &self.remedy_effects));
        sections.extend(
            found.filter(|found| found.is_short()).and_then(UnsupportedLoad::loads_section),
        );
        let mut rest = std::mem::take(&mut document.sections);
        if document.is_accepted {
            // They are harmless but would fill a page; the diagnosis of a single problem, and JSON,
            // contain them.
            rest.retain(|own| own.title != "Dependent rows");
        }
        if document.is_accepted && !self.causes().is_empty() {
            rest.retain(|own| !own.title.starts_with("Rank and"));
        }
        rest.iter_mut()
            .filter(|own| own.title == "Causes")
            .for_each(|own| own.title = "Remarks".into());
        sections.into_iter().for_each(|section| document.add("", section));
        document.sections.extend(rest);
    }

    fn why(&self) -> Option<Section> {
        let causes = self.causes();
        let title = match (&causes[..], self.warnings.is_empty()) {
            ([only], _) => format!("the cause: {only}"),
            ([_, ..], _) => format!("the causes: {}", causes.join(", ")),
            ([], false) => "warnings".into(),
            ([], true) => "what was examined".into(),
        };
        let mut section = Section::new(title);
        let slow = self.unsupported.iter().flat_map(|found| &found.causes);
        let mut named: Vec<(&str, String)> =
            slow.map(|cause| (cause.name(), cause.to_string())).collect();
        named.extend(self.ended.iter().map(|why| (ENDED, format!("{why}."))));
        named.extend(
            self.gave_up
                .iter()
                .map(|how| (GAVE_UP, format!("{how}. From there on the motion is not valid."))),
        );
        named.extend(self.moving.iter().map(|cause| (cause.name(), cause.to_string())));
        let mut lines: Vec<[String; 2]> = Vec::new();
        for (k, name) in self.causes().into_iter().enumerate() {
            let word = if k == 0 { "Cause" } else { "Also" };
            if let Some((_, text)) = named.iter().find(|(own, _)| *own == name) {
                lines.push([format!("{word}: {name}"), capitalized(text)]);
            }
        }
        let pace = self.unsupported.as_ref().and_then(UnsupportedLoad::pace);
        lines.extend(pace.map(|pace| ["Slow sweeps".into(), pace]));
        lines.extend(self.no_reference.iter().map(|reason| {
            let lost = "Sinking, feedback, compliance and friction were not examined.";
            ["No reference".into(), format!("{}. {lost}", capitalized(reason))]
        }));
        // A measured remedy is better advice than the general one after the first sentence.
        let is_measured = self.unsupported.as_ref().is_some_and(UnsupportedLoad::is_short);
        for warning in self.distinct_warnings() {
            let fact = warning.split_once(". ").filter(|_| is_measured);
            let words = fact.map_or(capitalized(warning), |(fact, _)| capitalized(fact) + ".");
            lines.push(["Warning".into(), words]);
        }
        let lost = self.lost_bounces.iter();
        lines.extend(lost.map(|lost| ["Note".into(), format!("{}.", capitalized(lost))]));
        if !self.ruled_out.is_empty() {
            let words = format!("{}.", capitalized(&self.ruled_out.join("; ")));
            lines.push(["Ruled out".into(), words]);
        }
        if !lines.is_empty() {
            lines.push(["Not examined".into(), format!("{}.", capitalized(NOT_EXAMINED))]);
        }
        let rows: Vec<Vec<String>> = lines.into_iter().map(Vec::from).collect();
        (!rows.is_empty()).then(|| {
            section.table("what was found", &["finding", "evidence"], rows);
            section
        })
    }

    /// The warnings without those about bodies that earlier ones name.
    fn distinct_warnings(&self) -> Vec<&str> {
        let (mut named, mut distinct): (Vec<&str>, Vec<&str>) = Default::default();
        for warning in &self.warnings {
            let bodies: Vec<&str> = warning.split('"').skip(1).step_by(2).collect();
            if bodies.is_empty() || bodies.iter().any(|body| !named.contains(body)) {
                distinct.push(warning);
            }
            named.extend(bodies);
        }
        distinct
    }

    /// The worst step by each measure except the error: the measure's name and the step's index. A
    /// measure that is 0 is omitted.
    pub fn worst(&self) -> Vec<(&'static str, usize)> {
        let worst = |name: &'static str, measure: &dyn Fn(usize) -> Option<f64>| {
            let values = (0..self.notes.len()).filter_map(|k| Some((k, measure(k)?)));
            let (k, value) = values.max_by(|a, b| a.1.total_cmp(&b.1).then(b.0.cmp(&a.0)))?;
            (value > 0.0).then_some((name, k))
        };
        let energy = |k: usize| self.notes.get(k)?.energy;
        let measures = [
            worst("residual", &|k| Some(self.notes[k].residual)),
            worst("bias", &|k| Some(self.notes[k].bias)),
            worst(OVERLAP, &|k| self.notes[k].penetration),
            worst("energy gain in the step", &|k| Some(energy(k)? - energy(k.checked_sub(1)?)?)),
        ];
        measures.into_iter().flatten().collect()
    }

    /// The same as JSON.
    pub fn to_json(&self) -> Value {
        let number = lcplab_lcp::file::number;
        let note = |note: &StepSummary| {
            json!({ "name": note.name, "missing": note.missing.map(number), "unsupported": number(note.unsupported),
                "residual": number(note.residual), "bias": number(note.bias),
                "penetration": note.penetration, "energy": note.energy })
        };
        let sunk = self
            .sunk
            .as_ref()
            .map(|(body, depth)| json!({ "body": body, "depth": number(*depth) }));
        let remedy_effect = |remedy_effect: &RemedyEffect| {
            json!({ "what": remedy_effect.what, "missing": number(remedy_effect.missing), "off": number(remedy_effect.off),
                "iterations": number(remedy_effect.iterations) })
        };
        json!({
            "headline": self.headline(),
            "causes": self.causes(),
            "ruled_out": self.ruled_out,
            "no_reference": self.no_reference,
            "ended": self.ended,
            "gave_up": self.gave_up,
            "unmeasured": self.unmeasured,
            "seconds": self.time,
            "sunk": sunk,
            "warnings": self.warnings,
            "lost_bounces": self.lost_bounces,
            "solve": self.unsupported.as_ref().map(UnsupportedLoad::to_json),
            "remedies": self.remedy_effects.iter().map(remedy_effect).collect::<Vec<_>>(),
            "steps": self.notes.iter().map(note).collect::<Vec<_>>(),
        })
    }
}
