//! Exact solutions near answers with sliding contacts: of problems with a closed form in 400 bits,
//! the rounded solution is always proved, and no other answer is.

use dashu_float::FBig;
use dashu_float::round::mode::HalfEven;
use lcplab_judge::{Demand, Verdict, judge_cone};
use lcplab_lcp::friction::{ConeProblem, Contact, FrictionProblem, Law};
use lcplab_testing::{INF, boxed, cases};
use proptest::prelude::*;

/// 400 bits.
type Big = FBig<HalfEven, 2>;

fn big(x: f64) -> Big {
    Big::try_from(x).unwrap().with_precision(400).value()
}

/// A contact in a chain of contacts: contact c changes the b of those after it.
#[derive(Debug, Clone)]
struct Link {
    /// a_n and a_t of its block of A, which is diagonal.
    scales: [f64; 2],
    b: [f64; 3],
    mu: f64,
    /// The block of A that multiplies the x of the contact before it.
    coupling: [f64; 9],
}

/// The solution of one contact in closed form: x_n = max(−b_n/a_n, 0) and x_t = −b_t/a_t, shortened
/// to μ x_n; under the associated law the least energy on the cone's side, if it slides.
fn closed_form(link: &Link, b: &[Big; 3], law: Law) -> [Big; 3] {
    let [a_n, a_t] = link.scales.map(big);
    let (mu, zero) = (big(link.mu), big(0.0));
    let push = (&b[1] * &b[1] + &b[2] * &b[2]).sqrt();
    let normal = (-&b[0] / &a_n).max(zero.clone());
    if &push / &a_t <= &mu * &normal {
        return [normal, -&b[1] / &a_t, -&b[2] / &a_t];
    }
    let normal = match law {
        Law::Coulomb => normal,
        Law::Associated => (&mu * &push - &b[0]) / (&a_n + &mu * &mu * &a_t),
    };
    if normal <= zero {
        return [zero.clone(), zero.clone(), zero];
    }
    let friction = &mu * &normal / &push;
    [normal, -&friction * &b[1], -&friction * &b[2]]
}

/// The problem of a chain, and its only solution.
fn chain(links: &[Link], law: Law) -> (ConeProblem, Vec<Big>) {
    let n = 3 * links.len();
    let (mut a, mut x) = (vec![vec![0.0; n]; n], Vec::<Big>::new());
    for (c, link) in links.iter().enumerate() {
        let mut b = link.b.map(big);
        for i in 0..3 {
            a[3 * c + i][3 * c + i] = link.scales[i.min(1)];
            for j in 0..3 * usize::from(c > 0) {
                a[3 * c + i][3 * c - 3 + j] = link.coupling[3 * i + j];
                b[i] += big(link.coupling[3 * i + j]) * &x[3 * c - 3 + j];
            }
        }
        x.extend(closed_form(link, &b, law));
    }
    let rows: Vec<&[f64]> = a.iter().map(Vec::as_slice).collect();
    let b: Vec<f64> = links.iter().flat_map(|link| link.b).collect();
    let lo: Vec<f64> = (0..n).map(|i| if i % 3 == 0 { 0.0 } else { -INF }).collect();
    let contact =
        |(c, link): (usize, &Link)| Contact { rows: [3 * c, 3 * c + 1, 3 * c + 2], mu: link.mu };
    let contacts = links.iter().enumerate().map(contact).collect();
    let friction = FrictionProblem::new(boxed(&rows, &b, &lo, &vec![INF; n]), contacts).unwrap();
    (ConeProblem::new(friction, law), x)
}

fn rounded(x: &[Big]) -> Vec<f64> {
    x.iter().map(|x| x.to_f64().value()).collect()
}

/// max |x_i − y_i| of the exact solution y.
fn distance(x: &[f64], exact: &[Big]) -> Big {
    let misses = x.iter().zip(exact).map(|(&x, y)| big(x) - y);
    misses.map(|miss| (-&miss).max(miss)).max().unwrap()
}

fn size(x: &[f64]) -> f64 {
    x.iter().fold(0.0, |most, x| f64::max(most, x.abs()))
}

/// One to four contacts whose scales, loads and pushes lie between 10⁻⁸ and 10⁸; a contact pushes
/// the next one about as much as that one's own load.
fn links() -> impl Strategy<Value = Vec<Link>> {
    let power = || (-8i32..=8).prop_map(|e| 10f64.powi(e));
    // Away from 0, where a contact is at the boundary between two states.
    let part = || (0.01f64..1.0, any::<bool>()).prop_map(|(x, up)| if up { x } else { -x });
    let link = (
        [power(), power(), power(), power()],
        [part(), part(), part()],
        prop_oneof![Just(0.0), 0.1f64..1.5],
        prop::collection::vec(part(), 9),
        prop_oneof![Just(-1.0), Just(-1.0), Just(1.0)],
    );
    prop::collection::vec(link, 1..=4).prop_map(|links| {
        let mut before: Option<[f64; 2]> = None;
        let link = |([a_n, a_t, load, push], part, mu, coupling, sign): (
            [f64; 4],
            [f64; 3],
            f64,
            Vec<f64>,
            f64,
        )| {
            // x of the contact before is about load/a, and A x here about this load.
            let unit = before.map_or(0.0, |[load_before, a]| load * a / load_before);
            before = Some([load, a_n]);
            Link {
                scales: [a_n, a_t],
                b: [sign * load * f64::abs(part[0]), push * part[1], push * part[2]],
                mu,
                coupling: std::array::from_fn(|k| unit * coupling[k]),
            }
        };
        links.into_iter().map(link).collect()
    })
}

fn laws() -> impl Strategy<Value = Law> {
    prop::sample::select(vec![Law::Coulomb, Law::Associated])
}

proptest! {
    #![proptest_config(cases(300))]

    #[test]
    fn the_rounded_solution_is_accepted_and_proved_at_its_true_distance(links in links(), law in laws()) {
        let (problem, exact) = chain(&links, law);
        let x = rounded(&exact);
        let verdict = judge_cone(&problem, &x, &Demand::default()).verdict;
        prop_assert!(verdict.is_solution(), "{verdict}, {x:?}");
        // Entries of 10²² and 10⁻⁴ in one problem can leave it unproved.
        let smallest = x.iter().map(|x| x.abs()).filter(|&x| x > 0.0).fold(INF, f64::min);
        let Verdict::Proved { distance: stated } = verdict else {
            prop_assert!(smallest < 1e-20 * size(&x), "{verdict}, {x:?}");
            return Ok(());
        };
        prop_assert!(distance(&x, &exact) <= big(stated), "{x:?}");
        prop_assert!(stated <= 2.0 * f64::EPSILON * size(&x), "{stated} {x:?}");
    }

    #[test]
    fn a_proof_never_states_less_than_the_true_distance(
        links in links(),
        law in laws(),
        at in any::<prop::sample::Index>(),
        exponent in -12.0f64..-3.0,
        sign in prop::sample::select(vec![-1.0, 1.0]),
    ) {
        let (problem, exact) = chain(&links, law);
        let mut x = rounded(&exact);
        let i = at.index(x.len());
        x[i] += sign * 10f64.powf(exponent) * size(&x);
        let certificate = judge_cone(&problem, &x, &Demand::default());
        if let Verdict::Proved { distance: stated } = certificate.verdict {
            prop_assert!(distance(&x, &exact) <= big(stated), "{x:?}");
            prop_assert!(stated <= 1e-6 * size(&x), "{x:?}");
        }
    }

    #[test]
    fn friction_in_another_direction_or_state_is_never_proved(
        links in links(),
        law in laws(),
        turn in prop::sample::select(vec![0.0, 0.5, -1.0, 1e-3]),
        angle in prop::sample::select(vec![0.0f64, 1e-3, 1.0, 3.0]),
        at in any::<prop::sample::Index>(),
    ) {
        let (problem, exact) = chain(&links, law);
        let mut x = rounded(&exact);
        let c = 3 * at.index(x.len() / 3);
        let (t1, t2) = (x[c + 1], x[c + 2]);
        x[c + 1] = (1.0 + turn) * (angle.cos() * t1 - angle.sin() * t2);
        x[c + 2] = (1.0 + turn) * (angle.sin() * t1 + angle.cos() * t2);
        if let Verdict::Proved { distance: stated } =
            judge_cone(&problem, &x, &Demand::default()).verdict
        {
            prop_assert!(distance(&x, &exact) <= big(stated), "{x:?}");
        }
    }
}

/// A unit mass on the floor, pressed and pushed; μ = ½.
fn pushed(law: Law, unit: f64, b: [f64; 3]) -> ConeProblem {
    let a: [&[f64]; 3] = [&[unit, 0.0, 0.0], &[0.0, unit, 0.0], &[0.0, 0.0, unit]];
    let lcp = boxed(&a, &b, &[0.0, -INF, -INF], &[INF; 3]);
    let contact = Contact { rows: [0, 1, 2], mu: 0.5 };
    ConeProblem::new(FrictionProblem::new(lcp, vec![contact]).unwrap(), law)
}

#[test]
fn a_rational_sliding_contact_is_an_exact_solution() {
    // It slides along t1 with 3 − 1 m/s: x_t = μ x_n = 1. Associated: x_n = (2 + ½·3) / 1.25.
    let slides = pushed(Law::Coulomb, 1.0, [-2.0, -3.0, 0.0]);
    let verdict = judge_cone(&slides, &[2.0, 1.0, 0.0], &Demand::default()).verdict;
    assert_eq!(verdict, Verdict::Proved { distance: 0.0 });
    let slides = pushed(Law::Associated, 1.0, [-2.0, -3.0, 0.0]);
    let verdict = judge_cone(&slides, &[2.8, 1.4, 0.0], &Demand::default()).verdict;
    assert!(verdict.distance().is_some_and(|distance| distance < 1e-15), "{verdict}");
}

#[test]
fn a_rounded_answer_of_size_1e18_is_proved() {
    // x_n = 2e18, and x_t = 1e18 along (3, 4)/5: the rounding error of A x exceeds the slip.
    let size = 2f64.powi(61);
    let problem = pushed(Law::Coulomb, 1.0, [-size, -0.3 * size - 3.0, -0.4 * size - 4.0]);
    let x = [size, 0.3 * size, 0.4 * size];
    let certificate = judge_cone(&problem, &x, &Demand::default());
    let Verdict::Proved { distance } = certificate.verdict else { panic!("{certificate:?}") };
    assert!(distance <= 64.0 * f64::EPSILON * size, "{distance}");
    // Off by 1e-7 it is not.
    let off = [size, 0.3 * size * (1.0 + 1e-7), 0.4 * size];
    assert_eq!(judge_cone(&problem, &off, &Demand::default()).verdict.distance(), None);
}

#[test]
fn a_box_around_a_zero_with_a_nearly_singular_derivative_stays_smaller_than_x() {
    // Rank 3, with one contact that is open, one that sticks and one that slides. x is off in the
    // open one. A larger box is not proved either: its image grows with the square of its size, and
    // so does the number of digits.
    let a: [&[f64]; 9] = [
        &[1.0, 2.0, 0.0, 1.0, -1.0, -1.0, 2.0, 0.0, -2.0],
        &[2.0, 5.0, -1.0, 1.0, 0.0, -2.0, 2.0, -2.0, -3.0],
        &[0.0, -1.0, 1.0, 1.0, -2.0, 0.0, 2.0, 2.0, -1.0],
        &[1.0, 1.0, 1.0, 2.0, -3.0, -1.0, 4.0, 2.0, -3.0],
        &[-1.0, 0.0, -2.0, -3.0, 5.0, 1.0, -6.0, -4.0, 4.0],
        &[-1.0, -2.0, 0.0, -1.0, 1.0, 1.0, -2.0, 0.0, 2.0],
        &[2.0, 2.0, 2.0, 4.0, -6.0, -2.0, 8.0, 4.0, -6.0],
        &[0.0, -2.0, 2.0, 2.0, -4.0, 0.0, 4.0, 4.0, -2.0],
        &[-2.0, -3.0, -1.0, -3.0, 4.0, 2.0, -6.0, -2.0, 5.0],
    ];
    let b = [-100.5, -179.0, -26.0, -133.0, 161.0, 105.0, -256.0, -53.0, 242.0];
    let lo: Vec<f64> = (0..9).map(|i| if i % 3 == 0 { 0.0 } else { -INF }).collect();
    let contact = |(c, mu)| Contact { rows: [3 * c, 3 * c + 1, 3 * c + 2], mu };
    let contacts = [0.5, 0.75, 2.0].into_iter().enumerate().map(contact).collect();
    let friction = FrictionProblem::new(boxed(&a, &b, &lo, &[INF; 9]), contacts).unwrap();
    let problem = ConeProblem::new(friction, Law::Associated);
    let exact = [0.0, 0.0, 0.0, 4.0, 0.0, 3.0, 20.0, -24.0, -32.0];
    let verdict = |x: &[f64]| judge_cone(&problem, x, &Demand::default()).verdict;
    assert_eq!(verdict(&exact), Verdict::Proved { distance: 0.0 });
    let mut x = exact;
    x[2] = -0.00011996290282846902;
    assert!(!verdict(&x).is_solution());
}
