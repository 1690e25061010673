//! E36: the listings do not compile together, K&M Codes 3, 5 and 7.

use super::{Evidence, Exhibit, Severity};

pub(super) const EXHIBIT: Exhibit = Exhibit {
    id: "E36",
    title: "the listings do not compile together",
    place: "K&M Codes 3, 5 and 7",
    severity: Severity::Misprint,
    may_be_scan: false,
    printed: "Code 3 passes dt to ComputeJointConstraints, which has no parameter and yet uses dt. The class is \
              Simulation_c in one listing and Simulation in another, the solver GaussSeidelLCP in one and \
              LCPSolver in the other. Code 7 calls CreateWorldII through a pointer to a constant body, and \
              Code 5 does not declare that method const.",
    holds: "One name for each thing, a parameter dt, and a const method.",
    why: "None of it misleads a reader who knows C++, and none survives a compiler: g++ rejects the call with dt and \
          the call of the method, each reduced to a few lines.",
    evidence: Evidence::Words(
        "the fault lies in the types of C++. In Rust the same slips do not compile either, so no program \
         that runs can contain them; the listings here have one name for each thing and take dt.",
    ),
};
