//! Residuals by sweep, next to the slopes that theory predicts.

use std::cmp::Ordering;

use crate::number::readable;
use crate::plot::{Axis, Lines, Series};
use crate::report::page::{Cell, Mark, Table};
use crate::report::study::convergence::sweeps::{Curve, Rates};
use crate::report::view::attempt::stem;
use crate::report::view::{Outcome, ReportPage};
use crate::solver::Pgs;

/// A measured rate, as digits per sweep, is marked if it differs from the predicted one by more
/// than this fraction.
const AGREES: f64 = 0.1;

pub(super) fn show(studies: &[&Rates], document: &mut ReportPage) {
    document.text(
        "While the active set does not change, each sweep multiplies the error by the same \
         matrix, and the residual after $k$ sweeps is proportional to $\\rho^k$, where $\\rho$ is the spectral radius \
         of this matrix: the curves below have the slope $\\log \\rho$. For a chain, whose matrix is tridiagonal, Young's theory also \
         gives the best relaxation factor:",
    );
    document.equation(
        "\\rho_{GS} = \\rho_J^2, \\qquad \\omega^* = \\frac{2}{1 + \\sqrt{1 - \\rho_J^2}}, \
         \\qquad \\rho(\\omega^*) = \\omega^* - 1",
        "Young 1950",
    );
    for study in studies {
        document.figure(figure(study));
    }
    document.table("rates", table(studies));
}

/// For equations the slope is claimed; with bounds only that no curve converges more slowly than ρ.
pub(super) fn outcome(studies: &[&Rates]) -> Outcome {
    let slopes = |equations: bool| {
        let studies = studies.iter().filter(move |study| study.equations_only == equations);
        studies
            .flat_map(|study| &study.curves)
            .filter_map(|curve| Some((curve.agrees()?, curve.is_slower()?)))
    };
    let (agree, all) = (slopes(true).filter(|(agrees, _)| *agrees).count(), slopes(true).count());
    let (settled, bounded) =
        (slopes(false).filter(|(agrees, _)| *agrees).count(), slopes(false).count());
    let slower = slopes(false).filter(|(agrees, slower)| !agrees && *slower).count();
    let mut says =
        format!("Without bounds, {agree} of {all} convergence rates match the spectral radius");
    if bounded > 0 {
        says += &format!("; with bounds, {settled} of {bounded}");
    }
    let faster = bounded - settled - slower;
    if faster > 0 {
        says += &format!(
            " (the other {faster} still converge faster than in the limit, which is not an error)"
        );
    }
    Outcome { good: agree == all && slower == 0, says }
}

impl Curve {
    /// Whether predicted and measured slope gain the same number of digits per sweep.
    fn agrees(&self) -> Option<bool> {
        let (predicted, measured) = (self.predicted_rate?, self.measured_rate?);
        Some((measured.ln() / predicted.ln() - 1.0).abs() <= AGREES)
    }

    /// Whether the curve converges more slowly than predicted.
    fn is_slower(&self) -> Option<bool> {
        Some(self.measured_rate? > self.predicted_rate?)
    }
}

fn name(omega: f64) -> String {
    if omega == 1.0 { Pgs::NAME.into() } else { format!("sor ω = {omega}") }
}

fn figure(study: &Rates) -> Lines {
    let residuals = |curve: &Curve| -> Vec<(f64, f64)> {
        curve.residuals.iter().map(|(sweep, residual)| (*sweep as f64, *residual)).collect()
    };
    let mut series: Vec<Series> = study
        .curves
        .iter()
        .map(|curve| Series::measured(name(curve.omega), residuals(curve)).labeled(label(curve)))
        .collect();
    series.extend(study.curves.iter().filter_map(slope));
    let rows = study.rows;
    let kind = if study.equations_only {
        "Equations only: after the first sweeps, the curves have the predicted slopes until rounding \
         errors dominate."
    } else {
        "With bounds: the prediction applies only once the active set no longer changes."
    };
    Lines::new(
        format!("convergence_{}", stem(&study.scene)),
        title(study),
        format!(
            "{rows} rows. The natural residual is the largest |x − Π(x − w)|. {kind} The pale bands show the \
             predicted slopes over the second half of each curve, where the rate is measured. Dantzig's method needs {} pivots for \
             the same problem.",
            study.pivots
        ),
        Axis::linear("sweep", ""),
        Axis::log("natural residual", "m/s or N s"),
        series,
    )
}

/// The predicted slope over the second half of the measured curve, through the middle of this half.
fn slope(curve: &Curve) -> Option<Series> {
    let rate = curve.predicted_rate?;
    let (start, _) = *curve.residuals.get(curve.residuals.len() / 2)?;
    let (middle, residual) = *curve.residuals.get(3 * curve.residuals.len() / 4)?;
    let at = |k: usize| (k as f64, residual * rate.powf(k as f64 - middle as f64));
    let name = format!("theory, {}", name(curve.omega));
    Some(Series::theory(name, vec![at(start), at(curve.sweeps)]).labeled(""))
}

/// ω, and the predicted factor per sweep, with the measured one if they disagree.
fn label(curve: &Curve) -> String {
    match (curve.measured_rate, curve.predicted_rate, curve.agrees()) {
        (Some(_), Some(rate), Some(true)) => format!("ω = {}: ρ = {rate:.4}", curve.omega),
        (Some(measured), Some(rate), _) => {
            format!("ω = {}: measured {measured:.4}, ρ = {rate:.4}", curve.omega)
        }
        _ => format!("ω = {}", curve.omega),
    }
}

/// The finding: the sweeps per decimal digit with PGS and with the best ω; until a curve has its
/// final slope, also those in the limit.
fn title(study: &Rates) -> String {
    let per_digit = |curve: &Curve| Some(-1.0 / curve.measured_rate?.log10());
    let needs = |curve: &Curve| {
        let limit = match (curve.predicted_rate, curve.agrees()) {
            (Some(rate), Some(false)) => {
                format!(" ({} in the limit)", readable(-1.0 / rate.log10(), 2))
            }
            _ => String::new(),
        };
        Some((readable(per_digit(curve)?, 2), limit))
    };
    let pgs = study.curves.iter().find(|curve| curve.omega == 1.0).and_then(needs);
    let measured = study.curves.iter().filter(|curve| per_digit(curve).is_some());
    let by_rate = |a: &&Curve, b: &&Curve| a.measured_rate.partial_cmp(&b.measured_rate);
    let best = measured.min_by(|a, b| by_rate(a, b).unwrap_or(Ordering::Equal));
    match (pgs, best.and_then(|best| Some((best.omega, needs(best)?)))) {
        (Some((pgs, limit)), Some((omega, (best, best_limit)))) => format!(
            "{}: a decimal digit takes {pgs} sweeps of pgs{limit}, {best} of SOR with ω = {omega}{best_limit}",
            study.title
        ),
        _ => study.title.clone(),
    }
}

fn table(studies: &[&Rates]) -> Table {
    let rows =
        studies.iter().flat_map(|study| study.curves.iter().map(|curve| cells(study, curve)));
    Table::new(
        "Contraction per sweep, predicted and measured",
        "The factor by which a sweep multiplies the error: *predicted* is the spectral radius of the \
             iteration matrix on the active set, *measured* the factor per sweep in the second half of the curve. \
             They agree if the numbers of digits gained per sweep differ by at most 10 %. With bounds, ρ is the limit \
             of the factor; a curve that still falls faster, because the slowest component is small, has *not \
             settled*. ω* is rounded to four decimals; because ρ(ω) has a vertical tangent there, the predicted ρ is \
             slightly larger than ω* − 1.",
        "scene | #ω | #predicted ρ | #measured | #sweeps recorded | agreement",
        rows.collect(),
    )
}

fn cells(study: &Rates, curve: &Curve) -> Vec<Cell> {
    let rate = |rate: Option<f64>| rate.map_or(Cell::text("–"), |rate| Cell::number(rate, 5));
    let agreement = match (curve.agrees(), curve.is_slower()) {
        (Some(true), _) => Cell::text("agrees").marked(Mark::Good),
        (Some(false), Some(false)) if !study.equations_only => Cell::text("not settled"),
        (Some(false), _) => Cell::text("differs").marked(Mark::Bad),
        (None, _) => Cell::text("–"),
    };
    let optimal = study.optimal_omega.is_some_and(|best| (best - curve.omega).abs() < 1e-4);
    let omega = Cell::number(curve.omega, 5);
    vec![
        Cell::text(&study.scene),
        if optimal { Cell { text: format!("{} = ω*", omega.text), ..omega } } else { omega },
        rate(curve.predicted_rate),
        rate(curve.measured_rate),
        Cell::count(curve.sweeps),
        agreement,
    ]
}
