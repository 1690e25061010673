//! The chapter's key terms, each with the function that computes it.

use crate::document::{Document, Section};

/// A term.
#[derive(Debug, Clone, Copy)]
pub struct Term {
    /// The term.
    pub name: &'static str,
    /// What it means, in our own words.
    pub means: &'static str,
    /// Where the library computes it.
    pub code: &'static [&'static str],
}

/// The terms in the chapter's order, and the one of its title.
pub const TERMS: &[Term] = &[
    Term {
        name: "degrees of freedom",
        means: "The number of independent velocities that a system has at an instant: the \
         components of all moving bodies, less the rank of the equations' J.",
        code: &["diagnosis::Freedoms"],
    },
    Term {
        name: "equations of motion",
        means: "How velocities and positions change with time: M u̇ = F + Jᵀλ and ṡ = S u, \
         with the conditions of complementarity on λ.",
        code: &["simulation::Simulation::step", "formulation"],
    },
    Term {
        name: "constraint",
        means: "A condition c(s) = 0 or c(s) ≥ 0 on positions, or on velocities only; its J \
         has a row for each.",
        code: &["constraint::Constraint"],
    },
    Term {
        name: "inertia",
        means: "That a body keeps its velocity and its angular momentum unless something \
         acts on it; measured by mass and moments of inertia.",
        code: &["body::Body"],
    },
    Term {
        name: "mass",
        means: "How much force a body's acceleration takes, in kg. That of an immovable body \
         is stored as an inverse mass of 0.",
        code: &["body::Body::mass", "assembly::Block"],
    },
    Term {
        name: "centre of mass",
        means: "The mean of a body's points weighted with their mass; it is the centroid of \
         the shape at uniform density only. Positions and arms are counted from it.",
        code: &["body::inertia::principal_frame", "body::Pose"],
    },
    Term {
        name: "weight",
        means: "The force m g of gravity on a body, in N; it is no property of the body \
         alone.",
        code: &["assembly::mass"],
    },
    Term {
        name: "moment of inertia",
        means: "How much torque an angular acceleration takes, in kg m²: three principal \
         moments, in world axes the matrix R I Rᵀ, which turns with the body.",
        code: &["body::inertia::moments", "body::Body::world_inertia"],
    },
    Term {
        name: "acceleration",
        means: "The rate of the velocity, in m/s², and of the angular velocity, in rad/s².",
        code: &["body::Body::accelerate", "assembly::Assembly::accelerate"],
    },
    Term {
        name: "velocity",
        means: "The rate of the position, in m/s, and with it the angular velocity in world \
         axes, in rad/s. The rate of a quaternion follows from the latter.",
        code: &["body::State::velocity", "body::State::rate"],
    },
    Term {
        name: "Newton's laws",
        means: "A body left alone keeps its velocity; force is mass times acceleration; \
         forces between two bodies are opposite and equal. The last is why both \
         bodies of a row of J get the same x, with opposite signs.",
        code: &["assembly::Assembly::pull_back", "formulation::velocity"],
    },
    Term {
        name: "linear system",
        means: "A x = b. The step of equations alone is one; inequalities make a \
         complementarity problem of it.",
        code: &["solver::linalg::ldlt", "lcp::Lcp"],
    },
    Term {
        name: "linear complementarity problem",
        means: "w = A x + b with bounds on x, and each w 0 unless its x stands at a bound, \
         where its sign is fixed. The term is complementarity: K&M's \"complementary\" \
         is a slip, E62.",
        code: &["lcp::Lcp", "certificate::judge"],
    },
];

/// The glossary.
pub fn document() -> Document {
    let mut document = Document {
        title: "Key terms".into(),
        lead: "What the chapter defines at its end, and where the library computes it.".into(),
        is_accepted: true,
        ..Document::default()
    };
    for term in TERMS {
        let mut section = Section::new(term.name);
        section.say(term.means);
        section.say(format!("In the library: {}.", term.code.join(", ")));
        document.add("", section);
    }
    document
}
