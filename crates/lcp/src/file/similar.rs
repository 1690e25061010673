//! Suggests the known key of a problem file that an unknown key was probably meant to be.

use super::READ;
use crate::edit_distance::edit_distance;

/// Names that other programs and textbooks use for the keys of a problem file.
const OTHER_NAMES: [(&str, &[&str]); 5] = [
    ("b", &["q"]),
    ("lo", &["l", "lb", "low", "lower", "min"]),
    ("hi", &["u", "ub", "up", "high", "upper", "max"]),
    ("mu", &["mus", "friction", "friction_coefficient"]),
    ("friction_index", &["findex"]),
];

/// A key with at most this many changed letters counts as misspelled.
const MOST_CHANGES: usize = 2;

/// The known key most similar to this one, if any is similar.
pub(super) fn similar(key: &str) -> Option<&'static str> {
    let key = key.to_lowercase().replace('-', "_");
    let is_other = |(_, others): &&(&str, &[&str])| others.contains(&key.as_str());
    if let Some((known, _)) = OTHER_NAMES.iter().find(is_other) {
        return Some(known);
    }
    if let Some(known) = READ.into_iter().find(|known| known.to_lowercase() == key) {
        return Some(known);
    }
    // Two changes turn any short word into any other.
    let long = READ.into_iter().filter(|known| known.len() > 2 * MOST_CHANGES);
    let nearest = long.map(|known| (edit_distance(&key, known), known)).min()?;
    (nearest.0 <= MOST_CHANGES).then_some(nearest.1)
}
