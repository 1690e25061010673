use lcplab::lesson::exercise::{Verdict, lesson09};

pub fn mistakes() -> Vec<(&'static str, Verdict)> {
    vec![
        // Speeds are exchanged whatever the masses.
        ("9.1", lesson09::two_balls(|_, v, _| [v[1], v[0]])),
        // Balls that part are pulled together.
        (
            "9.1",
            lesson09::two_balls(|m, v, e| {
                let x = (1.0 + e) * (v[0] - v[1]) / (1.0 / m[0] + 1.0 / m[1]);
                [v[0] - x / m[0], v[1] + x / m[1]]
            }),
        ),
        // Lesson 1's formula: a taken for positive.
        ("9.2", lesson09::all_answers(|a, b| vec![f64::max(0.0, -b / a)])),
        // 0 is listed though the contact would close.
        (
            "9.2",
            lesson09::all_answers(|a, b| [0.0, -b / a].into_iter().filter(|x| *x >= 0.0).collect()),
        ),
        // The slope of lesson 8.
        ("9.3", lesson09::critical_friction(|theta, _| theta.tan())),
        // The moment of inertia is not divided by.
        (
            "9.3",
            lesson09::critical_friction(|theta, k| {
                let (sin, cos) = theta.sin_cos();
                (1.0 + k * cos * cos) / (k * sin * cos)
            }),
        ),
    ]
}
