//! Rapier, in double precision and with its own defaults but for the iterations.

use lcplab::body::Pose;
use nalgebra::{Quaternion, UnitQuaternion, Vector3};
use rapier3d_f64::prelude::{
    ColliderBuilder, PhysicsWorld, Pose as Place, RigidBodyBuilder, RigidBodyHandle, Rotation,
    Vector,
};

use super::{Engine, HALF, MASS, Setting, World};

pub const ENGINE: Engine = Engine {
    name: "Rapier",
    ours: false,
    build: |setting, iterations| Box::new(Rapier::new(setting, iterations)),
};

struct Rapier {
    world: PhysicsWorld,
    cubes: Vec<RigidBodyHandle>,
}

impl Rapier {
    fn new(setting: &Setting, iterations: usize) -> Self {
        let mut world =
            PhysicsWorld { gravity: Vector::new(0.0, 0.0, -9.81), ..PhysicsWorld::new() };
        world.integration_parameters.dt = setting.dt;
        world.integration_parameters.num_solver_iterations = iterations;
        let surface = |collider: ColliderBuilder| collider.friction(setting.friction);
        let ground = ColliderBuilder::cuboid(100.0, 100.0, 1.0);
        let below = RigidBodyBuilder::fixed().translation(Vector::new(0.0, 0.0, -1.0));
        world.insert(below, surface(ground));
        let mut cube = |pose: &Pose| {
            let (p, q) = (pose.p, pose.q);
            let place = Place {
                translation: Vector::new(p.x, p.y, p.z),
                rotation: Rotation::from_xyzw(q.i, q.j, q.k, q.w),
            };
            let body = RigidBodyBuilder::dynamic().pose(place).can_sleep(false);
            world.insert(body, surface(ColliderBuilder::cuboid(HALF, HALF, HALF).mass(MASS))).0
        };
        let cubes = setting.places.iter().map(|state| cube(&state.pose)).collect();
        Rapier { world, cubes }
    }
}

impl World for Rapier {
    fn step(&mut self) {
        self.world.step();
    }

    fn poses(&self) -> Vec<Pose> {
        let pose = |&cube: &RigidBodyHandle| {
            let Place { translation: p, rotation: q } = *self.world.bodies[cube].position();
            let q = Quaternion::new(q.w, q.x, q.y, q.z);
            Pose { p: Vector3::new(p.x, p.y, p.z), q: UnitQuaternion::from_quaternion(q) }
        };
        self.cubes.iter().map(pose).collect()
    }
}
