//! A suspected cause is tested by an intervention: the solve or the run is repeated without it, and
//! a measure decides. Every suspect is a row of a table.

/// A suspected cause of a `Case`.
pub(super) struct Suspect<Case, Effect, Found> {
    /// Repeats the solve or the run without it; `None` if there is nothing to remove.
    pub intervention: fn(&Case) -> Option<Effect>,
    /// Decides by the effect of the removal.
    pub measure: fn(&Case, Effect) -> Found,
}

/// Tries the interventions of a table, one after the other.
pub(super) fn test_all<Case, Effect, Found>(
    table: &[Suspect<Case, Effect, Found>],
    case: &Case,
) -> Vec<Found> {
    let found = |suspect: &Suspect<Case, Effect, Found>| {
        Some((suspect.measure)(case, (suspect.intervention)(case)?))
    };
    table.iter().filter_map(found).collect()
}
