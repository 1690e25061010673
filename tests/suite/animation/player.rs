//! Animations: the numbers of the page are those of the simulation.

use lcplab::simulation;
use std::ops::ControlFlow;

use lcplab::animation::{Animation, Measure, Recording, instants};
use lcplab::body::State;
use lcplab::report::page::{Block, Page, Player, SPEEDS, Section, speed};
use lcplab::scene::{Scene, Scheme};
use lcplab::simulation::{Motion, Simulation};
use serde_json::Value;

const STEPS: usize = 40;

fn simulation(scene: &Scene) -> Simulation {
    Simulation::new(scene.clone(), simulation::solver(scene).unwrap())
}

/// Two recordings of the same motion, of which the second has fewer sweeps.
fn animation(name: &str, samples: usize) -> Animation {
    let scene = Scene::load(name).unwrap();
    let mut hasty = scene.clone();
    hasty.solver.name = "pgs".into();
    hasty.solver.max_iterations = 2;
    let recordings = [&scene, &hasty]
        .map(|own| Recording::of(&own.solver.name, &mut simulation(own), STEPS, samples));
    Animation::new("animation", &scene, recordings.into())
}

/// The states and the motion at the start and after each step, without any animation.
fn states(scene: &Scene) -> Vec<(Vec<State>, Motion)> {
    let mut simulation = simulation(scene);
    let mut all = vec![(simulation.states().to_vec(), simulation.motion())];
    simulation.run(STEPS, |step| {
        all.push((step.states.clone(), step.motion.clone()));
        ControlFlow::Continue(())
    });
    all
}

/// A list of changes as the numbers that it stands for.
fn numbers(changes: &Value, count: usize) -> Vec<f64> {
    let changes = changes.as_array().unwrap();
    let mut sum = 0;
    let mut next = |k: usize| {
        sum += changes.get(k).map_or(0, |change| change.as_i64().unwrap());
        sum as f64
    };
    (0..count).map(&mut next).collect()
}

fn page(animation: Animation) -> String {
    let player = Player {
        animation: animation.drawn(),
        caption: "A *animation*.".into(),
        files: Vec::new(),
    };
    let blocks = vec![Block::Player(Box::new(player))];
    let section = Section { id: "one".into(), title: "One".into(), blocks, ..Section::default() };
    Page { sections: vec![section], ..Page::default() }.render().unwrap()
}

/// The data that stand on a page.
fn data(html: &str) -> Value {
    let start = html.split("<script type=\"application/json\">").nth(1).unwrap();
    serde_json::from_str(start.split("</script>").next().unwrap()).unwrap()
}

#[test]
fn the_poses_on_the_page_are_those_of_the_simulation() {
    for name in ["stack", "dominoes", "double_pendulum", "ragdoll"] {
        let animation = animation(name, 11);
        let (scene, data) = (animation.scene.clone(), data(&page(animation)));
        let (unit, turn) = (data["unit"].as_f64().unwrap(), data["turn"].as_f64().unwrap());
        let pixel = 1.0 / data["scale"].as_f64().unwrap();
        assert!(unit <= 0.05 * pixel && turn <= 1e-4, "finer than an eye can see");
        let (all, shown) = (states(&scene), instants(STEPS, 11));
        assert_eq!(data["steps"], serde_json::json!(shown));
        for body in 0..scene.bodies.len() {
            let channels = data["recordings"][0]["poses"][body].as_array().unwrap();
            let channels: Vec<_> = channels.iter().map(|list| numbers(list, shown.len())).collect();
            for (k, &step) in shown.iter().enumerate() {
                let pose = &all[step].0[body].pose;
                for axis in 0..3 {
                    let (shown, is) = (channels[axis][k] * unit, pose.p[axis]);
                    assert!((shown - is).abs() <= 0.501 * unit, "{name}: {shown} for {is}");
                }
                let q = pose.q.quaternion();
                let turned = channels.get(3..).unwrap_or_default();
                let same = |sign: f64| {
                    let parts = turned.iter().zip([q.w, q.i, q.j, q.k]);
                    parts.map(|(c, q)| (c[k] * turn - sign * q).abs()).fold(0.0, f64::max)
                };
                assert!(same(1.0).min(same(-1.0)) <= 0.501 * turn, "{name}, step {step}");
            }
        }
    }
}

#[test]
fn the_curves_pass_through_the_cursor_at_each_instant() {
    let animation = animation("pendulum", 9);
    let (all, shown, data) =
        (states(&animation.scene), instants(STEPS, 9), data(&page(animation.clone())));
    let side = |k: usize| data["plot"][k].as_f64().unwrap();
    let (left, right, top, bottom) = (side(0), side(1), side(2), side(3));
    let energies = data["recordings"][0]["measures"][0].as_array().unwrap();
    let [lo, hi] = [0, 1].map(|k| data["measures"][0]["range"][k].as_f64().unwrap());
    let chart = animation.chart(Measure::Energy);
    let course = chart.split("curve-0").nth(1).unwrap().split(" d=\"M").nth(1).unwrap();
    let points: Vec<_> = course.split('"').next().unwrap().split('L').collect();
    assert_eq!((points.len(), energies.len()), (9, 9));
    for (k, point) in points.iter().enumerate() {
        let (x, y) = point.split_once(' ').unwrap();
        let (x, y): (f64, f64) = (x.parse().unwrap(), y.parse().unwrap());
        let cursor = left + shown[k] as f64 / STEPS as f64 * (right - left);
        assert!((x - cursor).abs() <= 0.06, "{x} for {cursor}");
        let change = all[shown[k]].1.energy() - all[0].1.energy();
        assert!((energies[k].as_f64().unwrap() - change).abs() <= 1e-3 * change.abs());
        let height = bottom - (change - lo) / (hi - lo) * (bottom - top);
        assert!((y - height).abs() <= 0.3, "{y} for {height}");
    }
}

#[test]
fn a_box_at_rest_is_held_by_arrows_as_long_as_its_weight() {
    let scene = Scene::load("stack").unwrap();
    let recording = Recording::of("dantzig", &mut simulation(&scene), 2, 3);
    let animation = Animation::new("animation", &scene, vec![recording]);
    let data: Value = serde_json::from_str(&animation.data()).unwrap();
    let forces: Vec<i64> =
        serde_json::from_value(data["recordings"][0]["forces"][2].clone()).unwrap();
    let acting = &animation.recordings[0].samples[2].frame.forces;
    let upward: f64 = acting.iter().map(|force| force.force.z).sum();
    let weights = 15.0 * 9.81; // 5 + 4 + 3 + 2 + 1 boxes of 1 kg
    assert!((upward - weights).abs() < 1e-6 * weights, "{upward}");
    // Seven numbers a force: origin, point, and an arrow in tenths of a px along the world's axes.
    let arrows: Vec<&[i64]> = forces.chunks(7).collect();
    let raised: i64 = arrows.iter().map(|arrow| arrow[6]).sum();
    let longest = acting.iter().map(|force| force.force.norm()).fold(0.0, f64::max);
    let share = raised as f64 / arrows.iter().map(|arrow| arrow[6]).max().unwrap() as f64;
    assert!((share - weights / longest).abs() < 0.01 * share, "{share} for {}", weights / longest);
    let (unit, floor) = (data["unit"].as_f64().unwrap(), arrows[0]);
    let at = acting[0].point;
    assert!(
        (1..4).all(|k| (floor[k] as f64 * unit - at[k - 1]).abs() <= unit),
        "{floor:?} at {at}"
    );
}

#[test]
fn a_animation_is_the_same_bytes_twice_and_fetches_nothing() {
    let html = page(animation("stack", 9));
    assert!(!animation("stack", 9).chart(Measure::Energy).contains("NaN"));
    assert_eq!(html, page(animation("stack", 9)));
    for forbidden in ["src=", "http://", "https://", "@import", "fetch("] {
        let namespace = |text: &str| text.replace("http://www.w3.org/2000/svg", "");
        assert!(!namespace(&html).contains(forbidden), "{forbidden}");
    }
    assert!(
        !html.contains("url(")
            || html.matches("url(").count() == html.matches("url(\"data:").count()
    );
}

#[test]
fn a_page_with_a_animation_reads_without_its_script() {
    let html = page(animation("stack", 9));
    let visible = html.split("<div class=\"stills\">").nth(1).unwrap();
    assert_eq!(visible.matches("class=\"instant\"").count(), 10, "five frames of either recording");
    assert_eq!(html.matches("class=\"screen\" hidden").count(), 1);
    assert!(html.contains("aria-label=\"energy change over 0.4 s: "));
    assert!(!Page::default().render().unwrap().contains("figure.player"), "only where needed");
}

#[test]
fn a_name_cannot_end_the_data() {
    let scene = Scene::load("fig7").unwrap();
    let evil = "</script><script>alert(1)</script>";
    let recording = Recording::of(evil, &mut simulation(&scene), 2, 3);
    let html = page(Animation::new("animation", &scene, vec![recording]));
    assert_eq!(html.matches("<script>").count(), 1);
    assert_eq!(data(&html)["recordings"][0]["name"], evil);
}

#[test]
fn a_take_that_flies_apart_does_not_make_the_others_small() {
    let scene = Scene::load("stack").unwrap();
    let good = Recording::of("dantzig", &mut simulation(&scene), 10, 6);
    let mut wild = good.clone();
    for (k, sample) in wild.samples.iter_mut().enumerate() {
        sample.frame.states[1].pose.p.x += 10f64.powi(k as i32);
    }
    let scale = |recordings: Vec<Recording>| {
        let data: Value =
            serde_json::from_str(&Animation::new("animation", &scene, recordings).data()).unwrap();
        data["scale"].as_f64().unwrap()
    };
    let (alone, beside) = (scale(vec![good.clone(), good.clone()]), scale(vec![good, wild]));
    assert!(beside > 0.5 * alone, "{beside} beside {alone}");
}

#[test]
fn a_animation_lasts_at_least_four_seconds_where_slowing_can_do_that() {
    for duration in [0.07, 0.3, 1.0, 3.9, 4.0, 60.0] {
        let own = speed(duration);
        assert!(SPEEDS.contains(&own) && duration / own >= 4.0, "{duration} s at {own}");
        let faster = SPEEDS.iter().filter(|speed| **speed > own);
        assert!(faster.into_iter().all(|faster| duration / faster < 4.0), "no slower than needed");
    }
}

#[test]
fn a_simulation_that_fails_says_so_at_its_end() {
    let mut scene = Scene::load("painleve").unwrap();
    scene.step.scheme = Scheme::Acceleration;
    let recording = Recording::of("lemke", &mut simulation(&scene), 200, 50);
    assert!(recording.ending.is_some() && recording.samples.len() < 50);
    let (reason, animation) =
        (recording.ending.clone().unwrap(), Animation::new("animation", &scene, vec![recording]));
    assert!(animation.panes()[0].description.ends_with(&reason));
    assert_eq!(data(&page(animation))["recordings"][0]["ending"], reason);
}

#[test]
fn a_body_that_outweighs_all_others_tenfold_is_marked_with_its_mass() {
    let marks = |mass: f64| {
        let text = format!(
            "title = \"two\"\n[[bodies]]\nname = \"a\"\nshape = {{ sphere = 0.5 }}\nmass = 1\nposition = [0, 0, 1]\n\
             [[bodies]]\nname = \"b\"\nshape = {{ sphere = 0.5 }}\nmass = {mass}\nposition = [2, 0, 1]\n"
        );
        let scene = Scene::from_toml("two", &text).unwrap();
        let recording = Recording::of("dantzig", &mut simulation(&scene), 2, 2);
        page(Animation::new("animation", &scene, vec![recording])).contains(" kg</text>")
    };
    assert_eq!([1.0, 9.9, 10.0, 0.1].map(marks), [false, false, true, true]);
}

/// The number behind a key of the first tag with it.
fn number(text: &str, key: &str) -> f64 {
    let value = text.split(key).nth(1).unwrap();
    value.split(['"', 'm', 'v']).next().unwrap().parse().unwrap()
}

#[test]
fn the_strips_of_an_animation_are_one_row_each_at_one_scale_with_7_pt() {
    let strips = animation("pyramid", 21).drawn().strips;
    let bars: Vec<f64> = strips.iter().map(|strip| number(strip, "0 -4h")).collect();
    assert_eq!(bars.len(), 2);
    assert_eq!(bars[0], bars[1], "px of a meter");
    for strip in &strips {
        let starts = strip.split("class=\"instant\"").skip(1);
        let heights: Vec<&str> = starts
            .map(|start| {
                let at = start.split("translate(").nth(1).unwrap().split(')').next().unwrap();
                at.split_once(' ').unwrap().1
            })
            .collect();
        assert_eq!(heights.len(), 5);
        assert!(heights.iter().all(|height| *height == heights[0]), "{heights:?}");
        // On a sheet of 182 mm in at most 62 mm of height, text of 14 px.
        let [wide, high] = [" width=\"", " height=\""].map(|key| number(strip, key));
        let mm = f64::min(182.0 / wide, 62.0 / high);
        assert!(14.0 * mm * 72.0 / 25.4 >= 7.0, "{wide} × {high}");
    }
}

#[test]
fn arrows_stay_in_the_picture_and_do_not_hide_what_holds_a_chain() {
    let strip = &animation("chain", 21).drawn().strips[0];
    for frame in strip.split("class=\"instant\"").skip(1) {
        let frame = frame.split("</g>\n<text").next().unwrap();
        // The border: M0 0h{w}v{h}, in tenths of a px.
        let border = frame.split("M0 0h").nth(1).unwrap();
        let (wide, rest) = border.split_once('v').unwrap();
        let high: f64 = rest.split('h').next().unwrap().parse().unwrap();
        let wide: f64 = wide.parse().unwrap();
        let heads = frame.split("<path stroke=\"none\"").skip(1);
        let heads = heads.flat_map(|path| path.split(" d=\"").nth(1).unwrap().split('"').next());
        let starts = heads.flat_map(|path| path.split('M').skip(1));
        for tip in starts {
            let mut numbers = tip.split(|c: char| !(c.is_ascii_digit() || c == '-' || c == '.'));
            let (x, y): (f64, f64) = (
                numbers.next().unwrap().parse().unwrap(),
                numbers.next().unwrap().parse().unwrap(),
            );
            assert!((-1.0..wide + 1.0).contains(&x) && (-1.0..high + 1.0).contains(&y), "{x} {y}");
        }
    }
}
