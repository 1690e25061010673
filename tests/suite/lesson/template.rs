//! Problems with parameters: every admissible combination has the right answer and hints that are
//! wrong, and a student's numbers are the same on every machine.

use std::collections::{BTreeMap, BTreeSet};

use lcplab::lesson::problem::{Problem, Reply};
use lcplab::lesson::template::{Seed, Template};

use super::problem::templates;
use super::second_way;

/// Combinations of one problem that are tried at most.
const TRIED: u64 = 1500;

fn with_parameters() -> Vec<Template> {
    let all = templates().into_iter().flat_map(|(_, templates)| templates);
    all.filter(Template::has_parameters).collect()
}

fn drawn(template: &Template, secret: &str, student: &str) -> Problem {
    template.drawn(&Seed { secret, student }).unwrap()
}

#[test]
fn the_answer_agrees_with_a_second_method_for_the_printed_numbers_and_for_students() {
    let mut wrong = Vec::new();
    for template in with_parameters() {
        let students = ["Ada", "Blaise", "Carl", "Daniel", "Emmy", "Felix", "Grace", "Henri"];
        let own = students.map(|student| drawn(&template, "", student));
        for problem in std::iter::once(template.printed().unwrap()).chain(own) {
            let name = second_way::name(&problem);
            let answer = second_way::answer(&problem)
                .unwrap_or_else(|| panic!("{name}: add a second method for its answer"));
            let off = (answer - problem.answer).abs();
            if off > 0.5 * problem.within * answer.abs() {
                wrong.push(format!("{name}: {answer}, not {}", problem.answer));
            }
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}

#[test]
fn every_admissible_combination_has_one_right_answer_and_a_hint_for_each_typical_mistake() {
    let mut wrong = Vec::new();
    for template in with_parameters() {
        let (mut admissible, count) = (0, template.combinations());
        // A stride that is prime to the lists' lengths visits all combinations of any two lists.
        let stride = [1, 7, 11, 13, 17, 19, 23].into_iter().find(|own| count <= own * TRIED);
        let stride = usize::try_from(stride.unwrap_or(29)).unwrap();
        for index in (0..count).step_by(stride) {
            let Some(problem) = template.at(index).unwrap() else { continue };
            let name = second_way::name(&problem);
            let also = problem.also.iter();
            let also = also.map(|own| (own.answer, Reply::AlsoRight(own.remark.clone())));
            let traps = problem.traps.iter();
            let traps = traps.map(|own| (own.answer, Reply::Wrong(own.hint.clone())));
            let expected = std::iter::once((problem.answer, Reply::Right)).chain(also).chain(traps);
            for (number, reply) in expected {
                if problem.reply(number) != reply {
                    wrong.push(format!("{name}: {number} gets {:?}", problem.reply(number)));
                }
            }
            let texts = [&problem.text, &problem.because];
            assert!(texts.iter().all(|text| !text.contains("{{")), "{name}");
            admissible += 1;
        }
        assert!(admissible > 0, "{}", template.id);
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}

#[test]
fn students_have_different_answers_and_never_the_printed_one() {
    for template in with_parameters() {
        let printed = template.printed().unwrap();
        let students = (0..60).map(|k| drawn(&template, "a secret", &format!("student {k}")));
        let answers: BTreeSet<String> = students
            .map(|own| {
                assert_ne!(own.reply(printed.answer), Reply::Right, "{}", second_way::name(&own));
                format!("{:.6e}", own.answer)
            })
            .collect();
        assert!(answers.len() >= 5, "{}: {answers:?}", template.id);
    }
}

/// The index is the first eight bytes of a SHA-256, taken modulo the number of combinations; these
/// were computed in Python with hashlib.
#[test]
fn the_numbers_of_a_student_are_the_same_on_every_machine() {
    let all = with_parameters();
    let numbers = |id: &str, secret: &str, student: &str| {
        let template = all.iter().find(|template| template.id == id).unwrap();
        drawn(template, secret, student).parameters
    };
    let of = |pairs: &[(&str, f64)]| -> BTreeMap<String, f64> {
        pairs.iter().map(|(name, value)| (name.to_string(), *value)).collect()
    };
    for (secret, student, expected) in [
        ("", "Ada Lovelace", of(&[("l", 2.1), ("m", 2.5)])),
        ("", "Émilie du Châtelet", of(&[("l", 0.9), ("m", 2.0)])),
        ("autumn", "Ada Lovelace", of(&[("l", 1.5), ("m", 2.0)])),
    ] {
        assert_eq!(numbers("3.p1", secret, student), expected, "{secret} {student}");
    }
    assert_eq!(numbers("3.p2", "", "ada  LOVELACE "), numbers("3.p2", "", "Ada Lovelace"));
}

fn template(lines: &str) -> Template {
    let text = format!(
        "id = \"1.p1\"\nkind = \"pencil\"\ntitle = \"\"\nminutes = 3\nlevel = 1\nunit = \"\"\nwithin = 0.01\n\
         because = \"\"\n{lines}"
    );
    toml::from_str(&text).unwrap()
}

#[test]
fn a_text_shows_formulas_with_digits_and_as_fractions() {
    let problem = template(
        "parameters.x = [1.5, 2]\nvalues.y = \"x/9\"\nanswer = \"y\"\n\
         text = '{{x}} {{x^2}} {{y:3}} {{1/3:/}} {{0 - 5/3:/}} {{4/2:/}} {{PI:/}} x^{{{2*x:2}}} {{x - x}}'",
    );
    let expected = r"1.5 2.25 0.167 \tfrac{1}{3} -\tfrac{5}{3} 2 3.142 x^{3} 0";
    assert_eq!(problem.printed().unwrap().text, expected);
}

#[test]
fn a_formula_that_cannot_be_used_is_an_error_that_quotes_it() {
    for (lines, message) in [
        ("text = \"\"\nanswer = \"2*mass\"", "\"mass\" is neither a parameter nor a value"),
        ("text = \"\"\nanswer = \"1/0\"", "\"1/0\" is not finite"),
        ("text = \"{{x\"\nanswer = 1", "has no end"),
        ("text = \"\"\nvalues.y = 2\nanswer = 1", "y: must be a formula"),
        ("text = \"\"\nparameters.x = []\nanswer = 1", "x: needs at least one value"),
        (
            "text = \"\"\nparameters.x = [1, 2]\npositive = [\"x - 1\"]\nanswer = 1",
            "not admissible",
        ),
    ] {
        let error = template(lines).printed().unwrap_err().to_string();
        assert!(error.starts_with("problem 1.p1: ") && error.contains(message), "{error}");
    }
    let never = "text = \"\"\nparameters.x = [2, 1]\npositive = [\"x - 1\"]\nanswer = \"x\"";
    let error = template(never).drawn(&Seed { secret: "", student: "Ada" }).unwrap_err();
    assert!(error.to_string().contains("no combination"), "{error}");
}
