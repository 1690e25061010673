//! Recognizes keys that state rolling or torsional friction, which no friction model here has.

/// Parts of such keys, in lower case.
const PARTS: [&str; 4] = ["rolling", "spinning", "torsional", "twisting"];
/// Other such keys: of Siconos, and of papers.
const KEYS: [&str; 4] = ["mu_r", "mur", "mu_roll", "roll_friction"];

/// The reason why a key of a problem or a scene is invalid, if it states rolling or torsional
/// friction. Without this friction the problem would be another one, so it cannot be ignored.
///
/// ```
/// use lcplab_lcp::rolling_friction;
///
/// assert!(rolling_friction("rolling_friction").unwrap().starts_with("states rolling friction"));
/// assert!(rolling_friction("mu_r").is_some() && rolling_friction("torsionalMu").is_some());
/// assert_eq!(rolling_friction("mu"), None);
/// ```
pub fn rolling_friction(key: &str) -> Option<String> {
    let lower = key.to_lowercase().replace('-', "_");
    let is_meant = KEYS.contains(&lower.as_str()) || PARTS.iter().any(|part| lower.contains(part));
    is_meant.then(|| {
        let kind = if lower.contains("roll") || KEYS.contains(&lower.as_str()) {
            "rolling"
        } else {
            "torsional"
        };
        format!(
            "states {kind} friction, which is not supported: contacts have a normal force and \
             sliding friction; remove the key to leave this friction out"
        )
    })
}
