//! The answer to each problem with parameters by a second method, which shares nothing with the
//! formulas of the problem files: bisection, steps in time, scans of a slider, all cases of an LCP,
//! or the command that the problem tells the student to run.

use std::collections::BTreeMap;
use std::f64::consts::PI;
use std::process::Command;

use lcplab::lcp::{Lcp, Matrix, library};
use lcplab::lesson::problem::Problem;
use lcplab::solver::{BlockPivoting, Options, Registry, Solver, Start, Status};
use nalgebra::{DMatrix, DVector};

const G: f64 = 9.81;

/// The answer, or `None` for a problem that is not known here.
pub(super) fn answer(problem: &Problem) -> Option<f64> {
    let Some((_, method)) = METHODS.iter().find(|(id, _)| *id == problem.id) else {
        return run_by_student(problem);
    };
    Some(method(&|name: &str| problem.parameters[name]))
}

type Numbers<'a> = &'a dyn Fn(&str) -> f64;
type Method = fn(Numbers) -> f64;

const METHODS: [(&str, Method); 36] = [
    ("1.p1", |p| {
        let tray = -(p("v") + p("more"));
        let falls = -p("v") - G * p("dt");
        let x = &solutions(&[&[1.0 / p("m")]], &[falls - tray], &[f64::INFINITY])[0];
        x[0]
    }),
    ("1.p2", |p| {
        let a: [&[f64]; 2] = [&[1.0, -1.0], &[-1.0, 2.0]];
        let x = &solutions(&a, &[-1.0, 0.0], &[p("upper"), p("lower")])[0];
        1.0 - x[1] // gravity gives the lower load 1 m/s
    }),
    ("1.x1", |p| {
        let is_several = |a01: f64| {
            solutions(&[&[2.0, a01], &[a01, 2.0]], &[-1.0, -p("c")], &[f64::INFINITY; 2]).len() > 1
        };
        slider(-4.0, 4.0, 0.1).find(|a01| is_several(*a01)).unwrap()
    }),
    ("2.p1", |p| {
        let puck = |t: f64| (0.3 * p("k") + p("vx") * t).hypot(0.4 * p("k") + p("vy") * t);
        let bob = 0.6 * p("vx") + 0.8 * p("vy"); // upwards, so that the rope keeps its length
        let length = |t: f64| puck(t) + (-p("h") + bob * t).abs();
        assert!(slope(length).abs() < 1e-6);
        curvature(length)
    }),
    ("2.p2", |p| {
        // A positive turn about y takes z towards x; the door turns the other way.
        slope(|t| {
            let angle = -p("omega") * t;
            angle.sin() * p("r") + angle.cos() * p("v") * t
        })
    }),
    ("2.x1", |p| {
        // J₁ = 2 J₀ and b = J u*: all points of one line are solutions if the lines coincide.
        let is_one_line = |b1: f64| {
            let [x0, x1] = [[p("v"), 0.0], [0.0, p("v") / 2.0]];
            let w1 = |x: [f64; 2]| 2.0 * x[0] + 4.0 * x[1] + b1;
            w1(x0).abs() + w1(x1).abs() < 1e-9
        };
        slider(-4.0, 4.0, 0.1).find(|b1| is_one_line(*b1)).unwrap()
    }),
    ("3.p1", |p| {
        let inertia = p("m") * p("l").powi(2) / 12.0;
        let (middle, spin) = (1.0 / p("m"), p("l") / 2.0 / inertia);
        zero(0.0, p("l"), |distance| middle - spin * distance)
    }),
    ("3.p2", |p| {
        // In free flight the gap to the circle would open with c̈ = b.
        let gap = |t: f64| (p("v") * t).hypot(p("R") - G / 2.0 * t * t) - p("R");
        -p("m") * curvature(gap)
    }),
    ("3.x1", |p| {
        let pushes = |b1: f64| {
            let a: [&[f64]; 2] = [&[1.0, -1.0], &[-1.0, 2.0]];
            solutions(&a, &[-p("u"), b1], &[f64::INFINITY; 2])[0][1] > 1e-9
        };
        slider(-4.0, 4.0, 0.1).filter(|b1| pushes(*b1)).last().unwrap()
    }),
    ("4.p1", |p| {
        let mut x = [3.0 * p("weight"), 2.0 * p("weight")];
        for _ in 0..2 {
            x[0] = (x[0] - (x[0] - x[1] - p("weight"))).max(0.0);
            x[1] = (x[1] - (-x[0] + 2.0 * x[1]) / 2.0).max(0.0);
        }
        x[0]
    }),
    ("5.p1", |p| {
        // Sweeps over the ten rows, of which row 6 stays at its bound; after a hundred of them the
        // error falls by its rate.
        let mut error = [1.0_f64; 10];
        error[6] = 0.0;
        let mut sweep = || {
            for i in (0..10).filter(|i| *i != 6) {
                let below = if i > 0 { error[i - 1] } else { 0.0 };
                let above = if i < 9 { error[i + 1] } else { 0.0 };
                error[i] = (below + above) / if i == 0 { 1.0 } else { 2.0 };
            }
            error.iter().fold(0.0_f64, |most, own| most.max(own.abs()))
        };
        let first = (0..100).map(|_| sweep()).last().unwrap();
        let needed = first * 10.0_f64.powf(-p("digits"));
        (1..).find(|_| sweep() <= needed).unwrap().into()
    }),
    ("6.p1", |p| {
        let a: [&[f64]; 2] = [&[2.0, -1.0], &[-1.0, 2.0]];
        solutions(&a, &[p("opens"), -p("closes")], &[f64::INFINITY; 2])[0][1]
    }),
    ("6.p2", |p| {
        let a: [&[f64]; 3] = [&[1.0, -1.0, 0.0], &[-1.0, 2.0, 0.0], &[0.0, 0.0, 1.0]];
        solutions(&a, &[-p("v"), 0.0, -p("v")], &[f64::INFINITY; 3])[0][0]
    }),
    ("7.p1", |p| {
        let q = p("p") + 3.0 * p("k");
        let cover = |x1: f64| q - 2.0 * x1; // keeps w₁ at 0
        cover(zero(0.0, q, |x1| -x1 - p("p") + cover(x1)))
    }),
    ("7.x1", |p| {
        let ends_on_ray = |a11: f64| {
            let a = Matrix::dense(2, &[1.0, p("a"), 2.0, a11]);
            let lcp = Lcp::new(a, vec![-1.0, -1.5], vec![0.0; 2], vec![f64::INFINITY; 2]).unwrap();
            let lemke = Registry::standard().entry("lemke").unwrap().build(&Options::default());
            lemke.solve(&lcp, &Start::default(), &mut ()).status != Status::Solved
        };
        slider(-2.0, 2.0, 0.1).filter(|a11| ends_on_ray(*a11)).last().unwrap()
    }),
    ("7.r1", |p| {
        let n = p("n") as usize;
        let lcp = library::by_name("murty").unwrap().generate(&[("n", p("n"))]).unwrap().lcp;
        let start = vec![0.0; n];
        BlockPivoting::default().solve(&lcp, &Start::at(&start), &mut ()).iterations as f64
    }),
    ("8.p1", |p| {
        let x = [0.5 + p("error"), 2.0 * p("error")];
        let w = [2.0 * x[0] - x[1] - 1.0, -x[0] + 2.0 * x[1] + 0.5];
        let gap = x[0] * w[0] + x[1] * w[1];
        zero(0.0, 10.0, |speed| gap - speed * speed) // all of it in one ball of 1 kg
    }),
    ("8.p2", |p| {
        let x = [2.0 * p("p"), 0.0];
        let w = [2.0 * x[0] + x[1] - 2.0 * p("p"), x[0] + 2.0 * x[1] + 1.0];
        x[0].min(w[0]).abs().max(x[1].min(w[1]).abs())
    }),
    ("9.p1", |p| {
        // The load of leg 2 decides the other three: moments about both sides, then the sum.
        let legs = |x2: f64| {
            let (x1, x3) = (p("weight") * p("a") - x2, p("weight") * p("b") - x2);
            [p("weight") - x1 - x2 - x3, x1, x2, x3]
        };
        let all = (0..=100_000).map(|k| legs(p("weight") * f64::from(k) / 1e5));
        let standing = all.filter(|legs| legs.iter().all(|x| *x >= -1e-9));
        standing.map(|legs| legs[0]).fold(0.0, f64::max)
    }),
    ("9.x1", |p| {
        let ends_above = |start: f64| {
            let mut x = [0.0, start];
            for _ in 0..100 {
                x[0] = (p("c") - 2.0 * x[1]).max(0.0);
                x[1] = (p("c") - 2.0 * x[0]).max(0.0);
            }
            x[1] > x[0]
        };
        slider(0.0, 4.0, 0.1).find(|start| ends_above(*start)).unwrap()
    }),
    ("10.p1", |p| {
        let (slop, dt) = (p("slop") / 1e3, p("dt"));
        // How much faster the row asks the ball to be in the second step than it is by itself.
        let pushes = |d: f64| {
            let asked = |overlap: f64| p("beta") / dt * (overlap - slop);
            let first = asked(d);
            asked(d - first * dt) - (first - G * dt)
        };
        1e3 * zero(slop, 10.0, pushes)
    }),
    ("10.p2", |p| {
        let (mut place, mut velocity) = ([p("l"), 0.0], [0.0, p("v")]);
        let energy = |v: [f64; 2]| v[0] * v[0] + v[1] * v[1];
        let half = energy(velocity) / 2.0;
        let mut projections = 0.0;
        while energy(velocity) > half * (1.0 + 1e-9) {
            place = [place[0] + velocity[0] * p("dt"), place[1] + velocity[1] * p("dt")];
            let size = place[0].hypot(place[1]);
            let normal = [place[0] / size, place[1] / size];
            place = [normal[0] * p("l"), normal[1] * p("l")];
            let along = velocity[0] * normal[0] + velocity[1] * normal[1];
            velocity = [velocity[0] - along * normal[0], velocity[1] - along * normal[1]];
            projections += 1.0;
        }
        projections
    }),
    ("11.p1", |p| {
        let angle = p("angle") * PI / 180.0;
        let wanted = [p("push") * angle.cos(), p("push") * angle.sin()];
        let nearest = nearest_on_polygon(p("press") / 2.0, 8, wanted);
        nearest[0].hypot(nearest[1])
    }),
    ("11.p2", |p| zero(0.0, 1e3, |v| p("part") - v / v.hypot(p("belt")))),
    ("11.x1", |p| {
        let pushes_aside = |size: f64| {
            let wanted = [size * (PI / 6.0).cos(), size * (PI / 6.0).sin()];
            nearest_on_polygon(p("press") / 2.0, 4, wanted)[1] > 1e-9
        };
        slider(0.0, 4.0, 0.05).filter(|size| pushes_aside(*size)).last().unwrap()
    }),
    ("12.p1", |p| {
        let lower_after = |ratio: f64| {
            let (u1, u2) = (p("k"), -1.0);
            // Momentum, and the relative velocity times −e.
            let middle = (ratio * u1 + u2) / (ratio + 1.0);
            middle - p("k") * (u1 - u2) / (ratio + 1.0)
        };
        zero(0.1, 100.0, lower_after)
    }),
    ("12.p2", |p| {
        let normal = p("down") + p("k") * p("down");
        // A solid ball has I = ⅖ m r²: an impulse x at its lowest point slows that point by 7/2 x.
        let stops = p("side") / 3.5;
        p("side") - stops.min(p("mu") * normal)
    }),
    ("13.p1", |p| {
        let (s, c) = (p("angle") * PI / 180.0).sin_cos();
        let a = 1.0 + 3.0 * c * c - 3.0 * p("mu") * s * c;
        let has_force = |spin: f64| !line(a, spin * spin * s - 1.0).is_empty();
        zero(0.0, 5.0, |spin| if has_force(spin) { 1.0 } else { -1.0 })
    }),
    ("13.x1", |p| {
        let has_none = |degrees: &f64| {
            let (s, c) = (degrees * PI / 180.0).sin_cos();
            line(1.0 + 3.0 * c * c - 3.0 * p("mu") * s * c, -1.0).is_empty()
        };
        let none: Vec<f64> = slider(5.0, 85.0, 1.0).filter(has_none).collect();
        none.last().unwrap() - none[0]
    }),
    ("14.p1", |p| {
        // Joint k joins the links k − 1 and k; the ceiling joins nothing.
        let (mut entries, joints) = (0, p("n") as usize);
        let links = |joint: usize| [joint.checked_sub(1), Some(joint)].into_iter().flatten();
        for i in 0..joints {
            let meets = |j: &usize| links(i).any(|own| links(*j).any(|other| other == own));
            entries += 9 * (0..joints).filter(meets).count();
        }
        entries as f64
    }),
    ("14.p2", |p| {
        let n = p("n") as usize;
        let mut joined = vec![vec![false; n]; n];
        for i in 0..n {
            for j in [(i + 1) % n, (i + n - 1) % n] {
                joined[i][j] = true;
            }
        }
        let mut new = 0.0;
        for k in 0..n {
            let left: Vec<usize> = (k + 1..n).filter(|i| joined[k][*i]).collect();
            for (at, &i) in left.iter().enumerate() {
                for &j in &left[at + 1..] {
                    new += f64::from(u8::from(!joined[i][j]));
                    joined[i][j] = true;
                    joined[j][i] = true;
                }
            }
        }
        new
    }),
    ("15.p1", |p| {
        let mut u = [0.0; 2];
        for _ in 0..1000 {
            u = u.map(|u| u - G * p("dt"));
            two_balls(&mut u, &mut [0.0; 2], p("sweeps") as usize, [1.0, 1.0]);
        }
        -1e3 * u[0]
    }),
    ("15.p2", |p| {
        let (mut u, mut x, mut depth) = ([0.0; 2], [0.0; 2], 0.0);
        let inverse = [1.0 / p("lower"), 1.0 / p("upper")];
        for _ in 0..20_000 {
            // The impulses of the step before act first.
            u = [
                u[0] - G * p("dt") + inverse[0] * (x[0] - x[1]),
                u[1] - G * p("dt") + inverse[1] * x[1],
            ];
            two_balls(&mut u, &mut x, 1, inverse);
            depth -= u[0] * p("dt");
        }
        1e3 * depth
    }),
    ("16.p1", |p| {
        // A spring with the frequency f for the effective mass of the contact, here the lower ball.
        let stiffness = p("lower") * (2.0 * PI * p("hertz")).powi(2);
        1e3 * zero(0.0, 10.0, |depth| (p("lower") + p("upper")) * G - stiffness * depth)
    }),
    ("16.p2", |p| {
        // With the same h the frequency goes with the number of substeps, the sag with 1/ω².
        let sag = |substeps: f64| p("stiffer").powi(2) * (10.0 / substeps).powi(2);
        slider(1.0, 1000.0, 1.0).find(|substeps| sag(*substeps) <= 1.0 + 1e-9).unwrap()
    }),
    ("17.p1", |p| {
        // From Lagrange's equation of z = ½x² in x.
        let (x, v) = (p("x"), p("v"));
        let along = -(x * v * v + G * x) / (1.0 + x * x);
        let up = v * v + x * along;
        along.hypot(up + G)
    }),
];

/// Runs the commands of a problem as a student would, and reads the answer.
fn run_by_student(problem: &Problem) -> Option<f64> {
    let folder = tempfile::tempdir().unwrap();
    let spans = problem.text.split('`').skip(1).step_by(2);
    let commands = spans.filter(|span| span.contains("lcplab "));
    let mut printed = String::new();
    for command in commands {
        let is_solve = command.contains("lcplab solve ");
        let command = command.replace("lcplab", env!("CARGO_BIN_EXE_lcplab"));
        let command = if is_solve { format!("{command} --json") } else { command };
        let output =
            Command::new("sh").args(["-c", &command]).current_dir(&folder).output().unwrap();
        printed = String::from_utf8(output.stdout).unwrap();
    }
    let json = || serde_json::from_str::<serde_json::Value>(&printed).unwrap();
    let of_body = |name: &str, at: usize| {
        let line = printed.lines().find(|line| line.trim_start().starts_with(name)).unwrap();
        line.trim_start()[name.len()..].split_whitespace().nth(at).unwrap().parse().unwrap()
    };
    match &*problem.id {
        "1.r1" | "3.r1" => json()["x"][0].as_f64(),
        "9.r1" => json()["scaled_residual"].as_f64(),
        "10.r1" => Some(of_body("ball ", 5)),
        "12.r1" => Some(of_body("ball 3 ", 3)),
        _ => None,
    }
}

/// All solutions of a small boxed LCP with lower bounds 0, by its cases.
fn solutions(a: &[&[f64]], b: &[f64], hi: &[f64]) -> Vec<Vec<f64>> {
    let n = b.len();
    let a = DMatrix::from_fn(n, n, |i, j| a[i][j]);
    let b = DVector::from_column_slice(b);
    let mut found: Vec<Vec<f64>> = Vec::new();
    for case in 0..3_usize.pow(n as u32) {
        let side = |i: usize| case / 3_usize.pow(i as u32) % 3;
        if (0..n).any(|i| side(i) == 2 && hi[i].is_infinite()) {
            continue;
        }
        let free: Vec<usize> = (0..n).filter(|i| side(*i) == 1).collect();
        let mut x = DVector::from_fn(n, |i, _| if side(i) == 2 { hi[i] } else { 0.0 });
        let rest = &a * &x + &b;
        let part = DMatrix::from_fn(free.len(), free.len(), |i, j| a[(free[i], free[j])]);
        let right = DVector::from_fn(free.len(), |i, _| -rest[free[i]]);
        // nalgebra does not solve a system without rows.
        let solved = if free.is_empty() { Some(right) } else { part.lu().solve(&right) };
        let Some(solved) = solved else { continue };
        free.iter().zip(solved.iter()).for_each(|(i, own)| x[*i] = *own);
        let w = &a * &x + &b;
        let fits = |i: usize| match side(i) {
            0 => w[i] >= -1e-9,
            1 => x[i] >= -1e-9 && x[i] <= hi[i] + 1e-9,
            _ => w[i] <= 1e-9,
        };
        let is_new = found.iter().all(|own| own.iter().zip(&x).any(|(a, b)| (a - b).abs() > 1e-6));
        if (0..n).all(fits) && is_new {
            found.push(x.iter().copied().collect());
        }
    }
    found
}

/// The solutions x of one row.
fn line(a: f64, b: f64) -> Vec<f64> {
    let both = [0.0, -b / a];
    both.into_iter().filter(|x| *x >= 0.0 && a * x + b >= -1e-12).collect()
}

/// The values of a slider.
fn slider(from: f64, to: f64, step: f64) -> impl Iterator<Item = f64> {
    let count = ((to - from) / step).round() as i32;
    (0..=count).map(move |k| (from / step).round() + f64::from(k)).map(move |k| k * step)
}

/// The zero of a function with one change of sign, by bisection.
fn zero(from: f64, to: f64, f: impl Fn(f64) -> f64) -> f64 {
    let (mut low, mut high) = (from, to);
    let is_same_side = |x: f64| (f(x) > 0.0) == (f(from) > 0.0);
    for _ in 0..100 {
        let middle = (low + high) / 2.0;
        if is_same_side(middle) { low = middle } else { high = middle }
    }
    low
}

/// The first derivative at 0.
fn slope(f: impl Fn(f64) -> f64) -> f64 {
    (f(1e-5) - f(-1e-5)) / 2e-5
}

/// The second derivative at 0.
fn curvature(f: impl Fn(f64) -> f64) -> f64 {
    (f(1e-4) - 2.0 * f(0.0) + f(-1e-4)) / 1e-8
}

/// The point of a regular polygon with a corner on the first axis that is nearest to a point
/// outside of it.
fn nearest_on_polygon(radius: f64, corners: usize, wanted: [f64; 2]) -> [f64; 2] {
    let corner = |k: usize| {
        let (s, c) = (2.0 * PI * (k as f64) / (corners as f64)).sin_cos();
        [radius * c, radius * s]
    };
    let on_edge = |k: usize| {
        let (from, to) = (corner(k), corner(k + 1));
        (0..=20_000)
            .map(move |t| f64::from(t) / 2e4)
            .map(move |t| [from[0] + t * (to[0] - from[0]), from[1] + t * (to[1] - from[1])])
    };
    let far = |point: &[f64; 2]| (point[0] - wanted[0]).hypot(point[1] - wanted[1]);
    let points = (0..corners).flat_map(on_edge);
    points.min_by(|a, b| far(a).total_cmp(&far(b))).unwrap()
}

/// Sweeps from the ground up over the contacts of two balls.
fn two_balls(u: &mut [f64; 2], x: &mut [f64; 2], sweeps: usize, inverse: [f64; 2]) {
    for _ in 0..sweeps {
        let push = (-u[0] / inverse[0]).max(-x[0]);
        x[0] += push;
        u[0] += inverse[0] * push;
        let push = (-(u[1] - u[0]) / (inverse[0] + inverse[1])).max(-x[1]);
        x[1] += push;
        u[0] -= inverse[0] * push;
        u[1] += inverse[1] * push;
    }
}

/// A problem and its parameters, for a message.
pub(super) fn name(problem: &Problem) -> String {
    let numbers: &BTreeMap<String, f64> = &problem.parameters;
    format!("{} {numbers:?}", problem.id)
}
