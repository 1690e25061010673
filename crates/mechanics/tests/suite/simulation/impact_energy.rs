//! Energies of impacts that contradict the coefficient of restitution are reported where kinetic
//! energy shows it, and nowhere else.

use lcplab_mechanics::scene::{Integrator, Scene, Scheme};
use lcplab_mechanics::simulation::{ImpactCause, ImpactEnergy, Step, Warnings};
use proptest::prelude::*;

use super::{assert_near, simulation};

/// Without gravity, and with bounces of any speed.
fn head(dt: f64, restitution: f64, friction: f64) -> String {
    format!(
        "gravity = [0, 0, 0]\nstep.dt = {dt}\n\
         [contact]\nrestitution = {restitution}\nfriction = {friction}\nbounce_speed = 0\n"
    )
}

fn scene(text: &str) -> Scene {
    Scene::from_toml("impact.toml", text).unwrap()
}

/// A ball of a chain: its mass (kg), the gap before it (m) and its velocity (m/s).
type Link = (f64, f64, f64);

const RADIUS: f64 = 0.1;

/// Balls in a row along x, and a wall at the end.
fn chain(links: &[Link], gap_of_wall: f64, dt: f64, restitution: f64) -> Scene {
    let mut text = head(dt, restitution, 0.0);
    let mut x = 0.0;
    for (k, (mass, gap, velocity)) in links.iter().enumerate() {
        x += 2.0 * RADIUS + gap;
        text += &format!(
            "[[bodies]]\nname = \"ball{k}\"\nshape = {{ sphere = {RADIUS} }}\nmass = {mass}\n\
             position = [{x}, 0, 0]\nvelocity = [{velocity}, 0, 0]\n"
        );
    }
    let wall = x + RADIUS + gap_of_wall + 0.5;
    text += &format!(
        "[[bodies]]\nname = \"wall\"\nfixed = true\nshape = {{ box = [1, 6, 6] }}\nposition = [{wall}, 0, 0]\n"
    );
    scene(&text)
}

fn reports(step: &Step) -> &[ImpactEnergy] {
    &step.impact_energy
}

/// The total energy of a step's reports (J).
fn reported(step: &Step) -> f64 {
    reports(step).iter().map(|report| report.energy).sum()
}

fn link() -> impl Strategy<Value = Link> {
    let gap = prop_oneof![Just(0.0), 0.0..0.03, 0.03..0.2];
    (0.2..5.0, gap, -3.0..3.0).prop_map(|(mass, gap, velocity)| (mass, gap, velocity))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    /// At e = 1 kinetic energy changes only with a report: the energy is computed from masses and
    /// velocities alone.
    #[test]
    fn at_restitution_1_the_reports_are_the_change_of_kinetic_energy(
        links in prop::collection::vec(link(), 1..6),
        gap in prop_oneof![Just(0.0), 0.0..0.03],
        is_acceleration: bool,
    ) {
        let mut chain = chain(&links, gap, 0.01, 1.0);
        if is_acceleration {
            chain.step.scheme = Scheme::Acceleration;
        }
        let mut chain = simulation(chain);
        let mut before = chain.motion().kinetic;
        let scale = before.max(1e-3);
        for _ in 0..10 {
            let step = chain.step().unwrap();
            let change = step.motion.kinetic - before;
            prop_assert!((reported(&step) - change).abs() < 1e-9 * scale, "{} {change}", reported(&step));
            prop_assert!(reports(&step).is_empty() || change.abs() > 1e-12 * scale, "{change} {:?}", reports(&step));
            before = step.motion.kinetic;
        }
    }

    /// Below e = 1 losses are expected, gains never are.
    #[test]
    fn at_any_restitution_kinetic_energy_does_not_rise_without_a_report(
        links in prop::collection::vec(link(), 1..6),
        gap in prop_oneof![Just(0.0), 0.0..0.03],
        e in 0.0..0.999f64,
    ) {
        let mut chain = simulation(chain(&links, gap, 0.01, e));
        let mut before = chain.motion().kinetic;
        let scale = before.max(1e-3);
        for _ in 0..10 {
            let step = chain.step().unwrap();
            let change = step.motion.kinetic - before;
            prop_assert!(change < 1e-9 * scale || reported(&step) > change - 1e-9 * scale);
            prop_assert!(reports(&step).iter().all(|report| report.energy > 0.0));
            before = step.motion.kinetic;
        }
    }

    /// A rod that hits the ground with one end: friction at e = 1 removes energy, or adds it if it
    /// reverses the slip (Kane's paradox). There is one contact, so the change of kinetic energy is
    /// the contact's work.
    #[test]
    fn friction_that_takes_energy_is_no_report_and_friction_that_adds_it_is_one(
        angle in 5.0..85.0f64,
        mu in 0.0..1.5f64,
        e in prop_oneof![Just(1.0), 0.0..1.0f64],
        slip in -3.0..3.0f64,
        spin in -10.0..10.0f64,
    ) {
        let (change, step) = rod_hits(angle, mu, e, slip, spin);
        if change > 1e-9 {
            let [report] = reports(&step) else { panic!("{change} J came from nowhere") };
            assert_near(report.energy, change, 1e-9);
            prop_assert_eq!(report.cause, ImpactCause::Friction);
        } else {
            prop_assert!(reports(&step).is_empty(), "{:?} {change}", reports(&step));
        }
    }
}

/// A rod at an angle (degrees) to the ground that hits it at 2 m/s: the change of its kinetic
/// energy (J).
fn rod_hits(angle: f64, mu: f64, e: f64, slip: f64, spin: f64) -> (f64, Step) {
    let height = 0.5 * angle.to_radians().sin() + 0.05;
    let text = format!(
        "{}[[bodies]]\nname = \"ground\"\nfixed = true\nshape = {{ plane = [0, 0, 1] }}\n\
         [[bodies]]\nname = \"rod\"\nshape = {{ capsule = {{ length = 1, radius = 0.05 }} }}\nmass = 2\n\
         position = [0, 0, {height}]\nrotation = {{ y = {} }}\nvelocity = [{slip}, 0, -2]\n\
         angular_velocity = [0, {spin}, 0]\n",
        head(1e-3, e, mu),
        90.0 - angle
    );
    let mut rod = simulation(scene(&text));
    let before = rod.motion().kinetic;
    let step = rod.step().unwrap();
    (step.motion.kinetic - before, step)
}

#[test]
fn kanes_rod_gains_energy_by_friction_and_is_named() {
    // From two equations in the plane, normal and tangential: the slip reverses, the limit of
    // friction is reached.
    let (change, step) = rod_hits(42.0, 0.5, 1.0, -0.4, -10.0);
    assert_near(change, 7.481_949_552_292_687, 1e-9);
    let [report] = reports(&step) else { panic!("{:?}", reports(&step)) };
    assert_near(report.energy, change, 1e-9);
    assert_eq!(report.cause, ImpactCause::Friction);
}

#[test]
fn equal_balls_whose_impacts_lie_in_different_steps_exchange_their_velocities_without_a_report() {
    // 2 m/s in steps of 10 ms: gaps of 25 mm are more than a step.
    let links = [(1.0, 0.0, 2.0), (1.0, 0.025, 0.0), (1.0, 0.025, 0.0)];
    let mut chain = simulation(chain(&links, 0.025, 0.01, 1.0));
    for _ in 0..12 {
        assert!(reports(&chain.step().unwrap()).is_empty());
    }
    // Through the chain to the wall and back.
    let speeds: Vec<f64> = chain.states()[..3].iter().map(|state| state.v.x).collect();
    let mut sizes: Vec<f64> = speeds.iter().map(|v| v.abs()).collect();
    sizes.sort_by(f64::total_cmp);
    for (size, exact) in sizes.into_iter().zip([0.0, 0.0, 2.0]) {
        assert_near(size, exact, 1e-12);
    }
}

#[test]
fn two_balls_and_a_wall_in_one_step_lose_half_of_the_energy_and_it_is_said_why() {
    let scene = chain(&[(1.0, 0.0, 2.0), (1.0, 0.01, 0.0)], 0.01, 0.01, 1.0);
    let mut balls = simulation(scene.clone());
    let step = balls.step().unwrap();
    let [report] = reports(&step) else { panic!("{:?}", reports(&step)) };
    // By hand: 2 J before; the wall stops ball1 at 1 m/s, ball0 returns with 1 m/s: 1 J.
    assert_near(report.energy, -1.0, 1e-12);
    assert_eq!((report.bodies, report.cause), ([1, 2], ImpactCause::GapClosed));
    assert_near(report.gap, 0.01, 1e-12);
    let message = report.message(&scene, 1);
    assert!(message.contains("lost 1 J in step 1") && message.contains("0.01 m away"), "{message}");
    let mut warnings = Warnings::default();
    warnings.add(&scene, &step);
    let json = &warnings.to_json()[0];
    assert_eq!(json["bodies"], serde_json::json!(["ball1", "wall"]));
    assert_eq!((&json["kind"], &json["step"]), (&"gap_closed_within_step".into(), &1.into()));
}

#[test]
fn a_ball_that_parts_from_a_wall_and_is_pressed_back_within_the_step_gains_energy_and_is_named() {
    // ½ (2² + 0.5²) J before; Newton's law between the balls alone: a separation speed of 2.5 m/s,
    // ball1 at rest: ½ 2.5² J.
    let scene = chain(&[(1.0, 0.0, 2.0), (1.0, 0.0, -0.5)], 0.0, 0.01, 1.0);
    let step = simulation(scene).step().unwrap();
    let [report] = reports(&step) else { panic!("{:?}", reports(&step)) };
    assert_near(report.energy, 3.125 - 2.125, 1e-12);
    assert_eq!((report.bodies, report.cause), ([1, 2], ImpactCause::NotBounced));
}

#[test]
fn a_ball_on_the_ground_is_never_reported_whatever_its_restitution() {
    for scheme in
        [Scheme::Velocity, Scheme::Acceleration, Scheme::SequentialImpulses, Scheme::SplitImpulse]
    {
        for e in [0.0, 0.5, 1.0] {
            for bounce_speed in [0.0, 0.1] {
                let text = format!(
                    "step.scheme = \"{}\"\n[contact]\nrestitution = {e}\nbounce_speed = {bounce_speed}\nfriction = 0.5\n\
                     [[bodies]]\nname = \"ground\"\nfixed = true\nshape = {{ plane = [0, 0, 1] }}\n\
                     [[bodies]]\nname = \"ball\"\nshape = {{ sphere = 0.1 }}\nmass = 3\nposition = [0, 0, 0.6]\n\
                     velocity = [1, 0, 0]\nangular_velocity = [0, 0, 5]\n",
                    scheme.name()
                );
                let mut ball = simulation(scene(&text));
                for _ in 0..200 {
                    let step = ball.step().unwrap();
                    assert!(reports(&step).is_empty(), "{scheme:?} {e}: {:?}", reports(&step));
                }
            }
        }
    }
}

#[test]
fn what_friction_takes_of_an_oblique_impact_is_not_the_impacts_loss() {
    // A point with 3 m/s along and 2 m/s into the ground: friction reduces the former by μ 2 · 2
    // m/s.
    let text = format!(
        "{}[[bodies]]\nname = \"ground\"\nfixed = true\nshape = {{ plane = [0, 0, 1] }}\n\
         [[bodies]]\nname = \"bead\"\nshape = \"point\"\nmass = 1\nvelocity = [3, 0, -2]\n",
        head(0.01, 1.0, 0.25)
    );
    let mut bead = simulation(scene(&text));
    let step = bead.step().unwrap();
    assert_near(bead.states()[1].v.x, 3.0 - 0.25 * 4.0, 1e-12);
    assert_near(bead.states()[1].v.z, 2.0, 1e-12);
    assert!(reports(&step).is_empty());
}

#[test]
fn a_bat_and_a_joint_add_and_take_nothing_that_is_reported() {
    // A wall that moves at 3 m/s gives a ball at rest 6 m/s.
    let bat = format!(
        "{}[[bodies]]\nname = \"bat\"\nfixed = true\nshape = {{ box = [1, 1, 1] }}\nvelocity = [3, 0, 0]\n\
         [[bodies]]\nname = \"ball\"\nshape = {{ sphere = 0.1 }}\nmass = 1\nposition = [0.6, 0, 0]\n",
        head(0.01, 1.0, 0.0)
    );
    let mut bat = simulation(scene(&bat));
    let step = bat.step().unwrap();
    assert_near(bat.states()[1].v.x, 6.0, 1e-12);
    assert!(reports(&step).is_empty(), "{:?}", reports(&step));
    // A dumbbell hits the ground with one end: its rod keeps the distance.
    let dumbbell = format!(
        "{}[[bodies]]\nname = \"ground\"\nfixed = true\nshape = {{ plane = [0, 0, 1] }}\n\
         [[bodies]]\nname = \"low\"\nshape = \"point\"\nmass = 1\nvelocity = [0, 0, -2]\n\
         [[bodies]]\nname = \"high\"\nshape = \"point\"\nmass = 1\nposition = [0.6, 0, 0.8]\nvelocity = [0, 0, -2]\n\
         [[constraints]]\nkind = \"distance\"\nbodies = [\"low\", \"high\"]\n",
        head(0.01, 1.0, 0.0)
    );
    let mut dumbbell = simulation(scene(&dumbbell));
    let step = dumbbell.step().unwrap();
    assert_near(step.motion.kinetic, 4.0, 1e-12);
    assert!(reports(&step).is_empty(), "{:?}", reports(&step));
}

#[test]
fn feedback_that_throws_an_overlap_apart_is_reported_with_its_energy_and_small_feedback_is_not() {
    // 0.2/dt · 50 mm is 1 m/s.
    let thrown = |overlap: f64, gravity: f64| {
        let text = format!(
            "gravity = [0, 0, {gravity}]\nstep = {{ dt = 0.01, baumgarte = 0.2 }}\n\
             [[bodies]]\nname = \"ground\"\nfixed = true\nshape = {{ plane = [0, 0, 1] }}\n\
             [[bodies]]\nname = \"ball\"\nshape = {{ sphere = 0.5 }}\nmass = 2\nposition = [0, 0, {}]\n",
            0.5 - overlap
        );
        simulation(scene(&text)).step().unwrap()
    };
    let step = thrown(0.05, 0.0);
    let [report] = reports(&step) else { panic!("{:?}", reports(&step)) };
    assert_near(report.energy, 1.0, 1e-12);
    assert!(matches!(report.cause, ImpactCause::PushedApart(speed) if (speed - 1.0).abs() < 1e-12));
    assert!(reports(&thrown(1e-5, -9.81)).is_empty());
}

/// A scheme, an integrator, and whether impacts divide a step.
type Way = (Scheme, Integrator, bool);

/// Every scheme, and the acceleration level with every integrator.
fn ways() -> Vec<Way> {
    let others = Scheme::ALL.into_iter().filter(|scheme| *scheme != Scheme::Acceleration);
    let others = others.map(|scheme| (scheme, Integrator::default(), true));
    let integrators = [
        Integrator::ExplicitEuler,
        Integrator::SemiImplicitEuler,
        Integrator::Rk4,
        Integrator::ImplicitMidpoint,
    ];
    let of_events = |events| integrators.map(|own| (Scheme::Acceleration, own, events));
    others.chain([true, false].into_iter().flat_map(of_events)).collect()
}

/// A planted scene stepped in one way until its bodies have parted: the kinetic energy (J) after
/// it, the sum of the reports, and the reports with their steps.
fn stepped(
    mut scene: Scene,
    (scheme, integrator, events): Way,
) -> (f64, f64, Vec<(usize, ImpactEnergy)>) {
    (scene.step.scheme, scene.step.integrator, scene.step.events) = (scheme, integrator, events);
    let mut balls = simulation(scene);
    let mut found = Vec::new();
    for _ in 0..80 {
        let step = balls.step().unwrap();
        found.extend(step.impact_energy.iter().map(|own| (step.number, *own)));
    }
    (balls.motion().kinetic, found.iter().map(|(_, own)| own.energy).sum(), found)
}

#[test]
fn under_every_scheme_and_integrator_an_impact_has_its_energy_or_a_report_of_what_is_missing() {
    const TOLERANCE: f64 = 0.02;
    for e in [0.0, 0.5, 1.0] {
        let wall = chain(&[(1.0, 0.0, 2.0)], 0.007, 0.01, e);
        let balls = chain(&[(1.0, 0.0, 2.0), (3.0, 0.007, 0.0)], 50.0, 0.01, e);
        let all = chain(&[(1.0, 0.0, 2.0), (1.0, 0.01, 0.0)], 0.01, 0.01, e);
        // ½ m (e v)²; the motion of the center of mass, ½ (m v)²/(m + M), and e² of the rest.
        let [of_wall, of_balls] = [2.0 * e * e, 0.5 + 1.5 * e * e];
        let of_all = match e {
            0.0 => 0.0,
            1.0 => 2.0,
            // By hand: 0.5 and 1.5 m/s; ball1 returns with 0.75; −0.4375 and 0.1875; it returns
            // with 0.09375 and does not reach ball0.
            _ => 0.5 * (0.4375 * 0.4375 + 0.09375 * 0.09375),
        };
        for way in ways() {
            for (scene, right) in [(&wall, of_wall), (&balls, of_balls)] {
                let (kinetic, reported, found) = stepped(scene.clone(), way);
                let missing = kinetic - right;
                assert!(
                    (missing - reported).abs() < TOLERANCE * 2.0,
                    "{way:?} {e}: {missing} J, {found:?}"
                );
            }
            let (kinetic, reported, found) = stepped(all.clone(), way);
            let missing = kinetic - of_all;
            let is_right = (missing - reported).abs() < TOLERANCE * 2.0;
            // Impacts at one instant have no order, on which the energy depends at 0 < e < 1.
            let has_order = way.2 || e != 0.5;
            let is_named = e < 1.0 && !found.is_empty();
            assert!(is_right || is_named || !has_order, "{way:?} {e}: {missing} J, {found:?}");
        }
    }
}

#[test]
fn a_report_of_a_spread_impact_names_its_first_and_last_step_and_the_warning_its_first() {
    let mut scene = chain(&[(1.0, 0.0, 2.0)], 0.05, 0.01, 1.0);
    scene.step.scheme = Scheme::Penalty;
    let mut ball = simulation(scene.clone());
    let mut warnings = Warnings::default();
    for _ in 0..20 {
        warnings.add(&scene, &ball.step().unwrap());
    }
    let [own] = warnings.as_slice() else { panic!("{warnings:?}") };
    // 2 m/s close 50 mm after 2.5 steps; half a period of the contact spring takes π ms·√1000/10.
    assert_eq!((own.step, own.word), (3, "impact_energy_of_scheme"));
    assert!(own.message.contains("in steps 3 to 6") && own.message.contains("less than"), "{own}");
    let speed = ball.states()[0].v.x;
    assert_near(own.total, 0.5 * speed * speed - 2.0, 1e-9);
}

/// The line of centers turns while two balls approach each other within a step, and these schemes
/// take their impact later in it. No joint and no gravity exchanges energy.
#[test]
fn off_center_impacts_within_a_step_are_reported_with_the_change_of_kinetic_energy() {
    let mut reports_made = 0;
    for scheme in [Scheme::Xpbd, Scheme::Soft, Scheme::Penalty] {
        for (offset, gap, dt) in
            [(0.6, 1.3, 0.01), (0.6, 1.31, 0.02), (0.9, 1.2, 0.01), (0.3, 1.0, 0.02)]
        {
            let mut scene = scene(&format!(
                "{}[[bodies]]\nname = \"a\"\nmass = 1\nshape = {{ sphere = 0.5 }}\n\
                 velocity = [3, 0, 0]\n[[bodies]]\nname = \"b\"\nmass = 2\n\
                 shape = {{ sphere = 0.5 }}\nposition = [{}, {offset}, 0]\n",
                head(dt, 1.0, 0.0),
                1.0 + gap
            ));
            scene.step.scheme = scheme;
            let mut balls = simulation(scene);
            let before = balls.motion().kinetic;
            let (mut sum, mut after) = (0.0, before);
            for _ in 0..(1.0 / dt) as usize {
                let step = balls.step().unwrap();
                (sum, after) = (sum + reported(&step), step.motion.kinetic);
            }
            let (change, what) = (after - before, format!("{scheme:?}, {offset}, {gap}, {dt}"));
            match sum == 0.0 {
                // The tolerance of the report.
                true => {
                    assert!(change.abs() < 0.02 * before, "{what}: {change} J without a report")
                }
                false => assert_near(sum, change, 1e-9),
            }
            reports_made += usize::from(sum != 0.0);
        }
    }
    assert!(reports_made >= 4, "{reports_made}");
}

/// A ball of 4 m/s between walls with gaps of 5 and 15 mm: after its bounce on the second one it
/// would be 35 mm inside the first one at the end of the step. The bounce asks for at least 4 m/s
/// away from the second wall, the first wall allows 0.5 m/s: no impulses satisfy both.
#[test]
fn a_bounce_that_would_close_another_gap_within_the_step_is_named_as_a_contradiction() {
    let text = |dt: f64| {
        format!(
            "{}[[bodies]]\nname = \"left\"\nfixed = true\nshape = {{ plane = [1, 0, 0] }}\n\
             [[bodies]]\nname = \"right\"\nfixed = true\nshape = {{ plane = [-1, 0, 0] }}\n\
             position = [0.22, 0, 0]\n[[bodies]]\nname = \"ball\"\nmass = 1\n\
             shape = {{ sphere = 0.1 }}\nposition = [0.105, 0, 0]\nvelocity = [4, 0, 0]\n",
            head(dt, 1.0, 0.0)
        )
    };
    let scene = scene(&text(0.01));
    let step = simulation(scene.clone()).step().unwrap();
    let [report] = reports(&step) else { panic!("{:?}", reports(&step)) };
    assert_eq!((report.bodies, report.cause), ([2, 1], ImpactCause::Contradicted));
    let message = report.message(&scene, 1);
    assert!(message.contains("no impulses satisfy all rows") && message.contains("step.dt"));
    // With a step in which the ball does not cross the gap it keeps its energy.
    let mut ball = simulation(self::scene(&text(0.001)));
    for _ in 0..40 {
        let step = ball.step().unwrap();
        assert!(reports(&step).is_empty());
        assert_near(step.motion.kinetic, 8.0, 1e-12);
    }
}
