//! All methods that can be named and compared: the registered solvers and the reference.
//!
//! ```
//! use lcplab_analysis::methods::{default_for, entries, with_reference};
//! use lcplab_lcp::friction::Model;
//! use lcplab_solver::Registry;
//!
//! let named = entries(&["pgs".into(), "lemke".into()], Registry::standard())?;
//! assert_eq!(named.len(), 2);
//! assert_eq!(default_for(Model::CoupledBox), "dantzig");
//! assert_eq!(default_for(Model::Polyhedral { directions: 8 }), "lemke");
//! assert!(with_reference().method("clarabel", None).is_ok()); // the last one of the list
//! assert!(Registry::standard().method("clarabel", None).is_err());
//! # Ok::<(), lcplab_lcp::error::Error>(())
//! ```

use std::sync::LazyLock;

#[cfg(feature = "clarabel")]
use super::clarabel;
use lcplab_lcp::error::Result;
use lcplab_lcp::friction::{Form, Model};
#[cfg(feature = "clarabel")]
use lcplab_solver::Method;
use lcplab_solver::{Apgd, ConePgs, Dantzig, Entry, InteriorPoint, Lemke, Newton, Pgs, Registry};

/// The name of the reference.
pub(crate) const REFERENCE: &str = "clarabel";

/// One method of each kind: sweeps, Newton, gradients, an interior point, two pivoting methods,
/// sweeps for cones, and the reference.
pub const USUAL: [&str; 8] = [
    Pgs::NAME,
    Newton::NAME,
    Apgd::NAME,
    InteriorPoint::NAME,
    Dantzig::NAME,
    Lemke::NAME,
    ConePgs::NAME,
    REFERENCE,
];

/// The solvers with these names for plain LCPs; all of the library if the list is empty.
///
/// # Errors
/// If no solver has one of the names.
pub fn entries(names: &[String], solvers: &Registry) -> Result<Vec<Entry>> {
    if names.is_empty() {
        return Ok(Registry::standard().entries().cloned().collect());
    }
    names.iter().map(|name| solvers.entry(name).cloned()).collect()
}

/// The solvers of the library, then clarabel for boxes and for cones.
pub fn with_reference() -> &'static Registry {
    static ALL: LazyLock<Registry> = LazyLock::new(|| {
        #[cfg_attr(not(feature = "clarabel"), expect(unused_mut))]
        let mut registry = Registry::default();
        #[cfg(feature = "clarabel")]
        for method in [Method::Boxed(clarabel::box_qp()), Method::Cone(clarabel::cone_qp())] {
            registry.add_listed(method).expect("no solver of the library has this name");
        }
        registry
    });
    &ALL
}

/// The name of the default method.
pub fn default_for(model: Model) -> &'static str {
    match model.form() {
        Form::Box => Dantzig::NAME,
        Form::Polygon { .. } => Lemke::NAME,
        Form::Cone(_) => Apgd::NAME,
    }
}
