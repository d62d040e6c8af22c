# SPDX-License-Identifier: BSD-3-Clause
"""Errors of TRiSK's operators on a grid, for a smooth velocity with known derivatives. All values
are taken at points: velocities at the midpoints between cells, where models have them."""
import numpy as np

from shallow_water import norms


class Harmonic:
    """A spherical harmonic of the given degree: a homogeneous polynomial p with Laplace p = 0. Its
    surface Laplacian on the unit sphere is -degree (degree + 1) p."""

    def __init__(self, degree, value, gradient, turn):
        self.degree, self._value, self._gradient, self.turn = degree, value, gradient, turn

    def value(self, x):
        return self._value(*(x @ self.turn.T).T)

    def gradient(self, x):
        full = np.stack(self._gradient(*(x @ self.turn.T).T), axis=1) @ self.turn
        return full - (self.degree * self.value(x))[:, None] * x

    def laplacian(self, x):
        return -self.degree * (self.degree + 1) * self.value(x)


# This orthogonal matrix ensures that the fields have no symmetry of a grid.
TURN = np.linalg.qr(np.array([[0.9, 0.3, 0.1], [-0.2, 0.8, 0.5], [0.1, -0.4, 0.7]]))[0]
STREAM = Harmonic(3, lambda x, y, z: (x**2 - y**2) * z,
                  lambda x, y, z: (2 * x * z, -2 * y * z, x**2 - y**2), TURN)
POTENTIAL = Harmonic(4, lambda x, y, z: (x**3 - 3 * x * y**2) * z,
                     lambda x, y, z: (3 * (x**2 - y**2) * z, -6 * x * y * z, x**3 - 3 * x * y**2), TURN)


def velocity(x):
    """Returns a velocity on the unit sphere whose curl is Laplace STREAM and whose divergence is
    Laplace POTENTIAL."""
    return np.cross(x, STREAM.gradient(x)) + POTENTIAL.gradient(x)


def operator_errors(grid):
    """Returns the relative l2 and l_inf errors by operator."""
    r, v = grid.radius, velocity(grid.edge)
    across, along = np.sum(v * grid.normal, 1), np.sum(v * grid.tangent, 1)
    slope = np.sum(POTENTIAL.gradient(grid.edge) * grid.normal, 1)
    potential, on_edges = POTENTIAL.value(grid.cell), grid.dc * grid.dv
    gradient, divergence = grid.gradient(), grid.divergence()
    return {
        "gradient": norms(r * (gradient @ potential), slope, on_edges),
        "divergence": norms(r * (divergence @ across), POTENTIAL.laplacian(grid.cell), grid.area),
        "curl": norms(r * (grid.curl() @ across), STREAM.laplacian(grid.vertex), grid.triangle_area),
        "tangential velocity": norms(grid.weights @ across, along, on_edges),
        "Laplacian": norms(r**2 * (divergence @ (gradient @ potential)),
                           POTENTIAL.laplacian(grid.cell), grid.area),
    }
