// A cube of 2 kg at rest on the ground, without friction: its motion and its contacts in each of the last steps.
import * as module from "@dimforge/rapier3d-compat";

const rapier = module.default ?? module;
await rapier.init();
const world = new rapier.World({ x: 0, y: -10, z: 0 });
const place = rapier.RigidBodyDesc.fixed().setTranslation(0, -0.5, 0);
const ground = world.createCollider(rapier.ColliderDesc.cuboid(10, 0.5, 10).setFriction(0), world.createRigidBody(place));
const cube = world.createRigidBody(rapier.RigidBodyDesc.dynamic().setTranslation(0, 0.5, 0).setCanSleep(false));
const collider = world.createCollider(rapier.ColliderDesc.cuboid(0.5, 0.5, 0.5).setDensity(2).setFriction(0), cube);

const moving = () => [cube.linvel(), cube.angvel()].flatMap(({ x, y, z }) => [x, y, z]);
const steps = [];
for (let count = 0; count < 200; count++) {
  const before = moving();
  world.step();
  const points = [];
  const impulses = [];
  world.contactPair(collider, ground, (manifold, isFlipped) => {
    for (let k = 0; k < manifold.numContacts(); k++) {
      const { x, y, z } = isFlipped ? manifold.localContactPoint2(k) : manifold.localContactPoint1(k);
      points.push([x, y, z]);
      impulses.push(manifold.contactImpulse(k));
    }
  });
  steps.push({ before, after: moving(), points, impulses });
}
console.log(JSON.stringify({ version: rapier.version(), dt: world.timestep, mass: cube.mass(), steps: steps.slice(-10) }));
