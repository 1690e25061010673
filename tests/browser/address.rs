//! The addresses of live pages: one that means nothing is answered by a sentence and the page as it
//! usually begins, one that a page wrote is shown as it was.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use serde_json::{Value, json};

use lcplab::lesson::template::{Seed, Template};

use super::driver::Page;
use super::live::{READY, page};

/// The keys of each page's address, each with a value that changes what is shown and with values
/// that it may not have.
const KEYS: [(&str, &[(&str, &str, &[&str])]); 6] = [
    (
        "two_rows",
        &[
            ("a00", "1", &["-5", "4.1"]),
            ("a01", "-2", &["-5", "5"]),
            ("a10", "-1", &["-5", "2"]), // 2 is not a01, and A is symmetric
            ("a11", "1", &["-5", "5"]),
            ("symmetric", "false", &["-5", "1", "yes", "True", "constructor"]),
            ("b0", "2", &["-5", "5"]),
            ("b1", "2", &["-5", "5"]),
            ("bounds", "box", &["-5", "Box", "boxes", "0"]),
            ("solver", "jacobi", &["-5", "zzz", "PGS", "interior-point"]),
            ("omega", "1", &["-5", "0", "2"]),
            ("x0", "1", &["-5", "4.5"]),
            ("x1", "1", &["-5", "4.5"]),
            ("step", "3", &["-5", "1.5", "31"]),
        ],
    ),
    (
        "stack",
        &[
            (
                "masses",
                "1,100",
                &["-5", "0,1", "1,0", "1,,2", "1,2,", "1;2", "1e4", "1,1,1,1,1,1,1,1,1", "1,x"],
            ),
            ("solver", "lemke", &["-5", "zzz", "clarabel"]),
            ("omega", "1", &["-5", "0", "2"]),
            ("sweeps", "20", &["-5", "0", "61", "2.5"]),
            ("backward", "true", &["-5", "1", "yes"]),
            ("warm", "true", &["-5", "1", "yes"]),
            ("at", "3", &["-5", "1.5", "301"]),
        ],
    ),
    (
        "friction",
        &[
            ("press", "1", &["-5", "0", "5"]),
            ("mu", "1", &["-5", "2"]),
            ("directions", "8", &["-5", "0", "3", "8.0", "20"]),
            ("angle", "100", &["-5", "361"]),
            ("size", "1", &["-5", "5"]),
        ],
    ),
    (
        "cone_proof",
        &[
            ("press", "1", &["-5", "3"]),
            ("mu", "1", &["-5", "2"]),
            ("angle", "100", &["-5", "361"]),
            ("size", "1", &["-5", "3"]),
            ("distance", "-2", &["-10", "1"]),
            ("toward", "100", &["-5", "361"]),
            ("width", "-2", &["-10", "1"]),
        ],
    ),
    (
        "painleve",
        &[
            ("mu", "1.5", &["-5", "4"]),
            ("theta", "30", &["-5", "4", "90"]),
            ("omega", "1", &["-5", "3"]),
            ("dt", "0.02", &["-5", "0", "0.03"]),
            ("step", "3", &["-5", "1.5", "401"]),
        ],
    ),
    (
        "problem",
        &[
            ("example", "two solutions", &["-5", "no example"]),
            ("solver", "lemke", &["-5", "zzz", "Lemke"]),
            ("step", "1", &["-5", "1.5", "3000"]),
            ("lines", "4", &["-5", "1.5", "3000"]),
        ],
    ),
];
/// A browser takes 200 new addresses of a page in ten seconds, and two belong to each of these.
const MOST: usize = 80;
/// What no key may be.
const NOTHING: [&str; 10] =
    ["", "x", "NaN", "Infinity", "1e308", "-1e308", "1e999", "0x10", "%00", "null"];

/// What a page shows; and going to an address, whose `#` stands before the state.
const TOOLS: &str = "
const drawn = () => all('svg, pre, table').map((node) => node.innerHTML).join() + find('#says').textContent;
const go = (state) => new Promise((done) => { addEventListener('hashchange', done, { once: true }); location.hash = state; });
const usual = drawn(), sentence = () => (find('#address').hidden ? null : find('#address').textContent);
";

/// Those of these addresses of a page that are not answered by a sentence and the usual page.
fn not_refused(name: &str, good: &str, bad: &[String]) -> Value {
    let script = format!(
        "const wrong = [];
         for (const state of {}) {{
            await go('{good}');
            if (sentence() || drawn() === usual) wrong.push(['not shown', '{good}', sentence()]);
            await go(state);
            const said = sentence();
            if (!/^The address [^]*[.] The page uses its default settings[.]$/.test(said) || drawn() !== usual) wrong.push([state, said]);
         }}
         return wrong;",
        json!(bad)
    );
    page(name).seen(1280, &format!("{READY}{TOOLS}{script}"))
}

fn check(name: &str) {
    let (_, keys) = KEYS.iter().find(|own| own.0 == name).unwrap();
    let good = keys[0];
    let good = format!("{}={}", good.0, good.1);
    let mut bad: Vec<String> =
        ["zzz=1", "=1", "constructor=1", "__proto__=1", "&&zzz", "zzz"].map(String::from).into();
    for (key, value, others) in *keys {
        bad.push(format!("{key}={value}&{key}={value}"));
        bad.push(format!("{key}={value}&zzz={value}"));
        let values = NOTHING.iter().chain(*others);
        // The method that suits the problem is the empty one.
        let is_bad = |value: &&&str| !(*key == "solver" && name == "problem" && value.is_empty());
        bad.extend(values.filter(is_bad).map(|other| format!("{key}={other}")));
    }
    for some in bad.chunks(MOST) {
        assert_eq!(not_refused(name, &good, some), json!([]));
    }
}

#[test]
fn an_address_of_two_rows_that_means_nothing_is_a_sentence() {
    check("two_rows");
}

#[test]
fn an_address_of_the_stack_that_means_nothing_is_a_sentence() {
    check("stack");
}

#[test]
fn an_address_of_friction_that_means_nothing_is_a_sentence() {
    check("friction");
}

#[test]
fn an_address_of_the_rod_that_means_nothing_is_a_sentence() {
    check("painleve");
}

#[test]
fn an_address_of_the_box_that_means_nothing_is_a_sentence() {
    check("cone_proof");
}

#[test]
fn an_address_of_a_problem_that_means_nothing_is_a_sentence() {
    check("problem");
}

#[test]
fn a_page_begins_in_the_same_way_inside_another_one() {
    for (name, keys) in KEYS {
        let (key, value, bad) = keys[0];
        let Page(html) = page(name);
        let begun = |state: &str| {
            let state = format!("<html lang=\"en\" data-state=\"{state}\"");
            let page = Page(html.replacen("<html lang=\"en\"", &state, 1));
            let script = "return [find('#address').hidden, find('svg').innerHTML.length > 100]";
            page.seen(1280, &format!("{READY}{script}"))
        };
        assert_eq!(begun(&format!("{key}={value}")), json!([true, true]), "{name}");
        assert_eq!(begun(&format!("{key}={}", bad[0])), json!([false, true]), "{name}");
    }
}

#[test]
fn every_key_of_every_page_is_known_here() {
    for (name, keys) in KEYS {
        let script = "return Object.keys(USUAL).filter((key) => key !== 'problem')";
        let found = page(name).seen(1280, &format!("{READY}{script}"));
        let known: Vec<&str> = keys.iter().map(|own| own.0).collect();
        assert_eq!(found, json!(known), "{name}");
    }
}

#[test]
fn a_text_that_is_no_problem_is_a_sentence_and_stays_there() {
    let row = |n: usize| vec!["0"; n].join(",");
    let rows = |n: usize| vec![format!("[{}]", row(n)); n].join(",");
    let large = format!("{{\"A\":{{\"dense\":[{}]}},\"b\":[{}]}}", rows(61), row(61));
    let texts = [
        "{",
        "[]",
        "null",
        "5",
        "\"a\"",
        "{}",
        "{\"error\":1}",
        "{\"A\":1,\"b\":1}",
        "{\"A\":{\"dense\":[[1e999]]},\"b\":[1]}",
        "{\"A\":{\"dense\":[[1]]},\"b\":[1,2]}",
        "{\"A\":{\"dense\":[[1]]},\"b\":[1],\"model\":\"coulomb-cone\"}",
        &large,
    ];
    let script = format!(
        "const wrong = [];
         for (const text of {}) {{
            await go('problem=' + encodeURIComponent(text));
            if (!find('#says').textContent || !find('#says').classList.contains('bad') || find('#text').value !== text) wrong.push(text);
         }}
         return wrong;",
        json!(texts)
    );
    let wrong = page("problem").seen(1280, &format!("{READY}{TOOLS}{script}"));
    assert_eq!(wrong, json!([]));
}

#[test]
fn a_problem_of_odd_names_and_sizes_is_shown() {
    let texts = [
        r#"{"A":{"dense":[]},"b":[]}"#,
        r#"{"A":{"dense":[[1]]},"b":[-1],"rows":[{"label":5}]}"#,
        r#"{"A":{"dense":[[1]]},"b":[-1],"rows":[{"label":"<b>&"}],"name":"<i>"}"#,
        r#"{"A":{"dense":[[1]]},"b":[-1],"rows":[]}"#,
        r#"{"A":{"dense":[[-1e-300]]},"b":[-1e300],"lo":["-inf"]}"#,
        r#"{"A":{"dense":[[1e-308,0],[0,1e308]]},"b":[-1e300,-1e300]}"#,
    ];
    let script = format!(
        "const wrong = [];
         for (const text of {}) {{
            await go('problem=' + encodeURIComponent(text));
            if (!find('#says').textContent || sentence() || all('#rows i, #rows b').length) wrong.push([text, find('#says').textContent]);
         }}
         return wrong;",
        json!(texts)
    );
    let wrong = page("problem").seen(1280, &format!("{READY}{TOOLS}{script}"));
    assert_eq!(wrong, json!([]));
}

#[test]
fn an_address_that_a_page_wrote_shows_the_same_again() {
    // Turns each control in turn, goes away and comes back.
    let script = "
        const range = (node, part) => Number(node.min) + Math.round((node.max - node.min) / node.step * part) * node.step;
        const wrong = [];
        let part = 0.1;
        for (const id of Object.keys(USUAL)) {
            const node = find(`#${id}`);
            if (!node || node.disabled) continue;
            part = (part + 0.37) % 1;
            if (node.type === 'checkbox') set(`#${id}`, !node.checked);
            else if (node.type === 'range') set(`#${id}`, range(node, part));
            else if (node.options) set(`#${id}`, node.options[Math.floor(part * node.options.length)].value);
            else continue;
            await wait(300);
            const [before, address] = [drawn(), location.hash];
            if (!address) continue;
            await go('zzz');
            await go(address);
            if (sentence() || drawn() !== before) wrong.push([id, address, sentence()]);
        }
        return wrong;";
    for (name, _) in KEYS {
        let wrong = page(name).seen(1280, &format!("{READY}{TOOLS}{script}"));
        assert_eq!(wrong, json!([]), "{name}");
    }
}

/// The texts of a file's problems with the printed numbers and those of four students.
fn problem_texts(file: &str) -> Vec<String> {
    #[derive(serde::Deserialize)]
    struct Problems {
        problem: Vec<Template>,
    }
    let problems: Problems = toml::from_str(file).unwrap();
    let of_student = |template: &Template, student: &str| {
        template.drawn(&Seed { secret: "", student }).unwrap().text
    };
    let texts = |template: &Template| {
        let drawn = ["Ada", "Bo", "Cem", "Dora"].map(|student| of_student(template, student));
        [vec![template.printed().unwrap().text], drawn.to_vec()].concat()
    };
    problems.problem.iter().flat_map(texts).collect()
}

#[test]
fn every_address_that_the_lessons_link_to_is_shown() {
    let mut links: BTreeSet<(String, String)> = BTreeSet::new();
    let link = |link: &str| {
        let (file, state) = link.split_once('#')?;
        Some((file.strip_suffix(".html")?.to_string(), state.to_string()))
    };
    let files = |folder: &str, ending: &str| -> Vec<String> {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join(folder);
        let paths = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
        let wanted = paths.filter(|path| path.extension().is_some_and(|own| own == ending));
        wanted.map(|path| fs::read_to_string(path).unwrap()).collect()
    };
    let mut texts = files("notebooks", "md");
    texts.extend(files("notebooks/problems", "toml").iter().flat_map(|file| problem_texts(file)));
    for text in texts {
        let after = text.split("](../live/").skip(1);
        links.extend(after.filter_map(|rest| link(rest.split(')').next()?)));
    }
    assert!(links.len() > 20, "{links:?}");
    for (name, _) in KEYS {
        let of_page = links.iter().filter(|link| link.0 == name);
        let states: Vec<&str> = of_page.map(|link| link.1.as_str()).collect();
        let script = format!(
            "const wrong = [];
             for (const state of {}) {{ await go(state); if (sentence()) wrong.push([state, sentence()]); }}
             return wrong;",
            json!(states)
        );
        let wrong = page(name).seen(1280, &format!("{READY}{TOOLS}{script}"));
        assert_eq!(wrong, json!([]), "{name}");
    }
}
