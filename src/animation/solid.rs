//! The drawn solids of bodies and rods, one function per shape.

use nalgebra::{UnitQuaternion, Vector3};

use crate::body::{Body, Placed, Polytope, Pose, Shape};

/// A convex solid in world coordinates (m): the hull of its corners, expanded by a radius. A ball
/// is one corner and a radius, a polyhedron has radius 0, a capsule would be two corners and a
/// radius.
#[derive(Debug, Clone)]
pub(super) struct Solid {
    /// The body or rod it belongs to.
    pub part: Part,
    /// Its corners (m).
    pub corners: Vec<Vector3<f64>>,
    /// The radius around them (m).
    pub radius: f64,
    /// The faces of a polyhedron: indices of corners, counter-clockwise from outside.
    pub faces: Vec<Vec<usize>>,
    /// The directions of its edges without duplicates; with the faces they determine what is in
    /// front.
    pub edges: Vec<Vector3<f64>>,
    /// Its orientation.
    pub turn: UnitQuaternion<f64>,
}

/// The body or rod that a solid belongs to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Part {
    /// The body with this index.
    Body(usize),
    /// The rod between these bodies; `None` is the world.
    Rod([Option<usize>; 2]),
}

impl Solid {
    /// The solids of a body (several for a compound); a point gets the radius `dot` (m), and a half
    /// space has none.
    pub fn of(index: usize, body: &Body, pose: &Pose, dot: f64) -> Vec<Self> {
        Solid::of_shape(Part::Body(index), &body.shape, pose, dot)
    }

    fn of_shape(part: Part, shape: &Shape, pose: &Pose, dot: f64) -> Vec<Self> {
        match shape {
            Shape::Point => vec![ball(part, pose, dot)],
            Shape::Sphere { radius } => vec![ball(part, pose, *radius)],
            Shape::Box { half } => vec![polyhedron(part, pose, &Polytope::cuboid(half))],
            Shape::Capsule { half_length, radius } => {
                vec![capsule(part, pose, *half_length, *radius)]
            }
            Shape::Hull(hull) => vec![polyhedron(part, pose, hull)],
            Shape::Compound(placed) => {
                let of =
                    |own: &Placed| Solid::of_shape(part, &own.shape, &pose.after(&own.pose), dot);
                placed.iter().flat_map(of).collect()
            }
            Shape::Plane { .. } => Vec::new(),
        }
    }

    /// A thin rod.
    pub fn rod(bodies: [Option<usize>; 2], ends: [Vector3<f64>; 2], radius: f64) -> Self {
        let along = (ends[1] - ends[0]).try_normalize(0.0);
        Solid {
            part: Part::Rod(bodies),
            corners: ends.into(),
            radius,
            faces: Vec::new(),
            edges: along.into_iter().collect(),
            turn: UnitQuaternion::identity(),
        }
    }

    /// The corners of a face.
    pub fn face<'a>(&'a self, face: &'a [usize]) -> impl Iterator<Item = &'a Vector3<f64>> {
        face.iter().map(|&k| &self.corners[k])
    }

    /// The outward unit normal of a face, which has at least three corners.
    pub fn normal(&self, face: &[usize]) -> Option<Vector3<f64>> {
        let [a, b, c] = [0, 1, 2].map(|k| face.get(k).map(|&k| self.corners[k]));
        (b? - a?).cross(&(c? - b?)).try_normalize(0.0)
    }

    /// The minimum and maximum of n · x over its points x.
    pub fn interval(&self, n: &Vector3<f64>) -> (f64, f64) {
        let along = self.corners.iter().map(|corner| n.dot(corner));
        let (lo, hi) = along.fold(EMPTY, |(lo, hi), x| (lo.min(x), hi.max(x)));
        (lo - self.radius, hi + self.radius)
    }

    /// The mean of its corners (m).
    pub fn center(&self) -> Vector3<f64> {
        self.corners.iter().sum::<Vector3<f64>>() / self.corners.len() as f64
    }
}

/// The empty interval.
const EMPTY: (f64, f64) = (f64::INFINITY, f64::NEG_INFINITY);

fn ball(part: Part, pose: &Pose, radius: f64) -> Solid {
    let (corners, faces, edges) = (vec![pose.p], Vec::new(), Vec::new());
    Solid { part, corners, radius, faces, edges, turn: pose.q }
}

fn capsule(part: Part, pose: &Pose, half_length: f64, radius: f64) -> Solid {
    let along = pose.direction(&Vector3::z());
    let end = along * half_length;
    let corners = vec![pose.p - end, pose.p + end];
    Solid { part, corners, radius, faces: Vec::new(), edges: vec![along], turn: pose.q }
}

fn polyhedron(part: Part, pose: &Pose, shape: &Polytope) -> Solid {
    let edge = |ends: [usize; 2]| shape.vertices[ends[1]] - shape.vertices[ends[0]];
    let mut edges: Vec<Vector3<f64>> = Vec::new();
    for along in shape.edges.iter().filter_map(|e| edge(e.ends).try_normalize(0.0)) {
        if edges.iter().all(|known| known.cross(&along).norm() > 1e-9) {
            edges.push(along);
        }
    }
    Solid {
        part,
        corners: shape.vertices.iter().map(|vertex| pose.point(vertex)).collect(),
        radius: 0.0,
        faces: shape.faces.iter().map(|face| face.corners.clone()).collect(),
        edges: edges.iter().map(|along| pose.direction(along)).collect(),
        turn: pose.q,
    }
}
