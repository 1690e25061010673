// A ball of restitution 0.8 falls from some heights: its mass, and its speed before and after the step in which it bounces.
import * as module from "@dimforge/rapier3d-compat";

const rapier = module.default ?? module;
await rapier.init();

function bounce(height) {
  const world = new rapier.World({ x: 0, y: -10, z: 0 });
  const place = rapier.RigidBodyDesc.fixed().setTranslation(0, -0.5, 0);
  world.createCollider(rapier.ColliderDesc.cuboid(10, 0.5, 10).setRestitution(0.8), world.createRigidBody(place));
  const ball = world.createRigidBody(rapier.RigidBodyDesc.dynamic().setTranslation(0, 0.5 + height, 0));
  world.createCollider(rapier.ColliderDesc.ball(0.5).setRestitution(0.8), ball);
  let before = 0;
  while (ball.linvel().y <= 0) {
    before = ball.linvel().y;
    world.step();
  }
  return { before, after: ball.linvel().y, mass: ball.mass(), dt: world.timestep };
}

console.log(JSON.stringify({ version: rapier.version(), steps: [0.05, 0.2, 0.5, 2].map(bounce) }));
