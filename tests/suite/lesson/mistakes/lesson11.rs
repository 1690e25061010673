use lcplab::lesson::exercise::{Verdict, lesson11};

pub fn mistakes() -> Vec<(&'static str, Verdict)> {
    vec![
        // Each contact carries the body on it alone.
        ("11.1", lesson11::layers(|masses, g, dt| masses.iter().map(|m| m * g * dt).collect())),
        // Weights are summed from the ground up.
        (
            "11.1",
            lesson11::layers(|masses, g, dt| {
                (0..masses.len()).map(|k| masses[..=k].iter().sum::<f64>() * g * dt).collect()
            }),
        ),
        // By place in the list.
        (
            "11.2",
            lesson11::warm_start(|old, now| {
                (0..now.len()).map(|k| old.get(k).map_or(0.0, |(_, x)| *x)).collect()
            }),
        ),
        // Contacts that are new are left out.
        (
            "11.2",
            lesson11::warm_start(|old, now| {
                now.iter()
                    .filter_map(|name| old.iter().find(|(id, _)| id == name).map(|(_, x)| *x))
                    .collect()
            }),
        ),
        // ρ upside down: the light one on top.
        (
            "11.3",
            lesson11::sweeps(|below, above, reduction| {
                (reduction.ln() / (below / (below + above)).ln()).ceil() as usize
            }),
        ),
        // The ratio of the masses in place of the number of sweeps.
        (
            "11.3",
            lesson11::sweeps(|below, above, reduction| {
                ((above / below) * (1.0 / reduction).log10()).ceil() as usize
            }),
        ),
    ]
}
