//! The friction models on a block that is pushed from all sides, and on a rod.

use super::attempt::listed;
use super::{Headline, Outcome, ReportPage, View};
use crate::number::readable;
use crate::plot::{self, Axis, Lines, Series};
use crate::report::page::{Cell, Mark, Table};
use crate::report::study::friction::{Answer, Model};
use crate::report::study::slider::{DT, Path};
use crate::report::study::sliding::{Figure, Finding, PUSH_ANGLE, Plan, SHOWN, Slide};

/// The allowed difference between measured and expected numbers (relative, degrees, N s, m/s).
const AGREES: f64 = 1e-3;
/// The direction of the push in the table (degrees).
const TABLE: f64 = 30.0;

impl View for Plan {
    const TITLE: &'static str = "Friction models compared: a block pushed in many directions";

    fn show(&self, findings: &[Finding], document: &mut ReportPage) {
        for study in findings {
            document.text(
                "Coulomb's law: the friction of a sticking contact has any strength up to $\\mu x_n$; that of \
                 a sliding contact has exactly the strength $\\mu x_n$ and points against the slip $w_t$.",
            );
            document.equation(
                "|x_t| \\le \\mu x_n, \\qquad w_t \\ne 0 \\Rightarrow x_t = -\\mu x_n \\frac{w_t}{|w_t|}",
                "Coulomb",
            );
            document.text(
                "The first condition is the friction cone; in the plane of the two tangents $t_1$, $t_2$ it is bounded by a \
                 circle, which linear constraints only approximate. Solvers use one of these sets:\n\n\
                 - *frozen-box*: each tangent has its own bounds, $\\pm\\mu$ times a known normal impulse. In a single problem it comes from a solve *without* friction; in a simulation, from the previous step (0 in the first step of a contact). The set is a square of fixed size.\n\
                 - *coupled-box*: the same square, with the current $x_n$.\n\
                 - *polygon-4*, *-8*, *-16*: a polygon with its corners on the circle, one at $t_1$; an LCP in which one unknown for each corner and one for the sliding speed replace the two tangents, solved by Lemke's method.\n\
                 - *associated-cone*: the circle itself, as a convex problem in which sliding bodies lift off.\n\
                 - *coulomb-cone*: the circle itself, and the exact law.\n\n\
                 A block of 1 kg lies on the floor and is pushed along it. It is pressed down so that \
                 $\\mu x_n = 1$ N s. $A$ is the identity: no impulse changes the $w$ of another row. The friction impulse \
                 is therefore the point of the model's box, polygon or cone that is nearest to the impulse that \
                 would hold the block, the opposite of the push. This point follows from geometry alone: the lines below show the geometric construction, \
                 the markers the answers of the solvers.",
            );
            document.figure(direction_figure(study));
            document.text(
                "A real floor has no tangents: the program chooses them. The largest push that does not move the block (Table 1) \
                 is too large toward the corners of the box, by $\\sqrt{2} - 1$ = 41 %, and too small across the edges \
                 of a polygon, by $1 - \\cos(\\pi/k)$: 29 %, 8 % and 2 % for $k$ = 4, 8, 16.",
            );
            document.table("friction_block", block_table(study));
            document.text(
                "For the block *frozen-box* agrees with *coupled-box*, and *associated-cone* with *coulomb-cone*, except that it \
                 lifts the block. For a rod on two feet, the two boxes give the same motion but different impulses: friction \
                 shifts load from one foot to the other, which *frozen-box* ignores.",
            );
            document.table("friction_rod", rod_table(study));
            document.text(
                "The error of a model repeats in every step. The block of the scene *sliding* starts at 30° to \
                 $t_1$ with 3 m/s. By Coulomb's law it stops on the straight line, after $v^2 / (2 \\mu g)$. \
                 In a model with corners, friction is the corner that points most against the slip. It turns \
                 the slip toward the direction halfway between two corners: toward $t_1$ for the box, toward \
                 the diagonal for the polygon with four corners.",
            );
            document.table("friction_paths", path_table(study));
        }
    }

    fn headline(&self, findings: &[Finding]) -> Headline {
        let answer = findings.first().map(|study| {
            let (turned, models) = most_aside();
            let close = closest(study).map_or(String::new(), |(model, part)| {
                format!(
                    "; the best of these, {model}, is off by {} and {}°",
                    percent(part),
                    readable(aside(model), 4)
                )
            });
            format!(
                "**Use {}: no other model here obeys Coulomb's law.** Friction of boxes and polygons points to a corner: they \
                 hold {} and turn friction by almost {turned:.0}° ({models}){close}. **The shipped scenes use *coupled-box***, \
                 because every solver of boxed LCPs takes it, and few take cones: it is exact only for slip along a \
                 tangent{}.",
                listed(&obeying(study)),
                strength(study),
                along(study)
            )
        });
        let paths = findings.first().map(path_figure);
        let figure = paths.map(|own| Box::new(own) as Box<dyn plot::Figure>);
        let table = findings.first().map(|study| ("friction_models".into(), models(study)));
        Headline { figure, table, ..Headline::of(answer) }
    }

    fn outcome(&self, findings: &[Finding]) -> Outcome {
        let slides = checked(findings.iter().flat_map(|study| &study.slides), slides_as_expected);
        let grips = checked(findings.iter().flat_map(|study| &study.grips), |grip| {
            (grip.measured - grip.expected).abs() <= AGREES
        });
        let paths = checked(findings.iter().flat_map(|study| &study.paths), stops_as_expected);
        let rods = checked(findings.iter().flat_map(|study| &study.rod), is_accepted);
        let says = format!(
            "{} of {} pushes, {} of {} sticking limits and {} of {} paths agree with the geometric construction; {} of {} \
             answers for the rod accepted",
            slides[0], slides[1], grips[0], grips[1], paths[0], paths[1], rods[0], rods[1]
        );
        Outcome { good: [slides, grips, paths, rods].iter().all(|[good, all]| good == all), says }
    }
}

/// The number of these that are as expected, and their total number.
fn checked<'a, T: 'a>(
    all: impl Iterator<Item = &'a T>,
    is_good: impl Fn(&T) -> bool,
) -> [usize; 2] {
    all.fold([0, 0], |[good, all], own| [good + usize::from(is_good(own)), all + 1])
}

/// The minimum and maximum friction of each model that is shown, and its largest misalignment.
fn models(study: &Finding) -> Table {
    let row = |model: &Model| {
        let held = held(study, *model).map(|part| Cell::number((100.0 * part).round(), 3));
        let aside = match aside(*model) {
            0.0 => Cell::count(0),
            most => Cell { value: Some(most), ..Cell::text(format!("< {}", readable(most, 4))) },
        };
        [Cell::text(model.to_string())].into_iter().chain(held).chain([aside]).collect()
    };
    Table::new(
        "Friction under each model",
        format!(
            "A block is pushed in directions {}° apart. *weakest*, *strongest*: the largest push that does not move it, \
             relative to Coulomb's limit. *off*: the angle between friction and the direction against the slip.",
            readable(PUSH_ANGLE, 2)
        ),
        "model | #weakest (%) | #strongest (%) | #off (°)",
        SHOWN.iter().map(row).collect(),
    )
}

/// The model that is shown with the largest value, and that value.
fn extreme(of: impl Fn(Model) -> f64) -> (f64, String) {
    let all = SHOWN.iter().map(|model| (of(*model), model.to_string()));
    all.max_by(|a, b| a.0.total_cmp(&b.0)).unwrap_or_default()
}

/// The least and the largest push that a model holds, with these models.
fn strength(study: &Finding) -> String {
    let (least, weakest) = extreme(|model| -held(study, model)[0]);
    let (most, strongest) = extreme(|model| held(study, model)[1]);
    let (least, most) = (percent(-least), percent(most));
    format!("{least} ({weakest}) to {most} ({strongest}) of Coulomb's limit")
}

fn percent(part: f64) -> String {
    format!("{}\u{a0}%", readable((100.0 * part).round(), 3))
}

/// The models whose answers for the block obey Coulomb's law.
fn obeying(study: &Finding) -> Vec<String> {
    let obeys = |model: &Model| {
        let mut own = study.slides.iter().filter(|slide| slide.answer.model == *model);
        own.all(|slide| follows(&slide.answer))
    };
    Model::ALL.into_iter().filter(obeys).map(|model| format!("*{model}*")).collect()
}

/// The coupled box where the block slides along a tangent, and the least that it holds.
fn along(study: &Finding) -> String {
    let slides = study.slides.iter().filter(|own| own.answer.model == Model::CoupledBox);
    let along = slides.filter(|own| own.degrees == 0.0).map(pairs);
    let of = |[(strength, _), (off, _), _]: [(f64, f64); 3]| {
        let off = readable((10.0 * off).round() / 10.0, 3);
        let [least, _] = held(study, Model::CoupledBox).map(percent);
        format!(
            " ({} of the limit, {off}° off), and it never holds less than {least} of it",
            percent(strength)
        )
    };
    along.map(of).collect()
}

/// The model with corners whose limit is closest to Coulomb's, and the error of it.
fn closest(study: &Finding) -> Option<(Model, f64)> {
    let error = |model: Model| {
        let errors = held(study, model).map(|part| (part - 1.0).abs());
        (model, errors[0].max(errors[1]))
    };
    let all = SHOWN.into_iter().filter(|model| aside(*model) > 0.0).map(error);
    all.min_by(|a, b| a.1.total_cmp(&b.1))
}

/// The least and the largest push that a model holds, relative to Coulomb's limit.
fn held(study: &Finding, model: Model) -> [f64; 2] {
    let grips = study.grips.iter().filter(|grip| grip.model == model).map(|grip| grip.measured);
    grips.fold([f64::INFINITY, 0.0], |[lo, hi], grip| [f64::min(lo, grip), f64::max(hi, grip)])
}

/// The bound of the angle between friction and the direction against the slip (degrees).
fn aside(model: Model) -> f64 {
    stairs(model).iter().map(|(slip, friction)| (slip - friction).abs()).fold(0.0, f64::max)
}

/// The largest of these angles, and the models that have it.
fn most_aside() -> (f64, String) {
    let (most, _) = extreme(aside);
    let models = SHOWN.into_iter().filter(|model| aside(*model) > most - AGREES);
    (most, models.map(|model| model.to_string()).collect::<Vec<_>>().join(", "))
}

/// How far from where Coulomb's law stops the block the models with corners do.
fn path_title(study: &Finding) -> String {
    let stop =
        |model: Model| study.paths.iter().find(|path| path.model == model).map(|path| path.stop);
    let far = |model: Model| {
        let ([a, b], [x, y]) = (stop(model)?, stop(Model::CoulombCone)?);
        Some((a - x).hypot(b - y))
    };
    let far = SHOWN.into_iter().filter(|model| aside(*model) > 0.0).filter_map(far);
    let [least, most] =
        far.fold([f64::INFINITY, 0.0], |[lo, hi], own| [f64::min(lo, own), f64::max(hi, own)]);
    let [least, most] = [least, most].map(|own| readable(own, 2));
    format!("Boxes and polygons miss Coulomb's stopping point by {least} to {most}\u{a0}m")
}

fn path_figure(study: &Finding) -> Lines {
    let path = |model: &Model| {
        let paths = study.paths.iter().filter(|path| path.model == *model);
        let points = paths.flat_map(|path| path.points.iter().map(|&[x, y]| (x, y)));
        Series::points(model.to_string(), points.collect()).labeled(model.to_string())
    };
    let straight = study.paths.iter().find(|path| path.model == Model::CoulombCone);
    let line = straight.map(|path| vec![(0.0, 0.0), (path.expected[0], path.expected[1])]);
    let theory = Series::theory("theory, Coulomb".to_string(), line.unwrap_or_default());
    Lines::new(
        "friction_paths",
        path_title(study),
        format!(
            "{}A marker every 0.02 s; the last one is where the block stops. The line is the path by Coulomb's law, \
             which has no preferred direction.",
            straight.map_or(String::new(), start)
        ),
        Axis::linear("position along t₁", "m"),
        Axis::to_scale("position along t₂", "m"),
        SHOWN.iter().map(path).chain([theory]).collect(),
    )
}

/// The velocity at the start, from the distance of the first step and the straight path.
fn start(straight: &Path) -> String {
    let angle = straight.expected[1].atan2(straight.expected[0]).to_degrees();
    format!(
        "The block starts with {} m/s at {angle:.0}° to t₁. ",
        readable(straight.travel / DT, 2)
    )
}

fn path_table(study: &Finding) -> Table {
    Table::new(
        "Where the block stops",
        "Positions along $t_1$ and $t_2$; the expected ones follow from the geometry of the \
         model, for infinitely short steps. A row agrees if the distance from the expected position is at most the distance that the block moves in the \
         first two steps, and if its gap agrees to 1 µm. (*frozen-box* needs this tolerance: its limits come \
         from the previous step, so they are 0 in the first step.) *gap*: the height at which the block slides after 0.1 s, $\\Delta t\\, \\mu |v|$ for \
         *associated-cone*. With it the block starts at that height; if it started on the floor, it would be lifted off.",
        "model | solver | #problems | #accepted | #t₁ (m) | #expected (m) | #t₂ (m) | \
         #expected (m) | #gap (m) | #expected (m) | agreement",
        study.paths.iter().map(path_cells).collect(),
    )
}

/// Whether the block stops and floats as geometry predicts, with answers that the judge accepts.
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
        Series::points(model.to_string(), points.collect())
    };
    let theory = |model: &Model| Series::theory(format!("theory, {model}"), stairs(*model));
    let (most, names) = most_aside();
    Lines::new(
        "friction_direction",
        format!(
            "Friction points up to almost {most:.0}° away from the direction against the slip ({names})"
        ),
        format!(
            "The push is {} times the largest push that friction can resist, in directions from 0 to 90° \
             from t₁, in steps of 5°. Coulomb's law is the diagonal. With *coupled-box*, friction points at 45° to the \
             tangents unless the slip is along a tangent, so it is almost 45° off if the slip is almost along one.",
            readable(study.push, 3)
        ),
        Axis::linear("direction opposite to the slip", "degrees from t₁"),
        Axis::linear("direction of friction", "degrees from t₁"),
        SHOWN.iter().map(measured).chain(SHOWN.iter().map(theory)).collect(),
    )
}

/// The direction of friction as a function of the direction opposite to the slip: the corner that
/// is farthest along it, clipped at the tangents.
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

fn block_table(study: &Finding) -> Table {
    let slides = study.slides.iter().filter(|slide| slide.degrees == TABLE);
    Table::new(
        format!("The block, pushed with {} N s at 30°", readable(study.push, 3)),
        format!(
            "*strength*: $|x_t| / (\\mu x_n)$. *off*: the angle between friction and the direction opposite to \
             the slip. *rise*: the speed $w_n$ at which the block leaves the floor. The expected numbers \
             follow from the geometry of the model, and a row agrees if they differ by at most {}. *verdict*: \
             the judge's verdict on the problem with this friction model. *Coulomb residual*: the scaled residual of the same answer under \
             Coulomb's law.",
            readable(AGREES, 1)
        ),
        "model | verdict | #strength | #expected strength | #off (°) | #expected off (°) | #rise (m/s) | \
         #expected (m/s) | agreement | #Coulomb residual",
        slides.map(block_cells).collect(),
    )
}

/// Strength, angle and rise, each with the expected number.
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
    Table::new(
        "The rod on two feet",
        "Strength and angle as above, for each foot; a dash means that the foot sticks. The tangent rows of the two \
         feet along the rod are redundant, so individual impulses may not be unique; the velocities are unique. \
         *velocity error*: the largest difference of $w$ from that of *coulomb-cone*.",
        "model | solver | verdict | #load of foot 1 (N s) | #strength of foot 1 | #off at foot 1 (°) | \
         #load of foot 2 (N s) | #strength of foot 2 | #off at foot 2 (°) | #velocity error (m/s) | #Coulomb residual",
        study.rod.iter().map(|answer| rod_cells(answer, exact)).collect(),
    )
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

/// Four digits; numbers below the solvers' tolerance are 0.
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

/// Whether an answer obeys Coulomb's law.
fn follows(answer: &Answer) -> bool {
    answer.coulomb_residual <= 1e-8
}

fn residual(answer: &Answer) -> Cell {
    let number = Cell::number(answer.coulomb_residual, 2);
    number.marked(if follows(answer) { Mark::Good } else { Mark::Plain })
}
