//! The live pages: what their module answers is what the native program answers, bit for bit, and
//! their controls work. The variable LCPLAB_LIVE names a module that was built afresh.

use lcplab::live::PAGES;
use serde_json::{Value, json};

use super::driver::Page;

pub fn page(name: &str) -> Page {
    let page = PAGES.iter().find(|page| page.name == name).unwrap();
    Page(match std::env::var_os("LCPLAB_LIVE") {
        Some(module) => page.text_with(&std::fs::read(module).unwrap()),
        None => page.text(),
    })
}

/// Waits until the module answers, and listens to what is asked of it.
pub const READY: &str = "
while (document.documentElement.dataset.ready !== 'yes') await wait(10);
window.asked = [];
const set = (name, value) => { const node = find(name); if (node.type === 'checkbox') node.checked = value; else node.value = value;
    node.dispatchEvent(new Event(node.type === 'range' ? 'input' : 'change')); };
";

/// Fowler, Noll and Vo's hash of 32 bits.
const HASH: &str = "
const hash = (text) => { let h = 2166136261; for (const byte of new TextEncoder().encode(text)) h = Math.imul(h ^ byte, 16777619) >>> 0; return h; };
";

fn hash(text: &str) -> u32 {
    text.bytes().fold(2_166_136_261, |h, byte| (h ^ u32::from(byte)).wrapping_mul(16_777_619))
}

/// Every question of a page, answered natively. The sign of a zero is left out: which one the
/// larger of −0 and 0 is, IEEE 754 leaves to the machine.
fn compare(asked: &Value, least: usize) {
    let asked = asked.as_array().unwrap();
    assert!(asked.len() >= least, "{} questions", asked.len());
    for pair in asked {
        let question = pair[0].as_str().unwrap();
        let own = lcplab_live::answer(question).replace("-0.0", "0.0");
        assert_eq!(json!(hash(&own)), pair[1], "{question}");
    }
}

/// 25 sequences of eight clicks and moves each, the same in every run.
const SEQUENCES: &str = "
let seed = 1;
const below = (n) => { seed = (Math.imul(seed, 1103515245) + 12345) & 0x7fffffff; return (seed >> 8) % n; };
const turn = (name) => { const node = find(name);
    set(name, Number(node.min) + below(1 + Math.round((node.max - node.min) / node.step)) * Number(node.step)); };
const choose = (name) => set(name, find(name).options[below(find(name).options.length)].value);
for (let sequence = 0; sequence < 25; sequence++) {
    for (let k = 0; k < 8; k++) acts[below(acts.length)]();
}
return asked.map(([question, answer]) => [question, hash(answer.replaceAll('-0.0', '0.0'))]);
";

#[test]
fn two_rows_say_what_the_native_program_says_after_every_click() {
    let acts = "const acts = [() => turn('#a00'), () => turn('#a01'), () => turn('#a10'), () => turn('#a11'), () => turn('#b0'),
        () => turn('#b1'), () => turn('#omega'), () => choose('#solver'), () => choose('#bounds'), () => find('#next').click(),
        () => set('#symmetric', below(2) === 1)];";
    compare(&page("two_rows").seen(1280, &format!("{READY}{HASH}{acts}{SEQUENCES}")), 300);
}

#[test]
fn a_stack_says_what_the_native_program_says_after_every_click() {
    let acts = "const acts = [() => find('#more').click(), () => find('#fewer').click(), () => choose('#solver'), () => turn('#omega'),
        () => turn('#sweeps'), () => set('#backward', below(2) === 1), () => set('#warm', below(2) === 1), () => find('#row').click(),
        () => find('#sweep').click(), () => find('#motion').click(),
        () => press(find('#mass0'), ['ArrowRight', 'ArrowLeft'][below(2)])];";
    compare(&page("stack").seen(390, &format!("{READY}{HASH}{acts}{SEQUENCES}")), 300);
}

#[test]
fn friction_says_what_the_native_program_says_after_every_click() {
    let acts = "const acts = [() => turn('#press'), () => turn('#mu'), () => turn('#angle'), () => turn('#size'),
        () => choose('#directions'), () => press(find('#wanted'), ['ArrowRight', 'ArrowUp', 'ArrowDown'][below(3)])];";
    compare(&page("friction").seen(768, &format!("{READY}{HASH}{acts}{SEQUENCES}")), 300);
}

#[test]
fn a_box_around_x_says_what_the_native_program_says_after_every_click() {
    let acts = "const acts = [() => turn('#press'), () => turn('#mu'), () => turn('#angle'), () => turn('#size'), () => turn('#distance'), () => turn('#width'),
        () => press(find('#push'), ['ArrowRight', 'ArrowUp', 'ArrowDown'][below(3)]), () => press(find('#start'), ['ArrowLeft', 'ArrowUp', 'ArrowDown'][below(3)])];";
    compare(&page("cone_proof").seen(390, &format!("{READY}{HASH}{acts}{SEQUENCES}")), 200);
}

#[test]
fn a_box_around_x_proves_the_contact_or_the_page_says_why_not() {
    // Half-width, error and push; then the boxes drawn green and the beginning of the sentence.
    let script = "const shown = [];
        for (const state of ['', 'width=-0.3', 'width=-4&distance=-2', 'distance=0&width=-1', 'size=0.6', 'mu=0.5&angle=0&size=1&distance=-3&width=-2', 'size=1.25&width=-1&distance=-2', 'press=-0.5', 'mu=0&width=0', 'press=0.5&mu=1&size=0&width=-0.2&distance=-1']) {
            const done = new Promise((end) => addEventListener('hashchange', end, { once: true }));
            if (state) { location.hash = state; await done; }
            shown.push([all('#close .cone.in').length, find('#says').textContent, find('#says').className]);
        }
        return shown;";
    let found = page("cone_proof").seen(1280, &format!("{READY}{script}"));
    let expected = [
        (7, "exactly one solution. The contact is sliding"),
        (0, "X is too wide. The equations bend"),
        (0, "for so narrow a box"),
        (0, "No box with equal sides around this x"),
        (7, "already a point"),
        (0, "between sticking and sliding"),
        (0, "points of the other state, which is 0.05 m/s"),
        (7, "the contact is open. The block leaves the floor at 0.5 m/s"),
        (7, "already a point"),
        (0, "X is too wide. It also contains xₙ ≤ 0"),
    ];
    for (shown, (green, says)) in found.as_array().unwrap().iter().zip(expected) {
        assert_eq!(shown[0], green, "{says}: {found}");
        assert!(shown[1].as_str().unwrap().contains(says), "{says}: {found}");
        let class = if green > 0 {
            "good"
        } else if says.starts_with("between") {
            "caution"
        } else {
            "bad"
        };
        assert_eq!(shown[2], format!("says {class}"), "{says}");
    }
}

#[test]
fn painleve_says_what_the_native_program_says_after_every_click() {
    let acts = "const acts = [() => turn('#mu'), () => turn('#theta'), () => turn('#omega'), () => choose('#dt'),
        () => press(find('#here'), ['ArrowRight', 'ArrowUp', 'ArrowDown'][below(3)]), () => turn('#step')];";
    compare(&page("painleve").seen(390, &format!("{READY}{HASH}{acts}{SEQUENCES}")), 300);
}

#[test]
fn a_problem_that_is_brought_is_answered_as_the_native_program_does_it() {
    // A step of the sequence changes an entry of b, an x, the example or the method, or asks for a
    // proof. Methods that factor with faer are left out: it multiplies and adds in one rounding
    // where the processor can.
    let acts = "const exact = ['', 'pgs', 'sor', 'ssor', 'jacobi', 'block-pgs', 'nncg', 'anderson-pgs', 'mprgp', 'apgd', 'spectral', 'dantzig', 'lemke'];
        const edit = (change) => { const read = JSON.parse(find('#text').value); change(read); take(JSON.stringify(read), {}); };
        const acts = [() => choose('#example'), () => set('#solver', exact[below(exact.length)]), () => find('#prove').click(), () => find('#next').click(),
        () => find('#more').click(), () => edit((read) => { read.b[below(read.b.length)] = below(9) - 4; }),
        () => edit((read) => { read.A.dense[0][below(read.b.length)] = below(7) - 2; }),
        () => { find('#x').value = JSON.stringify(JSON.parse(find('#x').value).map((x) => x + below(3) / 2)); find('#x').dispatchEvent(new Event('change')); }];";
    compare(&page("problem").seen(1280, &format!("{READY}{HASH}{acts}{SEQUENCES}")), 120);
}

#[test]
fn a_problem_is_solved_derived_judged_and_proved_on_its_page() {
    let script = "const first = [find('#says').textContent, find('#x').value];
        find('#prove').click(); const unique = find('#proof').textContent;
        find('#x').value = '[4, 3, 2]'; find('#x').dispatchEvent(new Event('change')); const rejected = find('#judge').textContent;
        set('#example', 'no solution'); find('#prove').click();
        return [...first, unique, rejected, find('#says').textContent, find('#proof').textContent, all('#lines :is(table, math)').length];";
    let found = page("problem").seen(1280, &format!("{READY}{script}"));
    let output = |k: usize| found[k].as_str().unwrap();
    assert_eq!(output(1), "[4,3,1]");
    assert!(
        output(0).contains("exact solution")
            && output(2).starts_with("Proved: exactly one solution"),
        "{found}"
    );
    assert!(output(3).contains("not a solution"), "{found}");
    assert!(output(5).starts_with("Proved: no solution exists"), "{found}");
    assert!(found[6].as_u64().unwrap() > 2, "{found}");
}

#[test]
fn every_example_of_the_page_is_a_problem_and_but_one_has_a_proved_answer() {
    let script = "return [...find('#example').options].map((option) => { set('#example', option.value); return find('#says').className; });";
    let found = page("problem").seen(1280, &format!("{READY}{script}"));
    let proved = json!("says good");
    assert_eq!(found, json!([proved, proved, proved, proved, "says bad"]));
}

#[test]
fn what_is_no_problem_is_said_and_what_was_typed_stays() {
    let script = "find('#text').value = '{\"A\": 1'; find('#text').dispatchEvent(new Event('input')); await wait(400);
        const broken = find('#says').textContent;
        find('#text').value = '{\"A\": {\"dense\": [[1]]}, \"b\": [1, 2]}'; find('#text').dispatchEvent(new Event('input')); await wait(600);
        return [broken, find('#says').textContent, find('#text').value, location.hash.includes('dense')];";
    let found = page("problem").seen(390, &format!("{READY}{script}"));
    let output = |k: usize| found[k].as_str().unwrap();
    assert!(output(0).starts_with("Not valid JSON"), "{found}");
    assert!(output(1).contains("b"), "{found}");
    assert_eq!(output(2), r#"{"A": {"dense": [[1]]}, "b": [1, 2]}"#);
    assert_eq!(found[3], json!(true));
}

#[test]
fn a_rod_has_the_answers_that_its_region_of_the_map_says() {
    // tan θ = 2 at 63.43°: one below 4/3, none above; ω² sin θ > 1 makes it two.
    let script = "const words = [];
        for (const [mu, omega] of [[1.3, 0], [1.4, 0], [1.4, 1.5], [1.3, 1.5]]) { set('#mu', mu); set('#omega', omega); words.push(find('#says').textContent.split(' ')[2]); }
        return words;";
    let found = page("painleve").seen(768, &format!("{READY}{script}"));
    assert_eq!(found, json!(["one", "no", "two", "one"]));
}

#[test]
fn a_rod_that_no_force_holds_is_stopped_in_its_first_step() {
    let script = "set('#mu', 1.5); set('#step', 1); const caught = find('#slip').textContent; set('#mu', 0.5); set('#step', 1); return [caught, find('#slip').textContent];";
    let found = page("painleve").seen(1280, &format!("{READY}{script}"));
    let slip = |k: usize| -> f64 {
        let text = found[k].as_str().unwrap().replace('−', "-").replace("×10⁻⁴", "e-4");
        text.split(' ').last().unwrap().parse().unwrap()
    };
    assert!(slip(0).abs() < 1e-2 && slip(1) > 0.5, "{found}");
}

#[test]
fn a_push_is_answered_by_the_corner_of_the_square_and_the_diamond_and_by_a_point_of_the_disc() {
    // 3 N s at 30 degrees against μ x_n = 1: (1, 1), (1, 0), (cos 30°, sin 30°).
    let script = "set('#press', 2); set('#size', 2.95); set('#size', 3);
        const answer = JSON.parse(asked.filter(([question]) => question.includes('friction')).at(-1)[1]);
        return answer.models.slice(0, 3).map(({ x }) => x.slice(1));";
    let found = page("friction").seen(1280, &format!("{READY}{script}"));
    let (sin, cos) = 30.0_f64.to_radians().sin_cos();
    for (x, exact) in found.as_array().unwrap().iter().zip([[1.0, 1.0], [1.0, 0.0], [cos, sin]]) {
        for i in 0..2 {
            assert!((x[i].as_f64().unwrap() - exact[i]).abs() < 1e-9, "{found}");
        }
    }
}

#[test]
fn the_address_keeps_what_a_page_shows() {
    let found = page("two_rows").seen(
        1280,
        &format!("{READY} set('#b1', -3); set('#solver', 'lemke'); find('#next').click(); await wait(400); return location.hash;"),
    );
    assert_eq!(found, json!("#b1=-3&solver=lemke&step=1"));
}

#[test]
fn gauss_seidel_takes_the_steps_of_the_lesson_and_goes_back() {
    // Figure of lesson 1: x = (½, ¾) after a sweep of A = [2 −1; −1 2], b = (−1, −1).
    let script = "set('#b1', -1); find('#first').click(); find('#next').click();
        const after = find('#words').textContent; find('#back').click();
        return [after.includes('x = (0.5, 0.75)'), find('#words').textContent.startsWith('start'), find('#back').disabled];";
    let found = page("two_rows").seen(390, &format!("{READY}{script}"));
    assert_eq!(found, json!([true, true, true]));
}

#[test]
fn the_number_of_cones_around_a_point_is_the_number_of_solutions() {
    // A = [2 −3; −3 2] has no solution, one, or two, as b goes around.
    let script = "set('#a01', -3); const counts = [];
        for (const [b0, b1] of [[-1, -1], [1, 1.5], [-1, 2]]) {
            set('#b0', b0); set('#b1', b1);
            const solutions = JSON.parse(asked.at(-1)[1]).solutions.length;
            counts.push([solutions, all('.cone.in').length]);
        }
        return counts;";
    let found = page("two_rows").seen(1280, &format!("{READY}{script}"));
    for pair in found.as_array().unwrap() {
        assert_eq!(pair[0], pair[1], "{found}");
    }
    assert_eq!(found[0][0], 0);
    assert_eq!(found[1][0], 2);
}

#[test]
fn points_are_moved_by_keys() {
    let script = "const before = location.hash; find('#start').focus(); press(find('#start'), 'ArrowRight'); press(find('#start'), 'ArrowUp'); await wait(400);
        return [before, location.hash, document.activeElement.id];";
    let found = page("two_rows").seen(1280, &format!("{READY}{script}"));
    assert_eq!(found, json!(["", "#x0=0.1&x1=0.1&step=4", "start"]));
}

#[test]
fn a_stack_sinks_under_ten_cold_sweeps_and_stands_under_pivoting() {
    let script = "const sunk = async (solver) => { set('#solver', solver); find('#motion').click();
            while (find('#motion').textContent === 'Stop') await wait(20);
            return Number(find('#says').textContent.match(/sunk (\\S+) cm/)[1].replace('−', '-')); };
        set('#sweeps', 10); set('#warm', false);
        return [await sunk('pgs'), await sunk('dantzig')];";
    let found = page("stack").seen(1280, &format!("{READY}{script}"));
    assert!(found[0].as_f64().unwrap() > 1.0, "{found}");
    assert!(found[1].as_f64().unwrap().abs() < 1e-6, "{found}");
}

#[test]
fn a_drawing_of_a_problem_takes_less_than_a_frame() {
    // 8 boxes, 60 sweeps of them traced: the largest that the page draws while a mass is dragged.
    // In wall time the fastest of many says what the page costs, not what the machine does besides.
    let script = "for (let k = 0; k < 3; k++) find('#more').click();
        let best = 1e9;
        for (let k = 0; k < 20; k++) { const start = performance.now(); press(find('#mass7'), 'ArrowRight'); best = Math.min(best, performance.now() - start); }
        return best;";
    let best = page("stack").seen(1280, &format!("{READY}{script}"));
    assert!(best.as_f64().unwrap() < 16.0, "{best}");
}

#[test]
fn no_control_is_cut_off_on_a_phone() {
    for name in ["two_rows", "stack", "friction", "cone_proof", "problem", "painleve"] {
        let script = "return [document.documentElement.scrollWidth <= innerWidth, all('button, select, input').filter((node) => shown(node)
            && node.getBoundingClientRect().right > innerWidth).map((node) => node.id)];";
        let found = page(name).seen(390, &format!("{READY}{script}"));
        assert_eq!(found, json!([true, []]), "{name}");
    }
}
