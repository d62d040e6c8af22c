# SPDX-License-Identifier: BSD-3-Clause
"""Tests bodies with walls much thinner than the spacing. Either the elements fill them, or the
status says that they do not."""

import itertools
import json
import os
import unittest

import numpy

from builds import exists_if
from command import DONE, NOT_CONFORMING, CommandTest

# The corners of the quadrilateral sides of a box. The k-th bit of a corner says on which side of
# axis k it lies.
BOX_SIDES = (0, 4, 6, 2), (1, 3, 7, 5), (0, 1, 5, 4), (2, 6, 7, 3), (0, 2, 3, 1), (4, 5, 7, 6)


def box(low, high):
    """Returns corners and outward triangles."""
    corners = [[(low, high)[code >> k & 1][k] for k in range(3)] for code in range(8)]
    return corners, [t for a, b, c, d in BOX_SIDES for t in ((a, b, c), (a, c, d))]


class ThinBodies(CommandTest):
    def write_off(self, name, bodies, turned=None):
        """Writes an OFF file. Each body has corners, triangles, and a flag for a cavity."""
        points, triangles = [], []
        for corners, faces, is_cavity in bodies:
            first = len(points)
            points += corners
            triangles += [[first + k for k in (reversed(f) if is_cavity else f)] for f in faces]
        points = numpy.array(points, float)
        if turned is not None:
            points = points @ turned.T
        with open(self.folder / name, "w", encoding="ascii") as file:
            print(f"OFF\n{len(points)} {len(triangles)} 0", file=file)
            for point in points:
                print(*point.tolist(), file=file)
            for triangle in triangles:
                print(3, *triangle, file=file)
        return name

    def place(self, domain, spacing, *more, code=DONE, ranks=0):
        arguments = ("--domain", domain, "--spacing", str(spacing), "--check", "--quiet", "--report", "a.json",
                     "--output", "a.csv", *more)
        if ranks:
            self.run_on_ranks(*arguments, ranks=ranks)
        else:
            self.run_command(*arguments, code=code)
        return json.loads((self.folder / "a.json").read_text())

    def assert_filled(self, report, volume, nodes):
        self.assertAlmostEqual(report["volume"]["domain"], volume, delta=1e-9 * volume)
        self.assertAlmostEqual(report["volume"]["elements"], volume, delta=1e-9 * volume)
        self.assertLess(report["boundary"]["distance"], 1e-9)
        self.assertLess(report["boundary"]["given_distance"], 1e-9)
        self.assertEqual(report["missing_faces"], 0)
        self.assertEqual(report["unresolved_places"], 0)  # d is as requested
        self.assertTrue(0.7 * nodes < report["nodes"] < 1.3 * nodes, report["nodes"])

    def test_plates(self):
        for size, spacing, nodes in (((2, 2, 0.05), 1, 20), ((2, 2, 0.05), 0.5, 56), ((4, 4, 0.12), 1, 56),
                                     ((100, 60, 0.1), 5, 616), ((10, 6, 0.01), 1, 170), ((6, 0.2, 10), 1, 170)):
            with self.subTest(size=size, spacing=spacing):
                text = f"box(0,0,0, {size[0]},{size[1]},{size[2]})"
                self.assert_filled(self.place(text, spacing), numpy.prod(size), nodes)

    def test_turned_plates(self):
        a, b = 0.7, 0.4
        turned = (numpy.array([[numpy.cos(a), -numpy.sin(a), 0], [numpy.sin(a), numpy.cos(a), 0], [0, 0, 1]])
                  @ numpy.array([[1, 0, 0], [0, numpy.cos(b), -numpy.sin(b)], [0, numpy.sin(b), numpy.cos(b)]]))
        for thickness in 0.02, 0.1, 0.2:
            with self.subTest(thickness):
                name = self.write_off("plate.off", [(*box((0, 0, 0), (10, 6, thickness)), False)], turned)
                self.assert_filled(self.place(name, 1), 60 * thickness, 170)

    def test_a_blade(self):
        """Checks a blade, whose sides meet at an angle of a tenth of a degree."""
        corners = [[x, y, z] for x, y, z in itertools.product((0, 6), (0,), (-0.005, 0.005))]
        corners += [[0, 6, 0], [6, 6, 0]]
        triangles = [(0, 2, 1), (1, 2, 3), (0, 1, 4), (2, 5, 3), (0, 4, 2), (2, 4, 5), (1, 3, 4), (3, 5, 4)]
        name = self.write_off("blade.off", [(corners, triangles, False)])
        report = self.place(name, 0.7)
        self.assertAlmostEqual(report["volume"]["elements"], 0.18, delta=1e-9)
        self.assertEqual(report["unresolved_places"], 0)

    def test_a_shell(self):
        outer, inner = box((0, 0, 0), (6, 6, 6)), box((0.1, 0.1, 0.1), (5.9, 5.9, 5.9))
        report = self.place(self.write_off("shell.off", [(*outer, False), (*inner, True)]), 1)
        volume = 6 ** 3 - 5.8 ** 3
        self.assertAlmostEqual(report["volume"]["elements"], volume, delta=1e-9 * volume)
        self.assertLess(report["nodes"], 600)

    def test_gaps(self):
        """Checks two bodies at a distance of less than a tenth of d."""
        for gap in 0.002, 0.02, 0.1:
            with self.subTest(gap):
                lower, upper = box((0, 0, 0), (4, 4, 2)), box((0, 0, 2 + gap), (4, 4, 4))
                name = self.write_off("two.off", [(*lower, False), (*upper, False)])
                self.assert_filled(self.place(name, 0.8), 16 * (4 - gap), 330)

    def test_a_stack(self):
        plates = [(*box((0, 0, 0.08 * k), (6, 6, 0.08 * k + 0.05)), False) for k in range(6)]
        self.assert_filled(self.place(self.write_off("stack.off", plates), 1), 6 * 36 * 0.05, 660)

    def test_lost_volume_has_a_status(self):
        """Checks a fin that is a third of d thick at its foot. The tetrahedra fill too much or too
        little of it."""
        low, high = 0.45, 0.55
        outline = [(0, 0), (1, 0), (1, low), (2, (1 + 2 * low) / 4), (2, (1 + 2 * high) / 4), (1, high), (1, 1),
                   (0, 1), (0, high), (0, low)]
        ends = [(0, 1, 2, 9), (9, 2, 5, 8), (2, 3, 4, 5), (8, 5, 6, 7)]
        sides = [end[::-1] for end in ends] + [[10 + v for v in end] for end in ends]
        sides += [(i, (i + 1) % 10, 10 + (i + 1) % 10, 10 + i) for i in range(10)]
        triangles = [t for a, b, c, d in sides for t in ((a, b, c), (a, c, d))]
        name = self.write_off("fin.off", [([[x, y, z] for z in (0, 1) for x, y in outline], triangles, False)])
        report = self.place(name, 0.3, "--set", "conforming_rounds=0", code=NOT_CONFORMING)
        lost = report["volume"]["domain"] - report["volume"]["elements"]
        self.assertGreater(abs(lost), 0.005 * report["volume"]["domain"])
        self.assertEqual(report["status"], NOT_CONFORMING - 2)
        report = self.place(name, 0.3)  # only edges at the right angles of the cube are 1.1 d long
        self.assertAlmostEqual(report["volume"]["elements"], report["volume"]["domain"], delta=1e-9)

    @exists_if("PNPBS_MPIEXEC" in os.environ)
    def test_ranks_place_the_same_nodes(self):
        outer, inner = box((0, 0, 0), (6, 6, 6)), box((0.1, 0.1, 0.1), (5.9, 5.9, 5.9))
        shell = self.write_off("shell.off", [(*outer, False), (*inner, True)])
        for domain, spacing in ((shell, 1), ("box(0,0,0, 10,6,0.05)", 0.6)):
            hashes = {self.place(domain, spacing, ranks=ranks)["hash"] for ranks in (0, 3)}
            self.assertEqual(len(hashes), 1, domain)


if __name__ == "__main__":
    unittest.main()
