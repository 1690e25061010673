//! Results for continuous integration: JUnit XML and SARIF.

use lcplab::plot::canvas::escape;
use lcplab::report::study::regression::{Finding, Verdict};
use serde_json::{Value, json};

/// The results as JUnit XML: a test case for each solver and problem.
pub fn junit(findings: &[Finding]) -> String {
    let count = |is: fn(&Verdict) -> bool| findings.iter().filter(|f| is(&f.verdict)).count();
    let failures = count(|verdict| matches!(verdict, Verdict::Failed(_)));
    let skipped = count(|verdict| matches!(verdict, Verdict::Known(_)));
    let tests = findings.len();
    let mut text = format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n\
         <testsuite name=\"lcplab test\" tests=\"{tests}\" failures=\"{failures}\" skipped=\"{skipped}\">\n"
    );
    for Finding { solver, problem, verdict, .. } in findings {
        let case =
            format!("  <testcase classname=\"{}\" name=\"{}\"", escape(solver), escape(problem));
        let inner = match verdict {
            Verdict::Passed | Verdict::Fixed => None,
            Verdict::Known(why) => Some(("skipped", why)),
            Verdict::Failed(why) => Some(("failure", why)),
        };
        text += &match inner {
            None => format!("{case}/>\n"),
            Some((tag, why)) => {
                format!("{case}>\n    <{tag} message=\"{}\"/>\n  </testcase>\n", escape(why))
            }
        };
    }
    text + "</testsuite>\n"
}

/// The problems that are not accepted, or worse than recorded, as SARIF 2.1.0.
pub fn sarif(findings: &[Finding]) -> String {
    let results: Vec<Value> = findings.iter().filter_map(result).collect();
    let rule = json!({
        "id": "solver",
        "shortDescription": { "text": "A solver's answer to a problem" },
    });
    let tool = json!({ "driver": { "name": "lcplab", "rules": [rule] } });
    let log = json!({
        "$schema": "https://json.schemastore.org/sarif-2.1.0.json",
        "version": "2.1.0",
        "runs": [{ "tool": tool, "results": results }],
    });
    format!("{log:#}\n")
}

fn result(finding: &Finding) -> Option<Value> {
    let (level, why) = match &finding.verdict {
        Verdict::Passed | Verdict::Fixed => return None,
        Verdict::Known(why) => ("note", why),
        Verdict::Failed(why) => ("error", why),
    };
    let uri = finding.problem.replace('%', "%25").replace(' ', "%20");
    let mut result = json!({
        "ruleId": "solver",
        "level": level,
        "message": { "text": format!("{}: {why}", finding.solver) },
        "locations": [{ "physicalLocation": { "artifactLocation": { "uri": uri } } }],
    });
    if level == "note" {
        result["suppressions"] =
            json!([{ "kind": "external", "justification": "listed in the baseline" }]);
    }
    Some(result)
}
