use lcplab::lesson::exercise::{Verdict, impacts};

pub fn mistakes() -> Vec<(&'static str, Verdict)> {
    vec![
        // Speeds are exchanged whatever the masses.
        ("12.1", impacts::two_balls(|_, v, _| [v[1], v[0]])),
        // Balls that part are pulled together.
        (
            "12.1",
            impacts::two_balls(|m, v, e| {
                let x = (1.0 + e) * (v[0] - v[1]) / (1.0 / m[0] + 1.0 / m[1]);
                [v[0] - x / m[0], v[1] + x / m[1]]
            }),
        ),
        // Lesson 1's formula: a taken for positive.
        ("13.1", impacts::all_answers(|a, b| vec![f64::max(0.0, -b / a)])),
        // 0 is listed though the contact would close.
        (
            "13.1",
            impacts::all_answers(|a, b| [0.0, -b / a].into_iter().filter(|x| *x >= 0.0).collect()),
        ),
        // The slope of the lesson on friction.
        ("13.2", impacts::critical_friction(|theta, _| theta.tan())),
        // The moment of inertia is not divided by.
        (
            "13.2",
            impacts::critical_friction(|theta, k| {
                let (sin, cos) = theta.sin_cos();
                (1.0 + k * cos * cos) / (k * sin * cos)
            }),
        ),
        // The larger of the two, which is always the gap's.
        (
            "12.b",
            impacts::bounce(|h, e, dt, n| fall(h, dt, n, |gap, v| f64::max(gap, e * v.min(0.0)))),
        ),
        // Subtracted instead of added.
        ("12.b", impacts::bounce(|h, e, dt, n| fall(h, dt, n, |gap, v| gap - e * v.min(0.0)))),
        // No restitution at all.
        ("12.b", impacts::bounce(|h, _, dt, n| fall(h, dt, n, |gap, _| gap))),
        // It bounces with its own speed upwards.
        ("12.b", impacts::bounce(|h, e, dt, n| fall(h, dt, n, |_, v| -e * v.min(0.0)))),
    ]
}

/// The ball of 9.b, with any bias of a contact that is hit from the gap's bias and the velocity.
fn fall(height: f64, dt: f64, steps: usize, hit: impl Fn(f64, f64) -> f64) -> Vec<[f64; 2]> {
    let (mut z, mut v) = (height, 0.0);
    let mut states = Vec::new();
    for _step in 0..steps {
        let free = v - 9.81 * dt;
        let mut bias = z / dt;
        if free + bias < 0.0 {
            bias = hit(bias, v);
        }
        v = f64::max(free, -bias);
        z += dt * v;
        states.push([z, v]);
    }
    states
}
