# SPDX-License-Identifier: BSD-3-Clause
"""The shallow-water equations in vector-invariant form by TRiSK, and a test case.

The fluxes of potential vorticity conserve energy (Ringler et al. 2010). The case is from
Williamson, Drake, Hack, Jakob and Swarztrauber (Journal of Computational Physics 102 (1992),
211-224). Lengths are in metres, times in seconds."""
import math

import numpy as np

DAY = 86400.0
GRAVITY, ROTATION = 9.80616, 7.292e-5


class ShallowWater:
    """A model with depths at cells and velocities across edges."""

    def __init__(self, grid, coriolis, bottom=0.0):
        """`coriolis` has values at vertices, `bottom` at cells."""
        self.grid, self.coriolis, self.bottom = grid, coriolis, bottom + np.zeros(len(grid.area))
        self.divergence, self.gradient, self.curl = grid.divergence(), grid.gradient(), grid.curl()
        self.to_edges, self.to_vertices = grid.cells_to_edges(), grid.cells_to_vertices()
        self.from_vertices, self.kinetic = grid.vertices_to_edges(), grid.kinetic_energy()

    def rates(self, h, u):
        flux = (self.to_edges @ h) * u
        vorticity = (self.coriolis + self.curl @ u) / (self.to_vertices @ h)
        q = self.from_vertices @ vorticity
        along = 0.5 * (q * (self.grid.weights @ flux) + self.grid.weights @ (q * flux))
        head = GRAVITY * (h + self.bottom) + self.kinetic @ (u * u)
        return -(self.divergence @ flux), along - self.gradient @ head

    def step(self, h, u, dt):
        """Makes a step of the classical Runge-Kutta scheme of fourth order."""
        sum_h, sum_u = np.zeros_like(h), np.zeros_like(u)
        at_h, at_u = h, u
        for weight, ahead in ((1, 0.5), (2, 0.5), (2, 1), (1, 0)):
            rate_h, rate_u = self.rates(at_h, at_u)
            sum_h += weight * rate_h
            sum_u += weight * rate_u
            at_h, at_u = h + ahead * dt * rate_h, u + ahead * dt * rate_u
        return h + dt / 6 * sum_h, u + dt / 6 * sum_u

    def mass(self, h):
        return math.fsum(self.grid.area * h)

    def energy(self, h, u):
        return math.fsum(self.grid.area * h * (self.kinetic @ (u * u) + GRAVITY * (0.5 * h + self.bottom)))


def norms(found, exact, area):
    """Returns the relative l2 and l_inf errors (Williamson et al. 1992)."""
    off = found - exact
    return (math.sqrt(np.sum(area * off**2) / np.sum(area * exact**2)), abs(off).max() / abs(exact).max())


class SteadyFlow:
    """Test case 2 of Williamson et al.: a steady zonal flow in geostrophic balance, with its axis
    tilted by an angle."""

    SPEED, HEAD = 2 * math.pi / 12, 2.94e4  # radii per day; metres^2 / second^2

    def __init__(self, grid, angle):
        axis = np.array([-math.sin(angle), 0, math.cos(angle)])
        speed = self.SPEED * grid.radius / DAY
        factor = grid.radius * ROTATION * speed + speed**2 / 2
        self.h = (self.HEAD - factor * (grid.cell @ axis)**2) / GRAVITY
        stream = -grid.radius * speed * (grid.vertex @ axis)
        begin, end = stream[grid.vertices_on_edge].T
        self.u = -(end - begin) / grid.dv
        self.model = ShallowWater(grid, 2 * ROTATION * (grid.vertex @ axis))
        self.wave = math.sqrt(self.HEAD) + speed

    def run(self, days, courant):
        """Returns the errors at the end, the changes of mass and energy, and the time step."""
        grid, model = self.model.grid, self.model
        steps = math.ceil(days * DAY * self.wave / (courant * grid.dc.min()))
        dt = days * DAY / steps
        h, u = self.h, self.u
        mass, energy = model.mass(h), model.energy(h, u)
        for _ in range(steps):
            h, u = model.step(h, u, dt)
        h_errors, u_errors = norms(h, self.h, grid.area), norms(u, self.u, grid.dc * grid.dv)
        return {"h": h_errors, "u": u_errors, "mass": model.mass(h) / mass - 1,
                "energy": model.energy(h, u) / energy - 1, "dt": dt, "steps": steps}
