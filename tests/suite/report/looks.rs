//! Every registered solver has a look of its own, and no two names that a shipped report draws in
//! one figure have similar colors.

use lcplab::plot::style::style;
use lcplab::scene::Scheme;
use lcplab::solver::{KNOWN_WRONG, Registry};

/// The least CIEDE2000 distance of two colors; from about 10 on, they differ at a glance.
const APART: f64 = 12.0;

#[test]
fn no_two_names_of_a_figure_have_similar_colors_in_light_or_dark() {
    let solvers = || {
        Registry::standard().entries().map(|entry| &*entry.name).chain(["clarabel", "sor ω = 1.7"])
    };
    let schemes = Scheme::ALL.map(Scheme::name);
    let engines = ["mujoco", "drake", "pybullet", "rapier", "pinocchio", "dart", "siconos"];
    let integrators = ["midpoint rule", "RK4", "velocity cone"];
    let causes =
        ["contact", "restitution", "integrator", "friction", "constraint", "gap", "bias", "sum"];
    let sets: [Vec<&str>; 6] = [
        solvers().collect(),
        schemes.into_iter().chain(integrators).chain(engines).collect(),
        causes.into(),
        vec!["pgs, 10 sweeps", "pgs, 50 sweeps", "dantzig"],
        vec!["sor ω = 0.8", "pgs", "sor ω = 1.3", "sor ω = 1.6", "sor ω = 1.9"],
        vec!["pgs", "sor ω = 1.3", "sor ω = 1.5", "sor ω = 1.7894", "sor ω = 1.9"],
    ];
    for names in sets {
        for (k, a) in names.iter().enumerate() {
            for b in &names[..k] {
                let (one, other) = (style(a).color, style(b).color);
                let light = distance(lab(one), lab(other));
                let dark = distance(lab(inverted(one)), lab(inverted(other)));
                assert!(light.min(dark) >= APART, "{a} and {b}: {light:.1}, dark {dark:.1}");
            }
        }
    }
}

/// The color on a dark page: the filter `invert(1) hue-rotate(180deg)`.
fn inverted((r, g, b): (u8, u8, u8)) -> (u8, u8, u8) {
    let [r, g, b] = [r, g, b].map(|c| 255.0 - f64::from(c));
    let mix = |row: [f64; 3]| (row[0] * r + row[1] * g + row[2] * b).clamp(0.0, 255.0) as u8;
    (mix([-0.574, 1.43, 0.144]), mix([0.426, 0.43, 0.144]), mix([0.426, 1.43, -0.856]))
}

/// CIE L*a*b* of an sRGB color, D65.
fn lab((r, g, b): (u8, u8, u8)) -> [f64; 3] {
    let linear = |c: u8| match f64::from(c) / 255.0 {
        c if c <= 0.04045 => c / 12.92,
        c => ((c + 0.055) / 1.055).powf(2.4),
    };
    let [r, g, b] = [r, g, b].map(linear);
    let root = |t: f64| if t > 0.008856 { t.cbrt() } else { 7.787 * t + 16.0 / 116.0 };
    let x = root((0.412_456_4 * r + 0.357_576_1 * g + 0.180_437_5 * b) / 0.95047);
    let y = root(0.212_672_9 * r + 0.715_152_2 * g + 0.072_175 * b);
    let z = root((0.019_333_9 * r + 0.119_192 * g + 0.950_304_1 * b) / 1.08883);
    [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
}

/// CIEDE2000 (Sharma, Wu, Dalal 2005).
fn distance([l1, a1, b1]: [f64; 3], [l2, a2, b2]: [f64; 3]) -> f64 {
    let seventh = |c: f64| (c.powi(7) / (c.powi(7) + 25f64.powi(7))).sqrt();
    let g = 0.5 * (1.0 - seventh(f64::midpoint(a1.hypot(b1), a2.hypot(b2))));
    let (a1, a2) = ((1.0 + g) * a1, (1.0 + g) * a2);
    let (c1, c2) = (a1.hypot(b1), a2.hypot(b2));
    let hue = |a: f64, b: f64| b.atan2(a).to_degrees().rem_euclid(360.0);
    let (h1, h2) = (hue(a1, b1), hue(a2, b2));
    let turn = (h2 - h1 + 180.0).rem_euclid(360.0) - 180.0;
    let (l, c, h) = (f64::midpoint(l1, l2), f64::midpoint(c1, c2), h1 + 0.5 * turn);
    let cos = |k: f64, phase: f64| (k * h + phase).to_radians().cos();
    let t = 1.0 - 0.17 * cos(1.0, -30.0) + 0.24 * cos(2.0, 0.0) + 0.32 * cos(3.0, 6.0)
        - 0.2 * cos(4.0, -63.0);
    let off = (l - 50.0).powi(2);
    let by_l = (l2 - l1) / (1.0 + 0.015 * off / (20.0 + off).sqrt());
    let by_c = (c2 - c1) / (1.0 + 0.045 * c);
    let by_h = 2.0 * (c1 * c2).sqrt() * (0.5 * turn).to_radians().sin() / (1.0 + 0.015 * c * t);
    let bend = 30.0 * (-((h.rem_euclid(360.0) - 275.0) / 25.0).powi(2)).exp();
    let twist = -2.0 * seventh(c) * (2.0 * bend).to_radians().sin();
    (by_l.powi(2) + by_c.powi(2) + by_h.powi(2) + twist * by_c * by_h).sqrt()
}

#[test]
fn the_distance_of_colors_is_that_of_the_published_pairs() {
    // Pairs 1, 9 and 17 of Sharma, Wu and Dalal.
    let pairs = [
        ([50.0, 2.6772, -79.7751], [50.0, 0.0, -82.7485], 2.0425),
        ([50.0, 2.49, -0.001], [50.0, -2.49, 0.0009], 7.1792),
        ([50.0, 2.5, 0.0], [73.0, 25.0, -18.0], 27.1492),
    ];
    for (a, b, published) in pairs {
        assert!((distance(a, b) - published).abs() < 5e-5, "{}", distance(a, b));
    }
}

#[test]
fn no_two_solvers_look_the_same_in_grey() {
    let registered = Registry::standard()
        .entries()
        .chain(KNOWN_WRONG)
        .map(|entry| &*entry.name)
        .filter(|&n| n != "sor");
    let sor = ["sor ω = 0.8", "sor ω = 1.3", "sor ω = 1.5", "sor ω = 1.7", "sor ω = 1.9"];
    let names: Vec<&str> = registered.chain(["clarabel"]).chain(sor).collect();
    let looks: Vec<_> = names.iter().map(|name| style(name)).collect();
    for (k, a) in looks.iter().enumerate() {
        let same = looks[..k].iter().position(|b| (a.dash, a.marker) == (b.dash, b.marker));
        assert!(same.is_none(), "{} looks as {} does in gray", names[k], names[same.unwrap()]);
    }
}

#[test]
fn an_unlisted_solver_differs_from_all_listed_ones_in_gray() {
    let listed: Vec<_> = Registry::standard().entries().map(|entry| style(&entry.name)).collect();
    for k in 0..100 {
        let own = style(&format!("solver {k}"));
        let same =
            listed.iter().position(|other| (own.dash, own.marker) == (other.dash, other.marker));
        assert_eq!(
            same.map(|at| Registry::standard().entries().nth(at).unwrap().name.as_ref()),
            None,
            "solver {k}"
        );
    }
}
