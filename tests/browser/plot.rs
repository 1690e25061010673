//! Plots say the number of the point that is pointed at, and show and hide curves.

use serde_json::json;

use super::{sample, written};

/// Moves the pointer to the k-th point of a curve as it is drawn, on a straight piece perhaps
/// without a corner there; what the tip says then. The axis of x is linear.
const POINT: &str = "
const tip = () => (find('.tip').hidden ? null : all('.tip > *').map((line) => line.textContent));
const svg = (id) => find(`#${id}-desc`).ownerSVGElement;
const at = (picture, x, y) => {
  const spot = new DOMPoint(x, y).matrixTransform(picture.getScreenCTM());
  picture.dispatchEvent(new PointerEvent('pointermove', { clientX: spot.x, clientY: spot.y, bubbles: true }));
  return tip();
};
const corner = (picture, name, k, panel = 0) => {
  const line = all(`.series[data-series=\"${name}\"] polyline`, picture)[panel];
  const data = line.closest('.series').dataset.points.split(' ').map(Number).filter((_, i) => i % 2 === 0);
  const corners = line.getAttribute('points').split(' ').map((pair) => pair.split(',').map(Number));
  const share = (data.at(k) - data[0]) / (data.at(-1) - data[0]);
  const x = corners[0][0] + share * (corners.at(-1)[0] - corners[0][0]);
  const after = Math.max(1, corners.findIndex((own) => own[0] >= x - 1e-6));
  const [[x0, y0], [x1, y1]] = [corners[after - 1], corners[after]];
  const y = y0 + (y1 - y0) * (x - x0) / (x1 - x0);
  return at(picture, x / 10, y / 10);
};
";

fn seen(script: &str) -> serde_json::Value {
    sample().seen(1280, &format!("{POINT}{script}"))
}

#[test]
fn the_tip_says_the_nearest_point_with_its_units() {
    let found = seen(
        "const picture = svg('halving');
        return [corner(picture, 'pgs', 3), corner(picture, 'dantzig', 1), corner(picture, 'pgs', -1), at(picture, 650, 160)];",
    );
    assert_eq!(
        found,
        json!([
            ["pgs", "sweep 3", "residual 0.125 m/s"],
            ["dantzig", "sweep 1", "residual 0.01 m/s"],
            ["pgs", "sweep 8", "residual 0.003906 m/s"],
            null, // nothing is near
        ])
    );
}

#[test]
fn stacked_panels_have_points_of_their_own() {
    let found = seen(
        "const picture = svg('growth');
        const ends = [0, 1].map((panel) => corner(picture, 'velocity, dt/2', 0, panel));
        const last = (panel) => corner(picture, 'velocity, dt/2', -1, panel);
        return [...ends, last(0), last(1)];",
    );
    // Both curves start in one point; the first of them answers.
    let start = |axis: &str| json!(["velocity, dt", "time 0 s", axis]);
    assert_eq!(
        found,
        json!([
            start("energy 0 J"),
            start("drift 0 m"),
            ["velocity, dt/2", "time 10 s", "energy 2,000 J"],
            ["velocity, dt/2", "time 10 s", "drift −2×10⁻⁶ m"],
        ])
    );
}

#[test]
fn bars_say_their_amount_all_along() {
    let found = seen(
        "const picture = svg('times'), boxes = all('.series rect', picture).map((bar) => bar.getBoundingClientRect());
        return boxes.flatMap((box) => [0.1, 0.9].map((part) => {
          const spot = { clientX: box.left + part * box.width, clientY: box.top + box.height / 2, bubbles: true };
          picture.dispatchEvent(new PointerEvent('pointermove', spot));
          return tip();
        }));",
    );
    let (pgs, lemke) = (json!(["pgs", "time 3.25 ms"]), json!(["lemke", "time 0.5 ms"]));
    assert_eq!(found, json!([pgs, pgs, lemke, lemke]));
}

#[test]
fn keys_lead_along_a_curve_and_from_curve_to_curve() {
    let found = seen(
        "const field = find('.field', svg('halving')), output = () => field.getAttribute('aria-valuetext');
        const keys = ['ArrowRight', 'ArrowRight', 'ArrowDown', 'ArrowUp', 'End', 'Home', 'Escape'];
        const words = keys.map((key) => { press(field, key); return output(); });
        return [words, tip(), field.getAttribute('role'), field.tabIndex];",
    );
    let words = [
        "pgs, sweep 0, residual 1 m/s",
        "pgs, sweep 1, residual 0.5 m/s",
        "dantzig, sweep 1, residual 0.01 m/s",
        "pgs, sweep 1, residual 0.5 m/s",
        "pgs, sweep 9, residual 0 m/s", // has no place on the axis, and is shown on the frame
        "pgs, sweep 0, residual 1 m/s",
        "pgs, sweep 0, residual 1 m/s",
    ];
    assert_eq!(found, json!([words, null, "slider", 0]));
}

#[test]
fn the_legend_hides_a_curve_and_its_theory_and_shows_them_again() {
    let found = seen(
        "const picture = svg('halving');
        const names = ['pgs', 'theory, pgs: halved', 'dantzig', 'theory, dantzig', 'tolerance'];
        const group = (kind, name) => find(`.${kind}[data-series=\"${name}\"]`, picture);
        const look = () => names.map((name) => shown(group('series', name)));
        const views = [look()], entry = group('entry', 'pgs');
        entry.dispatchEvent(new MouseEvent('click', { bubbles: true })); views.push(look());
        const hidden = corner(picture, 'pgs', 3);
        press(entry, 'Enter'); views.push(look());
        press(group('entry', 'theory'), ' '); views.push(look());
        return [views, hidden, entry.getAttribute('role'), entry.tabIndex];",
    );
    assert_eq!(
        found,
        json!([
            [
                [true, true, true, true, true],
                [false, false, true, true, true],
                [true, true, true, true, true],
                [true, false, true, false, true],
            ],
            null,
            "button",
            0
        ])
    );
}

#[test]
fn a_curve_is_hidden_in_all_panels() {
    let found = seen(
        "const picture = svg('growth');
        press(find('.entry[data-series=\"velocity, dt\"]', picture), 'Enter');
        return all('.series', picture).map((group) => [group.dataset.series, shown(group)]);",
    );
    let pair = [json!(["velocity, dt", false]), json!(["velocity, dt/2", true])];
    assert_eq!(found, json!([pair[0], pair[1], pair[0], pair[1]]));
}

/// Of each line or bar figure that is shown: the smallest size of its text (px on the screen), and
/// how far (px) text sticks out of it.
const LABELS: &str = "
const shown = all('figure.plot svg').filter((svg) => svg.querySelector('[data-points]') && svg.getBoundingClientRect().width > 0);
return shown.map((svg) => {
  const frame = svg.getBoundingClientRect(), scale = frame.width / svg.viewBox.baseVal.width;
  const words = [...svg.querySelectorAll('text')];
  const out = (box) => Math.max(frame.left - box.left, box.right - frame.right, frame.top - box.top, box.bottom - frame.bottom);
  return [Math.min(...words.map((word) => scale * word.getAttribute('font-size'))),
    Math.max(...words.map((word) => out(word.getBoundingClientRect())))];
});";

#[test]
fn labels_can_be_read_on_desk_and_phone_and_stay_in_the_picture() {
    for width in super::WIDTHS {
        let page =
            written(&["report", "standard", "--section", "convergence"], "convergence/index.html");
        let found = page.seen(width, LABELS);
        let figures = found.as_array().unwrap();
        assert!(figures.len() >= 2, "{found}");
        for figure in figures {
            let [size, out] = [0, 1].map(|k| figure[k].as_f64().unwrap());
            assert!(size >= 10.0 && out <= 1.0, "at {width} px: {found}");
        }
    }
}
