//! Saves a scene file with the states that a simulation has reached, so that the simulation can
//! continue from there.

use toml::{Table, Value};

use super::description::Start;
use super::{Scene, change, text};
use crate::body::{Body, Mass, Shape, State};
use lcplab_lcp::error::{Error, Result};

/// The text of a scene file or shipped scene, with some fields overridden as by
/// [`Scene::load_with`], whose bodies start with these states, `elapsed` (s) after its beginning.
/// Joints are still defined at the positions of the file, so their lengths and angles are the same.
/// Comments in the file are lost.
///
/// # Errors
/// As for [`Scene::load_with`].
///
/// ```
/// use lcplab_mechanics::scene::{Scene, saved};
///
/// let scene = Scene::load("pendulum")?;
/// let mut states = scene.states.clone();
/// states[0].v.x = 0.25;
/// let text = saved("pendulum", &[], &scene, &states, 0.5)?;
/// assert_eq!(Scene::from_toml("later.toml", &text)?.states, states);
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
pub fn saved(
    path_or_name: &str,
    changes: &[(String, String)],
    scene: &Scene,
    states: &[State],
    elapsed: f64,
) -> Result<String> {
    let (path, text) = text(path_or_name)?;
    let mut table = change::table(&path, &text, changes)?;
    let moves = |body: &Body, state: &State| {
        body.mass != Mass::Fixed || (state.v, state.omega) != (State::WORLD.v, State::WORLD.omega)
    };
    let moved = scene.bodies.iter().zip(states).filter(|(body, state)| moves(body, state));
    let starts = moved.map(|(body, state)| start(&body.name, &body.shape, state));
    let starts: Vec<Value> = starts.collect::<std::result::Result<_, _>>().map_err(fault(&path))?;
    match starts.is_empty() {
        true => table.remove("start"),
        false => table.insert("start".into(), Value::Array(starts)),
    };
    if !scene.driven.is_empty() {
        table.insert("time".into(), Value::Float(scene.time + elapsed));
    }
    toml::to_string(&table).map_err(fault(&path))
}

fn fault(path: &str) -> impl Fn(toml::ser::Error) -> Error + '_ {
    move |error| Error::invalid(path, "start", error.to_string())
}

/// A state in the format of the file.
fn start(
    name: &str,
    shape: &Shape,
    State { pose, v, omega }: &State,
) -> std::result::Result<Value, toml::ser::Error> {
    let q = pose.q.quaternion();
    let start = Start {
        body: name.into(),
        position: pose.p.into(),
        orientation: (*shape != Shape::Point).then_some([q.w, q.i, q.j, q.k]),
        velocity: (*v).into(),
        angular_velocity: (*omega).into(),
    };
    Ok(Value::Table(Table::try_from(start)?))
}
