//! Animations: as a section, as the page of a simulation, and next to the tables of a comparison.

use nalgebra::Vector3;

use super::{Outcome, ReportPage, View};
use crate::animation::Animation;
use crate::body::{Body, State};
use crate::number::{count, counted, readable};
use crate::page::DrawnAnimation;
use crate::report::page::{Block, Cell, Page, Player, Table, Tile, markup};
use crate::report::recording::Record;
use crate::report::study::animation::{AnimationData, Plan};

/// The explanation of the controls, for the caption.
pub(super) const HOW: &str = "Arrows are forces on the moving body.";

impl ReportPage {
    /// Adds an animation as a separate section.
    pub(crate) fn animation(&mut self, animation: &Animation, caption: &str) {
        self.open("animation", "The motion");
        let drawn = animation.drawn();
        self.player(drawn, format!("{caption} {HOW}"));
    }

    /// Adds an animation from a recorded motion.
    fn recorded(&mut self, data: &AnimationData, plan: &Plan) {
        match data.animation() {
            Ok(animation) => self.player(animation.drawn(), plan.caption.clone()),
            Err(error) => self.text(format!("The animation cannot be shown: {error}.")),
        }
    }

    fn player(&mut self, animation: DrawnAnimation, caption: String) {
        self.add(animation_block(animation, caption));
    }
}

/// An animation with its caption.
pub(super) fn animation_block(animation: DrawnAnimation, caption: String) -> Block {
    Block::Player(Box::new(Player { animation, caption, files: Vec::new() }))
}

impl View for Plan {
    const TITLE: &'static str = "Animation of a scene";

    fn show(&self, findings: &[AnimationData], document: &mut ReportPage) {
        for data in findings {
            document.recorded(data, self);
        }
    }

    fn outcome(&self, _: &[AnimationData]) -> Outcome {
        Outcome::undecided()
    }
}

/// The page of one simulation: its animation and its totals; its tables are next to it.
pub(crate) fn simulation_page(animation: Animation, record: &Record) -> Page {
    let scene = animation.scene.clone();
    let judged = match record.verdicts() {
        [_, 0] => String::new(),
        [accepted, solves] if accepted == solves => {
            format!("The judge accepts all {} answers. ", count(solves))
        }
        [accepted, solves] => format!(
            "The judge accepts {} of {} answers; errors of the motion may be the solver's. ",
            count(accepted),
            count(solves)
        ),
    };
    let [found, run, advice] =
        [record.finding(), record.run(), record.advice()].map(|words| markup::literal(&words));
    let lead = format!(
        "**{found}.** {judged}{run}{advice} Not measured: the distance from the exact motion; a run with half \
         the step.dt estimates it."
    );
    let facts = vec![("lcplab".into(), env!("CARGO_PKG_VERSION").into())];
    let page = Page { title: scene.title.clone(), lead, facts, ..Page::default() };
    let mut document = ReportPage { page, figures: Vec::new(), tables: Vec::new() };
    let mut animation = animation.drawn();
    animation.title = String::new(); // the lead states it
    let files = FILES.map(|name| (name.into(), name.into())).into();
    let player = Player { animation, caption: HOW.into(), files };
    document.page.opening = vec![Block::Tiles(tiles(record)), Block::Player(Box::new(player))];
    if !scene.teaches.trim().is_empty() {
        document.page.opening.push(Block::Text(markup::literal(scene.teaches.trim())));
    }
    document.open("totals", "Totals");
    for (kind, remark) in record.remarks() {
        document.add(Block::Note(format!("**{kind}**: {}", markup::literal(&remark))));
    }
    if !record.page_totals().is_empty() {
        document.add(Block::Table(totals(record)));
    }
    let ledger = record.ledger();
    // Smaller ones would be shown as 0.
    if ledger.iter().any(|(_, work)| work.abs() >= 1e-12) {
        document.add(Block::Table(causes(record, &ledger)));
    }
    if record.listed().0.len() > 1 {
        document.open("end", "The bodies at the end");
        document.add(Block::Table(at_the_end(record)));
    }
    document.page
}

/// Whether to trust the run: the judge's verdicts, and what needs attention.
fn tiles(record: &Record) -> Vec<Tile> {
    let tile = |value: String, label: &str, good| Tile {
        value,
        label: label.into(),
        section: "totals".into(),
        good,
    };
    let [accepted, solves] = record.verdicts();
    let answers = tile(
        format!("{} of {}", count(accepted), count(solves)),
        &format!("answers accepted by the judge; scaled residual at most {}", record.residual()),
        accepted == solves,
    );
    let warnings = record.remarks().iter().filter(|(kind, _)| *kind != "note").count();
    let attention = match warnings {
        0 => tile("no warnings".into(), "about the motion", true),
        _ => tile(counted(warnings, "warning"), "about the motion, listed with the totals", false),
    };
    (solves > 0).then_some(answers).into_iter().chain([attention]).collect()
}

/// Where the bodies are at the end.
fn at_the_end(record: &Record) -> Table {
    let (moving, more) = record.listed();
    let vector = |v: &Vector3<f64>| {
        let parts = [v.x, v.y, v.z].map(|x| readable(if x.abs() < 5e-4 { 0.0 } else { x }, 3));
        Cell::text(format!("({})", parts.join(", ")))
    };
    let row = |(body, state): (&Body, &State)| {
        vec![Cell::text(body.name.as_str()), vector(&state.pose.p), vector(&state.v)]
    };
    let rows = moving.into_iter().map(row).collect();
    let note = match more {
        0 => String::new(),
        more => format!("{more} more bodies are in final.toml."),
    };
    let head = "body | position (m) | velocity (m/s)";
    Table::new("Positions and velocities at the end", &note, head, rows)
}

/// The causes of a change of the energy whose names need an explanation.
const CAUSES: [(&str, &str); 3] = [
    ("constraint", "work of joints, whose direction turns within a step"),
    ("bias", "correction of position errors"),
    ("integrator", "gravity acts along the path of the step instead of the mean velocity"),
];

/// The causes of the change of the energy, and their sum.
fn causes(record: &Record, ledger: &[(&str, f64)]) -> Table {
    let sum: f64 = ledger.iter().map(|(_, work)| work).sum();
    let largest = ledger.iter().fold(0.0, |most: f64, (_, work)| most.max(work.abs()));
    // The sum has three digits, and all causes as many decimals, so that they add up to it.
    let smallest = if sum.abs() > 1e-6 * largest { sum.abs() } else { largest };
    let decimals = (2.0 - smallest.log10().floor()).clamp(0.0, 12.0) as usize;
    let row = |name: &str, work: f64| {
        let text = format!("{work:.decimals$}").replace('-', "−");
        vec![Cell::text(name), Cell { text, value: Some(work), ..Cell::default() }]
    };
    let explained = |(name, meaning): &(&str, &str)| {
        let is_listed = ledger.iter().any(|(own, _)| own == name);
        is_listed.then(|| format!(" *{name}*: {meaning}."))
    };
    let explained: String = CAUSES.iter().filter_map(explained).collect();
    let how = format!("Over all steps.{explained} The ledger {}.", record.balance());
    let causes = ledger.iter().map(|&(name, work)| row(name, work));
    let rows = causes.chain([row("sum, the change at the end", sum)]).collect();
    Table::new("What changed the energy", how, "cause | #energy (J)", rows)
}

/// The totals; further lines of a value follow its first one.
fn totals(record: &Record) -> Table {
    let row = |(name, value): (&str, String)| {
        let single = |line: &str| line.split_whitespace().collect::<Vec<_>>().join(" ");
        let (first, more) = value.split_once('\n').unwrap_or((&value, ""));
        let more = more.lines().map(single).collect::<Vec<_>>().join("; ");
        vec![Cell::text(name), Cell::text(format!("{first} {more}").trim_end())]
    };
    let totals = record.page_totals();
    let mut how = String::new();
    if totals.iter().any(|(name, _)| *name == "laws") {
        how += "*weight*: the part of it that contacts, joints and springs support. *laws*: the largest violations \
                of those of contact and friction.";
    }
    let rows = totals.into_iter().map(row).collect();
    Table::new("Totals of the run", how, "measure | value", rows)
}

/// The files that `simulate` writes next to the page.
const FILES: [&str; 5] =
    ["trajectory.csv", "ledger.csv", "forces.csv", "results.json", "final.toml"];
