#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests of the study of bodies, with cubes of tetrahedra that are damaged in one way each.

The study must also detect a program that does not report the damage."""
import itertools
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))
from body_files import cut_to_triangles, read_body  # noqa: E402
from judge import boundary_faces, judged  # noqa: E402
from random_bodies import random_body  # noqa: E402
from sharp_edges import is_surface, opening_angles  # noqa: E402

CELLS = 3


def cube(at=(0, 0, 0)):
    """Returns corners and tetrahedra of cubic cells, each divided into six (Kuhn's division)."""
    side = CELLS + 1
    x = np.array(list(itertools.product(range(side), repeat=3)), float) + at
    tetrahedra = []
    for cell in itertools.product(range(CELLS), repeat=3):
        for axes in itertools.permutations(range(3)):
            corner = np.array(cell)
            way = [corner.copy()]
            for axis in axes:
                corner[axis] += 1
                way.append(corner.copy())
            tetrahedra.append([int(np.dot(c, (side * side, side, 1))) for c in way])
    tetrahedra = np.array(tetrahedra)
    corners = x[tetrahedra]
    turned = np.linalg.det(corners[:, 1:] - corners[:, :1]) < 0
    tetrahedra[turned] = tetrahedra[turned][:, [1, 0, 2, 3]]
    return x, tetrahedra


def surface_of(x, tetrahedra):
    return x, boundary_faces(tetrahedra)


class Judge(unittest.TestCase):
    def setUp(self):
        self.x, self.tetrahedra = cube()
        self.body = surface_of(self.x, self.tetrahedra)

    def judged(self, x, tetrahedra):
        return judged(self.body, x, tetrahedra)

    def test_whole(self):
        found = self.judged(self.x, self.tetrahedra)
        self.assertTrue(found["whole"], found)
        self.assertEqual((found["euler"], found["pieces"]), (2, 1))
        self.assertAlmostEqual(found["least_angle"], 45)
        self.assertLess(max(found["to_body"], found["from_body"]), 0.2)
        self.assertAlmostEqual(found["volume"], CELLS ** 3)
        self.assertAlmostEqual(found["volume_of_body"], CELLS ** 3)

    def test_hollow(self):
        middle = np.abs(self.x[self.tetrahedra].mean(1) - CELLS / 2).max(1).argmin()
        found = self.judged(self.x, np.delete(self.tetrahedra, middle, 0))
        self.assertEqual((found["pieces"], found["euler"], found["whole"]), (2, 4, False))
        self.assertLess(found["volume"], found["volume_of_body"] - 1 / 7)

    def test_off_the_surface(self):
        inside = np.all((self.x[self.tetrahedra].mean(1) > 1), axis=1)
        found = self.judged(self.x, self.tetrahedra[~inside])
        self.assertGreater(found["to_body"], 0.5)

    def test_torn(self):
        for shift, edges, nodes in (((CELLS,) * 3, 0, 1), ((CELLS, CELLS, 0), CELLS, 0)):
            x, tetrahedra = cube(shift)
            both = np.concatenate([self.x, x])
            both, places = np.unique(both, axis=0, return_inverse=True)
            places = places.reshape(-1)
            found = self.judged(both, places[np.concatenate([self.tetrahedra,
                                                             tetrahedra + len(self.x)])])
            self.assertEqual(found["torn_edges"], edges)
            self.assertGreaterEqual(found["torn_nodes"], nodes)
            self.assertFalse(found["whole"])

    def test_isolated(self):
        found = self.judged(np.concatenate([self.x, [[1.5, 1.5, 1.5]]]), self.tetrahedra)
        self.assertEqual((found["isolated"], found["whole"]), (1, False))

    def test_flat(self):
        self.assertEqual(self.judged(self.x, self.tetrahedra)["flat"], 0)
        square = [0, 1, (CELLS + 1) + 1, CELLS + 1]  # a side of a cell
        found = self.judged(self.x, np.concatenate([self.tetrahedra, [square]]))
        self.assertEqual(found["flat"], 1)

    def test_turned_over(self):
        self.tetrahedra[7] = self.tetrahedra[7][[1, 0, 2, 3]]
        found = self.judged(self.x, self.tetrahedra)
        self.assertEqual((found["turned_over"], found["whole"]), (1, False))


class SharpEdges(unittest.TestCase):
    def setUp(self):
        self.x, self.tetrahedra = cube()
        self.surface = boundary_faces(self.tetrahedra)

    def angles(self, triangles):
        _, found = opening_angles(self.x, triangles)
        return set(found.round(6)) - {180}

    def test_cube(self):
        self.assertEqual(self.angles(self.surface), {90})
        self.assertEqual(self.angles(self.surface[:, ::-1]), {90})

    def test_turned_in(self):
        corner = np.all(self.x[self.tetrahedra].mean(1) > CELLS - 1, axis=1)
        self.assertEqual(self.angles(boundary_faces(self.tetrahedra[~corner])), {90, 270})

    def test_told_apart(self):
        """Cubes are sheared to a wedge of 20 degrees. Two of its edges have this angle, and the
        opposite ones 160 degrees."""
        tangent = np.tan(np.radians(20))
        self.x[:, 0] += self.x[:, 1] / tangent
        self.assertEqual(self.angles(self.surface), {20, 90, 160})
        found = judged((self.x, self.surface), self.x, self.tetrahedra, 0.5)
        self.assertLess(found["at_sharp_edges"], len(self.tetrahedra))
        self.assertGreater(found["at_sharp_edges"], 0)
        least = {found["least_angle_at_sharp_edges"], found["least_angle_elsewhere"]}
        self.assertEqual(min(least), found["least_angle"])
        whole = judged(surface_of(*cube()), *cube())
        self.assertEqual((whole["at_sharp_edges"], whole["least_angle_at_sharp_edges"]), (0, None))
        self.assertEqual(whole["least_angle_elsewhere"], whole["least_angle"])


class RandomBodies(unittest.TestCase):
    def test_pure(self):
        one, other = random_body(5, 2), random_body(5, 3)
        again = random_body(5, 2)
        self.assertTrue(all(np.array_equal(a, b) for a, b in zip(one, again)))
        self.assertFalse(np.array_equal(one[0], other[0]))
        self.assertFalse(np.array_equal(one[0], random_body(6, 2)[0]))

    def test_closed(self):
        for number in range(20):
            x, triangles = random_body(6, number)
            self.assertTrue(is_surface(triangles))
            self.assertEqual(len(np.unique(x, axis=0)), len(x))

    def test_touching_along_an_edge(self):
        both = np.concatenate([cube()[0], cube((CELLS, CELLS, 0))[0]])
        x, places = np.unique(both, axis=0, return_inverse=True)
        tetrahedra = places.reshape(-1)[np.concatenate([cube()[1], cube()[1] + len(both) // 2])]
        self.assertFalse(is_surface(boundary_faces(tetrahedra)))
        self.assertTrue(is_surface(boundary_faces(cube()[1])))


class Polygons(unittest.TestCase):
    def test_not_convex(self):
        comb = np.array([[0, 0], [5, 0], [5, 3], [4, 3], [4, 1], [3, 1], [3, 3], [0, 3]], float)
        zero = np.zeros(len(comb))
        for x in (np.column_stack([comb, zero]), np.column_stack([comb[:, 1], zero, comb[:, 0]])):
            triangles = np.array(cut_to_triangles(x, list(range(len(x)))))
            sides = x[triangles[:, 1:]] - x[triangles[:, :1]]
            areas = np.cross(sides[:, 0], sides[:, 1]) / 2
            self.assertEqual(len(triangles), len(x) - 2)
            self.assertAlmostEqual(np.linalg.norm(areas.sum(0)), 13)
            self.assertAlmostEqual(np.linalg.norm(areas, axis=1).sum(), 13)


class Study(unittest.TestCase):
    """Tests with a fake program that always writes the same tetrahedra."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        x, triangles = surface_of(*cube())
        rows = [f"{a} {b} {c}" for a, b, c in x] + [f"3 {a} {b} {c}" for a, b, c in triangles]
        (self.folder / "cube.off").write_text("\n".join(["OFF", f"{len(x)} {len(triangles)} 0", *rows]))

    def refused(self, *bodies):
        """Runs the study with a program that writes nothing."""
        program = self.folder / "refuses"
        program.write_text("#!/bin/sh\nexit 2\n")
        program.chmod(0o755)
        return self.run_study(program, *bodies)

    def study(self, tetrahedra, status, *bodies):
        x, _ = cube()
        for suffix, rows, head in ((".node", x, f"{len(x)} 3 0 0"), (".ele", tetrahedra + 1,
                                                                   f"{len(tetrahedra)} 4 0")):
            lines = [" ".join(str(word) for word in (k + 1, *row)) for k, row in enumerate(rows)]
            (self.folder / ("made" + suffix)).write_text("\n".join([head, *lines, ""]))
        program = self.folder / "program"
        program.write_text(f"""#!/bin/sh
for word; do
  case $word in
    *.node | *.ele) cp "{self.folder}/made.${{word##*.}}" "$word" ;;
  esac
done
{"exit " if status >= 0 else "kill "}{status}{"" if status >= 0 else " $$"}
""")
        program.chmod(0o755)
        return self.run_study(program, *(bodies or [self.folder / "cube.off"]))

    @staticmethod
    def run_study(program, *arguments):
        return subprocess.run([sys.executable, "-B", HERE / "study.py", "--program", program, *arguments],
                              capture_output=True, text=True)

    def test_whole(self):
        done = self.study(cube()[1], 0)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("1 bodies: 1 whole, 0 torn", done.stdout)

    def test_silent(self):
        torn = cube()[1][6:]  # without the cell of a corner
        self.assertIn("0 whole, 1 torn, 0 with tetrahedra of no volume, 1 of both without", self.study(torn, 0).stdout)
        self.assertEqual(self.study(torn, 0).returncode, 1)
        self.assertEqual(self.study(torn, 6).returncode, 0)

    def test_random(self):
        """No random body is three cubes wide, so that each is torn and kept."""
        found = self.study(cube()[1], 6, "--random", "4:7", "--count", "2", "--keep", self.folder / "kept")
        self.assertEqual(found.returncode, 0, found.stderr)
        self.assertRegex(found.stdout, "(?m)^4:7 [^\n]*\n4:8 ")
        self.assertRegex(found.stdout, "\nagain: .*/study.py --random 4:8 --parts 25 --nodes 6000 ")
        x, _ = read_body(self.folder / "kept" / "random_4_8_25.off")
        self.assertTrue(np.array_equal(x, random_body(4, 8)[0]))

    def test_too_many_torn(self):
        for most, status in ((0, 1), (1, 0)):
            found = self.study(cube()[1][6:], 6, self.folder / "cube.off", "--most-torn", str(most))
            self.assertEqual(found.returncode, status)

    def test_refused(self):
        """A file may be rejected, but a random body may not."""
        self.assertIn("1 refused", self.refused(self.folder / "cube.off").stdout)
        self.assertEqual(self.refused(self.folder / "cube.off").returncode, 0)
        self.assertEqual(self.refused("--random", "4").returncode, 1)

    def test_crash(self):
        found = self.study(cube()[1], -11)
        self.assertEqual(found.returncode, 1)
        self.assertIn("0 whole, 0 torn, 0 with tetrahedra of no volume, 0 of both without exit code 6; 0 refused, "
                      "1 failed", found.stdout)


if __name__ == "__main__":
    unittest.main()
