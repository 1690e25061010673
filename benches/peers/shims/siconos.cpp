// Siconos: Lemke's method and a Newton method on a matrix.
//
// It knows x ≥ 0 only: y = x − lo, and a row more for each finite upper bound,
//
//     [A  I] [y]   [A lo + b]
//     [-I 0] [v] + [hi − lo ] ≥ 0
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <siconos/numerics/LCP_Solvers.h>
#include <siconos/numerics/LinearComplementarityProblem.h>
#include <siconos/numerics/NonSmoothDrivers.h>
#include <siconos/numerics/NumericsMatrix.h>
#include <siconos/numerics/SolverOptions.h>
#include <siconos/numerics/lcp_cst.h>
#include <unistd.h>
#include <vector>

#include "clock.h"

// One thread for everybody. The name is there if the algebra is OpenBLAS.
extern "C" void openblas_set_num_threads(int) __attribute__((weak));

namespace {

// Whatever it prints is dropped, as long as this lives.
class Silence {
  int kept[2] = {dup(1), dup(2)};

 public:
  Silence() {
    fflush(nullptr);
    const int nowhere = open("/dev/null", O_WRONLY);
    for (int stream : {1, 2}) dup2(nowhere, stream);
    close(nowhere);
  }
  ~Silence() {
    fflush(nullptr);
    for (int stream : {1, 2}) {
      dup2(kept[stream - 1], stream);
      close(kept[stream - 1]);
    }
  }
};

double solve(int method, int iterations, int n, const double* A, const double* b, const double* lo,
             const double* hi, double* x, int* complaints) {
  if (openblas_set_num_threads) openblas_set_num_threads(1);
  std::vector<int> upper;
  for (int i = 0; i < n; ++i)
    if (!std::isinf(hi[i])) upper.push_back(i);
  const int m = n + int(upper.size());
  std::vector<double> q(m), z(m, 0.0), w(m, 0.0);
  NumericsMatrix* M = NM_create(NM_DENSE, m, m);  // by columns
  std::memset(M->matrix0, 0, sizeof(double) * size_t(m) * m);
  for (int i = 0; i < n; ++i) {
    q[i] = b[i];
    for (int j = 0; j < n; ++j) {
      M->matrix0[size_t(j) * m + i] = A[size_t(i) * n + j];
      q[i] += A[size_t(i) * n + j] * lo[j];
    }
  }
  for (size_t k = 0; k < upper.size(); ++k) {
    M->matrix0[(n + k) * m + upper[k]] = 1;
    M->matrix0[size_t(upper[k]) * m + n + k] = -1;
    q[n + k] = hi[upper[k]] - lo[upper[k]];
  }
  LinearComplementarityProblem problem;
  problem.size = m;
  problem.M = M;
  problem.q = q.data();
  SolverOptions* options = solver_options_create(method);
  options->iparam[SICONOS_IPARAM_MAX_ITER] = iterations;
  options->dparam[SICONOS_DPARAM_TOL] = 1e-9;
  double seconds;
  {
    Silence silence;
    seconds = seconds_of(
        [&] { *complaints = linearComplementarity_driver(&problem, z.data(), w.data(), options); });
  }
  for (int i = 0; i < n; ++i) x[i] = z[i] + lo[i];
  solver_options_delete(options);
  NM_clear(M);
  free(M);
  return seconds;
}

}  // namespace

// What it does not solve in so many pivots, or steps, it does not solve; a step is a factorisation.
constexpr int MOST_PIVOTS = 20000, MOST_STEPS = 200;

// Both return the seconds; `complaints` is 0 if it says that it succeeded. Lower bounds are finite.
extern "C" double peers_siconos_lemke(int n, const double* A, const double* b, const double* lo,
                                      const double* hi, double* x, int* complaints) {
  return solve(SICONOS_LCP_LEMKE, MOST_PIVOTS, n, A, b, lo, hi, x, complaints);
}

extern "C" double peers_siconos_newton(int n, const double* A, const double* b, const double* lo,
                                       const double* hi, double* x, int* complaints) {
  return solve(SICONOS_LCP_NEWTON_MIN_FBLSA, MOST_STEPS, n, A, b, lo, hi, x, complaints);
}
