//! The animation plays, stops, steps, and goes where it is told to.

use lcplab::animation::{Animation, Recording};
use lcplab::report::page::{self, Block, Player, Section};
use lcplab::scene::Scene;
use lcplab::simulation::{self, Simulation};
use serde_json::json;

use super::driver::Page;
use super::sample;

/// The animation and its instant: a hundred steps in eleven instants.
const ANIMATION: &str = "
const animation = find('figure.player'), part = (name) => find(name, animation);
const now = () => [Number(part('.scrub').value), part('.clock').textContent.split('step ')[1]];
const stage = () => part('.bodies').innerHTML;
";

fn seen(script: &str) -> serde_json::Value {
    sample().seen(1280, &format!("{ANIMATION}{script}"))
}

#[test]
fn it_plays_until_it_is_stopped_and_ends_at_the_end() {
    let found = seen(
        "const play = part('.play'), label = () => play.getAttribute('aria-label');
        const start = [now(), label()], still = stage();
        part('.speed').value = '0.25'; // a second of motion, four seconds long
        play.click();
        await wait(2000);
        const middle = [now()[0], label(), stage() !== still];
        play.click();
        const stopped = now()[0];
        await wait(3000);
        const later = [now()[0] - stopped, label()];
        play.click();
        await wait(9000);
        return [start, middle, later, [now(), label()]];",
    );
    let middle = found[1][0].as_i64().unwrap();
    assert!((4..=6).contains(&middle), "{found}: half way after half the time");
    assert_eq!(
        found,
        json!([[[0, "0"], "Play"], [middle, "Pause", true], [0, "Play"], [[10, "100"], "Play"],])
    );
}

#[test]
fn buttons_and_keys_step() {
    let found = seen(
        "const screen = part('.screen'), seen = [];
        for (const name of ['.on', '.on', '.back']) { part(name).click(); seen.push(now()); }
        for (const key of ['ArrowRight', 'End', 'ArrowLeft', 'Home', 'ArrowLeft']) { press(screen, key); seen.push(now()); }
        return seen;",
    );
    let steps = [1, 2, 1, 2, 10, 9, 0, 0].map(|k| json!([k, (10 * k).to_string()]));
    assert_eq!(found, json!(steps));
}

#[test]
fn the_slider_moves_the_bodies() {
    let found = seen(
        "const before = stage(), range = part('.scrub');
        range.value = 7;
        range.dispatchEvent(new Event('input', { bubbles: true }));
        return [now(), stage() !== before, range.getAttribute('aria-valuetext') === part('.clock').textContent];",
    );
    assert_eq!(found, json!([[7, "70"], true, true]));
}

/// The page of a simulated stack: seen from above its ground is a plane, from below only a grid.
#[test]
fn a_drag_turns_the_camera_and_two_clicks_turn_it_back() {
    let page = super::written(&["simulate", "stack", "--steps", "10"], "index.html");
    let script = format!(
        "{ANIMATION}{}",
        "const svg = part('.stage'), soil = part('.soil'), first = [stage(), soil.innerHTML];
        svg.setPointerCapture = () => {};
        const at = (type, x, y) => svg.dispatchEvent(new PointerEvent(type, { clientX: x, clientY: y, buttons: 1, pointerId: 1 }));
        at('pointerdown', 100, 100);
        at('pointermove', 150, 100);
        const turned = [stage() !== first[0], soil.innerHTML !== first[1], part('.untilt').hidden];
        // Seen from above, the whole plane of the ground is visible.
        at('pointermove', 150, 100 + 1000);
        const above = soil.innerHTML.includes('#eef0f3');
        at('pointermove', 150, 100 - 2000);
        const below = soil.innerHTML.includes('#eef0f3');
        svg.dispatchEvent(new MouseEvent('dblclick'));
        const back = [stage() === first[0], soil.innerHTML === first[1], part('.untilt').hidden];
        const screen = part('.screen');
        const key = (key) => screen.dispatchEvent(new KeyboardEvent('keydown', { key, shiftKey: true, bubbles: true, cancelable: true }));
        key('ArrowRight');
        const right = stage() !== first[0];
        key('ArrowLeft');
        return [turned, above, below, back, right];"
    );
    let found = page.seen(1280, &script);
    assert_eq!(found, json!([[true, true, false], true, false, [true, true, true], true]));
}

/// A scene under two gravities (m/s²), a hundred steps.
fn two_gravities(scene: &Scene, gravities: [f64; 2]) -> Page {
    let recording = |g: f64| {
        let mut scene = scene.clone();
        scene.gravity.z = -g;
        let solver = simulation::solver(&scene).unwrap();
        let name = format!("{g} m/s²");
        Recording::of(&name, &mut Simulation::new(scene, solver), 100, 11)
    };
    let recordings = gravities.map(recording).into();
    let animation = Animation::new("swing", scene, recordings).drawn();
    let player = Player { animation, caption: String::new(), files: Vec::new() };
    let blocks = vec![Block::Player(Box::new(player))];
    let section =
        Section { id: "swing".into(), title: "Swing".into(), blocks, ..Section::default() };
    let page = page::Page { title: "Swing".into(), sections: vec![section], ..Default::default() };
    Page(page.render().unwrap())
}

#[test]
fn bodies_have_outlines_where_the_first_pane_has_them_unless_they_are_there() {
    let script = "
        const outlines = () => all('.ghosts', animation).map((pane) => pane.children.length > 0);
        press(part('.screen'), 'Home');
        const start = outlines();
        press(part('.screen'), 'End');
        return [start, outlines()];";
    let page = two_gravities(&Scene::load("pendulum").unwrap(), [9.81, 1.62]);
    let found = page.seen(1280, &format!("{ANIMATION}{script}"));
    assert_eq!(found, json!([[false, false], [false, true]]));
}

/// One ball hovers, the other falls out of the picture.
#[test]
fn bodies_outside_the_picture_are_counted() {
    let text = "title = 'ball'\n[step]\ndt = 0.01\n[[bodies]]\nname = 'ball'\nmass = 1\nshape = { sphere = 0.1 }";
    let page = two_gravities(&Scene::from_toml("ball.toml", text).unwrap(), [0.0, 9.81]);
    let script = "
        const said = () => all('.values', animation).map((pane) => /outside the picture 1 of 1/.test(pane.textContent));
        press(part('.screen'), 'Home');
        const start = said();
        press(part('.screen'), 'End');
        return [start, said()];";
    let found = page.seen(1280, &format!("{ANIMATION}{script}"));
    assert_eq!(found, json!([[false, false], [false, true]]));
}
