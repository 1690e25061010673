//! Light and dark: as the reader prefers, and by the button.

use serde_json::json;

use super::sample;

const PAPERS: [&str; 2] = ["rgb(255, 255, 255)", "rgb(21, 24, 29)"];
const LOOK: &str = "
const button = find('.theme');
const look = () => [getComputedStyle(document.documentElement).backgroundColor, button.getAttribute('aria-pressed'),
  getComputedStyle(find('#figure-1 svg')).filter !== 'none'];
const views = [look()];
for (let k = 0; k < 2; k++) { button.click(); views.push(look()); }
return [views, button.hidden, localStorage.getItem('lcplab-theme')];";

#[test]
fn the_button_turns_the_colors_and_turns_them_back_and_the_choice_is_kept() {
    let (light, dark) = (json!([PAPERS[0], "false", false]), json!([PAPERS[1], "true", true]));
    assert_eq!(sample().seen(1280, LOOK), json!([[light, dark, light], false, "light"]));
    // The same for one who prefers dark.
    let seen = sample().seen_by(&["--blink-settings=preferredColorScheme=0"], 1280, LOOK);
    assert_eq!(seen, json!([[dark, light, dark], false, "dark"]));
}
