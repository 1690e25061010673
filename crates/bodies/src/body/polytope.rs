//! Convex polytopes: the vertices, edges and faces between which contacts are found.
//!
//! A point and a segment are polytopes without faces: with a radius around them they are a ball and
//! a capsule.

use std::collections::BTreeMap;

use nalgebra::Vector3;
use parry3d_f64::glamx::DVec3;
use parry3d_f64::shape::ConvexPolyhedron;

use super::Pose;

/// Points whose hull is thinner than this fraction of its length span no volume.
const FLAT: f64 = 1e-9;

/// The convex hull of its vertices (m, body frame).
///
/// ```
/// use lcplab_bodies::body::{Polytope, Pose};
/// use nalgebra::Vector3;
///
/// let cuboid = Polytope::cuboid(&Vector3::new(1.0, 0.5, 0.25));
/// let (v, e, f) = (cuboid.vertices.len(), cuboid.edges.len(), cuboid.faces.len());
/// assert_eq!((v, e, f), (8, 12, 6)); // Euler: v − e + f = 2
/// assert_eq!(Polytope::segment(1.0).vertices, [-Vector3::z(), Vector3::z()]);
/// assert!(Polytope::point().edges.is_empty());
///
/// let corners = [Vector3::zeros(), Vector3::x(), Vector3::y(), Vector3::z()];
/// assert_eq!(Polytope::hull(&corners).unwrap().faces.len(), 4);
/// assert_eq!(Polytope::hull(&corners[..3]), None); // a triangle has no volume
///
/// let frame = Pose { p: Vector3::z(), ..Pose::default() };
/// assert_eq!(Polytope::segment(1.0).seen_from(&frame).vertices[1], Vector3::zeros());
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Polytope {
    /// The vertices.
    pub vertices: Vec<Vector3<f64>>,
    /// The edges; each has a face on either side, except the edge of a segment.
    pub edges: Vec<Edge>,
    /// The faces; none for a point and a segment.
    pub faces: Vec<Face>,
    /// The cylinder that the polytope approximates as a prism, if it does.
    pub cylinder: Option<Cylinder>,
}

/// A cylinder in its polytope's frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cylinder {
    /// Its center (m).
    pub center: Vector3<f64>,
    /// Its unit axis.
    pub axis: Vector3<f64>,
    /// Half of its length (m).
    pub half_length: f64,
    /// Its radius (m).
    pub radius: f64,
}

/// An edge of a polytope.
#[derive(Debug, Clone, PartialEq)]
pub struct Edge {
    /// The two vertices it joins.
    pub ends: [usize; 2],
    /// The two faces it joins. Seen from outside, it runs counterclockwise from end 0 to end 1
    /// around the first one.
    pub faces: Option<[usize; 2]>,
}

/// A face of a polytope.
#[derive(Debug, Clone, PartialEq)]
pub struct Face {
    /// The unit normal, pointing outward.
    pub normal: Vector3<f64>,
    /// The vertices around it, counterclockwise as seen from outside.
    pub corners: Vec<usize>,
    /// The edges around it; edge k joins corner k to the next.
    pub edges: Vec<usize>,
}

impl Polytope {
    /// The origin as a polytope.
    pub fn point() -> Self {
        Polytope { vertices: vec![Vector3::zeros()], edges: vec![], faces: vec![], cylinder: None }
    }

    /// The segment along z between −`half_length` and `half_length` (m).
    pub fn segment(half_length: f64) -> Self {
        let end = Vector3::z() * half_length;
        let edge = Edge { ends: [0, 1], faces: None };
        Polytope { vertices: vec![-end, end], edges: vec![edge], faces: vec![], cylinder: None }
    }

    /// The box with these half edges (m). Bit i of a vertex's index is set if the vertex is on the
    /// positive side of axis i; face 2i + 1 is on the positive side of axis i, face 2i on the
    /// negative side.
    pub fn cuboid(half: &Vector3<f64>) -> Self {
        let corner =
            |k: usize| Vector3::from_fn(|i, _| if k >> i & 1 == 1 { half[i] } else { -half[i] });
        let faces = (0..6).map(|f| {
            let (i, side) = (f / 2, f % 2);
            let (j, k) = (1 << ((i + 1) % 3), 1 << ((i + 2) % 3));
            let first = side << i;
            let around = [first, first | j, first | j | k, first | k];
            if side == 1 { around.to_vec() } else { around.into_iter().rev().collect() }
        });
        let polytope = Polytope::of_faces((0..8).map(corner).collect(), faces.collect());
        polytope.unwrap_or_else(Polytope::point)
    }

    /// The convex hull of these points (m); `None` if they span no volume or are not finite.
    pub fn hull(points: &[Vector3<f64>]) -> Option<Self> {
        if !spans_volume(points) {
            return None;
        }
        let points: Vec<DVec3> = points.iter().map(|p| DVec3::new(p.x, p.y, p.z)).collect();
        let hull = ConvexPolyhedron::from_convex_hull(&points)?;
        let faces = hull.faces().iter().map(|face| {
            let corners = hull.vertices_adj_to_face().iter().map(|&k| k as usize);
            let first = face.first_vertex_or_edge as usize;
            corners.skip(first).take(face.num_vertices_or_edges as usize).collect()
        });
        let vertices = hull.points().iter().map(|p| Vector3::new(p.x, p.y, p.z)).collect();
        Polytope::of_faces(vertices, faces.collect())
    }

    /// The polytope with these corners around its faces, without vertices that belong to no face.
    /// `None` if the surface is not closed.
    fn of_faces(vertices: Vec<Vector3<f64>>, around: Vec<Vec<usize>>) -> Option<Self> {
        let mut kept: Vec<usize> = around.concat();
        kept.sort_unstable();
        kept.dedup();
        let vertices: Vec<_> = kept.iter().map(|&k| vertices[k]).collect();
        let mut sides: BTreeMap<[usize; 2], [Option<usize>; 2]> = BTreeMap::new();
        let mut faces = Vec::with_capacity(around.len());
        for (f, corners) in around.iter().enumerate() {
            let corners: Vec<usize> =
                corners.iter().map(|k| kept.binary_search(k)).collect::<Result<_, _>>().ok()?;
            for (from, to) in around_pairs(&corners) {
                let ends = [from.min(to), from.max(to)];
                sides.entry(ends).or_default()[usize::from(from > to)] = Some(f);
            }
            let normal = area(&vertices, &corners).try_normalize(0.0)?;
            faces.push(Face { normal, corners, edges: Vec::new() });
        }
        let index: BTreeMap<_, _> = sides.keys().enumerate().map(|(e, ends)| (*ends, e)).collect();
        for face in &mut faces {
            let edge = |(from, to): (usize, usize)| index[&[from.min(to), from.max(to)]];
            face.edges = around_pairs(&face.corners).map(edge).collect();
        }
        let edge = |(ends, [left, right]): (_, [Option<usize>; 2])| {
            Some(Edge { ends, faces: Some([left?, right?]) })
        };
        let edges = sides.into_iter().map(edge).collect::<Option<_>>()?;
        Some(Polytope { vertices, edges, faces, cylinder: None })
    }

    /// The same polytope in the axes of `frame`, whose pose is given in the polytope's own axes.
    pub fn seen_from(&self, frame: &Pose) -> Self {
        let mut seen = self.clone();
        seen.vertices.iter_mut().for_each(|vertex| *vertex = frame.local(vertex));
        let turned = |face: &mut Face| face.normal = frame.q.inverse() * face.normal;
        seen.faces.iter_mut().for_each(turned);
        if let Some(cylinder) = &mut seen.cylinder {
            cylinder.center = frame.local(&cylinder.center);
            cylinder.axis = frame.q.inverse() * cylinder.axis;
        }
        seen
    }
}

/// Each corner with the next one around the face.
fn around_pairs(corners: &[usize]) -> impl Iterator<Item = (usize, usize)> {
    (0..corners.len()).map(move |k| (corners[k], corners[(k + 1) % corners.len()]))
}

/// Twice the vector area of a polygon.
fn area(vertices: &[Vector3<f64>], corners: &[usize]) -> Vector3<f64> {
    let origin = vertices[corners[0]];
    let triangle = |(a, b): (usize, usize)| (vertices[a] - origin).cross(&(vertices[b] - origin));
    around_pairs(corners).map(triangle).sum()
}

/// Whether the points are finite and not on a common plane.
fn spans_volume(points: &[Vector3<f64>]) -> bool {
    let farthest = |distance: &dyn Fn(&Vector3<f64>) -> f64| {
        points.iter().max_by(|a, b| distance(a).total_cmp(&distance(b))).copied()
    };
    let Some(&origin) = points.first() else { return false };
    if !points.iter().all(|p| p.iter().all(|x| x.is_finite())) {
        return false;
    }
    let Some(along) = farthest(&|p| (p - origin).norm()).map(|p| p - origin) else { return false };
    let Some(axis) = along.try_normalize(0.0) else { return false };
    let across = |p: &Vector3<f64>| (p - origin) - axis * axis.dot(&(p - origin));
    let Some(side) = farthest(&|p| across(p).norm()).map(|p| across(&p)) else { return false };
    let up = axis.cross(&side.try_normalize(0.0).unwrap_or_else(Vector3::zeros));
    let height = points.iter().map(|p| up.dot(&(p - origin)).abs()).fold(0.0, f64::max);
    side.norm() > FLAT * along.norm() && height > FLAT * along.norm()
}
