"""Writes the files of this folder: problems with known numbers, by the tools whose formats they are.

    pip install numpy scipy highspy h5py && python make.py

NumPy, SciPy (also MATLAB's format 5) and HiGHS write their own formats. MATLAB's format 7.3 and the
files of FCLIB and Chrono are laid out by hand as MATLAB and their sources lay them out (fclib.h,
ChSystemDescriptor::WriteMatrixBlocks): none of them is installed by pip.
"""

import os

import h5py
import highspy
import numpy as np
import scipy.io
import scipy.sparse

inf = np.inf

# tridiag(-1, 2, -1) with a third that no decimal holds, and a box.
A = np.array([[2.0, -1.0, 0.0], [-1.0, 2.0, -1.0], [0.0, -1.0, 1 / 3]])
b = np.array([-1.0, 0.1, 3.0])
lo = np.array([0.0, -inf, -2.5])
hi = np.array([inf, 7.0, -1 / 3])

scipy.io.mmwrite("scipy.mtx", scipy.sparse.csr_array(A))
for name, vector in [("b", b), ("lo", lo), ("hi", hi)]:
    scipy.io.mmwrite(f"scipy_{name}.mtx", vector[:, None])

# Unsymmetric, so that rows and columns cannot be confused; A.T is stored by columns.
U = np.triu(A)
np.savez("numpy.npz", A=U.T.copy().T, b=b, lo=lo, hi=hi)
S = scipy.sparse.csr_array(U)
arrays = dict(data=S.data, indices=S.indices, indptr=S.indptr, shape=S.shape, format="csr")
np.savez_compressed("scipy.npz", **arrays, b=b.astype(">f4"), lo=lo, hi=hi)
scipy.sparse.save_npz("matrix_only.npz", S)

model = highspy.HighsModel()
lp, hessian = model.lp_, model.hessian_
lp.num_col_, lp.num_row_ = 3, 0
lp.col_cost_, lp.col_lower_, lp.col_upper_ = b, lo, hi
lp.a_matrix_.start_ = [0] * 4
hessian.dim_, hessian.format_ = 3, highspy.HessianFormat.kTriangular
lower = scipy.sparse.csc_array(np.tril(A))
hessian.start_, hessian.index_, hessian.value_ = lower.indptr, lower.indices, lower.data
highs = highspy.Highs()
highs.passModel(model)
highs.writeModel("highs.mps")
os.replace("highs.mps", "highs.qps")

# min x² + y² + z² − x with x + y ≥ 2, z = 2 and x, y ≤ 5, in both forms of a quadratic program.
P, q = 2 * np.eye(3), np.array([-1.0, 0.0, 0.0])
between = dict(
    P=scipy.sparse.csc_array(P), q=q[:, None], r=0.5, n=3, m=4,
    A=scipy.sparse.csc_array(np.array([[1.0, 1, 0], [0, 0, 1], [1, 0, 0], [0, 1, 0]])),
    l=np.array([[2.0], [2], [-1e20], [-1e20]]), u=np.array([[1e20], [2], [5], [5]]),
)
separate = dict(
    P=P, q=q, G=np.array([[-1.0, -1, 0]]), h=-2.0, A=scipy.sparse.csc_array([[0.0, 0, 1]]), b=2.0,
    ub=np.array([5, 5, inf]),
)
os.makedirs("matlab", exist_ok=True)
scipy.io.savemat("matlab/between.mat", between, do_compression=True)
scipy.io.savemat("matlab/separate.mat", separate, do_compression=False)
# min x² + y² + x + y with x − y/3 = 0, x + y ≤ 26 and x, y ≥ 0; the 0 was computed, and is a rounding error.
rounding = dict(P=2 * np.eye(2), q=np.ones(2), A=np.array([[1, -1 / 3], [1, 1], [1, 0], [0, 1]]))
rounding |= dict(l=np.array([2.0**-54, -np.inf, 0, 0]), u=np.array([2.0**-54, 26, np.inf, np.inf]))
scipy.io.savemat("matlab/rounding.mat", rounding, do_compression=True)
scipy.io.savemat("matlab/lcp.mat", dict(A=U, b=b, lo=lo, hi=hi), do_compression=True)
small = dict(A=np.array([[2, -1], [-1, 300]], dtype=np.int16), b=np.array([-1, 2], dtype=np.int8))
scipy.io.savemat("matlab/integers.mat", small)
scipy.io.savemat("matlab/single.mat", {"A": np.float32([[1 / 3]]), "b": np.uint8([200])})
scipy.io.savemat("matlab/structure.mat", {"problem": {"A": A, "b": b}})
scipy.io.savemat("matlab/complex.mat", {"A": A * 1j, "b": b})
scipy.io.savemat("matlab/text.mat", {"A": A, "b": "one"})
scipy.io.savemat("matlab/cube.mat", {"A": np.zeros((2, 2, 2)), "b": b})
scipy.io.savemat("matlab/triangle.mat", between | {"P": scipy.sparse.csc_array(np.triu(A))})
scipy.io.savemat("matlab/format_4.mat", {"A": A, "b": b}, format="4")


def matlab_73(path, variables):
    """MATLAB's save -v7.3: a block of 512 bytes, columns as rows, sparse matrices as groups."""
    with h5py.File(path, "w", userblock_size=512) as file:
        for name, value in variables.items():
            if scipy.sparse.issparse(value):
                group = file.create_group(name)
                group.attrs["MATLAB_class"] = np.bytes_("double")
                group.attrs["MATLAB_sparse"] = np.uint64(value.shape[0])
                group["jc"] = value.indptr.astype(np.uint64)
                if value.nnz:
                    group["data"], group["ir"] = value.data, value.indices.astype(np.uint64)
                continue
            array = np.atleast_2d(value)
            is_whole = array.dtype.kind == "i"
            dataset = file.create_dataset(name, data=array.T.astype(np.int64 if is_whole else float))
            dataset.attrs["MATLAB_class"] = np.bytes_("int64" if is_whole else "double")
    with open(path, "r+b") as file:
        file.write(b"MATLAB 7.3 MAT-file".ljust(124) + b"\x00\x02IM")


matlab_73("matlab/between_73.mat", between)
matlab_73("matlab/lcp_73.mat", dict(A=U, b=b, lo=lo, hi=hi))
with h5py.File("matlab/structure_73.mat", "w", userblock_size=512) as file:
    file.create_group("problem").attrs["MATLAB_class"] = np.bytes_("struct")


def fclib_matrix(group, kind, matrix):
    """fclib.h, write_matrix: nz is -1 for columns, -2 for rows, else the number of triplets."""
    stored = {"csc": scipy.sparse.csc_array, "csr": scipy.sparse.csr_array}.get(kind)
    if stored:
        matrix = stored(matrix)
        nz, p, i = {"csc": -1, "csr": -2}[kind], matrix.indptr, matrix.indices
    else:
        matrix = scipy.sparse.coo_array(matrix)
        nz, p, i = matrix.nnz, matrix.coords[1], matrix.coords[0]  # CSparse: p columns, i rows
    m, n = matrix.shape
    for name, value in [("nzmax", matrix.nnz), ("m", m), ("n", n), ("nz", nz)]:
        group.create_dataset(name, data=np.array([value], dtype=np.int32))
    group.create_dataset("p", data=p.astype(np.int32))
    group.create_dataset("i", data=i.astype(np.int32))
    group.create_dataset("x", data=matrix.data)


def fclib(path, kind, matrices, vectors):
    with h5py.File(path, "w") as file:
        root = file.create_group(kind)
        root.create_dataset("spacedim", data=np.array([3], dtype=np.int32))
        for name, (storage, matrix) in matrices.items():
            fclib_matrix(root.create_group(name), storage, matrix)
        for name, vector in vectors.items():
            root.create_dataset(f"vectors/{name}", data=np.array(vector))
        root.create_dataset("info/title", data=np.bytes_("two contacts"))


W = np.diag([2.0, 3, 4, 5, 6, 7])
W[0, 3] = W[3, 0] = 1
W[0, 4], W[4, 0] = 0.125, 0.25  # unsymmetric
V = np.zeros((6, 1))
V[1, 0] = -0.5
fclib("fclib_local.hdf5", "fclib_local",
      {"W": ("csc", W), "V": ("coo", V), "R": ("csr", np.array([[1.5]]))},
      {"q": [-1.0, 2, 0, -3, 0, 1], "mu": [0.5, 0.25], "s": [4.0]})

# A point of three masses and a counterweight: one contact and one equation.
M = np.diag([1.0, 4, 4, 4])  # with square roots that a Cholesky factor holds exactly
H = np.array([[1.0, 0, 0], [0, 1, 0], [0, 0, 1], [0, 1, 0]])
G = np.array([[-1.0], [0], [0], [1]])
f, w, e = [-2.0, 8, 0, 4], [0.5, 0, 0], [1.0]
fclib("fclib_global.hdf5", "fclib_global",
      {"M": ("csr", M), "H": ("csc", H), "G": ("coo", G)},
      {"f": f, "w": w, "b": e, "mu": [0.5]})


def stream_out(path, matrix):
    """ChMatrix.h, StreamOut: indices from 0, zeros left out, but the last entry always there."""
    rows, cols = matrix.shape
    with open(path, "w") as file:
        for i, j in np.argwhere(matrix):
            file.write(f"{i} {j} {matrix[i, j]:.12e}\n")
        if not matrix[-1].any() or not matrix[:, -1].any():
            file.write(f"{rows - 1} {cols - 1} {0:.12e}\n")


os.makedirs("chrono", exist_ok=True)
stream_out("chrono/dump_H.dat", M)
stream_out("chrono/dump_Cq.dat", np.hstack([G, H]).T)  # the joint first, then the contact
stream_out("chrono/dump_E.dat", np.diag([0.25, 0, 0, 0]))
for name, vector in [("f", f), ("b", e + w)]:
    np.savetxt(f"chrono/dump_{name}.dat", vector, fmt="%.12e")
np.savetxt("chrono/dump_fric.dat", [-2, 0.5, -1, -1], fmt="%.12g")
