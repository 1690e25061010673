//! The models of friction on a block that is pushed from all sides, and on a rod.

use super::{Document, Outcome, View};
use crate::number::readable;
use crate::plot::{Axis, Lines, Panel, Series};
use crate::report::page::{Cell, Column, Mark, Table};
use crate::report::study::friction::{Answer, Model};
use crate::report::study::slider::Path;
use crate::report::study::sliding::{Figure, Finding, Plan, SHOWN, Slide};

/// Measured and expected numbers may differ by this much (parts, degrees, N s, m/s).
const AGREES: f64 = 1e-3;
/// The direction of the push in the table (degrees).
const TABLE: f64 = 30.0;

impl View for Plan {
    const TITLE: &'static str = "Four models of friction, pushed from all sides";

    fn show(&self, findings: &[Finding], document: &mut Document) {
        for study in findings {
            document.text(
                "Coulomb's law says: a contact that sticks holds with any force up to $\\mu x_n$; one that \
                 slides rubs with exactly $\\mu x_n$, straight against the slip $w_t$.",
            );
            document.equation(
                "|x_t| \\le \\mu x_n, \\qquad w_t \\ne 0 \\Rightarrow x_t = -\\mu x_n \\frac{w_t}{|w_t|}",
                "Coulomb",
            );
            document.text(
                "That is a disc in the plane of the two tangents $t_1$, $t_2$, and a disc is not linear. \
                 Solvers replace it:\n\n\
                 - **Frozen box**: each tangent has bounds of its own, $\\pm\\mu$ times the normal impulse \
                 that there would be *without* friction. A square of fixed size.\n\
                 - **Coupled box**: the same square, with the present $x_n$. The scenes of this report do \
                 this, and so does Open Dynamics Engine.\n\
                 - **Polygon** of 4, 8 or 16 corners on the circle, one at $t_1$: an LCP with one unknown \
                 more for each corner, solved by Lemke's method.\n\
                 - **Cone**: the disc itself. *Associated*, as a convex problem, whose price is that it \
                 lifts what slides; or *Coulomb*, with nothing given up.\n\n\
                 A block of 1 kg lies on the floor and is pushed along it. It is pressed so that \
                 $\\mu x_n = 1$ N s. Its rows do not feel each other ($A$ is the identity), and so friction is \
                 the point of the model's square, polygon or disc that is nearest to the push, drawn from the \
                 centre. Everything below can be drawn with ruler and compasses; lines are that drawing, \
                 markers are what the solvers found.",
            );
            document.figure(direction_figure(study));
            document.text(
                "Friction that should point straight against the slip snaps to a corner of the box or of \
                 the polygon instead. A crate that is dragged at 30° to the tangents veers off to one side; \
                 dragged along a tangent it does not. And a floor has no tangents: the program chose them.",
            );
            document.figure(grip_figure(study));
            document.text(
                "How far the square or polygon reaches in a direction is how hard one may push before the block moves: too hard across \
                 the corners of the box, by $\\sqrt{2} - 1$ = 41 %, and too softly across the edges of a \
                 polygon, by $1 - \\cos(\\pi/k)$: 29 %, 8 % and 2 % for $k$ = 4, 8, 16.",
            );
            document.table("friction_block", block_table(study));
            document.text(
                "On the block the two boxes do the same, as do the two cones but for the lifting. A rod on \
                 two feet tells them apart by their impulses: its middle is above the ground, so friction at the \
                 feet tips it, and one foot is pressed harder than without friction, the other more lightly. The \
                 frozen box knows nothing of that: its *strength* is too small at the one and too large at the \
                 other, where it may exceed the $\\sqrt{2}$ of a square of the right size. The rod moves alike under \
                 both boxes, whose friction adds up to the same. With more corners the polygons come near \
                 Coulomb's law; the boxes do not.",
            );
            document.table("friction_rod", rod_table(study));
            document.text(
                "What a model does to one problem, it does in every step. A block of the scene *sliding* starts \
                 at 30° to $t_1$ with 3 m/s. Coulomb's law stops it on the straight line, after \
                 $v^2 / (2 \\mu g)$. Under a model with corners, friction is the corner that points most against the slip, and so \
                 turns the slip towards the direction halfway between two corners: towards $t_1$ on the box, \
                 towards the diagonal on the polygon with four corners.",
            );
            document.figure(path_figure(study));
            document.table("friction_paths", path_table(study));
        }
    }

    fn answer(&self, findings: &[Finding]) -> Option<String> {
        let study = findings.first()?;
        let said: Vec<String> = SHOWN.iter().filter_map(|model| bias(study, *model)).collect();
        Some(format!(
            "**What does a model of friction get wrong?** How much of Coulomb's limit it holds, and where it points, when a \
             block is pushed in directions a few degrees apart: {}.",
            said.join("; ")
        ))
    }

    fn outcome(&self, findings: &[Finding]) -> Outcome {
        let slides = checked(findings.iter().flat_map(|study| &study.slides), slides_as_expected);
        let grips = checked(findings.iter().flat_map(|study| &study.grips), |grip| {
            (grip.measured - grip.expected).abs() <= AGREES
        });
        let paths = checked(findings.iter().flat_map(|study| &study.paths), stops_as_expected);
        let rods = checked(findings.iter().flat_map(|study| &study.rod), is_accepted);
        let says = format!(
            "{} of {} pushes, {} of {} grips and {} of {} paths as geometry says; {} of {} answers \
             on the rod accepted",
            slides[0], slides[1], grips[0], grips[1], paths[0], paths[1], rods[0], rods[1]
        );
        Outcome { good: [slides, grips, paths, rods].iter().all(|[good, all]| good == all), says }
    }
}

/// How many of these are as they should, and how many there are.
fn checked<'a, T: 'a>(
    all: impl Iterator<Item = &'a T>,
    is_good: impl Fn(&T) -> bool,
) -> [usize; 2] {
    all.fold([0, 0], |[good, all], own| [good + usize::from(is_good(own)), all + 1])
}

/// How much a model holds, at least and at most, and how far aside its friction points.
fn bias(study: &Finding, model: Model) -> Option<String> {
    let grips = study.grips.iter().filter(|grip| grip.model == model).map(|grip| grip.measured);
    let (least, most) =
        grips.fold((f64::INFINITY, 0.0), |(lo, hi), grip| (f64::min(lo, grip), f64::max(hi, grip)));
    let slides = study.slides.iter().filter(|slide| slide.answer.model == model);
    let aside =
        slides.filter_map(|slide| slide.answer.contacts.first()?.misalignment).fold(0.0, f64::max);
    let percent = |part: f64| readable((100.0 * part).round(), 3);
    let held = match (percent(least), percent(most)) {
        (least, most) if least == most => least,
        (least, most) => format!("{least} to {most}"),
    };
    let aside = match aside.round() {
        0.0 => "straight".to_string(),
        degrees => format!("up to {}° aside", readable(degrees, 2)),
    };
    least.is_finite().then(|| format!("*{}* {held} %, {aside}", short(model)))
}

fn path_figure(study: &Finding) -> Lines {
    let path = |model: &Model| {
        let paths = study.paths.iter().filter(|path| path.model == *model);
        let points = paths.flat_map(|path| path.points.iter().map(|&[x, y]| (x, y)));
        Series::points(short(*model), points.collect())
    };
    let straight = study.paths.iter().find(|path| path.model == Model::CoulombCone);
    let line = straight.map(|path| vec![(0.0, 0.0), (path.expected[0], path.expected[1])]);
    let theory = Series::theory("theory, Coulomb".to_string(), line.unwrap_or_default());
    Lines {
        id: "friction_paths".into(),
        title: "A block's way over the floor, from above".into(),
        caption:
            "A marker every 0.02 s; the last one is where it stops. The line is Coulomb's law, \
                  which has no preferred direction."
                .into(),
        x: Axis::linear("place along t₁", "m"),
        panels: vec![Panel {
            y: Axis::linear("place along t₂", "m"),
            series: SHOWN.iter().map(path).chain([theory]).collect(),
        }],
    }
}

fn path_table(study: &Finding) -> Table {
    Table {
        title: "Where the block stops".into(),
        how_to_read: "Places along $t_1$ and $t_2$; the expected ones come from the figure alone, for \
                      infinitely short steps. A row agrees if the block stops within two steps' travel \
                      of it (two, because the frozen box knows no load in the first step) and floats as \
                      expected to 1 µm. *gap* is the height at which it slides after 0.1 s: \
                      $\\Delta t\\, \\mu |v|$ under the associated cone, whose block starts at that \
                      height; one that starts on the floor is thrown up by it."
            .into(),
        columns: vec![
            Column::words("model"),
            Column::words("solver"),
            Column::numbers("problems", ""),
            Column::numbers("accepted", ""),
            Column::numbers("t₁", "m"),
            Column::numbers("expected", "m"),
            Column::numbers("t₂", "m"),
            Column::numbers("expected", "m"),
            Column::numbers("gap", "m"),
            Column::numbers("expected", "m"),
            Column::words("agreement"),
        ],
        rows: study.paths.iter().map(path_cells).collect(),
        ..Table::default()
    }
}

/// Whether the block stops and floats as geometry says, by answers that the judge accepts.
fn stops_as_expected(path: &Path) -> bool {
    let ([x, y], [ex, ey]) = (path.stop, path.expected);
    (x - ex).hypot(y - ey) <= 2.0 * path.travel
        && (path.gap - path.expected_gap).abs() <= 1e-6
        && path.accepted == path.problems
}

fn path_cells(path: &Path) -> Vec<Cell> {
    let ([x, y], [ex, ey]) = (path.stop, path.expected);
    let mut cells = vec![
        Cell::text(path.model.to_string()),
        Cell::text(&path.solver),
        Cell::count(path.problems),
        Cell::count(path.accepted),
    ];
    cells.extend([x, ex, y, ey, path.gap, path.expected_gap].map(tidy));
    cells.push(match stops_as_expected(path) {
        true => Cell::text("agrees").marked(Mark::Good),
        false => Cell::text("differs").marked(Mark::Bad),
    });
    cells
}

/// How the curves of a model are called.
fn short(model: Model) -> String {
    match model {
        Model::FrozenBox | Model::CoupledBox => "box".into(),
        Model::CoulombCone => "disc".into(),
        other => other.to_string(),
    }
}

fn against(v: [f64; 3]) -> f64 {
    f64::atan2(0.0 - v[2], 0.0 - v[1]).to_degrees()
}

fn direction_figure(study: &Finding) -> Lines {
    let measured = |model: &Model| {
        let slides = study.slides.iter().filter(|slide| slide.answer.model == *model);
        let contacts = slides.flat_map(|slide| slide.answer.contacts.first());
        let sliding = contacts.filter(|contact| contact.misalignment.is_some());
        let point = |impulse: [f64; 3], velocity| {
            (against(velocity), impulse[2].atan2(impulse[1]).to_degrees())
        };
        let points = sliding.map(|contact| point(contact.impulse, contact.velocity));
        Series::points(short(*model), points.collect())
    };
    let theory =
        |model: &Model| Series::theory(format!("theory, {}", short(*model)), stairs(*model));
    Lines {
        id: "friction_direction".into(),
        title: "Where friction points, and where it should".into(),
        caption: format!(
            "The block is pushed {} times as hard as friction can hold, from 0 to 90° to t₁ in steps \
             of 5°. Coulomb's law is the diagonal. For the box all slip but that along a tangent \
             meets the same friction, at 45°.",
            readable(study.push, 3)
        ),
        x: Axis::linear("direction opposite to the slip", "degrees from t₁"),
        panels: vec![Panel {
            y: Axis::linear("direction of friction", "degrees from t₁"),
            series: SHOWN.iter().map(measured).chain(SHOWN.iter().map(theory)).collect(),
        }],
    }
}

/// The direction of friction over the direction against the slip: the corner that lies farthest
/// along it, cut off at the tangents.
fn stairs(model: Model) -> Vec<(f64, f64)> {
    let Figure::Polygon { corners, first, .. } = Figure::of(model) else {
        return vec![(0.0, 0.0), (90.0, 90.0)];
    };
    let (step, first) = (360.0 / corners as f64, first.to_degrees());
    let around = (-1..corners as i32).map(|k| first + step * f64::from(k));
    let steps = around.flat_map(|c| [(c - step / 2.0, c), (c + step / 2.0, c)]);
    let mut points: Vec<_> = steps.map(|(x, y)| (x.clamp(0.0, 90.0), y.clamp(0.0, 90.0))).collect();
    points.dedup();
    points
}

fn grip_figure(study: &Finding) -> Lines {
    let measured = |model: &Model| {
        let grips = study.grips.iter().filter(|grip| grip.model == *model);
        Series::points(short(*model), grips.map(|grip| (grip.degrees, grip.measured)).collect())
    };
    let theory = |model: &Model| {
        let reach = |degrees: f64| Figure::of(*model).reach(degrees.to_radians());
        let points = (0..=180).map(|k| f64::from(k) / 2.0).map(|d| (d, reach(d)));
        Series::theory(format!("theory, {}", short(*model)), points.collect())
    };
    Lines {
        id: "friction_grip".into(),
        title: "The hardest push that does not move the block".into(),
        caption: "Coulomb: 1 N s from every side. Markers: found by halving an interval 14 times, \
                  so to 10⁻⁴ N s."
            .into(),
        x: Axis::linear("direction of the push", "degrees from t₁"),
        panels: vec![Panel {
            y: Axis::linear("push", "N s"),
            series: SHOWN.iter().map(measured).chain(SHOWN.iter().map(theory)).collect(),
        }],
    }
}

fn block_table(study: &Finding) -> Table {
    let slides = study.slides.iter().filter(|slide| slide.degrees == TABLE);
    Table {
        title: format!("The block, pushed with {} N s at 30°", readable(study.push, 3)),
        how_to_read: format!(
            "*strength* is $|x_t| / (\\mu x_n)$, *off* the angle between friction and the direction \
             opposite to the slip, *rise* the speed $w_n$ at which the block leaves the floor; the \
             expected numbers come from the figure alone, and a row agrees if they differ by at most \
             {}. *verdict* judges the model's own problem; the *Coulomb residual* is the scaled \
             residual of the same answer in Coulomb's law.",
            readable(AGREES, 1)
        ),
        columns: vec![
            Column::words("model"),
            Column::words("verdict"),
            Column::numbers("strength", ""),
            Column::numbers("expected", ""),
            Column::numbers("off", "°"),
            Column::numbers("expected", "°"),
            Column::numbers("rise", "m/s"),
            Column::numbers("expected", "m/s"),
            Column::words("agreement"),
            Column::numbers("Coulomb residual", ""),
        ],
        rows: slides.map(block_cells).collect(),
        ..Table::default()
    }
}

/// Strength, angle and rise as found, each with the expected number.
fn pairs(slide: &Slide) -> [(f64, f64); 3] {
    let (contact, expected) = (slide.answer.contacts.first(), slide.expected);
    let strength = contact.and_then(|c| c.strength).unwrap_or(f64::NAN);
    let misalignment = contact.and_then(|c| c.misalignment).unwrap_or(f64::NAN);
    let rise = contact.map_or(f64::NAN, |c| c.velocity[0]);
    [(strength, expected.strength), (misalignment, expected.misalignment), (rise, expected.rise)]
}

fn slides_as_expected(slide: &Slide) -> bool {
    pairs(slide).iter().all(|(found, expected)| (found - expected).abs() <= AGREES)
}

fn block_cells(slide: &Slide) -> Vec<Cell> {
    let (answer, pairs) = (&slide.answer, pairs(slide));
    let mut cells = vec![Cell::text(answer.model.to_string()), verdict(answer)];
    cells.extend(pairs.iter().flat_map(|(found, expected)| [tidy(*found), tidy(*expected)]));
    cells.push(match slides_as_expected(slide) {
        true => Cell::text("agrees").marked(Mark::Good),
        false => Cell::text("differs").marked(Mark::Bad),
    });
    cells.push(residual(answer));
    cells
}

fn rod_table(study: &Finding) -> Table {
    let exact = study.rod.iter().find(|answer| answer.model == Model::CoulombCone);
    Table {
        title: "The rod on two feet".into(),
        how_to_read: "Strength and angle as above, foot by foot; a dash is a foot that sticks. \
                      Along the rod the feet share a row of $A$, so single impulses may be one \
                      choice of several; velocities are not. \
                      *velocity error* is the largest difference of $w$ to that of Coulomb's cone."
            .into(),
        columns: vec![
            Column::words("model"),
            Column::words("solver"),
            Column::words("verdict"),
            Column::numbers("x_n, foot 1", "N s"),
            Column::numbers("strength", ""),
            Column::numbers("off", "°"),
            Column::numbers("x_n, foot 2", "N s"),
            Column::numbers("strength", ""),
            Column::numbers("off", "°"),
            Column::numbers("velocity error", "m/s"),
            Column::numbers("Coulomb residual", ""),
        ],
        rows: study.rod.iter().map(|answer| rod_cells(answer, exact)).collect(),
        ..Table::default()
    }
}

fn rod_cells(answer: &Answer, exact: Option<&Answer>) -> Vec<Cell> {
    let mut cells = vec![Cell::text(answer.model.to_string()), Cell::text(&answer.solver)];
    cells.push(verdict(answer));
    let or_dash = |value: Option<f64>| value.map_or(Cell::text("–"), tidy);
    for contact in &answer.contacts {
        cells.extend([
            tidy(contact.impulse[0]),
            or_dash(contact.strength),
            or_dash(contact.misalignment),
        ]);
    }
    let w = |answer: &Answer| -> Vec<f64> {
        answer.contacts.iter().flat_map(|contact| contact.velocity).collect()
    };
    let error = exact.map(|exact| {
        let pairs = w(answer).into_iter().zip(w(exact));
        pairs.map(|(w, exact)| (w - exact).abs()).fold(0.0, f64::max)
    });
    cells.push(or_dash(error));
    cells.push(residual(answer));
    cells
}

/// Four digits; what is below the solvers' tolerance is 0.
fn tidy(value: f64) -> Cell {
    let shown = if value.abs() < 1e-6 { 0.0 } else { value };
    Cell { value: Some(value), ..Cell::number(shown, 4) }
}

fn is_accepted(answer: &Answer) -> bool {
    answer.verdict != "not_a_solution"
}

fn verdict(answer: &Answer) -> Cell {
    let words = answer.verdict.replace('_', " ");
    Cell::text(words).marked(if is_accepted(answer) { Mark::Plain } else { Mark::Bad })
}

fn residual(answer: &Answer) -> Cell {
    let follows = answer.coulomb_residual <= 1e-8;
    Cell::number(answer.coulomb_residual, 2).marked(if follows { Mark::Good } else { Mark::Plain })
}
