//! The page of a proof: its claim, a button that checks it, its numbers, and what is not proved.

use dashu_ratio::RBig;
use lcplab::lcp::file::Problem;
use lcplab::lcp::{Lcp, Question};
use lcplab::number::readable;
use lcplab::page::{self, Block, Cell, Page, Section, Table};
use lcplab::proof::{Claim, Entry, Kind, Proof, Reason, Tree, Vector};

/// Maximum number of rows of a table; the proof file has all of them.
const SHOWN: usize = 24;
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
    let mut sections = vec![section("proof", "The proof", vec![claim])];
    let numbers = numbers(problem, &proof.claim);
    if !numbers.is_empty() {
        sections.push(section("numbers", "What the proof consists of", numbers));
    }
    // Of several solutions, nothing stronger can be true.
    let is_strongest = matches!(proof.claim, Claim::NotUnique { .. });
    if !missing.is_empty() && !is_strongest {
        let reasons = missing.iter().map(|(kind, reason)| format!("- *{kind}*: {reason}\n"));
        let reasons = vec![Block::Text(reasons.collect())];
        sections.push(section(
            "missing",
            "Stronger statements, and why they are not proved",
            reasons,
        ));
    }
    let rows = problem.lcp.len();
    Page {
        title: format!("A proof about {name}"),
        lead: format!(
            "**Proved: {}.** This is the strongest statement that lcplab proves about this complementarity \
             problem of {rows} rows.",
            proof.sentence()
        ),
        sections,
        ..Page::default()
    }
}

/// Why the claim holds, in words and numbers.
fn numbers(problem: &Problem, claim: &Claim) -> Vec<Block> {
    let solutions = |points: &[&Vector], why: &str| {
        vec![Block::Text(why.into()), Block::Table(points_table(problem, points))]
    };
    match claim {
        Claim::Solution { x, .. } => solutions(
            &[x],
            "In each row x is at its lower bound and w ≥ 0, at its upper bound and w ≤ 0, or between \
             them and w = 0. The numbers are exact.",
        ),
        Claim::Unique { x, by: Reason::Definite } => solutions(
            &[x],
            "If x and y were two solutions, (x − y)ᵀ A (x − y) would not be positive. But A + Aᵀ is \
             positive definite: all pivots of its elimination in exact arithmetic are positive.",
        ),
        Claim::Unique { x, by: Reason::PMatrix } => solutions(
            &[x],
            "All principal minors of A are positive, so the problem has exactly one solution for every b.",
        ),
        Claim::NotUnique { x, y } => solutions(
            &[x, y],
            &format!(
                "Both x and y satisfy the conditions of every row in exact arithmetic, and they differ {}.{} \
                 Uniqueness cannot be proved, because two solutions exist.",
                differing(&problem.lcp, x, y),
                in_w(problem, x, y)
            ),
        ),
        Claim::NoSolution { tree: Tree::Leaf(d) } => vec![
            Block::Text(
                "Multiply each row by its d and add: the sum Σ d w is negative for every x within the bounds. \
                 But d is positive only where w ≥ 0 is required and negative only where w ≤ 0 is \
                 required, so for a solution the sum would not be negative."
                    .into(),
            ),
            Block::Table(vector_table(problem, d)),
        ],
        Claim::NoSolution { tree } => vec![Block::Text(format!(
            "Each row of a solution is at its lower bound, at its upper bound or free. The proof \
             distinguishes these cases row by row, and a vector as in a proof by one Farkas vector \
             excludes each of the {} cases.",
            tree.leaves()
        ))],
        Claim::ConeSolution { .. }
        | Claim::BodySolution { .. }
        | Claim::Motion(_)
        | Claim::FrozenMotion(_)
        | Claim::Within { .. } => Vec::new(),
    }
}

/// In how many rows two points differ by more than rounding.
fn differing(lcp: &Lcp, x: &Vector, y: &Vector) -> String {
    match seen(&values(lcp, x), &values(lcp, y)).len() {
        0 => format!("by less than {AGREES:e} of the largest entry"),
        rows => format!("in {rows} of {} rows", lcp.len()),
    }
}

/// The rows in which two points differ by more than rounding.
fn seen(x: &[RBig], y: &[RBig]) -> Vec<usize> {
    let size = |value: &RBig| value.to_f64().value().abs();
    let largest = x.iter().chain(y).map(size).fold(0.0, f64::max);
    (0..x.len()).filter(|&i| size(&(&x[i] - &y[i])) > AGREES * largest).collect()
}

/// How two solutions compare in w, which a motion decides.
fn in_w(problem: &Problem, x: &Vector, y: &Vector) -> &'static str {
    let lcp = &problem.lcp;
    let (x, y) = (values(lcp, x), values(lcp, y));
    let both = (0..x.len()).map(|i| [&x, &y].map(|point| w(lcp, point, i).to_f64().value()));
    let both: Vec<[f64; 2]> = both.collect();
    let largest = both.iter().flatten().fold(0.0_f64, |largest, w| largest.max(w.abs()));
    let agree = both.iter().all(|[at_x, at_y]| (at_x - at_y).abs() <= AGREES * largest);
    match (agree, unit(problem)) {
        (false, _) => "",
        (true, None) => " w is the same in both, up to rounding.",
        (true, Some(_)) => {
            " w is the same in both, up to rounding: the bodies move alike, and only the loads are shared differently."
        }
    }
}

fn points_table(problem: &Problem, points: &[&Vector]) -> Table {
    let lcp = &problem.lcp;
    let points: Vec<Vec<RBig>> = points.iter().map(|point| values(lcp, point)).collect();
    let names = ["x", "y"];
    let unit = unit(problem);
    let in_unit = |unit: Option<&str>| unit.map_or(String::new(), |unit| format!(" ({unit})"));
    let [of_x, of_w] = [in_unit(unit), in_unit(unit.and_then(unit_of_w))];
    let mut headings = "row".to_string();
    for name in &names[..points.len()] {
        headings += &format!(" | #{name}{of_x} | #w at {name}{of_w}");
    }
    // Of two solutions, only the rows that differ are compared, if that can be seen.
    let shown: Vec<usize> = match &points[..] {
        [x, y] => seen(x, y),
        _ => Vec::new(),
    };
    let shown = if shown.is_empty() { (0..lcp.len()).collect() } else { shown };
    let rows = shown.iter().take(SHOWN).map(|&i| {
        let of = |x: &Vec<RBig>| [fraction(&x[i]), fraction(&w(lcp, x, i))].map(Cell::text);
        [vec![Cell::text(label(problem, i))], points.iter().flat_map(of).collect()].concat()
    });
    let title = match points.len() {
        1 => "The solution",
        _ if shown.len() < lcp.len() => "Two solutions, in the rows in which they differ",
        _ => "Two solutions",
    };
    Table::new(title, more(shown.len()), &headings, rows.collect())
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
    let rows = problem.extra.get("rows")?.as_array()?;
    let first = rows.first()?.get("unit")?.as_str()?;
    let is_common =
        rows.iter().all(|row| row.get("unit").and_then(|own| own.as_str()) == Some(first));
    is_common.then_some(first)
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
    let rounded = "Long fractions are rounded here, not in the proof. Numbers such as 10⁻¹⁷ are exact: they come from \
                   the rounded A and b of the file.";
    match rows.saturating_sub(SHOWN) {
        0 => rounded.into(),
        more => format!("{rounded} The proof file contains {more} more rows."),
    }
}

/// The row's number, and its label if the file has one; of a contact's row, the point and the
/// direction if all rows are those of one pair of bodies.
fn label(problem: &Problem, i: usize) -> String {
    let labels = || {
        let rows = problem.extra.get("rows").and_then(|rows| rows.as_array()).into_iter().flatten();
        rows.filter_map(|row| row.get("label")?.as_str())
    };
    let Some(own) = labels().nth(i) else { return i.to_string() };
    let pairs: Option<Vec<&str>> = labels().map(|label| Some(contact(label)?.0)).collect();
    let is_one_pair = pairs.is_some_and(|pairs| pairs.iter().all(|pair| *pair == pairs[0]));
    match contact(own).filter(|_| is_one_pair) {
        Some((_, row)) => format!("{i}: {row}"),
        None => format!("{i}: {own}"),
    }
}

/// The bodies of a contact's row, and its point and direction: of `friction slope box 2 at face 0
/// on vertex 1` these are `slope box` and `vertex 1, friction 2`.
fn contact(label: &str) -> Option<(&str, String)> {
    let (front, features) = label.split_once(" at ")?;
    let (_, point) = features.split_once(" on ")?;
    let (front, component) = front.rsplit_once(' ')?;
    let (kind, bodies) = front.split_once(' ')?;
    Some((
        bodies,
        match kind {
            "normal" => format!("{point}, normal"),
            kind => format!("{point}, {kind} {component}"),
        },
    ))
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

fn fraction(value: &RBig) -> String {
    let text = value.to_string();
    if text.len() > LONGEST { readable(value.to_f64().value(), 4) } else { text }
}
