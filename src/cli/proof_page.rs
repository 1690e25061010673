//! The page of a proof: its claim, a button that checks it, its numbers, and what is not proved.

use dashu_ratio::RBig;
use lcplab::lcp::file::Problem;
use lcplab::lcp::friction::Model;
use lcplab::lcp::{Lcp, Question};
use lcplab::number::{counted, readable};
use lcplab::page::{self, Block, Cell, Page, Picture, Section, Table};
use lcplab::plot::{Axis, Lines, Series};
use lcplab::proof::{Claim, Entry, Kind, Proof, Reason, Tree, Vector};
use serde_json::Value;

/// Maximum number of rows of a table; the proof file has all of them.
const SHOWN: usize = 24;
/// Maximum number of rows whose names a caption lists.
const NAMED: usize = 6;
/// Longer fractions are shown as decimals.
const LONGEST: usize = 14;
/// Values of w agree up to this part of the largest one.
const AGREES: f64 = 1e-12;

/// The page; `text` is the proof file.
pub fn page(question: &Question, proof: &Proof, missing: &[(Kind, String)], text: &str) -> Page {
    // The page's checker reads the problem under the requested model.
    let problem = &Problem { model: question.model(), ..question.problem().clone() };
    let name = if problem.name.is_empty() { "a problem" } else { &problem.name };
    let claim = Block::Proof(page::Proof {
        problem: problem.to_json().to_string(),
        text: text.to_string(),
    });
    let section = |id: &str, title: &str, blocks| Section {
        id: id.into(),
        title: title.into(),
        blocks,
        ..Section::default()
    };
    let mut sections = Vec::new();
    let (picture, numbers) = numbers(problem, &proof.claim);
    if !numbers.is_empty() {
        sections.push(section("numbers", "What the proof consists of", numbers));
    }
    // Of several solutions, nothing stronger can be true.
    let is_strongest = matches!(proof.claim, Claim::NotUnique { .. });
    if !missing.is_empty() && !is_strongest {
        let reasons = missing.iter().map(|(kind, reason)| format!("- *{kind}*: {reason}\n"));
        let title = "Stronger statements, and why they are not proved";
        sections.push(section("missing", title, vec![Block::Text(reasons.collect())]));
    }
    let (rows, sentence) = (counted(problem.lcp.len(), "row"), proof.sentence());
    let meaning = match &proof.claim {
        Claim::NotUnique { x, y }
            if problem.lcp.matrix().is_symmetric()
                && unit(problem).is_some()
                && agree_in_w(problem, &values(&problem.lcp, x), &values(&problem.lcp, y)) =>
        {
            " The contacts can share the forces in more than one way, but the bodies move alike: $w$ is the same in both but for the rounding of $A$ and $b$ in the file."
        }
        _ => "",
    };
    let subject = match proof.claim {
        Claim::NotUnique { .. } if !meaning.is_empty() => "One motion, two exact sets of forces:",
        Claim::NotUnique { .. } => "Two solutions for",
        Claim::Unique { .. } => "The only solution for",
        Claim::NoSolution { .. } => "No solution for",
        Claim::Solution { .. } => "An exact solution for",
        _ => "A proof about",
    };
    let limits = match proof.model {
        Some(Model::CoupledBox) => " (each friction component limited separately)",
        _ => "",
    };
    let stronger = if is_strongest { "" } else { " lcplab found no proof of anything stronger." };
    Page {
        title: format!("{subject} {name}"),
        lead: format!(
            "**Proved: {sentence}{limits}.**{meaning} The problem has {rows}{}.{stronger}",
            contacts(problem)
        ),
        opening: picture.map(Block::Figure).into_iter().chain([claim]).collect(),
        sections,
        facts: vec![("lcplab".into(), env!("CARGO_PKG_VERSION").into())],
        ..Page::default()
    }
}

/// The contact points of a problem whose rows are all contact rows of two bodies, in words.
fn contacts(problem: &Problem) -> String {
    let of_kind = |kind: &str| rows(problem).iter().filter(|row| row["kind"] == kind).count();
    let (points, friction) = (of_kind("normal"), of_kind("friction"));
    match pair(problem) {
        Some(pair) if points > 0 && points + friction == rows(problem).len() => {
            let names: Vec<&str> = pair.iter().filter_map(Value::as_str).collect();
            format!(", of {} between {}", counted(points, "contact point"), names.join(" and "))
        }
        _ => String::new(),
    }
}

/// What the file says of each row; empty if it says nothing.
fn rows(problem: &Problem) -> &[Value] {
    problem.extra.get("rows").and_then(Value::as_array).map_or(&[], |rows| rows)
}

/// The two bodies of all rows, if they are the same for each.
fn pair(problem: &Problem) -> Option<&Vec<Value>> {
    let first = rows(problem).first()?["bodies"].as_array()?;
    rows(problem).iter().all(|row| row["bodies"].as_array() == Some(first)).then_some(first)
}

/// Why the claim holds: a picture, and words and numbers.
fn numbers(problem: &Problem, claim: &Claim) -> (Option<Picture>, Vec<Block>) {
    let solutions = |points: &[&Vector], why: &str| {
        let points: Vec<_> = points.iter().map(|point| values(&problem.lcp, point)).collect();
        let shown = shown(&points);
        let table = Block::Table(points_table(problem, &points, &shown));
        (Some(drawing(problem, &points, &shown)), vec![Block::Text(why.into()), table])
    };
    match claim {
        Claim::Solution { x, .. } => solutions(
            &[x],
            "In each row $x$ is at its lower bound and $w \\ge 0$, at its upper bound and $w \\le 0$, or between \
             them and $w = 0$. The numbers are exact.",
        ),
        Claim::Unique { x, by: Reason::Definite } => solutions(
            &[x],
            "If $x$ and $y$ were two solutions, $(x - y)^T A\\, (x - y)$ would not be positive. But $A + A^T$ is \
             positive definite: all pivots of its elimination in exact arithmetic are positive.",
        ),
        Claim::Unique { x, by: Reason::PMatrix } => solutions(
            &[x],
            "All principal minors of $A$ are positive, so the problem has exactly one solution for every $b$.",
        ),
        Claim::NotUnique { x, y } => {
            solutions(&[x, y], "Both $x$ and $y$ satisfy the conditions of every row in exact arithmetic.")
        }
        Claim::NoSolution { tree: Tree::Leaf(d) } => (None, vec![
            Block::Text(
                "Multiply each row by its $d$ and add: the sum $d^T w$ is negative for every $x$ within the bounds. \
                 But $d$ is positive only where $w \\ge 0$ is required and negative only where $w \\le 0$ is \
                 required, so for a solution the sum would not be negative."
                    .into(),
            ),
            Block::Table(vector_table(problem, d)),
        ]),
        Claim::NoSolution { tree } => (None, vec![Block::Text(format!(
            "Each row of a solution is at its lower bound, at its upper bound or free. The proof \
             distinguishes these cases row by row, and a vector as in a proof by one Farkas vector \
             excludes each of the {} cases.",
            tree.leaves()
        ))]),
        _ => (None, Vec::new()),
    }
}

/// The rows in which two points differ by more than rounding, if there are any; otherwise all.
fn shown(points: &[Vec<RBig>]) -> Vec<usize> {
    let largest = points.iter().flatten().map(|x| float(x).abs()).fold(0.0, f64::max);
    let differs = |&i: &usize| match points {
        [x, y] => float(&(&x[i] - &y[i])).abs() > AGREES * largest,
        _ => false,
    };
    let rows: Vec<usize> = (0..points[0].len()).filter(differs).collect();
    if rows.is_empty() { (0..points[0].len()).collect() } else { rows }
}

fn float(value: &RBig) -> f64 {
    value.to_f64().value()
}

/// The points within their bounds, row by row.
fn drawing(problem: &Problem, points: &[Vec<RBig>], shown: &[usize]) -> Picture {
    let shown = &shown[..shown.len().min(SHOWN)];
    let floats: Vec<Vec<f64>> = points.iter().map(|x| x.iter().map(float).collect()).collect();
    let unit = unit(problem).unwrap_or_default();
    let bounds = |i: usize| <[f64; 2]>::from(problem.lcp.bounds(i, &floats[0]));
    let ends = |&i: &usize| bounds(i).into_iter().chain([f64::NAN]).map(move |y| (i as f64, y));
    let limits = Series::measured("limits", shown.iter().flat_map(ends).collect());
    let placed = |x: &Vec<f64>| shown.iter().map(|&i| (i as f64, x[i])).collect();
    let points = ["x", "y"].iter().zip(&floats).map(|(name, x)| Series::points(*name, placed(x)));
    let series = [limits].into_iter().chain(points).collect();
    let (title, name) = match &floats[..] {
        [x, y] => {
            let apart = |i: &usize| (x[*i] - y[*i]).abs();
            let most = readable(shown.iter().map(apart).fold(0.0, f64::max), 3);
            (
                format!(
                    "Two solutions, x and y, within the limits: they differ by up to {most} {unit}"
                ),
                "x, y",
            )
        }
        _ => {
            let at_bound = shown.iter().filter(|i| bounds(**i).contains(&floats[0][**i])).count();
            (format!("x is at a bound in {at_bound} of {} rows", shown.len()), "x")
        }
    };
    let others = counted(problem.lcp.len() - shown.len(), "other row");
    let caption = match floats.len() {
        2 if shown.len() < problem.lcp.len() => {
            format!("x, y: two exact solutions, equal in the {others}.")
        }
        2 => "x, y: two exact solutions.".into(),
        _ => String::new(),
    };
    let mut caption = caption + " Gray: from the lower to the upper limit, if both are finite.";
    let names: Vec<String> = shown.iter().map(|&i| label(problem, i)).collect();
    if names.len() <= NAMED && names.iter().any(|name| name.contains(':')) {
        caption += &format!(" Rows: {}.", names.join("; "));
        if shown.iter().any(|i| problem.lcp.coupled_to(*i).is_some()) {
            caption += " t1, t2: friction along two tangents.";
        }
    }
    let axes = (Axis::linear("row", ""), Axis::linear(name, unit));
    Picture::inline(&Lines::new("solutions", title, caption, axes.0, axes.1, series))
}

/// The sizes of entries of x and of w that are not rounding.
fn sizes(lcp: &Lcp, points: &[Vec<RBig>]) -> [f64; 2] {
    let of_x = points.iter().flatten().map(|x| float(x).abs()).fold(0.0, f64::max);
    [of_x, lcp.b().iter().fold(0.0, |most: f64, b| most.max(b.abs()))]
}

/// Whether two solutions have the same w, up to rounding. If A = J M⁻¹Jᵀ, they then have the same
/// motion.
fn agree_in_w(problem: &Problem, x: &[RBig], y: &[RBig]) -> bool {
    let lcp = &problem.lcp;
    let size = lcp.b().iter().fold(0.0, |most: f64, b| most.max(b.abs()));
    let apart = |i| float(&(w(lcp, x, i) - w(lcp, y, i))).abs();
    (0..lcp.len()).all(|i| apart(i) <= AGREES * size)
}

fn points_table(problem: &Problem, points: &[Vec<RBig>], shown: &[usize]) -> Table {
    let lcp = &problem.lcp;
    let is_same_w = matches!(points, [x, y] if agree_in_w(problem, x, y));
    let [size, size_of_w] = sizes(lcp, points);
    let unit = unit(problem);
    let in_unit = |unit: Option<&str>| unit.map_or(String::new(), |unit| format!(" ({unit})"));
    let [of_x, of_w] = [in_unit(unit), in_unit(unit.and_then(unit_of_w))];
    let mut headings = "row".to_string();
    for name in &["x", "y"][..points.len()] {
        headings += &format!(" | #{name}{of_x}");
        headings += &if is_same_w { String::new() } else { format!(" | #w at {name}{of_w}") };
    }
    // Of friction rows only, whose normal rows are the same in both.
    let limit = |i: usize| lcp.coupled_to(i).filter(|(normal, _)| !shown.contains(normal));
    let is_limited = points.len() > 1 && shown.iter().all(|i| limit(*i).is_some());
    if is_limited {
        headings += &format!(" | #limit{of_x}");
    }
    let rows = shown.iter().take(SHOWN).map(|&i| {
        let of = |x: &Vec<RBig>| {
            let w = (!is_same_w).then(|| decimal(&w(lcp, x, i), size_of_w));
            [Some(decimal(&x[i], size)), w].into_iter().flatten().map(Cell::text)
        };
        let label = Cell::text(label(problem, i));
        let limit = limit(i).filter(|_| is_limited);
        let limit = limit.map(|(k, mu)| Cell::text(decimal(&(exact(mu) * &points[0][k]), size)));
        [label].into_iter().chain(points.iter().flat_map(of)).chain(limit).collect()
    });
    let note = if is_limited { "limit: ±μ times the normal x. " } else { "" };
    let title = match points.len() {
        1 => "The solution",
        _ if shown.len() < lcp.len() => "Two solutions, in the rows in which they differ",
        _ => "Two solutions",
    };
    Table::new(title, note.to_string() + &more(shown.len()), &headings, rows.collect())
}

fn vector_table(problem: &Problem, d: &[(usize, dashu_int::IBig)]) -> Table {
    let row = |(i, d): &(usize, dashu_int::IBig)| {
        let value = fraction(&RBig::from(d.clone()));
        vec![Cell::text(label(problem, *i)), Cell::text(value)]
    };
    let rows = d.iter().take(SHOWN).map(row).collect();
    Table::new("The Farkas vector; its other entries are 0", more(d.len()), "row | #d", rows)
}

/// The unit of x, if all rows have the same.
fn unit(problem: &Problem) -> Option<&str> {
    let first = rows(problem).first()?["unit"].as_str()?;
    rows(problem).iter().all(|row| row["unit"] == first).then_some(first)
}

/// The unit of w for this unit of x.
fn unit_of_w(x: &str) -> Option<&'static str> {
    Some(match x {
        "N s" => "m/s",
        "N m s" => "rad/s",
        "N" => "m/s²",
        "N m" => "rad/s²",
        _ => return None,
    })
}

fn more(rows: usize) -> String {
    let rounded = "Long fractions are rounded here, not in the proof. ≈ 0 is a number below 10⁻¹² of the largest one: \
                   A and b in the file are rounded, so the exact value is not 0.";
    match rows.saturating_sub(SHOWN) {
        0 => rounded.into(),
        more => format!("{rounded} The proof file contains {more} more rows."),
    }
}

/// The row's number, and its label if the file has one; of a contact's row, the point and the
/// direction if all rows are those of one pair of bodies.
fn label(problem: &Problem, i: usize) -> String {
    let Some(own) = rows(problem).get(i).and_then(|row| row["label"].as_str()) else {
        return i.to_string();
    };
    match contact(own).filter(|_| pair(problem).is_some()) {
        Some(row) => format!("{i}: {row}"),
        None => format!("{i}: {own}"),
    }
}

/// The point and the direction of a contact's row: of `friction slope box 2 at face 0 on vertex 1`
/// `vertex 1, t2`.
fn contact(label: &str) -> Option<String> {
    let (front, features) = label.split_once(" at ")?;
    let (_, point) = features.split_once(" on ")?;
    let (front, component) = front.rsplit_once(' ')?;
    Some(match front.starts_with("normal ") {
        true => format!("{point}, normal"),
        false => format!("{point}, t{component}"),
    })
}

/// The entries of x; a bound of a friction row depends on its normal row.
fn values(lcp: &Lcp, x: &Vector) -> Vec<RBig> {
    let denominator = RBig::from(x.denominator.clone());
    let own = |i: usize| match &x.entries[i] {
        Entry::Numerator(numerator) => RBig::from(numerator.clone()) / &denominator,
        Entry::Lo => exact(lcp.lo()[i]),
        Entry::Hi => exact(lcp.hi()[i]),
    };
    let coupled = |i: usize| lcp.coupling().and_then(|own| Some((own.index(i)?, own.mu(i))));
    let value = |i: usize| match (coupled(i), &x.entries[i]) {
        (Some((k, mu)), Entry::Lo) => -exact(mu) * own(k),
        (Some((k, mu)), Entry::Hi) => exact(mu) * own(k),
        _ => own(i),
    };
    (0..x.entries.len()).map(value).collect()
}

/// w_i = Σ_j a_ij x_j + b_i.
fn w(lcp: &Lcp, x: &[RBig], i: usize) -> RBig {
    let products = lcp.matrix().row(i).iter().map(|(j, a)| exact(a) * &x[j]);
    products.fold(exact(lcp.b()[i]), |sum, product| sum + product)
}

fn exact(value: f64) -> RBig {
    RBig::try_from(value).unwrap_or_default()
}

/// The number, or that it is rounding for numbers of this size.
fn decimal(value: &RBig, size: f64) -> String {
    let is_rounding = (0.0..=AGREES * size).contains(&float(value).abs());
    if is_rounding && *value != RBig::ZERO { "≈ 0".into() } else { fraction(value) }
}

fn fraction(value: &RBig) -> String {
    let text = value.to_string();
    if text.len() > LONGEST { readable(float(value), 4) } else { text }
}
