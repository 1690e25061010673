//! The libraries that take part, and how to install the missing ones.

use lcplab_benches::recording::Library;

/// lcplab and all other libraries.
pub fn all() -> Vec<Library> {
    let library = |name: &str, version: &str, package: &str| Library {
        name: name.into(),
        version: (!version.is_empty()).then(|| version.into()),
        package: package.into(),
    };
    vec![
        library("lcplab", &locked("lcplab"), "this repository"),
        library("Open Dynamics Engine", env!("HAS_ODE"), "libode-dev"),
        library("Bullet", env!("HAS_BULLET"), "libbullet-dev"),
        library("Siconos", env!("HAS_SICONOS"), "libsiconos-numerics-dev libopenblas0-pthread"),
        library("DART", crate::dart::version().unwrap_or_default(), "dartpy from PyPI"),
        library("Rapier", &locked("rapier3d-f64"), "crates.io: rapier3d-f64"),
        library("clarabel", &locked("clarabel"), "crates.io: clarabel"),
    ]
}

/// The version in the lock file.
fn locked(name: &str) -> String {
    const LOCK: &str = include_str!("../Cargo.lock");
    let entry = LOCK.split("[[package]]").find(|e| e.contains(&format!("name = \"{name}\"\n")));
    let version = entry.and_then(|entry| entry.split("version = \"").nth(1)?.split('"').next());
    version.unwrap_or_default().into()
}
