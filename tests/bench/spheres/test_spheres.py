#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests of the small study of MPAS grids: its grids and operators by known properties, the
command's grid against one from its points, and the tables. PNPBS_COMMAND is the command."""
import math
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

HERE = Path(__file__).resolve().parent
PROGRAM = Path(os.environ["PNPBS_COMMAND"])
sys.dont_write_bytecode = True
sys.path[:0] = [str(HERE)]

import numpy as np  # noqa: E402
from cgrid import CGrid, arc, differences  # noqa: E402
from operators import POTENTIAL, STREAM, operator_errors  # noqa: E402
from points import bisected, centroidal  # noqa: E402
from shallow_water import GRAVITY, ShallowWater, SteadyFlow  # noqa: E402

RADIUS = 6371220.0


class Grids(unittest.TestCase):
    def test_areas_and_counts(self):
        for level in range(4):
            grid = CGrid.from_points(bisected(level), RADIUS)
            self.assertEqual(len(grid.cell), 10 * 4**level + 2)
            self.assertEqual(len(grid.cell) - len(grid.dc) + len(grid.vertex), 2)
            self.assertEqual(np.bincount(grid.cells_on_edge.ravel()).tolist().count(5), 12)
            for areas in (grid.area, grid.triangle_area, grid.kites):
                self.assertAlmostEqual(areas.sum() / (4 * math.pi * RADIUS**2), 1, 13)

    def test_weights(self):
        """The weights are antisymmetric in the measure of energy, and the divergences of their
        results are averages of the divergences at cells. Only these weights have both properties.
        """
        grid = CGrid.from_points(np.random.default_rng(1).standard_normal((200, 3)), RADIUS)
        measured = (grid.weights.multiply(1 / grid.dv)).tocsr().multiply(grid.dc[:, None])
        self.assertLess(abs(measured + measured.T).max(), 1e-10)
        across = np.random.default_rng(2).standard_normal(len(grid.dc))
        out = (grid.weights @ across) * grid.dc
        begins, ends = grid.vertices_on_edge.T
        found = np.bincount(begins, out) - np.bincount(ends, out)
        wanted = grid.triangle_area * (grid.cells_to_vertices() @ (grid.divergence() @ across))
        np.testing.assert_allclose(found, wanted, atol=1e-10 * abs(wanted).max())

    def test_identities(self):
        """The curl of a gradient is zero, and so is the sum of a divergence."""
        grid = CGrid.from_points(np.random.default_rng(1).standard_normal((200, 3)))
        values = np.random.default_rng(3).standard_normal(200)
        slope = grid.gradient() @ values
        self.assertLess(abs(grid.triangle_area * (grid.curl() @ slope)).max(), 1e-13)
        self.assertLess(abs(np.sum(grid.area * (grid.divergence() @ slope))), 1e-10)

    def test_lloyd(self):
        """Points move to the centroids of their cells, for density 1 and for one that grows."""
        points = np.random.default_rng(1).standard_normal((100, 3))
        points /= np.linalg.norm(points, axis=1)[:, None]
        even = centroidal(points, 200)
        self.assertLess(arc(even, centroidal(even, 1)).max(), 0.01)
        self.assertLess(np.ptp(CGrid.from_points(even).area), 0.4 * np.ptp(CGrid.from_points(points).area))
        graded = centroidal(points, 200, lambda x: (1.2 + x[:, 2])**4)
        self.assertGreater(graded[:, 2].mean(), 0.1)


class Operators(unittest.TestCase):
    def test_fields(self):
        x = np.random.default_rng(1).standard_normal((20, 3))
        x /= np.linalg.norm(x, axis=1)[:, None]
        way = np.cross(x, np.random.default_rng(2).standard_normal((20, 3)))
        for field in (STREAM, POTENTIAL):
            # The derivatives are along great circles. The sum of second derivatives along two
            # perpendicular ones is the Laplacian.
            sides = way / np.linalg.norm(way, axis=1)[:, None]
            second, step = 0, 1e-3
            for side in (sides, np.cross(x, sides)):
                here = [field.value(math.cos(t) * x + math.sin(t) * side) for t in (-step, 0, step)]
                np.testing.assert_allclose((here[2] - here[0]) / (2 * step),
                                           np.sum(field.gradient(x) * side, 1), atol=1e-4)
                second = second + (here[2] - 2 * here[1] + here[0]) / step**2
            np.testing.assert_allclose(second, field.laplacian(x), atol=1e-4)

    def test_orders(self):
        coarse, fine = (operator_errors(CGrid.from_points(centroidal(bisected(level), 300))) for level in (3, 4))
        for name, ratio in (("gradient", 3.8), ("divergence", 2), ("curl", 1.9), ("tangential velocity", 3),
                            ("Laplacian", 2)):
            self.assertGreater(coarse[name][0] / fine[name][0], ratio, name)


class Flow(unittest.TestCase):
    def test_energy_rate(self):
        """The scheme in continuous time conserves energy in any state, on any cells."""
        grid = CGrid.from_points(np.random.default_rng(1).standard_normal((200, 3)), RADIUS)
        random = np.random.default_rng(2)
        model = ShallowWater(grid, 1e-4 * grid.vertex[:, 2], random.random(len(grid.area)))
        h, u = 1 + random.random(len(grid.area)), random.standard_normal(len(grid.dc))
        rate_h, rate_u = model.rates(h, u)
        gains = grid.area * (GRAVITY * (h + model.bottom) + model.kinetic @ (u * u)) * rate_h
        turns = grid.dc * grid.dv * (model.to_edges @ h) * u * rate_u
        self.assertLess(abs(gains.sum() + turns.sum()), 1e-12 * (abs(gains).sum() + abs(turns).sum()))

    def test_conservation(self):
        """Mass is conserved within rounding, and energy except for the error of the time steps."""
        grid = CGrid.from_points(bisected(3), RADIUS)
        runs = [SteadyFlow(grid, 0.7).run(1, courant) for courant in (0.5, 0.25)]
        for run in runs:
            self.assertLess(abs(run["mass"]), 1e-14)
        first, second = (run["energy"] for run in runs)
        self.assertLess(abs(first), 1e-6)
        self.assertLess(abs(second), abs(first) / 14)

    def test_error_falls(self):
        errors = [SteadyFlow(CGrid.from_points(centroidal(bisected(level), 100), RADIUS), 0.7).run(1, 0.5)
                  for level in (3, 4)]
        for key in "hu":
            self.assertGreater(errors[0][key][0] / errors[1][key][0], 3)
        self.assertLess(errors[1]["h"][0], 1e-3)


class Command(unittest.TestCase):
    def test_its_grid_is_that_of_its_points(self):
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run([PROGRAM, "--sphere", str(RADIUS), "--spacing", "400e3 + 200e3*sin(pi*lat/180)^2",
                            "--output", "grid.nc", "--format", "mpas", "--quiet"], cwd=folder, check=True)
            grid = CGrid.from_file(Path(folder) / "grid.nc")
        for name, difference in differences(grid, CGrid.from_points(grid.cell, RADIUS)).items():
            self.assertLess(difference, 1e-11, name)
        run = SteadyFlow(grid, 0.7).run(1, 0.5)
        self.assertLess(abs(run["mass"]), 1e-14)
        self.assertLess(run["h"][0], 1e-2)

    def tables(self, *words):
        done = subprocess.run([sys.executable, "-B", HERE / "study.py", "--pnpbs", PROGRAM, *words],
                              stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        rows = [[cell.strip() for cell in line.split("|")[1:-1]] for line in done.stdout.splitlines()
                if line.startswith(("| icos", "| PNPBS"))]
        third = len(rows) // 3
        for row in rows[2 * third:]:
            self.assertLess(float(row[3].split(" / ")[0]), 1e-2)
            self.assertLess(float(row[-2]), 1e-14)
        return rows[:third], rows[third:2 * third], rows[2 * third:]

    def test_tables(self):
        shapes, operators, flows = self.tables(
            "--grids", "icosahedral,pnpbs", "--levels", "3", "--lloyd", "5",
            "--days", "0.2", "--pnpbs-arguments", "--set effort=best")
        self.assertEqual([row[0] for row in shapes], [
            "icosahedral", "icosahedral, 5 Lloyd iterations", "PNPBS --set effort=best",
            "PNPBS --set effort=best, 5 Lloyd iterations"])
        for row in shapes + operators + flows:
            self.assertLess(abs(int(row[1].replace(" ", "")) - 642), 20)
        self.assertEqual({len(row) for row in shapes + operators}, {7})
        self.assertEqual({len(row) for row in flows}, {9})

    def test_graded(self):
        shapes, _, flows = self.tables("--grids", "graded", "--lloyd", "", "--levels", "4",
                                       "--days", "0.05", "--angles", "10")
        self.assertLess(float(shapes[0][3]), 0.6)
        self.assertEqual(len(flows[0]), 7)


if __name__ == "__main__":
    unittest.main()
