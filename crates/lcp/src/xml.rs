//! Recognizes models of other programs in XML, for better error messages.

/// Why an XML text is not read, by its root element; `None` if the text is not XML.
///
/// ```
/// let reason = lcplab_lcp::xml::reason("<mujoco><worldbody/></mujoco>").unwrap();
/// assert!(reason.contains("lcplab import"));
/// assert_eq!(lcplab_lcp::xml::reason("title = \"a scene\""), None);
/// ```
pub fn reason(text: &str) -> Option<String> {
    const IMPORT: &str = "the Python package writes it as a scene: python -m lcplab import";
    Some(match root(text)? {
        "mujoco" => format!("is a MuJoCo model (MJCF); {IMPORT}"),
        "robot" => format!("is a URDF model; {IMPORT}"),
        "sdf" => format!("is an SDF model, which lcplab does not read; of a URDF model, {IMPORT}"),
        other => {
            format!("is an XML file with the root element <{other}>, which lcplab does not read")
        }
    })
}

/// The name of the root element, after declarations and comments.
fn root(text: &str) -> Option<&str> {
    let mut rest = text.trim_start_matches('\u{feff}').trim_start();
    loop {
        let inner = rest.strip_prefix('<')?;
        let end = match inner.chars().next()? {
            '!' if inner.starts_with("!--") => "-->",
            '!' | '?' => ">",
            _ => {
                let is_end = |c: char| c.is_whitespace() || c == '>' || c == '/';
                return inner.split(is_end).next().filter(|name| !name.is_empty());
            }
        };
        rest = inner.split_once(end)?.1.trim_start();
    }
}

#[cfg(test)]
mod tests {
    use super::root;

    #[test]
    fn the_root_follows_declarations_and_comments() {
        let text = "\u{feff}<?xml version=\"1.0\"?>\n<!-- a > b --> <!DOCTYPE robot>\n<robot name=\"arm\">";
        assert_eq!(root(text), Some("robot"));
        assert_eq!(root("<mujoco/>"), Some("mujoco"));
        for other in ["", "<", "< a", "<!-- open", "{\"A\": 1}", "[step]"] {
            assert_eq!(root(other), None, "{other:?}");
        }
    }
}
