//! Results for continuous integration: JUnit XML and SARIF, the same for tests of a solver and for
//! receipts of an engine.

use serde::Serialize;
use serde_json::{Value, json};

use lcplab_page::escape::{xml_line as escape, xml_text};
use lcplab_page::number::plain;

/// A result compared with the recorded one.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(tag = "verdict", content = "why", rename_all = "snake_case")]
pub enum Verdict {
    /// Accepted, and not worse than recorded.
    Passed,
    /// Accepted, but recorded as not accepted.
    Fixed,
    /// Not accepted, for this reason, but not worse than recorded.
    Known(String),
    /// Worse than recorded, or not accepted and not recorded.
    Failed(String),
}

impl Verdict {
    /// The verdict in one word.
    pub fn word(&self) -> &'static str {
        match self {
            Verdict::Passed => "passed",
            Verdict::Fixed => "fixed",
            Verdict::Known(_) => "known",
            Verdict::Failed(_) => "failed",
        }
    }

    /// Whether the case fails.
    pub fn is_failure(&self) -> bool {
        matches!(self, Verdict::Failed(_))
    }
}

/// One test case: a solver on a problem, or a frame of an engine.
#[derive(Debug, Clone, PartialEq)]
pub struct Case {
    /// The group of the case: the solver, or `lcplab.receipts`.
    pub class: String,
    /// The problem or the frame: the path of its file, if it has one.
    pub name: String,
    /// The verdict, with its reason.
    pub verdict: Verdict,
    /// The rule of SARIF that a failure violates.
    pub rule: String,
    /// Measured values, as (name, value).
    pub properties: Vec<(&'static str, String)>,
    /// More text for people; may be empty.
    pub details: String,
    /// Whether the name is a file to which SARIF can point.
    pub is_file: bool,
}

/// The cases as JUnit XML, one test suite of this name; known failures are skipped.
///
/// ```
/// use lcplab_analysis::ci::{Case, Verdict, junit};
///
/// let case = Case {
///     class: "mine".into(),
///     name: "a.json".into(),
///     verdict: Verdict::Failed("w < 0".into()),
///     rule: "solver".into(),
///     properties: Vec::new(),
///     details: String::new(),
///     is_file: true,
/// };
/// let text = junit("lcplab test", &[case]);
/// assert!(text.contains(r#"<testsuite name="lcplab test" tests="1" failures="1" skipped="0">"#));
/// assert!(text.contains(r#"<failure message="w &lt; 0"/>"#));
/// ```
pub fn junit(suite: &str, cases: &[Case]) -> String {
    let failures = cases.iter().filter(|case| case.verdict.is_failure()).count();
    let skipped = cases.iter().filter(|case| matches!(case.verdict, Verdict::Known(_))).count();
    let mut text = format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n\
         <testsuite name=\"{}\" tests=\"{}\" failures=\"{failures}\" skipped=\"{skipped}\">\n",
        escape(suite),
        cases.len()
    );
    for case in cases {
        let (class, name) = (escape(&case.class), escape(&case.name));
        let inner = properties(case) + &result(case);
        text += &format!("  <testcase classname=\"{class}\" name=\"{name}\"");
        text += &match inner.is_empty() {
            true => "/>\n".to_string(),
            false => format!(">\n{inner}  </testcase>\n"),
        };
    }
    text + "</testsuite>\n"
}

fn properties(case: &Case) -> String {
    if case.properties.is_empty() {
        return String::new();
    }
    let property = |(name, value): &(&str, String)| {
        format!("      <property name=\"{name}\" value=\"{}\"/>\n", escape(value))
    };
    let all: String = case.properties.iter().map(property).collect();
    format!("    <properties>\n{all}    </properties>\n")
}

fn result(case: &Case) -> String {
    let (tag, why) = match &case.verdict {
        Verdict::Passed | Verdict::Fixed => return String::new(),
        Verdict::Known(why) => ("skipped", escape(&plain(why))),
        Verdict::Failed(why) => ("failure", escape(&plain(why))),
    };
    match case.details.is_empty() {
        true => format!("    <{tag} message=\"{why}\"/>\n"),
        false => {
            format!("    <{tag} message=\"{why}\">{}</{tag}>\n", xml_text(&plain(&case.details)))
        }
    }
}

/// The cases that are not accepted, or worse than recorded, as SARIF 2.1.0. `rules` are the names
/// of the rules and what they check.
pub fn sarif(rules: &[(String, String)], cases: &[Case]) -> String {
    let rule =
        |(id, text): &(String, String)| json!({ "id": id, "shortDescription": { "text": text } });
    let rules: Vec<Value> = rules.iter().map(rule).collect();
    let tool = json!({ "driver": { "name": "lcplab", "rules": rules } });
    let results: Vec<Value> = cases.iter().filter_map(sarif_result).collect();
    let log = json!({
        "$schema": "https://json.schemastore.org/sarif-2.1.0.json",
        "version": "2.1.0",
        "runs": [{ "tool": tool, "results": results }],
    });
    format!("{log:#}\n")
}

fn sarif_result(case: &Case) -> Option<Value> {
    let (level, why) = match &case.verdict {
        Verdict::Passed | Verdict::Fixed => return None,
        Verdict::Known(why) => ("note", why),
        Verdict::Failed(why) => ("error", why),
    };
    let text = match case.details.is_empty() {
        true => plain(&format!("{}: {why}", case.class)),
        false => plain(&case.details),
    };
    let mut result = json!({ "ruleId": case.rule, "level": level, "message": { "text": text } });
    if case.is_file {
        let uri = case.name.replace('%', "%25").replace(' ', "%20");
        result["locations"] =
            json!([{ "physicalLocation": { "artifactLocation": { "uri": uri } } }]);
    }
    if level == "note" {
        result["suppressions"] =
            json!([{ "kind": "external", "justification": "listed in the baseline" }]);
    }
    Some(result)
}
