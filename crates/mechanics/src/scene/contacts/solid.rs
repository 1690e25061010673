//! A body's shape in world axes: convex polytopes with a radius around them.

use std::sync::Arc;

use nalgebra::Vector3;

use crate::body::{Cylinder, Edge, Face, Placed, Polytope, Pose, Shape};

/// A direction counts as tangential to a surface below this sine.
const ALONG: f64 = 1e-9;

/// A body's polytope in world axes.
pub(super) struct Solid {
    polytope: Arc<Polytope>,
    parallels: Arc<[Vec<usize>]>,
    pose: Pose,
    /// The distance (m) up to which points around the polytope belong to the body.
    pub radius: f64,
    /// The extent of the polytope (m): the greatest distance of a vertex from its own origin.
    pub size: f64,
    /// The lengths of the polytope's edges (m).
    pub lengths: Vec<f64>,
    /// The polytope's vertices (m).
    pub vertices: Vec<Vector3<f64>>,
    /// The unit normals of its faces.
    pub normals: Vec<Vector3<f64>>,
    /// The unit directions of its edges, from end 0 to end 1.
    pub directions: Vec<Vector3<f64>>,
    /// For each edge between faces, the directions perpendicular to it into each face.
    inwards: Vec<Option<[Vector3<f64>; 2]>>,
}

/// A convex part of a body: a polytope in the body's axes with a radius around it.
#[derive(Clone)]
pub(super) struct Round {
    polytope: Arc<Polytope>,
    /// The edges, grouped into parallel ones.
    parallels: Arc<[Vec<usize>]>,
    radius: f64,
    /// The greatest distance (m) of a vertex from the part's own origin.
    size: f64,
}

impl Round {
    fn new(polytope: Arc<Polytope>, radius: f64) -> Self {
        let size = polytope.vertices.iter().map(|v| v.norm()).fold(0.0, f64::max);
        let parallels = parallels(&polytope).into();
        Round { polytope, parallels, radius, size }
    }

    /// The distance (m) of its farthest vertex from the body's center.
    pub fn arm(&self) -> f64 {
        self.polytope.vertices.iter().map(|vertex| vertex.norm()).fold(0.0, f64::max)
    }

    /// The same as a part of another body, in that body's axes.
    fn placed(self, pose: &Pose) -> Self {
        Round { polytope: Arc::new(self.polytope.seen_from(&pose.inverse())), ..self }
    }
}

/// The edges, grouped into parallel ones; groups in the order of their first edges.
fn parallels(polytope: &Polytope) -> Vec<Vec<usize>> {
    let along = |edge: &Edge| {
        let [from, to] = edge.ends.map(|k| polytope.vertices[k]);
        (to - from).normalize()
    };
    let directions: Vec<_> = polytope.edges.iter().map(along).collect();
    let mut groups: Vec<Vec<usize>> = Vec::new();
    for (k, e) in directions.iter().enumerate() {
        let is_parallel = |group: &&mut Vec<usize>| directions[group[0]].cross(e).norm() <= ALONG;
        match groups.iter_mut().find(is_parallel) {
            Some(group) => group.push(k),
            None => groups.push(vec![k]),
        }
    }
    groups
}

/// The convex parts of a shape: one, or several of a compound; `None` for a half space.
pub(super) fn parts(shape: &Shape) -> Vec<Option<Round>> {
    let convex = |polytope: Polytope, radius| vec![Some(Round::new(Arc::new(polytope), radius))];
    match shape {
        Shape::Point => convex(Polytope::point(), 0.0),
        Shape::Sphere { radius } => convex(Polytope::point(), *radius),
        Shape::Capsule { half_length, radius } => convex(Polytope::segment(*half_length), *radius),
        Shape::Box { half } => convex(Polytope::cuboid(half), 0.0),
        Shape::Hull(hull) => vec![Some(Round::new(hull.clone(), 0.0))],
        Shape::Compound(placed) => {
            let of = |part: &Placed| {
                let in_place = |own: Option<Round>| own.map(|round| round.placed(&part.pose));
                parts(&part.shape).into_iter().map(in_place).collect::<Vec<_>>()
            };
            placed.iter().flat_map(of).collect()
        }
        Shape::Plane { .. } => vec![None],
    }
}

impl Solid {
    /// A part without a pose.
    pub fn new(Round { polytope, parallels, radius, size }: Round) -> Self {
        let length = |edge: &Edge| {
            let [from, to] = edge.ends.map(|k| polytope.vertices[k]);
            (to - from).norm()
        };
        Solid {
            lengths: polytope.edges.iter().map(length).collect(),
            polytope,
            parallels,
            pose: Pose::default(),
            radius,
            size,
            vertices: Vec::new(),
            normals: Vec::new(),
            directions: Vec::new(),
            inwards: Vec::new(),
        }
    }

    /// The number of vertices, edges and faces.
    pub fn features(&self) -> [usize; 3] {
        let Polytope { vertices, edges, faces, .. } = &*self.polytope;
        [vertices.len(), edges.len(), faces.len()]
    }

    /// Moves it to this pose.
    pub fn place(&mut self, pose: &Pose) {
        let Solid { polytope, vertices, normals, directions, inwards, .. } = self;
        self.pose = *pose;
        vertices.clear();
        vertices.extend(polytope.vertices.iter().map(|v| pose.point(v)));
        normals.clear();
        normals.extend(polytope.faces.iter().map(|face| pose.direction(&face.normal)));
        directions.clear();
        let along = |edge: &Edge| (vertices[edge.ends[1]] - vertices[edge.ends[0]]).normalize();
        directions.extend(polytope.edges.iter().map(along));
        let inward = |(edge, e): (&Edge, &Vector3<f64>)| {
            edge.faces.map(|[left, right]| [normals[left].cross(e), -normals[right].cross(e)])
        };
        inwards.clear();
        inwards.extend(polytope.edges.iter().zip(&*directions).map(inward));
    }

    /// The edges, grouped into parallel ones.
    pub(crate) fn parallels(&self) -> &[Vec<usize>] {
        &self.parallels
    }

    /// Of these edges, all along one direction perpendicular to n, the lowest and the highest along
    /// n, with their heights (m).
    pub fn extremes(&self, edges: &[usize], n: &Vector3<f64>) -> [(usize, f64); 2] {
        let height = |k: usize| (k, n.dot(&self.vertices[self.polytope.edges[k].ends[0]]));
        let first = height(edges[0]);
        edges[1..].iter().map(|&k| height(k)).fold([first; 2], |[low, high], next| {
            [if next.1 < low.1 { next } else { low }, if next.1 > high.1 { next } else { high }]
        })
    }

    /// The ends of an edge (m).
    pub fn ends(&self, edge: usize) -> [Vector3<f64>; 2] {
        self.polytope.edges[edge].ends.map(|k| self.vertices[k])
    }

    /// The cylinder that it approximates, in world axes, with the faces at its lower and upper end.
    pub fn cylinder(&self) -> Option<(Cylinder, [usize; 2])> {
        let own = self.polytope.cylinder?;
        let center = self.pose.point(&own.center);
        let world = Cylinder { center, axis: self.pose.direction(&own.axis), ..own };
        let along = |f: &usize| self.polytope.faces[*f].normal.dot(&own.axis);
        let faces = || 0..self.normals.len();
        let lower = faces().min_by(|f, g| along(f).total_cmp(&along(g)))?;
        let upper = faces().max_by(|f, g| along(f).total_cmp(&along(g)))?;
        Some((world, [lower, upper]))
    }

    /// The vertices around a face.
    pub fn corners(&self, face: usize) -> &[usize] {
        &self.polytope.faces[face].corners
    }

    /// The edges around a face.
    pub fn rim(&self, face: usize) -> &[usize] {
        &self.polytope.faces[face].edges
    }

    /// The height (m) of a point above a face.
    pub fn height(&self, face: usize, point: &Vector3<f64>) -> f64 {
        self.normals[face].dot(&(point - self.vertices[self.corners(face)[0]]))
    }

    /// The sides of a face: a point on each (m), and the unit direction from there into the face.
    pub fn sides(&self, face: usize) -> impl Iterator<Item = [Vector3<f64>; 2]> {
        let Face { corners, edges, .. } = &self.polytope.faces[face];
        corners.iter().zip(edges).filter_map(move |(&corner, &edge)| {
            let is_first = self.polytope.edges[edge].faces?[0] == face;
            let [first, second] = self.inwards[edge]?;
            Some([self.vertices[corner], if is_first { first } else { second }])
        })
    }

    /// Whether a point lies over a face, or outside it by up to `rim` (m).
    pub fn covers(&self, face: usize, point: &Vector3<f64>, rim: f64) -> bool {
        self.sides(face).all(|[from, inward]| inward.dot(&(point - from)) >= -rim)
    }

    /// Whether an edge is the farthest feature along n (any length) among itself and its faces.
    pub(crate) fn edge_faces(&self, edge: usize, n: &Vector3<f64>) -> bool {
        let slack = ALONG * n.norm();
        self.inwards[edge].is_none_or(|faces| faces.iter().all(|inward| inward.dot(n) <= slack))
    }

    /// Whether no edge leaves a vertex along the unit vector n by more than `slack` (as a sine).
    pub(crate) fn vertex_faces(&self, vertex: usize, n: &Vector3<f64>, slack: f64) -> bool {
        self.polytope.edges.iter().zip(&self.directions).all(|(edge, e)| match edge.ends {
            [from, _] if from == vertex => e.dot(n) <= slack,
            [_, to] if to == vertex => -e.dot(n) <= slack,
            _ => true,
        })
    }

    /// A direction in the body's own axes.
    pub fn local(&self, direction: &Vector3<f64>) -> Vector3<f64> {
        self.pose.q.inverse() * direction
    }

    /// The normal of a face in the body's own axes.
    pub(crate) fn local_normal(&self, face: usize) -> Vector3<f64> {
        self.polytope.faces[face].normal
    }
}
