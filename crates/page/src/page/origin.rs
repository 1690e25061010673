//! The origin of what a section shows: how it was computed.

/// The origin of a section's figures and tables; empty fields are not shown.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Origin {
    /// The scenes or problems.
    pub scene: String,
    /// Solver, scheme and parameters, as text.
    pub settings: String,
    /// The command that computes it again, for example `lcplab simulate stack --steps 100`.
    pub command: String,
}

impl Origin {
    /// The fields that are set: their names and texts.
    pub(super) fn parts(&self) -> impl Iterator<Item = (&'static str, &str)> {
        let parts = [("tasks", self.scene.as_str()), ("settings", &self.settings)];
        parts.into_iter().filter(|(_, words)| !words.is_empty())
    }
}
