//! The equations without a number, in the order of the text.

use super::Entry;
use super::Verdict::{Misleading, Right, Wrong};

pub(super) const ENTRIES: &[Entry] = &[
    Entry::new("U1", Wrong, "The inequality at velocity level, for the multiplier λ.")
        .errata(&["E13"])
        .code(&["formulation::velocity", "explain::derivation"])
        .lesson(&[3])
        .remark("Its force terms lack dt, so it is right at dt = 1 only."),
    Entry::new("U2", Right, "The inequality at acceleration level, with J̇ u.")
        .code(&["formulation::acceleration", "test simulation::pendulum"])
        .lesson(&[3])
        .remark("The pendulum's tension comes out in closed form."),
    Entry::new("U3", Misleading, "A contact counts only while its gap is negative.")
        .errata(&["E38"])
        .code(&[
            "assembly::rows::Entering",
            "scene::settings::Contacts",
            "test simulation::impact::a_speculative_contact_closes_its_gap_and_no_more",
        ])
        .lesson(&[7, 11])
        .remark(
            "Touching must count, or resting bodies sink by a step first. Ours has a \
         margin, and gaps may close within the step.",
        ),
    Entry::new("U4", Right, "The matrix Q that makes the rate of a quaternion from ω.")
        .code(&["body::State::rate"])
        .lesson(&[3])
        .remark("For ω in world axes and order (w, x, y, z); 4 QᵀQ = I and Qᵀq = 0."),
    Entry::new("U5", Misleading, "K = J M⁻¹ Jᵀ, called the effective mass.")
        .errata(&["E23"])
        .code(&["formulation::delassus"])
        .lesson(&[3])
        .remark("It is the inverse of it: for 2 kg, K = ½ 1/kg."),
    Entry::new("U6", Wrong, "The constraint force from λ and J.")
        .errata(&["E22"])
        .code(&[
            "assembly::Assembly::pull_back",
            "test assembly::pulling_back_is_the_transpose_of_pushing_forward",
        ])
        .lesson(&[3])
        .remark(
            "F = Jᵀλ; J λ does not even have the right shape. It may be a fault of the \
         scan.",
        ),
];
