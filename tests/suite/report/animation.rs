//! Animations, and scenes with changed fields.

use lcplab::animation::{Animation, Recording};
use lcplab::report::study::Study;
use lcplab::report::study::animation::{self, AnimationData};
use lcplab::report::study::variation::Variation;
use lcplab::report::view::ReportPage;
use lcplab::simulation::Simulation;
use lcplab::solver::Registry;

fn variation(text: &str) -> Variation {
    toml::from_str(text).unwrap()
}

#[test]
fn a_variation_changes_the_fields_it_names_and_no_others() {
    let plain = variation("scene = 'stack'").scene().unwrap();
    let changed = "scene = 'stack'\nchange = { step = { dt = 0.02 }, generate = { count = 2 } }";
    let changed = variation(changed).scene().unwrap();
    assert_eq!((changed.step.dt, changed.bodies.len()), (0.02, 3));
    assert_eq!((changed.step.alpha, changed.title), (plain.step.alpha, plain.title));
}

#[test]
fn a_variation_that_is_no_scene_is_refused() {
    let refused = |text: &str| variation(text).scene().unwrap_err().to_string();
    let wrong = refused("scene = 'stack'\nchange = { step = { dt = -1.0 } }");
    assert!(wrong.contains("step.dt: must be positive, is -1"), "{wrong}");
    let wrong = refused("scene = 'stack'\nchange = { stop = { dt = 1.0 } }");
    assert!(wrong.contains("stop"), "{wrong}");
    assert!(refused("scene = 'moon'").contains("moon"));
}

#[test]
fn a_animation_survives_as_plain_data() {
    let scene = variation("scene = 'double_pendulum'");
    let mut simulation = Simulation::of(&scene.scene().unwrap()).unwrap();
    let recording = Recording::of("velocity", &mut simulation, 20, 6);
    let data = AnimationData::of("animation", scene.clone(), std::slice::from_ref(&recording));
    let text = serde_json::to_string(&data).unwrap();
    let back: AnimationData = serde_json::from_str(&text).unwrap();
    assert_eq!(back, data);
    let (animation, was) = (
        back.animation().unwrap(),
        Animation::new("animation", &scene.scene().unwrap(), vec![recording]),
    );
    assert_eq!(animation.times(), was.times());
    for (now, then) in animation.recordings[0].samples.iter().zip(&was.recordings[0].samples) {
        for (a, b) in now.frame.states.iter().zip(&then.frame.states) {
            assert!((a.pose.p - b.pose.p).norm() < 1e-5);
        }
        assert_eq!(now.frame.forces.len(), then.frame.forces.len());
    }
}

#[test]
fn a_animation_section_shows_its_variants_side_by_side() {
    let plan: animation::Plan = toml::from_str(
        "name = 'f'\nscene = 'pendulum'\nduration = 0.1\nsamples = 3\ncaption = 'Look.'\n\
         variants = [{ name = 'velocity' },\n\
         { name = 'acceleration', change = { step = { scheme = 'acceleration' } } }]",
    )
    .unwrap();
    let found = plan.run(0, Registry::standard()).unwrap().0;
    assert_eq!(found.recordings.iter().map(|own| own.samples.len()).collect::<Vec<_>>(), [3, 3]);
    let page = ReportPage::of(&plan, &[found]).page.render().unwrap();
    assert!(page.contains("acceleration") && page.contains("Look."));
}
