//! The shipped scenes, embedded in the program (the files of the folder `scenes/`), and exact
//! solutions of some.

pub mod bounce;
pub mod capstan;
pub mod fall;
pub mod ladder;
pub mod pendulum;
pub mod rolling;
pub mod spin;

use super::Scene;
use lcplab_lcp::error::Result;

/// A shipped scene.
///
/// ```
/// use lcplab_mechanics::scene::catalogue::{SHIPPED, text};
///
/// for shipped in SHIPPED {
///     assert_eq!(text(shipped.name), Some(shipped.text));
/// }
/// assert_eq!(SHIPPED[0].scene()?.name, SHIPPED[0].name);
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
#[derive(Debug, Clone, Copy)]
pub struct Shipped {
    /// The name that loads it.
    pub name: &'static str,
    /// The text of its file.
    pub text: &'static str,
}

macro_rules! shipped {
    ($($name:literal),* $(,)?) => {
        &[$(Shipped {
            name: $name,
            text: include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/scenes/", $name, ".toml")),
        }),*]
    };
}

/// All shipped scenes, from the simplest to the largest.
pub const SHIPPED: &[Shipped] = shipped![
    "fig6",
    "fig7",
    "free_fall",
    "bouncing_ball",
    "cradle",
    "cradle_touching",
    "fig8",
    "sphere_plane",
    "rolling_sphere",
    "incline",
    "sliding",
    "ladder",
    "friction_ramp",
    "stack",
    "persistence",
    "stack15",
    "stack50",
    "mass_ratio1",
    "mass_ratio2",
    "mass_ratio3",
    "overlap_recovery",
    "far",
    "pyramid",
    "card_house",
    "arch",
    "dominoes",
    "tower",
    "pendulum",
    "iftomm_pendulum",
    "conical_pendulum",
    "double_pendulum",
    "spring",
    "spring_damped",
    "motor",
    "atwood",
    "massive_pulley",
    "capstan",
    "catenary",
    "top",
    "dzhanibekov",
    "bricard",
    "rolling_balls",
    "three_points",
    "figure",
    "chain",
    "stretched_chain",
    "rope",
    "net",
    "sphere_net",
    "bridge",
    "ball_chain",
    "warm_start",
    "ball_and_chain",
    "joint_grid",
    "rush",
    "catapult",
    "ragdoll",
    "painleve",
];

impl Shipped {
    /// The scene.
    ///
    /// # Errors
    /// None for the shipped files, which are covered by tests.
    pub fn scene(&self) -> Result<Scene> {
        Scene::from_toml(&format!("{}.toml", self.name), self.text)
    }
}

/// The text of the shipped scene with this name.
pub fn text(name: &str) -> Option<&'static str> {
    SHIPPED.iter().find(|shipped| shipped.name == name).map(|shipped| shipped.text)
}
