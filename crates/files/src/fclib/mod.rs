//! FCLIB: the frictional contact library of Acary, Brémond and others, as HDF5 files.
//!
//! Defined by FCLIB's `fclib.h` (FrictionalContactLibrary/fclib, src/fclib.h) and INRIA's report
//! RT-0444 (Acary, Brémond, Koziara & Pérignon 2014). A file holds a *local* problem, in impulses
//! only, or a *global* one, which also has velocities:
//!
//! | local: `/fclib_local/` | global: `/fclib_global/` |
//! | --- | --- |
//! | u = W r + V λ + q | M v = H r + G λ + f |
//! | 0 = Vᵀ r + R λ + s | u = Hᵀ v + w,  0 = Gᵀ v + b |
//! | `W`, `V`, `R`; `vectors/q`, `s`, `mu` | `M`, `H`, `G`; `vectors/f`, `w`, `b`, `mu` |
//!
//! with r in Coulomb's cone of each contact and û = u + μ |u_t| n in its dual: model
//! `coulomb-cone`. x = (r, λ); a contact has the rows n, t1, t2, and the rows of λ, after all
//! contacts, are equations.
//!
//! ```text
//! local:  A = [W  V]    b = [q]          global:  A = [H G]ᵀ M⁻¹ [H G]    b = [H G]ᵀ M⁻¹ f + [w]
//!             [Vᵀ R]        [s]                                                              [b]
//! ```
//!
//! A matrix is a group with `m` rows, `n` columns, `nz` and the arrays `p`, `i`, `x`: compressed
//! columns for nz = −1, compressed rows for −2, else nz triplets. Names and texts are under
//! `info/`. Known answers, under `solution/` and `guesses/`, are not part of the problem and cause
//! a warning. A file with any other dataset, with two problems, or with rolling friction
//! (`fclib_global_rolling`) is invalid input.
//!
//! Traps: W may be asymmetric in its last digits and is used unchanged. For triplets, `fclib.h`
//! says that `p` holds rows and `i` columns, while Siconos passes them to CSparse with the opposite
//! meaning: `p` columns, `i` rows. The reader follows CSparse; this matters for V, H and G.
//! Contacts in the plane (`spacedim` 2) have the rows n, t, and their cone is the coupled box. Some
//! collections store half of W with an attribute `symmetric_packed`: that is not FCLIB's format and
//! is rejected.
//!
//! HDF5 is read and written in pure Rust (`hdf5-reader`, `hdf5-writer`) with the feature `fclib`,
//! which is enabled by default; without it both are errors. Only local problems are written.

#[cfg(feature = "fclib")]
mod leftover;
#[cfg(feature = "fclib")]
mod reader;
#[cfg(feature = "fclib")]
mod writer;

use super::Format;
use lcplab_lcp::friction::Model;

/// FCLIB's HDF5 files.
pub const FORMAT: Format = Format {
    name: "fclib",
    about: "FCLIB: frictional contact problems as HDF5 (the feature fclib)",
    endings: &[".hdf5", ".h5"],
    in_folder: None,
    beside: &[],
    carries: "contacts under Coulomb's law and equations; sparse",
    law: Some(Model::CoulombCone),
    trap: "W may be asymmetric in its last digits; p of a triplet is its column",
    #[cfg(feature = "fclib")]
    read: reader::read,
    #[cfg(feature = "fclib")]
    write: Some(writer::write),
    #[cfg(not(feature = "fclib"))]
    read: |input| Err(left_out(input.name())),
    #[cfg(not(feature = "fclib"))]
    write: Some(|_| Err(left_out("fclib".into()))),
};

#[cfg(not(feature = "fclib"))]
fn left_out(input: String) -> lcplab_lcp::error::Error {
    let reason = "this build has no HDF5; build with the feature fclib";
    lcplab_lcp::error::Error::invalid(input, "format", reason)
}
