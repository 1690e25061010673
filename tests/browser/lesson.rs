//! What a lesson's page does beside being read: live pages open in place, programs change their
//! language, the part for readers of the chapter is folded.

use serde_json::json;

use super::driver::Page;
use super::written;

fn lesson(number: &str, file: &str) -> Page {
    written(&["lesson", number], file)
}

#[test]
fn a_live_page_opens_where_it_is_read_with_the_state_of_the_link() {
    let script = "const place = find('details.live'); place.open = true;
        while (!find('iframe', place)) await wait(10);
        const frame = find('iframe', place);
        while (frame.contentDocument?.documentElement.dataset.ready !== 'yes') await wait(20);
        const inside = frame.contentDocument;
        const before = find('#says', inside).textContent;
        const slider = find('#mu', inside); slider.value = 1.5; slider.dispatchEvent(new inside.defaultView.Event('input'));
        await wait(400);
        return [find('#theta', inside).value, before.startsWith('There is one'), find('#says', inside).textContent.startsWith('There is no'), frame.offsetHeight > 600];";
    let found = lesson("13", "13_painleve.html").seen(1280, script);
    assert_eq!(found, json!(["63", true, true, true]));
}

#[test]
fn one_switch_turns_all_programs_of_a_page_to_rust() {
    let script = "const shows = (name) => all(`.twin > .${name}`).map((node) => shown(node));
        const before = [shows('rust'), shows('python')];
        find('[data-language=rust]').click();
        return [before, [shows('rust'), shows('python')], all('.switch [aria-pressed=true]').map((node) => node.textContent)];";
    let found = lesson("2", "02_jacobians.html").seen(1280, script);
    let (yes, no) = (json!([true, true, true]), json!([false, false, false]));
    assert_eq!(found[0], json!([no, yes]));
    assert_eq!(found[1], json!([yes, no]));
    assert_eq!(found[2], json!(["Rust", "Rust", "Rust"]));
}

#[test]
fn answers_and_what_a_class_does_not_need_are_folded() {
    let script = "const title = (part) => part.closest('section').querySelector('h2').textContent;
        const has = (part, words) => [part.open, title(part).includes(words)];
        const [further, chapter, ...rest] = all('details.part');
        return [has(further, 'Going further'), has(chapter, 'For readers of the chapter'), rest.length,
            all('details').filter((node) => find('summary', node).textContent === 'The answer').every((node) => !node.open)];";
    let found = lesson("2", "02_jacobians.html").seen(768, script);
    assert_eq!(found, json!([[false, true], [false, true], 0, true]));
}

#[test]
fn drawings_are_visible_and_described() {
    let script = "const drawings = all('.drawing img'); await wait(200);
        return drawings.map((image) => [image.naturalWidth > 300, image.getBoundingClientRect().width <= innerWidth, image.alt.length > 60]);";
    let found = lesson("11", "11_friction.html").seen(390, script);
    assert_eq!(found, json!([[true, true, true], [true, true, true]]));
}
