// A stack of three boxes in Bullet, whose last step is written as a problem file of lcplab.
//
//     g++ -std=c++11 bullet.cpp $(pkg-config --cflags --libs bullet) -o bullet && ./bullet 60 10
//     lcplab judge frame.json frame.x.json
//
// In your program, copy the struct Capture and add the line that makes one. It expects rigid bodies and contacts
// without restitution: Bullet's joints and its rolling friction are not written.
#include <btBulletDynamicsCommon.h>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <string>

#include "lcplab_dump.h"

/// Writes the last step of a world after each step of it.
struct Capture {
    Capture(btDynamicsWorld& world, const char* problem, const char* answer)
        : world(world), problem(problem), answer(answer) {
        world.setInternalTickCallback(before_step, this, true);
        world.setInternalTickCallback(after_step, this, false);
    }

private:
    btDynamicsWorld& world;
    std::string problem, answer;
    std::map<const btCollisionObject*, int> numbers;
    std::map<const btCollisionObject*, btVector3> centers; // at the start of the step
    lcplab::Frame frame;

    static lcplab::Vec3 vec(const btVector3& v) { return {{v.x(), v.y(), v.z()}}; }

    static void before_step(btDynamicsWorld* world, btScalar dt) {
        static_cast<Capture*>(world->getWorldUserInfo())->add_bodies(dt);
    }

    static void after_step(btDynamicsWorld* world, btScalar dt) {
        static_cast<Capture*>(world->getWorldUserInfo())->add_contacts(dt);
    }

    void add_bodies(double dt) {
        frame = lcplab::Frame("Bullet", dt, 8 * sizeof(btScalar));
        numbers.clear();
        centers.clear();
        for (int k = 0; k < world.getNumCollisionObjects(); ++k) {
            const btRigidBody* body = btRigidBody::upcast(world.getCollisionObjectArray()[k]);
            if (!body || body->isStaticOrKinematicObject()) continue;
            const btMatrix3x3 inverse = body->getInvInertiaTensorWorld(), inertia = inverse.inverse();
            const btVector3 linear = body->getLinearVelocity() + body->getTotalForce() * body->getInvMass() * btScalar(dt);
            const btVector3 angular = body->getAngularVelocity() + inverse * body->getTotalTorque() * btScalar(dt);
            const std::string name = "body " + std::to_string(k);
            centers[body] = body->getCenterOfMassPosition();
            numbers[body] = frame.body(name, 1 / body->getInvMass(),
                                       {{vec(inertia[0]), vec(inertia[1]), vec(inertia[2])}}, vec(linear), vec(angular));
        }
    }

    int number(const btCollisionObject* object) const {
        const auto found = numbers.find(object);
        return found == numbers.end() ? lcplab::fixed_body : found->second;
    }

    void add_contacts(double dt) {
        btDispatcher* dispatcher = world.getDispatcher();
        for (int k = 0; k < dispatcher->getNumManifolds(); ++k) {
            const btPersistentManifold* manifold = dispatcher->getManifoldByIndexInternal(k);
            for (int point = 0; point < manifold->getNumContacts(); ++point)
                add_point(*manifold, manifold->getContactPoint(point), dt);
        }
        for (const auto& own : numbers) {
            const btRigidBody* body = btRigidBody::upcast(own.first);
            frame.moved(own.second, vec(body->getLinearVelocity()), vec(body->getAngularVelocity()));
        }
        if (!frame.write(problem, answer)) std::fprintf(stderr, "cannot write %s\n", problem.c_str());
    }

    void add_point(const btPersistentManifold& manifold, const btManifoldPoint& point, double dt) {
        // The normal points from the second body to the first.
        const btCollisionObject *a = manifold.getBody1(), *b = manifold.getBody0();
        const btVector3 arm_a = point.getPositionWorldOnB() - centers[a], arm_b = point.getPositionWorldOnA() - centers[b];
        const btContactSolverInfo& info = world.getSolverInfo();
        const double gap = point.getDistance() + info.m_linearSlop;
        // An overlap is corrected by a second solve, unless it is small or this is turned off.
        const bool is_split = info.m_splitImpulse && gap <= info.m_splitImpulsePenetrationThreshold;
        const double bias = gap > 0 ? gap / dt : is_split ? 0 : info.m_erp2 * gap / dt;
        const int n = frame.row("normal", "normal", 0, lcplab::infinity, bias);
        frame.along(n, vec(point.m_normalWorldOnB), number(a), vec(arm_a), number(b), vec(arm_b));
        frame.answer(n, point.m_appliedImpulse);
        const bool has_two = info.m_solverMode & SOLVER_USE_2_FRICTION_DIRECTIONS;
        const btVector3 directions[] = {point.m_lateralFrictionDir1, point.m_lateralFrictionDir2};
        const double impulses[] = {point.m_appliedImpulseLateral1, point.m_appliedImpulseLateral2};
        for (int k = 0; k < (has_two ? 2 : 1); ++k) {
            const int t = frame.friction("friction", n, point.m_combinedFriction);
            frame.along(t, vec(directions[k]), number(a), vec(arm_a), number(b), vec(arm_b));
            frame.answer(t, impulses[k]);
        }
    }
};

int main(int argc, char** argv) {
    const int steps = argc > 1 ? std::atoi(argv[1]) : 60, sweeps = argc > 2 ? std::atoi(argv[2]) : 10;
    btDefaultCollisionConfiguration configuration;
    btCollisionDispatcher dispatcher(&configuration);
    btDbvtBroadphase broadphase;
    btSequentialImpulseConstraintSolver solver;
    btDiscreteDynamicsWorld world(&dispatcher, &broadphase, &solver, &configuration);
    world.setGravity(btVector3(0, 0, btScalar(-9.81)));
    world.getSolverInfo().m_numIterations = sweeps;
    btStaticPlaneShape floor_shape(btVector3(0, 0, 1), 0);
    btBoxShape box_shape(btVector3(btScalar(0.5), btScalar(0.5), btScalar(0.5)));
    btRigidBody floor(0, nullptr, &floor_shape);
    world.addRigidBody(&floor);
    btRigidBody* boxes[3];
    for (int k = 0; k < 3; ++k) {
        const btScalar mass = k == 2 ? 10 : 1;
        btVector3 inertia;
        box_shape.calculateLocalInertia(mass, inertia);
        btTransform pose(btQuaternion::getIdentity(), btVector3(0, 0, btScalar(0.5) + btScalar(k)));
        boxes[k] = new btRigidBody(mass, new btDefaultMotionState(pose), &box_shape, inertia);
        world.addRigidBody(boxes[k]);
    }
    Capture capture(world, "frame.json", "frame.x.json"); // the added line
    for (int k = 0; k < steps; ++k) world.stepSimulation(btScalar(0.01), 0, btScalar(0.01));
    for (btRigidBody* box : boxes) {
        world.removeRigidBody(box);
        delete box->getMotionState();
        delete box;
    }
    world.removeRigidBody(&floor);
    return 0;
}
