//! E60: captions and comments that name something else.

use super::{Evidence, Exhibit, Severity};

pub(super) const EXHIBIT: Exhibit = Exhibit {
    id: "E60",
    title: "captions and comments that name something else",
    place: "K&M captions and comments",
    severity: Severity::Misprint,
    may_be_scan: false,
    printed: "Code 5 is called a basic Euler integrator. A comment in Code 2 says that the step is without \
              constraints. Velocities are spelt Velocitys.",
    holds: "Code 5 is the class of a rigid body, and integrates nothing. Code 2 contains the constraint impulse. \
            The scheme that the chapter calls Euler is semi-implicit Euler: the new velocity moves the body.",
    why: "Labels are what a reader searches for. The name of the scheme matters most: explicit Euler, which \
          the word alone means, gains energy in every swing, and the chapter's scheme does not.",
    evidence: Evidence::Words(
        "nothing is computed from a caption. What the two Euler schemes do to a pendulum is a setting of \
         this library's acceleration level.",
    ),
};
