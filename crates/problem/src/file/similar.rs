//! Which key of a problem file an unknown one may have been meant to be.

use super::READ;

/// Other names of what a problem file holds, as programs and textbooks use them.
const OTHER_NAMES: [(&str, &[&str]); 5] = [
    ("b", &["q"]),
    ("lo", &["l", "lb", "low", "lower", "min"]),
    ("hi", &["u", "ub", "up", "high", "upper", "max"]),
    ("mu", &["mus", "friction", "friction_coefficient"]),
    ("friction_index", &["findex"]),
];

/// Changed letters up to which a key is taken for a misspelt one.
const MOST_CHANGES: usize = 2;

/// The known key that is most like this one, if any is.
pub(super) fn similar(key: &str) -> Option<&'static str> {
    let key = key.to_lowercase().replace('-', "_");
    let is_other = |(_, others): &&(&str, &[&str])| others.contains(&key.as_str());
    if let Some((known, _)) = OTHER_NAMES.iter().find(is_other) {
        return Some(known);
    }
    // Two changes make any short word of any other.
    let long = READ.into_iter().filter(|known| known.len() > 2 * MOST_CHANGES);
    let nearest = long.map(|known| (changes(&key, known), known)).min()?;
    (nearest.0 <= MOST_CHANGES).then_some(nearest.1)
}

/// How many letters must be changed, added or removed to make one word of another.
fn changes(from: &str, to: &str) -> usize {
    let to: Vec<char> = to.chars().collect();
    let mut row: Vec<usize> = (0..=to.len()).collect();
    for (i, a) in from.chars().enumerate() {
        let mut diagonal = std::mem::replace(&mut row[0], i + 1);
        for (j, b) in to.iter().enumerate() {
            let changed = diagonal + usize::from(a != *b);
            diagonal = row[j + 1];
            row[j + 1] = changed.min(diagonal + 1).min(row[j] + 1);
        }
    }
    row[to.len()]
}
