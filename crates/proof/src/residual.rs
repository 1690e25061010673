//! The scaled residual of an answer, in exact arithmetic.

use dashu_int::ops::Abs;
use dashu_ratio::RBig;

use lcplab_lcp::Lcp;
use lcplab_lcp::exact::dyadic::{Dyadic, dyadic, rational};

use crate::claim::Fraction;

/// max r_i as `docs/proofs.md` defines it; `None` if it is not finite.
pub fn scaled(lcp: &Lcp, x: &[f64]) -> Option<Fraction> {
    let rows: Vec<Row> = (0..lcp.len()).map(|i| Row::at(lcp, i, x)).collect();
    let mut most = RBig::ZERO;
    for i in 0..lcp.len() {
        most = most.max(miss(lcp, i, x, &rows)?);
    }
    let (numerator, denominator) = most.into_parts();
    Some(Fraction { numerator, denominator: denominator.into() })
}

/// w_i, T_i and s_i.
struct Row {
    w: RBig,
    terms: RBig,
    scale: RBig,
}

impl Row {
    fn at(lcp: &Lcp, i: usize, x: &[f64]) -> Row {
        let products = || {
            let row = lcp.matrix().row(i).iter().map(|(j, a)| dyadic(a) * dyadic(x[j]));
            row.chain([dyadic(lcp.b()[i])])
        };
        let sum = |terms: &mut dyn Iterator<Item = Dyadic>| {
            rational(&terms.fold(Dyadic::ZERO, |sum, term| sum + term))
        };
        let largest = || lcp.matrix().row(i).iter().map(|(_, a)| a.abs()).fold(0.0, f64::max);
        let scale = match (lcp.matrix().diagonal(i).abs(), largest()) {
            (0.0, largest) => largest,
            (own, _) => own,
        };
        let rest = exact(lcp.scale()) * exact(scale);
        let terms = sum(&mut products().map(|term| if term < Dyadic::ZERO { -term } else { term }));
        let scale = if scale == 0.0 { RBig::ONE } else { exact(scale) };
        Row { w: sum(&mut products()), terms: terms.max(rest), scale }
    }
}

fn exact(value: f64) -> RBig {
    rational(&dyadic(value))
}

/// r_i.
fn miss(lcp: &Lcp, i: usize, x: &[f64], rows: &[Row]) -> Option<RBig> {
    let row = &rows[i];
    let (mut own, mut lo, mut hi) = (exact(x[i]), bound(lcp.lo()[i]), bound(lcp.hi()[i]));
    let mut reach = own_reach(lcp, i);
    if let Some((k, mu)) = lcp.coupled_to(i) {
        let mu = exact(mu);
        let limit = &mu * exact(x[k]).max(RBig::ZERO);
        let near = &limit / RBig::from(1_u64 << 50);
        for bound in [-limit.clone(), limit.clone()] {
            if (&own - &bound).abs() <= near {
                own = bound;
            }
        }
        (lo, hi) = (Some(-limit.clone()), Some(limit));
        let natural = &rows[k].terms / &rows[k].scale;
        let size = own_reach(lcp, k).map_or(natural.clone(), |reach| natural.min(reach));
        reach = Some(mu * exact(x[k]).max(size)).filter(|reach| *reach != RBig::ZERO);
    }
    let natural = &row.terms / &row.scale;
    let unit = reach.map_or(natural.clone(), |reach| natural.min(reach));
    let step = match row.terms == RBig::ZERO {
        true => RBig::ZERO,
        false => &unit * &row.w / &row.terms,
    };
    let target = &own - step;
    let target = lo.map_or(target.clone(), |lo| target.max(lo));
    let target = hi.map_or(target.clone(), |hi| target.min(hi));
    match (own - target).abs() {
        miss if miss == RBig::ZERO => Some(miss),
        _ if unit == RBig::ZERO => None,
        miss => Some(miss / unit),
    }
}

fn bound(value: f64) -> Option<RBig> {
    value.is_finite().then(|| exact(value))
}

/// R_i of a row that is not coupled; `None` for ∞.
fn own_reach(lcp: &Lcp, i: usize) -> Option<RBig> {
    let finite = [lcp.lo()[i], lcp.hi()[i]].into_iter().filter(|bound| bound.is_finite());
    match finite.fold(0.0, |most: f64, bound| most.max(bound.abs())) {
        0.0 => None,
        most => Some(exact(most.max(lcp.scale()))),
    }
}
