//! A suspected cause is tested by an intervention: the solve or the run is repeated without it, and
//! a measure decides. Every suspect is a row of a table, and [`tested`] tries all rows.

use lcplab_problem::error::Result;

/// A suspected cause of a `Case`: what removes it, and what its removal shows.
pub(super) struct Suspect<Case, Effect, Cause> {
    /// Repeats the solve or the run without it; `None` if there is nothing of it to remove.
    pub intervention: fn(&Case) -> Result<Option<Effect>>,
    /// Decides by the effect of the removal.
    pub measure: fn(&Case, &Effect) -> Findings<Cause>,
    /// Whether a cause found here explains the symptom of all further rows, which are then not
    /// tested.
    pub is_last: bool,
}

/// What was found.
pub(super) struct Findings<Cause> {
    /// The causes, each with its strength.
    pub causes: Vec<(f64, Cause)>,
    /// The suspects that were ruled out, in words.
    pub ruled_out: Vec<String>,
}

impl<Cause> Default for Findings<Cause> {
    fn default() -> Self {
        Findings { causes: Vec::new(), ruled_out: Vec::new() }
    }
}

impl<Cause> Findings<Cause> {
    /// A cause.
    pub fn cause(strength: f64, cause: Cause) -> Self {
        Findings { causes: vec![(strength, cause)], ..Findings::default() }
    }

    /// A suspect that was ruled out.
    pub fn ruled_out(what: &str) -> Self {
        Findings { ruled_out: vec![what.into()], ..Findings::default() }
    }

    /// Both.
    pub fn and(mut self, other: Self) -> Self {
        self.causes.extend(other.causes);
        self.ruled_out.extend(other.ruled_out);
        self
    }
}

/// Tries the interventions of a table, one after the other.
pub(super) fn tested<Case, Effect, Cause>(
    table: &[Suspect<Case, Effect, Cause>],
    case: &Case,
) -> Result<Findings<Cause>> {
    let mut all = Findings::default();
    for suspect in table {
        let Some(effect) = (suspect.intervention)(case)? else { continue };
        let found = (suspect.measure)(case, &effect);
        let is_explained = suspect.is_last && !found.causes.is_empty();
        all = all.and(found);
        if is_explained {
            break;
        }
    }
    Ok(all)
}
