// Open Dynamics Engine: its Dantzig solver on a matrix, and a world of cubes stepped by QuickStep.
//
// A x + b = w here, A x = b + w there: b changes its sign.
#include <cmath>
#include <cstdarg>
#include <cstdlib>
#include <cstring>
#include <ode/ode.h>
#include <vector>

#include "clock.h"

static_assert(sizeof(dReal) == sizeof(double), "the library of double precision");

// The solver is exported, but its header is private; these declarations follow the symbols.
struct dxWorldProcessMemoryManager;
struct dxWorldProcessMemoryReserveInfo;
// Of the arena only the place that is free next and the first one are of interest.
class dxWorldProcessMemArena {
 public:
  void *next, *first, *end, *own;
  const void* manager;
};
extern void dxSolveLCP(dxWorldProcessMemArena*, unsigned n, double* A, double* pairs_bx, double* w,
                       unsigned unbounded, double* pairs_lohi, int* findex);
extern size_t dxEstimateSolveLCPMemoryReq(unsigned n, bool outer_w);
extern dxWorldProcessMemArena* dxAllocateTemporaryWorldProcessMemArena(
    size_t, const dxWorldProcessMemoryManager*, const dxWorldProcessMemoryReserveInfo*);
extern void dxFreeTemporaryWorldProcessMemArena(dxWorldProcessMemArena*);

namespace {

int messages = 0;

void count(int, const char*, va_list) { ++messages; }

void start_once() {
  static const bool started = [] {
    dInitODE2(0);
    dAllocateODEDataForThread(dAllocateMaskAll);
    dSetMessageHandler(count);  // the Dantzig solver returns no status, it only says "s <= 0"
    return true;
  }();
  (void)started;
}

struct Aligned {
  double* data;
  explicit Aligned(size_t n) : data(static_cast<double*>(aligned_alloc(64, (n * 8 + 63) / 64 * 64))) {}
  ~Aligned() { free(data); }
};

}  // namespace

// Returns the seconds; `complaints` is how often it said that something is wrong.
extern "C" double peers_ode_dantzig(int rows, const double* A, const double* b, const double* lo,
                                    const double* hi, double* x, int* complaints) {
  start_once();
  const size_t n = rows, stride = dPAD(rows);
  Aligned matrix(stride * n), bx(2 * n), lohi(2 * n);
  std::vector<double> w(n);
  bool unbounded = true;
  for (size_t i = 0; i < n; ++i) {
    memset(matrix.data + i * stride, 0, stride * sizeof(double));
    memcpy(matrix.data + i * stride, A + i * n, n * sizeof(double));
    bx.data[2 * i] = -b[i];
    bx.data[2 * i + 1] = 0;
    lohi.data[2 * i] = lo[i];
    lohi.data[2 * i + 1] = hi[i];
    unbounded &= std::isinf(lo[i]) && std::isinf(hi[i]);
  }
  dxWorldProcessMemArena* arena = dxAllocateTemporaryWorldProcessMemArena(
      dxEstimateSolveLCPMemoryReq(rows, true) + 4096, nullptr, nullptr);
  arena->next = arena->first;
  messages = 0;
  const double seconds = seconds_of([&] {
    dxSolveLCP(arena, rows, matrix.data, bx.data, w.data(), unbounded ? rows : 0, lohi.data, nullptr);
  });
  for (size_t i = 0; i < n; ++i) x[i] = bx.data[2 * i + 1];
  *complaints = messages;
  dxFreeTemporaryWorldProcessMemArena(arena);
  return seconds;
}

namespace {

struct World {
  dWorldID world = dWorldCreate();
  dSpaceID space = dHashSpaceCreate(nullptr);
  dJointGroupID contacts = dJointGroupCreate(0);
  std::vector<dBodyID> bodies;
  double dt, friction;

  ~World() {
    dJointGroupDestroy(contacts);
    dSpaceDestroy(space);
    dWorldDestroy(world);
  }
};

constexpr int MOST_CONTACTS = 8;

void touch(void* data, dGeomID one, dGeomID other) {
  World& w = *static_cast<World*>(data);
  dBodyID first = dGeomGetBody(one), second = dGeomGetBody(other);
  dContact found[MOST_CONTACTS];
  const int many = dCollide(one, other, MOST_CONTACTS, &found[0].geom, sizeof(dContact));
  for (int k = 0; k < many; ++k) {
    found[k].surface.mode = dContactApprox1;
    found[k].surface.mu = w.friction;
    dJointAttach(dJointCreateContact(w.world, w.contacts, &found[k]), first, second);
  }
}

}  // namespace

// Cubes on the plane z = 0. A pose is a position and a quaternion, the scalar first.
extern "C" void* peers_ode_world(int bodies, const double* poses, double half, double mass,
                                 double friction, double dt, int iterations) {
  start_once();
  dRandSetSeed(1);  // QuickStep takes the rows in random order
  World* w = new World;
  w->dt = dt;
  w->friction = friction;
  dWorldSetGravity(w->world, 0, 0, -9.81);
  dWorldSetAutoDisableFlag(w->world, 0);
  dWorldSetQuickStepNumIterations(w->world, iterations);
  dCreatePlane(w->space, 0, 0, 1, 0);
  for (int k = 0; k < bodies; ++k) {
    const double* p = poses + 7 * k;
    dBodyID body = dBodyCreate(w->world);
    dMass inertia;
    dMassSetBoxTotal(&inertia, mass, 2 * half, 2 * half, 2 * half);
    dBodySetMass(body, &inertia);
    dBodySetPosition(body, p[0], p[1], p[2]);
    const dQuaternion q = {p[3], p[4], p[5], p[6]};
    dBodySetQuaternion(body, q);
    dGeomSetBody(dCreateBox(w->space, 2 * half, 2 * half, 2 * half), body);
    w->bodies.push_back(body);
  }
  return w;
}

extern "C" void peers_ode_step(void* world) {
  World& w = *static_cast<World*>(world);
  dSpaceCollide(w.space, &w, touch);
  dWorldQuickStep(w.world, w.dt);
  dJointGroupEmpty(w.contacts);
}

extern "C" void peers_ode_poses(const void* world, double* poses) {
  for (dBodyID body : static_cast<const World*>(world)->bodies) {
    const dReal *p = dBodyGetPosition(body), *q = dBodyGetQuaternion(body);
    for (int k = 0; k < 3; ++k) *poses++ = p[k];
    for (int k = 0; k < 4; ++k) *poses++ = q[k];
  }
}

extern "C" void peers_ode_free(void* world) { delete static_cast<World*>(world); }
