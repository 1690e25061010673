//! A scene from text, and bytes as a small scene.

use arbitrary::{Result, Unstructured};
use lcplab::constraint::Field;
use lcplab::scene::description::{Body, Capsule, Constraint, Rotation, Shape};
use lcplab::scene::{Description, Scene, Scheme};

/// A scene's text: a scene whose states are numbers, or an error that names the file.
pub fn read_scene(text: &str) {
    match Scene::from_toml("scene.toml", text) {
        Ok(scene) => assert!(scene.states.iter().all(|state| state.is_finite())),
        Err(error) => assert!(error.to_string().starts_with("scene.toml")),
    }
}

/// Up to four bodies near the origin above a floor, up to three joints, any family of methods.
pub fn scene(u: &mut Unstructured<'_>) -> Result<Description> {
    let mut scene = Description::default();
    scene.step.scheme = *u.choose(&Scheme::ALL)?;
    scene.step.dt = *u.choose(&[0.01, 1.0 / 60.0, 1.0, 1e-9, 1e3])?;
    scene.step.baumgarte = *u.choose(&[0.0, 0.2, 1.0])?;
    scene.contact.friction = *u.choose(&[0.0, 0.5, 10.0])?;
    scene.contact.restitution = *u.choose(&[0.0, 0.5, 1.0])?;
    scene.solver.name = u.choose(&["pgs", "dantzig", "lemke", "newton", "block-pgs"])?.to_string();
    scene.solver.max_iterations = 50;
    if u.arbitrary()? {
        let shape = Shape::Plane([0.0, 0.0, 1.0]);
        scene.bodies.push(Body { name: "floor".into(), shape, fixed: true, ..Body::default() });
    }
    for k in 0..u.int_in_range(1..=4)? {
        scene.bodies.push(body(u, format!("b{k}"))?);
    }
    for _ in 0..u.int_in_range(0..=3)? {
        scene.constraints.push(joint(u, &scene.bodies)?);
    }
    Ok(scene)
}

fn body(u: &mut Unstructured<'_>, name: String) -> Result<Body> {
    let shape = match u.int_in_range(0..=4)? {
        0 => Shape::Point,
        1 => Shape::Sphere(length(u)?),
        2 => Shape::Box([length(u)?, length(u)?, length(u)?]),
        3 => Shape::Capsule(Capsule { length: length(u)?, radius: length(u)? }),
        _ => {
            let points = (0..u.int_in_range(4..=7)?).map(|_| place(u));
            Shape::Hull(points.collect::<Result<_>>()?)
        }
    };
    let rotation = match u.int_in_range(0..=2)? {
        0 => Some(Rotation::X(45.0)),
        1 => Some(Rotation::Quaternion([1.0, coordinate(u)?, coordinate(u)?, coordinate(u)?])),
        _ => None,
    };
    Ok(Body {
        name,
        shape,
        rotation,
        mass: Some(*u.choose(&[1.0, 2.0, 1e-9, 1e9])?),
        position: place(u)?,
        velocity: if u.arbitrary()? { place(u)? } else { [0.0; 3] },
        angular_velocity: if u.arbitrary()? { place(u)? } else { [0.0; 3] },
        ..Body::default()
    })
}

/// A joint with the fields that it needs, and some of those that it may have.
fn joint(u: &mut Unstructured<'_>, bodies: &[Body]) -> Result<Constraint> {
    let joint = u.choose(lcplab::constraint::ALL)?;
    let mut written = Constraint { kind: joint.name.into(), ..Constraint::default() };
    for _ in 0..u.int_in_range(joint.bodies.0..=joint.bodies.1)? {
        written.bodies.push(u.choose(bodies)?.name.clone());
    }
    for field in joint.needs {
        give(u, *field, &mut written)?;
    }
    for field in joint.takes {
        if u.arbitrary()? {
            give(u, *field, &mut written)?;
        }
    }
    Ok(written)
}

fn give(u: &mut Unstructured<'_>, field: Field, written: &mut Constraint) -> Result<()> {
    match field {
        Field::Point => written.point = Some(place(u)?),
        Field::Points => written.points = Some([place(u)?, place(u)?]),
        Field::Axis => written.axis = Some(place(u)?),
        Field::Axes => written.axes = Some([place(u)?, place(u)?]),
        Field::Length => written.length = Some(length(u)?),
        Field::Angle => written.angle = Some(length(u)?),
        Field::Limits => written.limits = Some([-length(u)?, length(u)?]),
        Field::Speed => written.speed = Some(coordinate(u)?),
        Field::StartSpeed => written.start_speed = Some(coordinate(u)?),
        Field::Effort => written.effort = Some(length(u)?),
        Field::Stiffness => written.stiffness = Some(length(u)?),
        Field::Damping => written.damping = Some(length(u)?),
        Field::Teeth => written.teeth = Some([3, u.int_in_range(0..=9)?]),
    }
    Ok(())
}

fn place(u: &mut Unstructured<'_>) -> Result<[f64; 3]> {
    Ok([coordinate(u)?, coordinate(u)?, coordinate(u)?])
}

/// Tenths of a metre around 0, so that faces lie on each other, and now and then one far off.
fn coordinate(u: &mut Unstructured<'_>) -> Result<f64> {
    let byte: i8 = u.arbitrary()?;
    Ok(match byte {
        i8::MIN => 1e9,
        i8::MAX => 1e-9,
        _ => f64::from(byte / 8) / 10.0,
    })
}

fn length(u: &mut Unstructured<'_>) -> Result<f64> {
    Ok(*u.choose(&[1.0, 0.5, 0.2, 0.1, 1e-6, 1e3])?)
}
