#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests of the evaluator, the cases and the measurement of compare.py against exact values."""
import math
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent))

import cases  # noqa: E402
import evaluate as evaluator  # noqa: E402
from adapters import esri_grid  # noqa: E402
from distance_to_loop import distance_to_loop  # noqa: E402
from domain import loop_area  # noqa: E402
from evaluate import CHORDS, Mesh, across_boundary, evaluate, narrow  # noqa: E402
from measure import Failed, measure  # noqa: E402
from spacing_table import SpacingTable, read_table, table_of  # noqa: E402


def one_everywhere(points):
    return np.ones(len(points))


def rectangle(x0, y0, x1, y1):
    return np.array([[x0, y0], [x1, y0], [x1, y1], [x0, y1]], float)


def unit_lattice(width, height):
    x, y = np.meshgrid(np.arange(width + 1.0), np.arange(height + 1.0))
    return np.column_stack([x.ravel(), y.ravel()])


class Exact(unittest.TestCase):
    def test_hexagonal_lattice(self):
        """A hexagon of side 12, cut along the rows, has 6 * 12^2 equilateral triangles."""
        side = 12
        nodes = np.array([(i + 0.5 * j, 0.5 * math.sqrt(3) * j)
                          for i in range(-side, side + 1) for j in range(-side, side + 1)
                          if abs(i + j) <= side])
        angle = math.pi / 3 * np.arange(6)
        domain = cases.from_loops([side * np.column_stack([np.cos(angle), np.sin(angle)])])
        m = evaluate(nodes, domain, one_everywhere)
        self.assertEqual(m["nodes"], 3 * side * (side + 1) + 1)
        self.assertEqual(m["triangles"], 6 * side ** 2)
        self.assertEqual(m["crossing"], 0)
        for key in ("covered", "quality_mean", "quality_one_percent", "quality_least",
                    "wide_quality_mean", "wide_quality_least", "edge_mean", "nearest_mean"):
            self.assertAlmostEqual(m[key], 1, 9, key)
        for key in ("edge_deviation", "nearest_deviation"):
            self.assertAlmostEqual(m[key], 0, 9, key)
        self.assertAlmostEqual(m["angle_least"], 60, 6)
        self.assertAlmostEqual(m["cell_99_percent"], 1 / math.sqrt(3), 9)
        self.assertEqual(m["histogram"][-1], m["triangles"])
        # Triangles in the corners, where a chord is shorter than 3, do not count.
        self.assertLess(m["wide_triangles"], m["triangles"])
        self.assertGreater(m["wide_triangles"], m["triangles"] - 6 * 9)

    def test_square_lattice(self):
        domain = cases.from_loops([rectangle(0, 0, 10, 6)])
        m = evaluate(unit_lattice(10, 6), domain, one_everywhere)
        self.assertEqual(m["triangles"], 120)
        # With legs of 1 the radii are r_in = 1 - sqrt(1/2), R = sqrt(1/2).
        self.assertAlmostEqual(m["quality_mean"], 2 * math.sqrt(2) - 2, 9)
        self.assertAlmostEqual(m["quality_least"], 2 * math.sqrt(2) - 2, 9)
        self.assertAlmostEqual(m["angle_least"], 45, 9)
        self.assertAlmostEqual(m["cell_99_percent"], math.sqrt(0.5), 9)
        straight, diagonal = 10 * 7 + 11 * 6, 60
        mean = (straight + diagonal * math.sqrt(2)) / (straight + diagonal)
        self.assertAlmostEqual(m["edge_mean"], mean, 9)
        square = (straight + diagonal * 2) / (straight + diagonal)
        self.assertAlmostEqual(m["edge_deviation"], math.sqrt(square - mean ** 2), 9)

    def test_spacing_scales_what_it_should(self):
        nodes, domain = unit_lattice(10, 6), cases.from_loops([rectangle(0, 0, 10, 6)])
        one, two = (evaluate(nodes, domain, lambda points, d=d: np.full(len(points), d))
                    for d in (1.0, 2.0))
        self.assertAlmostEqual(two["edge_mean"], one["edge_mean"] / 2, 12)
        self.assertAlmostEqual(two["nearest_mean"], 0.5, 12)
        self.assertEqual(two["quality_mean"], one["quality_mean"])

    def test_bands(self):
        """d differs by a factor between the halves of a lattice. The bands show what the mean does
        not."""
        nodes, domain = unit_lattice(40, 40), cases.from_loops([rectangle(0, 0, 40, 40)])
        m = evaluate(nodes, domain, lambda points: np.where(points[:, 0] < 19.5, 0.5, 2.0))
        even = evaluate(nodes, domain, one_everywhere)
        self.assertEqual(even["edge_bands"], [even["edge_mean"]])
        # The diagonal edges that join the halves are in a separate band.
        first, *_, last = m["edge_bands"]
        self.assertAlmostEqual(first / (2 * even["edge_mean"]), 1, 2)
        self.assertAlmostEqual(last / (0.5 * even["edge_mean"]), 1, 2)

    def test_one_triangle(self):
        corners = np.array([[0, 0], [4, 0], [0, 3]], float)
        m = evaluate(corners, cases.from_loops([corners]), one_everywhere)
        self.assertEqual(m["triangles"], 1)
        self.assertAlmostEqual(m["quality_least"], 2 * 1 / 2.5, 12)  # r_in 1, R 2.5
        self.assertAlmostEqual(m["angle_least"], math.degrees(math.asin(0.6)), 9)
        self.assertEqual(m["wide_triangles"], 0)
        self.assertIsNone(m["cell_99_percent"])  # there is no inner node

    def test_quality_and_angle_of_random_triangles(self):
        """The expected values come from Heron's formula and the cosine rule at all three corners.
        """
        points = np.random.default_rng(3).random((300, 2))
        triangles = np.arange(300).reshape(-1, 3)
        quality, angle = evaluator.shape(points, triangles)
        for t, (p, q, r) in enumerate(points[triangles]):
            a, b, c = math.dist(q, r), math.dist(r, p), math.dist(p, q)
            s = (a + b + c) / 2
            area = math.sqrt(s * (s - a) * (s - b) * (s - c))
            self.assertAlmostEqual(quality[t], 2 * (area / s) / (a * b * c / (4 * area)), 6)
            angles = [math.acos((v * v + w * w - u * u) / (2 * v * w))
                      for u, v, w in ((a, b, c), (b, c, a), (c, a, b))]
            self.assertAlmostEqual(angle[t], math.degrees(min(angles)), 5)

    def test_hole(self):
        """A ring of width 2 is narrow everywhere. Its hole has no triangles."""
        domain = cases.from_loops([rectangle(0, 0, 8, 8), rectangle(2, 2, 6, 6)], [(4, 4)])
        nodes = unit_lattice(8, 8)
        hole = (np.abs(nodes - 4) < 2).all(1)
        m = evaluate(nodes[~hole], domain, one_everywhere)
        self.assertEqual(m["triangles"], 2 * (64 - 16))
        self.assertAlmostEqual(m["covered"], 1, 12)
        self.assertEqual(m["wide_triangles"], 0)
        self.assertIsNone(m["wide_quality_least"])

    def test_coinciding_nodes_are_refused(self):
        nodes, domain = unit_lattice(4, 4), cases.from_loops([rectangle(0, 0, 4, 4)])
        with self.assertRaisesRegex(ValueError, "coincide"):
            evaluate(np.vstack([nodes, nodes[7]]), domain, one_everywhere)

    def test_slanted_straight_rows_make_no_triangle(self):
        """Rounding makes straight rows crooked, and Qhull returns triangles in some of them."""
        share = np.linspace(0, 1, 38)[:-1, None]
        random = np.random.default_rng(2)
        for _ in range(20):
            corners = random.random((3, 2))
            following = np.roll(corners, -1, 0)
            rows = [a + share * (b - a) for a, b in zip(corners, following)]
            nodes = np.vstack([*rows, corners.mean(0)])
            m = evaluate(nodes, cases.from_loops([corners]), one_everywhere)
            self.assertEqual(m["triangles"], 3 * 37)  # a fan around the middle
            self.assertAlmostEqual(m["covered"], 1, 9)


class Widths(unittest.TestCase):
    def test_chords_against_all_segments(self):
        """Rays through triangles give the same chords as the domain's segments."""
        random = np.random.default_rng(1)
        domain = cases.from_loops([rectangle(0, 0, 14, 9), rectangle(4, 3, 7, 6)], [(5, 5)])
        nodes = unit_lattice(14, 9)
        inner = (np.abs(nodes - [7, 4.5]) < [7, 4.5]).all(1)
        near_hole = (np.abs(nodes - [5.5, 4.5]) <= 1.5).all(1)
        nodes[inner & ~near_hole] += random.uniform(-0.3, 0.3, (np.sum(inner & ~near_hole), 2))
        nodes = nodes[~(np.abs(nodes - [5.5, 4.5]) < 1.5).all(1)]
        mesh = Mesh(nodes, domain)
        every = np.arange(len(mesh.triangles))
        found = narrow(mesh, every, np.ones(len(every)))
        expected = [shortest_chord(nodes[t].mean(0), domain) < 3 for t in mesh.triangles]
        self.assertEqual(found.tolist(), expected)
        self.assertTrue(0 < sum(expected) < len(expected))


def shortest_chord(p, domain):
    least = math.inf
    for chord in range(CHORDS):
        angle = (chord + 0.2718) * math.pi / CHORDS
        ux, uy = math.cos(angle), math.sin(angle)
        ways = {1: math.inf, -1: math.inf}
        for (ax, ay), (bx, by) in zip(*domain.ends()):
            left, right = ux * (ay - p[1]) - uy * (ax - p[0]), ux * (by - p[1]) - uy * (bx - p[0])
            if left * right > 0:
                continue
            share = left / (left - right)
            way = ux * (ax + share * (bx - ax) - p[0]) + uy * (ay + share * (by - ay) - p[1])
            side = 1 if way > 0 else -1
            ways[side] = min(ways[side], abs(way))
        least = min(least, ways[1] + ways[-1])
    return least


class Crossing(unittest.TestCase):
    def test_thin_land(self):
        """Nodes lie on both sides of a slit of width 0.1, staggered and 1 apart. They see each
        other across it."""
        slit = rectangle(1, 1.95, 7, 2.05)
        domain = cases.from_loops([rectangle(0, 0, 8, 4), slit], [(4, 2)])
        lattice = unit_lattice(8, 4)
        nodes = np.vstack([lattice[lattice[:, 1] != 2], [[0, 2], [8, 2]], slit,
                           [[x + 0.3, 1.95] for x in range(1, 7)],
                           [[x + 0.8, 2.05] for x in range(1, 7)]])
        mesh = Mesh(nodes, domain)
        crossed = across_boundary(mesh, domain)
        self.assertGreater(crossed.sum(), 0)
        for t, corners in enumerate(nodes[mesh.triangles]):
            heights = corners[:, 1]
            through = (heights <= 1.95).any() and (heights >= 2.05).any() and \
                (np.abs(corners[:, 0] - 4) < 3).all()
            if through:
                self.assertTrue(crossed[t], corners)
        whole = evaluate(nodes, domain, one_everywhere)
        self.assertEqual(whole["crossing"], crossed.sum())

    def test_no_slit(self):
        domain = cases.from_loops([rectangle(0, 0, 8, 4)])
        self.assertFalse(across_boundary(Mesh(unit_lattice(8, 4), domain), domain).any())


class Cases(unittest.TestCase):
    def test_domains(self):
        lakes = cases.read_poly(cases.DATA / "great_lakes_islands.poly")
        self.assertEqual(len(lakes.loops()), 110)
        self.assertEqual(sum(len(loop) for loop in lakes.loops()), len(lakes.vertices))
        self.assertFalse(lakes.contains(lakes.holes).any())
        ring = cases.annulus(0.001)
        self.assertAlmostEqual(ring.area(), math.pi * (1 - 0.16), 4)
        self.assertAlmostEqual(ring.perimeter(), 2 * math.pi * 1.4, 4)
        inside = ring.contains(np.array([[0, 0], [0.39, 0], [0.41, 0], [0, -0.99], [0.8, 0.8]]))
        self.assertEqual(inside.tolist(), [False, False, True, True, False])

    def test_lake_area_by_counting(self):
        lakes = cases.read_poly(cases.DATA / "great_lakes_islands.poly")
        low, high = lakes.vertices.min(0), lakes.vertices.max(0)
        some = low + (high - low) * np.random.default_rng(5).random((400000, 2))
        share = lakes.contains(some).mean()
        self.assertAlmostEqual(share * np.prod(high - low) / lakes.area(), 1, 2)

    def test_poly_reads_back(self):
        ring = cases.annulus(0.3)
        with tempfile.TemporaryDirectory() as folder:
            ring.write_poly(Path(folder) / "ring.poly")
            again = cases.read_poly(Path(folder) / "ring.poly")
        for name in ("vertices", "segments", "holes"):
            self.assertTrue(np.array_equal(getattr(ring, name), getattr(again, name)), name)

    def test_sizes(self):
        for name, make in cases.CASES.items():
            self.assertAlmostEqual(make(7000).expected_nodes() / 7000, 1, 3, name)
        square = cases.make_uniform_square(10000)
        # The expected number is 2 / (sqrt(3) d^2) + 2 / d.
        d = square.constant
        self.assertAlmostEqual(2 / math.sqrt(3) / d ** 2 + 2 / d, 10000, 3)
        graded = cases.make_graded_square(10000)
        there = graded.spacing(np.array([[0.5, 0.5], [1, 1]]))
        self.assertAlmostEqual(there[1] / there[0], 10, 3)

    def test_line(self):
        """The integrals of 1 / d and 1 / d^2 are known."""
        case = cases.make_graded_line(7000)
        least, far = case.constant, case.constant + 0.1
        along_y = np.log(far / least) / 0.2 * 2
        self.assertAlmostEqual((4 / math.sqrt(3) / 0.2 * (1 / least - 1 / far)
                                + along_y + 1 / far) / 7000, 1, 3)
        there = case.spacing(np.array([[0.1, 0.5], [0.9, 0.5], [0.3, 1.0]]))
        self.assertEqual(there[0], there[1])
        self.assertAlmostEqual(there[2] - there[0], 0.1, 14)

    def test_formula(self):
        for case in (cases.make_graded_square(500), cases.make_graded_line(500)):
            for x, y in ((0.1, 0.9), (0.5, 0.5)):
                value = eval(case.formula(power="**2"), {"sqrt": math.sqrt, "x": x, "y": y})
                self.assertAlmostEqual(value, case.spacing(np.array([[x, y]]))[0], 14)


class Airfoil(unittest.TestCase):
    def setUp(self):
        self.case = cases.make_graded_airfoil(100000)
        self.random = np.random.default_rng(7)

    def beside(self, count):
        """Returns points of the domain beside the airfoil, with the same number in each octave of
        the distance."""
        start = self.case.loop[self.random.integers(0, len(self.case.loop), count)]
        angle = self.random.uniform(0, 2 * math.pi, count)
        way = 10 ** self.random.uniform(-5, 0.3, count)
        points = start + way[:, None] * np.column_stack([np.cos(angle), np.sin(angle)])
        return points[self.case.domain.contains(points)]

    def test_domain(self):
        """The thickness of the section is a polynomial in sqrt(x), so that its area is known. The
        camber enlarges it by a thousandth."""
        loop = self.case.loop
        section = 1.2 * (0.2969 / 1.5 - 0.1260 / 2 - 0.3516 / 3 + 0.2843 / 4 - 0.1036 / 5)
        self.assertAlmostEqual(loop_area(loop) / section, 1.001, 3)
        self.assertAlmostEqual(self.case.domain.area(), 9 - loop_area(loop), 12)
        sides = np.roll(loop, -1, 0) - loop
        after = np.roll(sides, -1, 0)
        turns = sides[:, 0] * after[:, 1] - sides[:, 1] * after[:, 0]
        self.assertGreater(turns.min(), 0)  # convex
        self.assertEqual(np.argmax(np.arctan2(turns, (sides * after).sum(1))), len(loop) - 1)
        inside = self.case.domain.contains(np.array([[0.5, 0], [0.5, 0.08], [1.01, 0], [0.99, 0]]))
        self.assertEqual(inside.tolist(), [False, True, True, False])

    def test_distance(self):
        """Compares the distance with the minimum over single segments."""
        loop = self.case.loop.tolist()
        points = np.vstack([self.beside(200), self.case.loop[::40], [[0.5, 0.02], [0.9, 0.003]]])
        for (x, y), found in zip(points, distance_to_loop(points, self.case.loop)):
            least = math.inf
            for (ax, ay), (bx, by) in zip(loop, loop[1:] + loop[:1]):
                share = ((x - ax) * (bx - ax) + (y - ay) * (by - ay)) / math.dist((ax, ay),
                                                                                 (bx, by)) ** 2
                share = min(max(share, 0), 1)
                least = min(least, math.dist((x, y), (ax + share * (bx - ax),
                                                      ay + share * (by - ay))))
            self.assertAlmostEqual(found, least, 14)

    def test_spacing(self):
        there = self.case.spacing(np.array([self.case.loop[7], [1.5, 0], [-1, -1.5], [2, 0]]))
        self.assertAlmostEqual(there[0], self.case.constant, 15)
        self.assertAlmostEqual(there[1], self.case.constant + 0.15 * 0.5, 12)
        self.assertEqual(there[2:].tolist(), [0.15, 0.15])

    def test_nodes(self):
        """Compares with sums over the cells of the table, which are small where d is small."""
        table = table_of(self.case)
        middle = [0.5 * (lines[1:] + lines[:-1]) for lines in (table.x, table.y)]
        points = np.column_stack([a.ravel() for a in np.meshgrid(*middle, indexing="ij")])
        areas = np.outer(np.diff(table.x), np.diff(table.y)).ravel()
        inside = self.case.domain.contains(points)
        nodes = (2 / math.sqrt(3) * areas[inside] / self.case.spacing(points[inside]) ** 2).sum()
        self.assertAlmostEqual(nodes / self.case.inner_nodes(), 1, 2)
        self.assertAlmostEqual(cases.Case.boundary_nodes(self.case) / self.case.boundary_nodes(),
                               1, 6)

    def off(self, table):
        """Returns the relative error of a table, as the 99 % quantile and the maximum. Many points
        lie at both ends of the airfoil, where the error is largest."""
        points = self.beside(20000)
        share = np.abs(table.at(*points.T) / self.case.spacing(points) - 1)
        return np.quantile(share, 0.99), share.max()

    def test_table(self):
        table = table_of(self.case)
        most, worst = self.off(table)
        self.assertLess(most, 0.01)
        self.assertLess(worst, 0.05)
        points = self.beside(500)
        one = table.at_one()
        for (x, y), d in zip(points.tolist(), table.at(*points.T)):
            self.assertAlmostEqual(one(x, y), d, 14)
        with tempfile.TemporaryDirectory() as folder:
            table.write(Path(folder) / "table.txt")
            again = read_table(Path(folder) / "table.txt")
        for name in ("x", "y", "values"):
            self.assertTrue(np.array_equal(getattr(table, name), getattr(again, name)), name)

    def test_even_grid(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "grid.asc"
            esri_grid.write_grid(self.case, path)
            with open(path) as file:
                header = dict(next(file).split() for _ in range(6))
                values = np.loadtxt(file)
        x, y = (float(header[f"{axis}llcenter"]) + float(header[f"d{axis}"]) * np.arange(count)
                for axis, count in (("x", int(header["ncols"])), ("y", int(header["nrows"]))))
        self.assertEqual(values.shape, (len(y), len(x)))
        self.assertTrue(x[0] <= -1 and x[-1] >= 2 and y[0] <= -1.5 and y[-1] >= 1.5)
        most, worst = self.off(SpacingTable(x, y, values[::-1].T))
        self.assertLess(most, 0.08)
        self.assertLess(worst, 0.15)
        with self.assertRaisesRegex(Failed, "million values"):
            esri_grid.write_grid(cases.make_graded_airfoil(1e6), path)


class Measuring(unittest.TestCase):
    def run_python(self, code, **more):
        with tempfile.TemporaryDirectory() as folder:
            return measure([sys.executable, "-S", "-c", code], folder, **more)

    def test_memory_is_the_childs_own(self):
        ballast = bytearray(300_000_000)
        ballast[::4096] = b"x" * len(ballast[::4096])
        small = self.run_python("pass")
        large = self.run_python("b = bytearray(200_000_000); b[::4096] = b'x' * len(b[::4096])")
        self.assertLess(small.peak_bytes, 50e6)
        self.assertGreater(large.peak_bytes, 200e6)
        self.assertLess(large.peak_bytes, 250e6)
        del ballast

    def test_time_and_output(self):
        used = self.run_python("import os, time; time.sleep(0.3); "
                               "print(os.environ['OMP_NUM_THREADS'])")
        self.assertGreaterEqual(used.seconds, 0.3)
        self.assertEqual(used.stdout, "1\n")

    def test_failures(self):
        with self.assertRaisesRegex(Failed, "status 3: no luck"):
            self.run_python("import sys; sys.stderr.write('no luck\\n'); sys.exit(3)")
        self.run_python("import sys; sys.exit(3)", accepted=(0, 3))
        with self.assertRaisesRegex(Failed, "not done after 0.2 s"):
            self.run_python("import time; time.sleep(60)", time_limit=0.2)
        with self.assertRaisesRegex(Failed, "no-such-command"):
            measure(["no-such-command"], tempfile.gettempdir())


if __name__ == "__main__":
    unittest.main()
