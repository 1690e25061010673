"""A contact solve inside JAX: lcplab computes the answer, and its exact derivative backward.

Balls of masses m fall onto each other at speed v; contact i carries all balls above it, so its impulse is v times their
mass, whose derivatives are 0 and v. At a kink, where x has no gradient, `vjp` raises an error instead of returning a wrong one.
"""

import jax
import jax.numpy as jnp
import numpy as np

import lcplab

jax.config.update("jax_enable_x64", True)


def solved(A, b):
    return lcplab.solve(np.asarray(A), np.asarray(b)).x


def pulled_back(A, b, x, v):
    problem = lcplab.Problem(np.asarray(A), np.asarray(b))
    gradients = lcplab.gradient(problem, np.asarray(x)).vjp(np.asarray(v))
    return gradients["A"], gradients["b"]


def like(array):
    return jax.ShapeDtypeStruct(array.shape, array.dtype)


@jax.custom_vjp
def contact_impulses(A, b):
    return jax.pure_callback(solved, like(b), A, b, vmap_method="sequential")


def forward(A, b):
    x = contact_impulses(A, b)
    return x, (A, b, x)


def backward(saved, v):
    A, b, _ = saved
    return jax.pure_callback(pulled_back, (like(A), like(b)), *saved, v, vmap_method="sequential")


contact_impulses.defvjp(forward, backward)


def impulses_of_balls(masses, speed):
    n = len(masses)
    J = np.eye(n) - np.eye(n, k=-1)
    return contact_impulses(J @ jnp.diag(1 / masses) @ J.T, -speed * J @ np.ones(n))


def main():
    """The derivatives of the impulses with respect to the masses, (contacts, balls)."""
    masses = jnp.array([1.0, 2.0, 4.0])
    return np.asarray(jax.jacrev(impulses_of_balls)(masses, 3.0))


if __name__ == "__main__":
    print(main())
