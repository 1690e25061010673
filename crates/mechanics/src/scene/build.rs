//! Builds a scene from a description; every defect is reported, none is repaired. For constraints
//! see [`joints`](super::joints).

use std::collections::{BTreeMap, HashMap};
use std::f64::consts::TAU;
use std::path::Path;
use std::sync::Arc;

use nalgebra::{Quaternion, UnitQuaternion, Vector3};

use super::description::{self, Capsule, Description, Part, Rotation};
use super::joints::Site;
use super::settings::within_one;
use super::{Scene, anisotropy, driven, friction, generate, range, surface};
use crate::body::{Body, Cylinder, Mass, Placed, Polytope, Pose, Shape, State, inertia};
use lcplab_lcp::error::{Defects, Result};
use lcplab_lcp::memory::Memory;
use lcplab_solver::Registry;

/// A placeholder for an invalid mass, which causes no further defects.
const STAND_IN: Mass = Mass::Point { mass: 1.0 };
/// A placeholder for an invalid shape.
const SHAPE_STAND_IN: Shape = Shape::Sphere { radius: 1.0 };

pub(super) fn scene(name: &str, description: &Description) -> Result<Scene> {
    let mut defects = Defects::default();
    let whole = generate::expand(description, &mut defects);
    whole.step.check(&mut defects);
    whole.contact.check(&mut defects);
    friction::check(&mut defects, &whole.step, &whole.contact);
    whole.solver.check(&mut defects);
    range::vector(&mut defects, "gravity", &whole.gravity);
    let mut scene = Scene {
        name: stem(name),
        title: whole.title.clone(),
        teaches: whole.teaches.clone(),
        gravity: leaning(&mut defects, &whole),
        time: whole.time,
        driven: Vec::new(),
        step: whole.step.clone(),
        contact: whole.contact.clone(),
        solver: whole.solver.clone(),
        bodies: Vec::with_capacity(whole.bodies.len()),
        states: Vec::with_capacity(whole.bodies.len()),
        pairs: BTreeMap::new(),
        constraints: Vec::with_capacity(whole.constraints.len()),
        memory: Memory::default(),
        solvers: Registry::default(),
    };
    let mut names = HashMap::new();
    let mut frames = Vec::with_capacity(whole.bodies.len());
    for (k, body) in whole.bodies.iter().enumerate() {
        let place = format!("bodies[{k}]");
        if body.name.is_empty() {
            defects.add(format!("{place}.name"), "is empty");
        } else if body.name.contains(char::is_control) {
            defects.add(format!("{place}.name"), "has a line break or another control character");
        } else if let Some(first) = names.insert(body.name.as_str(), k) {
            let reason = format!("{:?} is the name of bodies[{first}] too", body.name);
            defects.add(format!("{place}.name"), reason);
        }
        let axes = if body.inertia.is_some() { Axes::Written } else { Axes::Principal };
        let (shape, frame) = build_shape(&mut defects, &place, &body.shape, axes);
        let mass = build_mass(&mut defects, &place, body, &shape);
        let (friction, static_friction) =
            surface::of_body(&mut defects, &place, body, &whole.contact);
        if let Some(restitution) = body.restitution {
            within_one(&mut defects, &format!("{place}.restitution"), restitution);
        }
        let fields = anisotropy::Fields {
            friction: Some(friction),
            across: body.friction_across,
            direction: body.friction_direction,
        };
        let force_at =
            body.force_at.map_or_else(Vector3::zeros, |point| frame.local(&point.into()));
        build_force(&mut defects, &place, body);
        scene.bodies.push(Body {
            name: body.name.clone(),
            mass,
            shape,
            friction,
            static_friction,
            anisotropy: fields.read(&mut defects, &place, &frame),
            restitution: body.restitution,
            force: body.force.into(),
            force_at,
            torque: body.torque.into(),
        });
        scene.states.push(build_state(&mut defects, &place, body, &frame));
        scene.driven.extend(driven::of_body(&mut defects, &place, body, &scene, k));
        frames.push(frame);
    }
    if !whole.time.is_finite() {
        defects.add("time", format!("must be finite, is {}", whole.time));
    }
    driven::check_scheme(&mut defects, &scene);
    for (k, pair) in whole.pairs.iter().enumerate() {
        let place = format!("pairs[{k}]");
        surface::add_pair(&mut defects, &place, pair, &names, &frames, &mut scene);
    }
    surface::separate(&whole.bodies, &mut scene);
    anisotropy::check(&mut defects, &scene);
    surface::check_scheme(&mut defects, &scene);
    for (k, constraint) in whole.constraints.iter().enumerate() {
        let site = Site { place: format!("constraints[{k}]"), written: constraint };
        scene.constraints.extend(site.build(&mut defects, &names, &scene));
    }
    if scene.driven.iter().any(|driven| driven.displacement.is_some()) && defects.is_empty() {
        scene.states = scene.supported(&scene.states, scene.time, scene.step.dt).into_owned();
    }
    for (k, constraint) in whole.constraints.iter().enumerate() {
        let site = Site { place: format!("constraints[{k}]"), written: constraint };
        site.start(&mut defects, &names, &whole.bodies, &mut scene);
    }
    for (k, start) in whole.start.iter().enumerate() {
        let place = format!("start[{k}]");
        match names.get(start.body.as_str()) {
            None => {
                let reason = format!("there is no body named {:?}", start.body);
                defects.add(format!("{place}.body"), reason);
            }
            Some(&body) => {
                let written = started(&whole.bodies[body], start);
                let frame = State::WORLD.pose;
                scene.states[body] = build_state(&mut defects, &place, &written, &frame);
            }
        }
    }
    defects.into_result(name)?;
    Ok(scene)
}

/// The description with everything made explicit: structures as bodies, a tilt as gravity, and for
/// each body its mass, moments, quaternion, coefficients and velocities.
pub(super) fn written_out(name: &str, description: &Description) -> Result<Description> {
    let scene = scene(name, description)?;
    let mut whole = generate::expand(description, &mut Defects::default());
    whole.generate.clear();
    whole.tilt = None;
    whole.gravity = scene.gravity.into();
    for (k, written) in whole.bodies.iter_mut().enumerate() {
        let (body, state) = (&scene.bodies[k], &scene.states[k]);
        if let Mass::Point { mass } | Mass::Rigid { mass, .. } = body.mass {
            (written.mass, written.density) = (Some(mass), None);
        }
        let follows = matches!(body.shape, Shape::Hull(_) | Shape::Compound(_));
        if let (Mass::Rigid { moments, .. }, false) = (body.mass, follows) {
            written.inertia = Some(moments.into());
        }
        let q = written.rotation.as_ref().and_then(turn).unwrap_or_default();
        written.rotation = (written.shape != description::Shape::Point)
            .then_some(Rotation::Quaternion([q.w, q.i, q.j, q.k]));
        written.friction = Some(body.friction);
        written.static_friction = body.static_friction.filter(|&own| own > body.friction);
        written.restitution = body.restitution.or(Some(scene.contact.restitution));
        if description.start.iter().all(|start| start.body != written.name) {
            (written.velocity, written.angular_velocity) = (state.v.into(), state.omega.into());
        }
    }
    whole.constraints.iter_mut().for_each(|constraint| constraint.start_speed = None);
    Ok(whole)
}

fn stem(name: &str) -> String {
    Path::new(name).file_stem().map_or_else(|| name.into(), |stem| stem.to_string_lossy().into())
}

/// Checks the forces on a body: they must be finite, and able to act on it.
fn build_force(defects: &mut Defects, place: &str, body: &description::Body) {
    let is_point = body.shape == description::Shape::Point;
    let given = [("force", body.force), ("torque", body.torque)];
    for (field, value) in given.into_iter().chain(body.force_at.map(|point| ("force_at", point))) {
        let place = format!("{place}.{field}");
        range::vector(defects, &place, &value);
        if body.fixed && value != [0.0; 3] {
            defects.add(place, "a fixed body has none");
        } else if is_point && field != "force" && value != [0.0; 3] {
            defects.add(place, "a point does not turn");
        }
    }
}

/// Gravity in the coordinates of a tilted scene.
fn leaning(defects: &mut Defects, whole: &Description) -> Vector3<f64> {
    let gravity: Vector3<f64> = whole.gravity.into();
    match whole.tilt.map(|tilt| turn(&tilt)) {
        None => gravity,
        Some(Some(q)) => q.inverse() * gravity,
        Some(None) => {
            defects.add("tilt", "is not a rotation: it must be finite and not 0");
            gravity
        }
    }
}

/// The axes of a hull or a compound.
#[derive(Clone, Copy)]
enum Axes {
    /// The principal axes of its homogeneous solid, with its center of mass as the origin.
    Principal,
    /// Those in which it is written, because the moments are given about them.
    Written,
}

/// The shape in the body's frame, and the pose of that frame in the axes of the description; they
/// differ only for hulls and compounds.
fn build_shape(
    defects: &mut Defects,
    place: &str,
    shape: &description::Shape,
    axes: Axes,
) -> (Shape, Pose) {
    let place = format!("{place}.shape");
    let mut is_length =
        |field: &str, value: f64| range::length(defects, format!("{place}{field}"), value);
    let shape = match shape {
        description::Shape::Point => Some(Shape::Point),
        description::Shape::Sphere(radius) => {
            is_length("", *radius).then_some(Shape::Sphere { radius: *radius })
        }
        description::Shape::Box(edges) => edges
            .iter()
            .all(|&edge| is_length("", edge))
            .then(|| Shape::Box { half: Vector3::from(*edges) / 2.0 }),
        description::Shape::Capsule(Capsule { length, radius }) => {
            let fits =
                [is_length(".capsule.length", *length), is_length(".capsule.radius", *radius)];
            let capsule = Shape::Capsule { half_length: length / 2.0, radius: *radius };
            (fits == [true; 2]).then_some(capsule)
        }
        description::Shape::Cylinder(Capsule { length, radius }) => {
            let fits =
                [is_length(".cylinder.length", *length), is_length(".cylinder.radius", *radius)];
            if fits == [true; 2] {
                return build_cylinder(*length, *radius);
            }
            None
        }
        description::Shape::Hull(points) => return build_hull(defects, &place, points, axes),
        description::Shape::Compound(parts) => return build_compound(defects, &place, parts, axes),
        description::Shape::Plane(normal) => {
            Some(Shape::Plane { normal: direction(defects, &place, normal) })
        }
    };
    (shape.unwrap_or(SHAPE_STAND_IN), State::WORLD.pose)
}

/// The prism that approximates a cylinder along z.
fn build_cylinder(length: f64, radius: f64) -> (Shape, Pose) {
    let points: Vec<Vector3<f64>> = prism(length, radius).into_iter().map(Vector3::from).collect();
    let (center, axis) = (Vector3::zeros(), Vector3::z());
    let cylinder = Some(Cylinder { center, axis, half_length: 0.5 * length, radius });
    let prism = Polytope::hull(&points).map(|hull| Polytope { cylinder, ..hull });
    let shape = prism.map_or(SHAPE_STAND_IN, |prism| Shape::Hull(Arc::new(prism)));
    (shape, State::WORLD.pose)
}

fn build_hull(
    defects: &mut Defects,
    place: &str,
    points: &[[f64; 3]],
    axes: Axes,
) -> (Shape, Pose) {
    let points: Vec<_> = points.iter().copied().map(Vector3::from).collect();
    let extent = points.iter().map(|point| point.amax()).fold(0.0, f64::max);
    if extent > 0.0
        && extent.is_finite()
        && !range::length(defects, format!("{place}.hull"), extent)
    {
        return (SHAPE_STAND_IN, State::WORLD.pose);
    }
    let Some(hull) = Polytope::hull(&points) else {
        let reason = format!("{} points that span no volume", points.len());
        defects.add(format!("{place}.hull"), reason);
        return (SHAPE_STAND_IN, State::WORLD.pose);
    };
    let frame = match axes {
        Axes::Principal => inertia::principal_frame(&hull),
        Axes::Written => State::WORLD.pose,
    };
    (Shape::Hull(Arc::new(hull.seen_from(&frame))), frame)
}

fn build_compound(defects: &mut Defects, place: &str, parts: &[Part], axes: Axes) -> (Shape, Pose) {
    let mut placed = Vec::with_capacity(parts.len());
    let mut are_near = true;
    for (k, part) in parts.iter().enumerate() {
        let place = format!("{place}.compound[{k}]");
        are_near &= range::offset(defects, &format!("{place}.position"), &part.position);
        let q = part.rotation.map_or(Some(UnitQuaternion::identity()), |rotation| turn(&rotation));
        if q.is_none() {
            let reason = "is not a rotation: it must be finite and not 0";
            defects.add(format!("{place}.rotation"), reason);
        }
        let (shape, frame) = build_shape(defects, &place, &part.shape, Axes::Principal);
        if matches!(shape, Shape::Point | Shape::Plane { .. } | Shape::Compound(_)) {
            let reason = "a part is a sphere, a box, a capsule, a cylinder or a hull";
            defects.add(format!("{place}.shape"), reason);
        }
        let written = Pose { p: part.position.into(), q: q.unwrap_or_default() };
        placed.push(Placed { shape, pose: written.after(&frame) });
    }
    if placed.is_empty() {
        defects.add(format!("{place}.compound"), "has no parts");
    }
    let weighs = placed.iter().all(|part| inertia::volume(&part.shape).is_some_and(|v| v > 0.0));
    if placed.is_empty() || !weighs || !are_near {
        return (SHAPE_STAND_IN, State::WORLD.pose);
    }
    let frame = match axes {
        Axes::Principal => inertia::principal_frame_of_parts(&placed),
        Axes::Written => State::WORLD.pose,
    };
    for part in &mut placed {
        part.pose = Pose { p: frame.local(&part.pose.p), q: frame.q.inverse() * part.pose.q };
    }
    (Shape::Compound(Arc::new(placed)), frame)
}

/// The number of sides of the prism that approximates a cylinder.
const SIDES: usize = 32;

/// The corners of a prism along z with the same volume as the cylinder.
fn prism(length: f64, radius: f64) -> Vec<[f64; 3]> {
    let step = TAU / SIDES as f64;
    let reach = radius * (step / libm::sin(step)).sqrt();
    let corner = |k: usize| {
        let (sin, cos) = libm::sincos(step * k as f64);
        [0.5, -0.5].map(|end| [reach * cos, reach * sin, end * length])
    };
    (0..SIDES).flat_map(corner).collect()
}

fn build_mass(defects: &mut Defects, place: &str, body: &description::Body, shape: &Shape) -> Mass {
    if body.fixed {
        let given = [body.mass.is_some(), body.density.is_some(), body.inertia.is_some()];
        for (field, _) in ["mass", "density", "inertia"].iter().zip(given).filter(|(_, on)| *on) {
            defects.add(format!("{place}.{field}"), "a fixed body has none");
        }
        return Mass::Fixed;
    }
    if matches!(shape, Shape::Plane { .. }) {
        defects.add(format!("{place}.shape"), "a plane must be fixed");
        return STAND_IN;
    }
    let Some(mass) = weigh(defects, place, body, shape) else { return STAND_IN };
    let homogeneous = match body.shape {
        description::Shape::Cylinder(Capsule { length, radius }) if *shape != SHAPE_STAND_IN => {
            let (along, square) = (0.5 * mass * radius * radius, mass * length * length / 12.0);
            Some(Vector3::new(0.5 * along + square, 0.5 * along + square, along))
        }
        _ => inertia::moments(shape, mass),
    };
    match (homogeneous, body.inertia) {
        (None, None) => Mass::Point { mass },
        (None, Some(_)) => {
            defects.add(format!("{place}.inertia"), "a point has none");
            Mass::Point { mass }
        }
        (Some(homogeneous), given) => {
            let moments = given.map_or(homogeneous, Vector3::from);
            if given.is_some() {
                check_moments(defects, &format!("{place}.inertia"), &body.name, &moments);
            }
            Mass::Rigid { mass, moments }
        }
    }
}

/// The given mass (kg), or the mass from the given density.
fn weigh(
    defects: &mut Defects,
    place: &str,
    body: &description::Body,
    shape: &Shape,
) -> Option<f64> {
    let (field, mass) = match (body.mass, body.density, inertia::volume(shape)) {
        (Some(mass), None, _) => ("mass", Ok(mass)),
        (None, Some(density), Some(volume)) if density > 0.0 => ("density", Ok(density * volume)),
        (None, Some(density), Some(_)) => ("density", Ok(density)),
        (None, Some(_), None) => ("density", Err("a point has no volume, give its mass")),
        (Some(_), Some(_), _) => ("density", Err("there is a mass too, give one of them")),
        (None, None, _) => ("mass", Err("is missing: give mass or density, or fixed = true")),
    };
    let place = format!("{place}.{field}");
    let what = format!("body {:?}: mass", body.name);
    match mass {
        Ok(mass) => range::divisor(defects, place, [&what, "kg"], mass).then_some(mass),
        Err(reason) => {
            defects.add(place, reason);
            None
        }
    }
}

/// Checks given moments: they must be positive, and none may exceed the sum of the other two.
fn check_moments(defects: &mut Defects, place: &str, body: &str, moments: &Vector3<f64>) {
    let what = format!("body {body:?}: moment of inertia");
    for &moment in moments {
        let rest = moments.sum() - moment;
        if !range::divisor(defects, place, [&what, "kg m²"], moment) {
            return;
        }
        if moment > rest * (1.0 + 1e-12) {
            let reason = format!("the moment {moment} exceeds the sum {rest} of the other two");
            defects.add(place, reason);
            return;
        }
    }
}

/// A body with a given initial state.
fn started(body: &description::Body, start: &description::Start) -> description::Body {
    description::Body {
        position: start.position,
        rotation: start.orientation.map(Rotation::Quaternion),
        velocity: start.velocity,
        angular_velocity: start.angular_velocity,
        ..body.clone()
    }
}

fn build_state(
    defects: &mut Defects,
    place: &str,
    body: &description::Body,
    frame: &Pose,
) -> State {
    range::vector(defects, &format!("{place}.position"), &body.position);
    let point = body.shape == description::Shape::Point;
    let motions = [("velocity", &body.velocity), ("angular_velocity", &body.angular_velocity)];
    for (field, motion) in motions {
        let place = format!("{place}.{field}");
        range::vector(defects, &place, motion);
        if point && field == "angular_velocity" && *motion != [0.0; 3] {
            defects.add(place, "a point does not turn");
        }
    }
    if point && body.rotation.is_some() {
        defects.add(format!("{place}.rotation"), "a point has no orientation");
    }
    let q = body.rotation.map_or(Some(UnitQuaternion::identity()), |rotation| turn(&rotation));
    if q.is_none() {
        defects.add(format!("{place}.rotation"), "is not a rotation: it must be finite and not 0");
    }
    let written = Pose { p: body.position.into(), q: q.unwrap_or_default() };
    State {
        pose: written.after(frame),
        v: body.velocity.into(),
        omega: body.angular_velocity.into(),
    }
}

fn turn(rotation: &Rotation) -> Option<UnitQuaternion<f64>> {
    let about = |axis: Vector3<f64>, degrees: f64| {
        // libm's sine is bitwise identical on every platform.
        let (sin, cos) = libm::sincos(0.5 * degrees.to_radians());
        let q = Quaternion::from_parts(cos, axis * sin);
        degrees.is_finite().then(|| UnitQuaternion::new_unchecked(q))
    };
    match *rotation {
        Rotation::X(degrees) => about(Vector3::x(), degrees),
        Rotation::Y(degrees) => about(Vector3::y(), degrees),
        Rotation::Z(degrees) => about(Vector3::z(), degrees),
        Rotation::Quaternion([w, x, y, z]) => {
            let q = Quaternion::new(w, x, y, z);
            let norm = q.norm();
            (norm > 0.0 && norm.is_finite()).then(|| UnitQuaternion::new_normalize(q))
        }
    }
}

/// The unit vector along these three numbers.
pub(super) fn direction(defects: &mut Defects, place: &str, vector: &[f64; 3]) -> Vector3<f64> {
    let vector = Vector3::from(*vector);
    let norm = vector.norm();
    if !(norm > 0.0 && norm.is_finite()) {
        defects.add(place, format!("needs a direction, has length {norm}"));
        return Vector3::z();
    }
    vector / norm
}
