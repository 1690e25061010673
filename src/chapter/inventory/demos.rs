//! The demonstrations.

use super::Entry;
use super::Verdict::{Confirmed, Convention, Misleading, Rebuilt};

pub(super) const ENTRIES: &[Entry] = &[
    Entry::new("D1", Misleading, "An object on a surface in one dimension.")
        .errata(&["E48"])
        .code(&["scene fig6"])
        .lesson(&[1, 3]),
    Entry::new("D2", Confirmed, "A stack of three in one dimension.")
        .code(&["scene fig7"])
        .lesson(&[1, 3]),
    Entry::new("D3", Confirmed, "Structures of point masses, run in space with z at 0.")
        .code(&["scene figure", "test simulation::demonstrations"])
        .lesson(&[4])
        .remark("z stays 0 to the last bit."),
    Entry::new("D4", Misleading, "A sphere on a net, held at the sum of the radii.")
        .errata(&["E65"])
        .code(&["scene sphere_net"])
        .lesson(&[11]),
    Entry::new("D5", Rebuilt, "A stack, and a round tower of 700 cubes.")
        .errata(&["E50"])
        .code(&["scene stack", "scene tower"])
        .lesson(&[10, 11]),
    Entry::new("D6", Rebuilt, "A ragdoll.")
        .code(&["scene ragdoll", "test simulation::demonstrations"])
        .lesson(&[7]),
    Entry::new("D7", Rebuilt, "Bridges.")
        .code(&[
            "scene bridge",
            "test simulation::demonstrations::each_bank_carries_half_of_the_bridge",
        ])
        .lesson(&[7])
        .remark("Each bank carries half the weight."),
    Entry::new("D8", Rebuilt, "A catapult.")
        .code(&["scene catapult", "test simulation::demonstrations"])
        .lesson(&[7]),
    Entry::new("D9", Convention, "Ropes and chains.")
        .code(&[
            "scene rope",
            "scene catenary",
            "scene chain",
            "constraint::rope",
            "test simulation::demonstrations",
        ])
        .lesson(&[4, 7])
        .remark("Rigid ropes are rods; a rope proper is an inequality, which we have too."),
    Entry::new("D10", Misleading, "Impossible constraints.")
        .errata(&["E61"])
        .code(&["scene fig8", "lcplab diagnose"])
        .lesson(&[6]),
    Entry::new("D11", Rebuilt, "Points that carry an orientation.")
        .code(&[
            "scene three_points",
            "body::alignment",
            "test simulation::demonstrations::three_points_tell_how_far_they_have_turned",
        ])
        .lesson(&[2]),
];
