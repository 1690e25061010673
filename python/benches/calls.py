"""What a call costs beside the solver itself: `python python/benches/calls.py`."""

import subprocess
import sys
import timeit

import numpy as np

import lcplab

generator = np.random.default_rng(1)
J = generator.normal(size=(20, 24))
A, b = J @ J.T, generator.normal(size=20)
problem = lcplab.Problem(A, b)


def best(call, number=2000):
    return 1e6 * min(timeit.repeat(call, number=number, repeat=5)) / number


def nothing(A, b, lo, hi, **settings):
    return None


arrays = best(lambda: lcplab.Problem(A, b))
inner = lcplab._lcplab
given = {"tolerance": 1e-8, "max_iterations": 10_000, "omega": None}
unproved = best(lambda: inner.solve(problem._inner, "pgs", {**given, "max_iterations": 0}, None, False, False))
print(f"a Problem of 20 rows from arrays       {arrays:8.1f} µs")
print(f"solve by no sweep, judged, not proved  {unproved:8.1f} µs")
print(f"solve by Dantzig's method              {best(lambda: inner.solve(problem._inner, 'dantzig', given, None, False, False)):8.1f} µs")
print(f"the same, proved exactly               {best(lambda: lcplab.solve(problem, solver='dantzig'), 50):8.1f} µs")
print(f"a function as the solver               {best(lambda: inner.solve(problem._inner, nothing, given, None, False, False)):8.1f} µs")
script = "import numpy, time; t = time.perf_counter(); import lcplab; print(time.perf_counter() - t)"
seconds = float(subprocess.run([sys.executable, "-c", script], capture_output=True, text=True).stdout)
print(f"import                                 {1e3 * seconds:8.1f} ms")
