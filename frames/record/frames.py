"""A frame: one step of a simulation with contacts, as the arrays that its problem is made from.

The problem of a frame with n rows and k velocities is, in lcplab's signs,

    w = A x + b,   A = J inv(M) J' + diag(R),   b = J u_star + bias,   x >= 0 pushes bodies apart

Arrays of a file (numpy.load, no pickles):

| array | type | meaning |
| --- | --- | --- |
| `J_data`, `J_indices`, `J_indptr` | f8, i4, i4 | J, n x k, by rows (CSR) |
| `M_data`, `M_indices`, `M_indptr` | f8, i4, i4 | M, k x k, symmetric positive definite, both triangles, by rows |
| `R` | f8, n | compliance of each row, at least 0 |
| `u_star` | f8, k | velocity (or acceleration) that the bodies would have without the rows |
| `bias` | f8, n | what is added to J u: error correction, target speeds, with restitution |
| `lo`, `hi` | f8, n | bounds of x; -inf and inf in coupled rows |
| `friction_index` | i4, n | the row of the normal that bounds this row, -1 for none |
| `mu` | f8, n | its coefficient of friction, 0 for other rows |
| `cone` | word | the law of the engine: coulomb-cone, associated-cone or coupled-box; box without coupled rows |
| `level` | word | velocity (x in N s, w in m/s) or acceleration (x in N, w in m/s^2) |
| `dt` | f8 | the step in seconds |
| `scale` | f8 | the weight of the lightest body (N), times dt at velocity level: a smaller x counts as rest |
| `source` | text | JSON: engine, version, scene, step, push, bodies, contacts, settings, what was derived, date |

A contact is three rows n, t1, t2, one after the other. Coupled rows are bounded by
|x_t1|, |x_t2| <= mu x_n (box) or by sqrt(x_t1^2 + x_t2^2) <= mu x_n (cones).
"""

import json
import pathlib

import numpy as np
import scipy.sparse as sp

DATE = "2026-11-26"  # of the recording


class Rows:
    """The rows of a frame as they are found: contacts, joints, limits, motors."""

    def __init__(self, k):
        self.k = k
        self.J, self.R, self.bias, self.lo, self.hi, self.index, self.mu = ([] for _ in range(7))

    def add(self, J, bias=0.0, R=0.0, lo=0.0, hi=np.inf, index=-1, mu=0.0):
        """One row; J has k entries."""
        for values, value in zip(
            (self.J, self.bias, self.R, self.lo, self.hi, self.index, self.mu), (J, bias, R, lo, hi, index, mu)
        ):
            values.append(value)

    def contact(self, J, mu, bias=(0.0, 0.0, 0.0), R=(0.0, 0.0, 0.0)):
        """The three rows n, t1, t2 of a contact; J is 3 x k."""
        normal = len(self.J)
        self.add(J[0], bias[0], R[0])
        for axis in (1, 2):
            self.add(J[axis], bias[axis], R[axis], -np.inf, np.inf, normal, mu)

    def save(self, path, M, u_star, *, cone, level, dt, lightest, source):
        """Writes the frame; M is k x k, `lightest` the mass of the lightest body (kg)."""
        J = clean(np.array(self.J))
        M = np.asarray(M)
        M = clean((M + M.T) / 2)
        M = np.where(M.T == 0, 0.0, M)  # symmetric to the last bit
        source = source | {"date": DATE, "contacts": int(len(set(self.index) - {-1}))}
        np.savez_compressed(
            path,
            **{f"J_{part}": array for part, array in csr(J).items()},
            **{f"M_{part}": array for part, array in csr(M).items()},
            R=np.array(self.R, float),
            u_star=np.array(u_star, float),
            bias=np.array(self.bias, float),
            lo=np.array(self.lo, float),
            hi=np.array(self.hi, float),
            friction_index=np.array(self.index, np.int32),
            mu=np.array(self.mu, float),
            cone=np.array(cone),
            level=np.array(level),
            dt=np.array(float(dt)),
            scale=np.array(9.81 * lightest * (dt if level == "velocity" else 1)),
            source=np.array(json.dumps(source)),
        )


def clean(matrix):
    """The matrix without entries that are rounding of 0 (1e-15 of the largest of their row)."""
    largest = np.abs(matrix).max(axis=1, keepdims=True)
    return np.where(np.abs(matrix) > 1e-15 * largest, matrix, 0.0)


def csr(matrix):
    """data, indices and indptr."""
    matrix = sp.csr_array(matrix)
    return {"data": matrix.data, "indices": matrix.indices.astype(np.int32), "indptr": matrix.indptr.astype(np.int32)}


def tangents(normal):
    """Two unit vectors that are perpendicular to the normal and to each other (x, y for normal z)."""
    axis = np.eye(3)[np.argmin(np.abs(normal))]
    first = axis - (axis @ normal) * normal
    first /= np.linalg.norm(first)
    return first, np.cross(normal, first)


class Frame:
    """A frame read from its file: A, b and all arrays, source as a dictionary."""

    def __init__(self, path):
        self.name = pathlib.Path(path).stem
        with np.load(path) as file:
            arrays = {part: file[part] for part in file.files}
        n, k = len(arrays["R"]), len(arrays["u_star"])
        for matrix, shape in (("J", (n, k)), ("M", (k, k))):
            parts = [arrays.pop(f"{matrix}_{part}") for part in ("data", "indices", "indptr")]
            setattr(self, matrix, sp.csr_array(tuple(parts), shape=shape))
        for part, array in arrays.items():
            setattr(self, part, array if array.ndim else array.item())
        self.source = json.loads(self.source)
        J, M = self.J.toarray(), self.M.toarray()
        self.bare = J @ np.linalg.solve(M, J.T)  # without compliance
        self.bare = (self.bare + self.bare.T) / 2
        self.A = self.bare + np.diag(self.R)
        self.b = J @ self.u_star + self.bias

    def problem(self):
        """The frame as a problem file of lcplab, with the key motion; no model is stated."""
        bound = lambda v: v if np.isfinite(v) else ("inf" if v > 0 else "-inf")
        triplets = lambda m: [[int(i), int(j), float(v)] for i, j, v in zip(m.row, m.col, m.data)]
        file = {
            "name": self.name,
            "source": json.dumps(self.source),
            "dt": self.dt,
            "scale": self.scale,
            "A": {"dense": self.A.tolist()},
            "b": self.b.tolist(),
            "lo": [bound(v) for v in self.lo],
            "hi": [bound(v) for v in self.hi],
            "motion": {
                "mass": triplets(sp.triu(self.M).tocoo()),
                "jacobian": triplets(self.J.tocoo()),
                "bias": self.bias.tolist(),
                "compliance": self.R.tolist(),
                "target": self.u_star.tolist(),
            },
        }
        if (self.friction_index >= 0).any():
            file |= {"friction_index": self.friction_index.tolist(), "mu": self.mu.tolist()}
        return file
