//! Nothing is wider than the screen, and the contents list is within reach.

use lcplab::report::{
    self,
    page::{Block, Section},
};
use serde_json::json;

use super::driver::Page;
use super::{WIDTHS, sample, written};

/// What sticks out of the page although no frame around it scrolls.
const OUTSIDE: &str = "
const width = document.documentElement.clientWidth;
return [width, document.documentElement.scrollWidth];";

#[test]
fn no_page_scrolls_sideways_on_desk_or_phone() {
    let long = "m g t / (I + m L^2/4) + ".repeat(3) + "t";
    let block = Block::Text(format!("- ${long}$\n- word\n\nand ${long}$ within"));
    let section = Section {
        id: "one".into(),
        title: "One".into(),
        blocks: vec![block],
        ..Section::default()
    };
    let formulas = report::page::Page { sections: vec![section], ..report::page::Page::default() };
    let pages = [
        Page(formulas.render().unwrap()),
        sample(),
        written(&["report", "chapter"], "index.html"),
        written(&["lesson", "4"], "04_sweeping.html"),
        written(&["simulate", "stack", "--steps", "5"], "index.html"),
        written(&["compare", "pendulum", "--steps", "3", "--solver", "dantzig"], "index.html"),
    ];
    for (k, page) in pages.iter().enumerate() {
        for width in WIDTHS {
            let seen = page.seen(width, OUTSIDE);
            let (room, needed) = (seen[0].as_u64().unwrap(), seen[1].as_u64().unwrap());
            assert!(needed <= room && room <= width.into(), "page {k} at {width} px: {seen}");
        }
    }
}

#[test]
fn a_table_too_wide_and_too_tall_for_a_phone_is_a_list_that_scrolls_in_its_own_frame() {
    let seen = sample().seen(
        390,
        "const frame = find('#table-2 .scroll');
        return [getComputedStyle(find('#table-2 tbody tr')).display === 'table-row', frame.scrollWidth > frame.clientWidth,
          frame.tabIndex, frame.scrollHeight > frame.clientHeight];",
    );
    assert_eq!(seen, json!([false, false, 0, true]));
}

#[test]
fn the_contents_fold_on_a_phone_and_stay_beside_the_text_on_a_desk() {
    let script = "
        const list = find('.rail details'), bar = find('.rail');
        scrollTo({ top: 3000, behavior: 'instant' });
        const box = bar.getBoundingClientRect(), views = [list.open, box.top >= 0 && box.bottom <= innerHeight];
        find('summary', list).click(); await wait(10); views.push(list.open);
        find('a', list).click(); await wait(10); views.push(list.open, location.hash);
        return views;";
    let (desk, phone) = (sample().seen(1280, script), sample().seen(390, script));
    assert_eq!(desk, json!([true, true, false, false, "#words"]));
    assert_eq!(phone, json!([false, true, true, false, "#words"]));
}

#[test]
fn what_can_be_focused_shows_it() {
    let seen = sample().seen(
        1280,
        "const output = (node) => { node.focus({ focusVisible: true }); return getComputedStyle(node).outlineStyle; };
        const skip = find('.skip'), place = () => skip.getBoundingClientRect().left;
        const away = place() < 0;
        skip.focus();
        return [away, place() >= 0, output(find('.theme')), output(find('#table-1 th span')), output(find('#table-1 .scroll'))];",
    );
    assert_eq!(seen, json!([true, true, "solid", "solid", "solid"]));
}
