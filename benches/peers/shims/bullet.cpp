// Bullet in double precision: its Dantzig and Lemke solvers on a matrix, and a world of cubes stepped by
// sequential impulses.
//
// A x + b = w here, A x = b + w there: b changes its sign.
#include <btBulletDynamicsCommon.h>
#include <cmath>
#include <memory>
#include <vector>

#include <BulletDynamics/MLCPSolvers/btDantzigLCP.h>
#include <BulletDynamics/MLCPSolvers/btLemkeSolver.h>

#include "clock.h"

static_assert(sizeof(btScalar) == sizeof(double), "the libraries of double precision");

// Returns the seconds; `complaints` is 1 if it says that it failed.
extern "C" double peers_bullet_dantzig(int n, const double* A, const double* b, const double* lo,
                                       const double* hi, double* x, int* complaints) {
  std::vector<btScalar> matrix(A, A + size_t(n) * n), right(n), w(n), low(lo, lo + n), high(hi, hi + n);
  bool unbounded = true;
  for (int i = 0; i < n; ++i) {
    right[i] = -b[i];
    x[i] = 0;
    if (std::isinf(low[i])) low[i] = -BT_INFINITY; else unbounded = false;
    if (std::isinf(high[i])) high[i] = BT_INFINITY; else unbounded = false;
  }
  btDantzigScratchMemory scratch;
  bool solved = false;
  const double seconds = seconds_of([&] {
    solved = btSolveDantzigLCP(n, matrix.data(), x, right.data(), w.data(), unbounded ? n : 0, low.data(),
                               high.data(), nullptr, scratch);
  });
  *complaints = !solved;
  return seconds;
}

extern "C" double peers_bullet_lemke(int n, const double* A, const double* b, const double* lo,
                                     const double* hi, double* x, int* complaints) {
  btMatrixXu matrix(n, n);
  btVectorXu right(n), low(n), high(n), answer(n);
  btAlignedObjectArray<int> limits;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) matrix.setElem(i, j, A[size_t(i) * n + j]);
    right[i] = -b[i];
    low[i] = std::isinf(lo[i]) ? -SIMD_INFINITY : lo[i];
    high[i] = std::isinf(hi[i]) ? SIMD_INFINITY : hi[i];
    answer[i] = 0;
    limits.push_back(-1);
  }
  btLemkeSolver solver;
  solver.m_maxLoops = 20 * n;
  solver.m_maxValue = 1e18;
  bool solved = false;
  const double seconds = seconds_of(
      [&] { solved = solver.solveMLCP(matrix, right, answer, low, high, limits, 0, false); });
  for (int i = 0; i < n; ++i) x[i] = answer[i];
  *complaints = !solved;
  return seconds;
}

namespace {

struct World {
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher{&configuration};
  btDbvtBroadphase broadphase;
  btSequentialImpulseConstraintSolver solver;
  btDiscreteDynamicsWorld world{&dispatcher, &broadphase, &solver, &configuration};
  btBoxShape cube, ground{btVector3(100, 100, 1)};
  std::vector<std::unique_ptr<btRigidBody>> bodies;  // the ground comes last
  double dt;

  World(double half, double dt) : cube(btVector3(half, half, half)), dt(dt) {}

  ~World() {
    for (auto& body : bodies) world.removeRigidBody(body.get());
  }

  void add(double mass, btCollisionShape& shape, const btTransform& place, double friction) {
    btVector3 inertia(0, 0, 0);
    if (mass > 0) shape.calculateLocalInertia(mass, inertia);
    bodies.push_back(std::make_unique<btRigidBody>(mass, nullptr, &shape, inertia));
    btRigidBody& body = *bodies.back();
    body.setWorldTransform(place);
    body.setFriction(friction);
    body.setActivationState(DISABLE_DEACTIVATION);
    world.addRigidBody(&body);
  }
};

}  // namespace

// Cubes on the plane z = 0, the upper side of a large box. A pose is a position and a quaternion, the
// scalar first. Bullet multiplies the friction of both bodies.
extern "C" void* peers_bullet_world(int bodies, const double* poses, double half, double mass,
                                    double friction, double dt, int iterations) {
  World* w = new World(half, dt);
  w->world.setGravity(btVector3(0, 0, -9.81));
  btContactSolverInfo& info = w->world.getSolverInfo();
  info.m_numIterations = iterations;
  info.m_leastSquaresResidualThreshold = 0;
  for (int k = 0; k < bodies; ++k) {
    const double* p = poses + 7 * k;
    const btTransform place(btQuaternion(p[4], p[5], p[6], p[3]), btVector3(p[0], p[1], p[2]));
    w->add(mass, w->cube, place, std::sqrt(friction));
  }
  w->add(0, w->ground, btTransform(btQuaternion::getIdentity(), btVector3(0, 0, -1)), std::sqrt(friction));
  return w;
}

extern "C" void peers_bullet_step(void* world) {
  World& w = *static_cast<World*>(world);
  w.world.stepSimulation(w.dt, 0, w.dt);
}

extern "C" void peers_bullet_poses(const void* world, double* poses) {
  const World& w = *static_cast<const World*>(world);
  for (size_t k = 0; k + 1 < w.bodies.size(); ++k) {
    const btTransform& place = w.bodies[k]->getWorldTransform();
    const btVector3& p = place.getOrigin();
    const btQuaternion q = place.getRotation();
    for (double value : {p.x(), p.y(), p.z(), q.w(), q.x(), q.y(), q.z()}) *poses++ = value;
  }
}

extern "C" void peers_bullet_free(void* world) { delete static_cast<World*>(world); }
