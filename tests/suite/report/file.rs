//! Report files: what is wrong with one is said all at once, each with its line.

use lcplab::error::Error;
use lcplab::report::experiment::{Experiment, SHIPPED, schema};
use lcplab::report::kind::KINDS;

const HEAD: &str = "title = \"t\"\nlead = \"l\"\n";

/// The defects of a file, each with its place.
fn defects(text: &str) -> Vec<String> {
    let Err(Error::Invalid { defects, .. }) = Experiment::parse(text, "file", "file") else {
        panic!("no defect in {text}")
    };
    defects.iter().map(ToString::to_string).collect()
}

/// The line, from 1, of what stands there once.
fn line(text: &str, what: &str) -> usize {
    assert_eq!(text.matches(what).count(), 1, "{what}");
    1 + text[..text.find(what).unwrap()].matches('\n').count()
}

/// The keys of sections that stand on a line of their own: number of the line, from 0, and key.
/// What a section changes in a scene is none: its keys are those of scenes.
fn settings(text: &str) -> Vec<(usize, &str)> {
    let is_key = |c: char| c.is_ascii_lowercase() || c == '_';
    let mut is_section = false;
    let mut settings = Vec::new();
    for (k, line) in text.lines().enumerate() {
        if line.starts_with('[') {
            is_section = line == "[[section]]";
        }
        let key = line.split_once(" = ").map_or("", |(key, _)| key);
        if is_section && !key.is_empty() && key.chars().all(is_key) {
            settings.push((k, key));
        }
    }
    settings
}

#[test]
fn a_setting_that_does_not_exist_is_named_with_its_line_wherever_it_stands() {
    for (name, text) in SHIPPED {
        for (k, key) in settings(text) {
            let mut lines: Vec<String> = text.lines().map(String::from).collect();
            lines[k] = lines[k].replacen(key, "not_a_setting", 1);
            let found = defects(&lines.join("\n"));
            let place = format!("line {}:", k + 1);
            let is_named =
                |defect: &String| defect.starts_with(&place) && defect.contains("not_a_setting");
            // A study that is called otherwise leaves a section of words with settings.
            let is_study = key == "study" && found.iter().any(|defect| defect.contains("no study"));
            assert!(is_study || found.iter().any(is_named), "{name}, line {}: {found:#?}", k + 1);
        }
    }
}

#[test]
fn all_defects_are_reported_at_once_and_nothing_else() {
    let text = format!(
        "{HEAD}leed = 3
[[section]]
study = \"convergence\"
scenes = [
    {{ scene = \"chain\", stp = 50, omegas = [1.0] }},
    {{ scene = \"stack\", step = \"one\", omegas = [1.1, \"fast\"] }},
    {{ step = 1, omegas = [1.2] }},
]
[[section]]
study = \"convergence\"
[section.methods]
solvers = 7
problems = [{{ boxes = 4, ratio = true }}, {{ family = \"stack\", vals = 3 }}, {{ boxes = 2 }}]
[[section]]
study = \"raze\"
[[section]]
text = \"words without a heading\"
"
    );
    let expected = [
        ("leed", "leed: unknown field \"leed\""),
        ("stp", "scenes[0].stp: the study \"convergence\": unknown field \"stp\", expected one of"),
        (
            "\"one\"",
            "scenes[1].step: the study \"convergence\": invalid type: string \"one\", expected an integer from 0",
        ),
        (
            "\"fast\"",
            "scenes[1].omegas[1]: the study \"convergence\": invalid type: string \"fast\", expected a number",
        ),
        ("[1.2]", "scenes[2]: the study \"convergence\": missing field \"scene\""),
        (
            "solvers",
            "section[1].methods.solvers: the study \"convergence\": invalid type: integer \"7\", expected a list",
        ),
        (
            "true",
            "problems[0].ratio: the study \"convergence\": invalid type: boolean \"true\", expected a number",
        ),
        ("vals", "problems[1].vals: the study \"convergence\": unknown field \"vals\""),
        ("raze", "there is no study named \"raze\"; there are verification"),
    ];
    let found = defects(&text);
    for (what, says) in expected {
        let place = format!("line {}:", line(&text, what));
        let is_told = |defect: &&String| defect.starts_with(&place) && defect.contains(says);
        assert_eq!(found.iter().filter(is_told).count(), 1, "{says}: {found:#?}");
    }
    let unclear = found
        .iter()
        .filter(|defect| defect.contains("convergence") && defect.contains("a problem is"));
    assert_eq!(unclear.count(), 1, "what boxes alone mean: {found:#?}");
    let without = found.iter().filter(|defect| defect.ends_with("needs a title, or a study"));
    assert_eq!(without.count(), 1);
    assert_eq!(found.len(), expected.len() + 2, "{found:#?}");
}

#[test]
fn what_is_missing_at_the_top_is_named() {
    assert_eq!(defects("lead = \"l\""), ["line 1: missing field \"title\""]);
    let found = defects(&format!("{HEAD}[[section]]\ntitle = \"words\"\nsize = 1"));
    assert!(found[0].ends_with("has \"size\", but no study with that setting"), "{found:?}");
}

#[test]
fn the_schema_has_every_study_with_what_its_settings_mean() {
    let schema = schema();
    let sections = schema["properties"]["section"]["items"]["oneOf"].as_array().unwrap();
    for kind in KINDS {
        let of_kind =
            |section: &&serde_json::Value| section["properties"]["study"]["const"] == kind.name;
        let section = sections.iter().find(of_kind).expect(kind.name);
        for (key, setting) in section["properties"].as_object().unwrap() {
            let is_told = setting["description"].is_string() || setting["$ref"].is_string();
            assert!(is_told || setting["anyOf"].is_array(), "{}: {key}: {setting}", kind.name);
        }
    }
}
