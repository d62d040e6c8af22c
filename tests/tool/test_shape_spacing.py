# SPDX-License-Identifier: BSD-3-Clause
"""Tests spacings that use the shape of the domain, seglen and curvature(N), against the values for
shapes with known segments and radii."""

import unittest

import numpy as np

from command import CommandTest

GROWTH = 0.15  # per unit of distance from the boundary


def distances_to_segment(points, a, b):
    along = np.clip(((points - a) @ (b - a)) / ((b - a) @ (b - a)), 0, 1)
    return np.linalg.norm(points - a - along[:, None] * (b - a), axis=1)


class ShapeSpacing(CommandTest):
    def nodes(self, domain, spacing, *arguments, steps=3):
        """Returns the positions of the nodes, d there, and whether they are on the boundary."""
        self.place_body(domain, spacing, "--set", f"steps={steps}", "-o", "nodes.csv",
                        "--nodes-only", "-q", *arguments)
        table = np.genfromtxt(self.folder / "nodes.csv", delimiter=",", names=True)
        axes = [name for name in "xyz" if name in table.dtype.names]
        return np.stack([table[a] for a in axes], axis=1), table["spacing"], table["tag"] != 0

    def write_polygons(self, *polygons, hole=None):
        vertices, segments = [], []
        for corners in polygons:
            first, n = len(vertices), len(corners)
            vertices += corners.tolist()
            segments += [(first + i, first + (i + 1) % n) for i in range(n)]
        lines = [f"{len(vertices)} 2 0 0", *(f"{i} {x!r} {y!r}" for i, (x, y) in enumerate(vertices)),
                 f"{len(segments)} 0", *(f"{i} {a} {b}" for i, (a, b) in enumerate(segments))]
        lines += ["0"] if hole is None else ["1", f"0 {hole[0]} {hole[1]}"]
        (self.folder / "polygons.poly").write_text("\n".join(lines) + "\n")
        return "polygons.poly"

    def write_off(self, vertices, triangles):
        lines = ["OFF", f"{len(vertices)} {len(triangles)} 0",
                 *(" ".join(map(repr, map(float, v))) for v in vertices),
                 *("3 " + " ".join(map(str, t)) for t in triangles)]
        (self.folder / "body.off").write_text("\n".join(lines) + "\n")
        return "body.off"

    def test_a_spot_with_a_fixed_node(self):
        """Checks that d is sampled at fixed nodes: a spot that no other sample hits is found by a
        fixed node in it."""
        corners = np.array([[0, 0], [1, 0], [1, 1], [0, 1]])
        spot = np.array([0.3712, 0.6283])
        formula = f"hypot(x-{spot[0]},y-{spot[1]})<0.004 ? 0.001 : 0.1"

        def nodes_in_spot(domain):
            points, _, _ = self.nodes(domain, formula)
            return np.count_nonzero(np.hypot(*(points - spot).T) < 0.004)

        self.assertEqual(nodes_in_spot(self.write_polygons(corners)), 0)
        text = (self.folder / "polygons.poly").read_text().splitlines()
        text[0] = "5 2 0 0"
        text.insert(5, f"4 {spot[0]} {spot[1]}")
        (self.folder / "with_node.poly").write_text("\n".join(text) + "\n")
        self.assertGreater(nodes_in_spot("with_node.poly"), 40)

    def test_curvature_of_a_circle(self):
        radius, middle = 2.5, np.array([10.0, -3.0])
        angles = np.arange(240) * 2 * np.pi / 240
        circle = middle + radius * np.stack([np.cos(angles), np.sin(angles)], axis=1)
        domain = self.write_polygons(circle)
        for n in (16, 40):
            with self.subTest(n):
                points, d, rim = self.nodes(domain, f"curvature({n})", "--corner-angle", "40")
                at_rim = 2 * np.pi * radius / n
                inwards = radius - np.linalg.norm(points - middle, axis=1)
                self.assertAlmostEqual(np.count_nonzero(rim), n, delta=1)
                np.testing.assert_allclose(d[rim], at_rim, rtol=2e-3)
                np.testing.assert_allclose(d, at_rim + GROWTH * inwards, rtol=2e-3)

    def test_curvature_of_two_circles(self):
        """Checks the curvature of a ring with a factor. The smaller circle has half the spacing."""
        angles = np.arange(240) * 2 * np.pi / 240
        unit = np.stack([np.cos(angles), np.sin(angles)], axis=1)
        domain = self.write_polygons(2 * unit, unit, hole=(0, 0))
        points, d, rim = self.nodes(domain, "0.5*curvature(20)", "--corner-angle", "40")
        r = np.hypot(*points.T)
        expected = 0.5 * np.minimum(2 * np.pi / 20 + GROWTH * (r - 1),
                                    2 * np.pi * 2 / 20 + GROWTH * (2 - r))
        np.testing.assert_allclose(d, expected, rtol=2e-3)
        self.assertAlmostEqual(np.count_nonzero(rim & (r < 1.01)), 40, delta=1)

    def test_curvature_of_a_ball(self):
        points, d, surface = self.nodes("ball(1,2,3, 0.5)", "curvature(18)")
        at_surface = 2 * np.pi * 0.5 / 18
        inwards = 0.5 - np.linalg.norm(points - [1, 2, 3], axis=1)
        self.assertGreater(np.count_nonzero(surface), 50)
        # Triangles approximate the ball, and small ones turn by slightly more.
        ratio = d / (at_surface + GROWTH * inwards)
        self.assertLess(ratio.max(), 1.01)
        self.assertGreater(ratio.min(), 0.92)
        self.assertGreater(ratio.mean(), 0.95)

    def test_curvature_of_a_cylinder(self):
        """Checks a cylinder. Its ends are flat, and the edges around them do not count as
        curvature."""
        points, d, _ = self.nodes("cylinder(0,0,0, 0,0,3, 0.5)", "curvature(14)")
        from_side = 0.5 - np.hypot(points[:, 0], points[:, 1])
        np.testing.assert_allclose(d, 2 * np.pi * 0.5 / 14 + GROWTH * from_side, rtol=0.02)

    def test_a_polygon_has_none(self):
        square = self.write_polygons(np.array([[0, 0], [4, 0], [4, 4], [0, 4.0]]))
        _, d, _ = self.nodes(square, "min(0.8, curvature(8))")
        np.testing.assert_array_equal(d, 0.8)

    def test_seglen_of_a_polygon(self):
        corners = np.array([[0, 0], [0.25, 0], [1, 0], [4, 0], [4, 2], [3.5, 2], [0, 2.0]])
        points, d, _ = self.nodes(self.write_polygons(corners), "seglen")
        expected = np.full(len(points), np.inf)
        for a, b in zip(corners, np.roll(corners, -1, axis=0)):
            reach = np.linalg.norm(b - a) + GROWTH * distances_to_segment(points, a, b)
            expected = np.minimum(expected, reach)
        np.testing.assert_allclose(d, expected, rtol=1e-9)
        self.assertLess(d.min(), 0.26)
        self.assertGreater(d.max(), 0.6)

    def test_seglen_of_an_octahedron(self):
        """Checks a body whose edges all have the same length. The spacing is a third of their mean
        length."""
        vertices = [[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]]
        triangles = [[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4],
                     [2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5]]
        points, d, _ = self.nodes(self.write_off(vertices, triangles), "seglen/3")
        inwards = (1 - np.abs(points).sum(axis=1)) / 3**0.5
        np.testing.assert_allclose(d, (2**0.5 + GROWTH * inwards) / 3, rtol=1e-6)

    def test_seglen_of_a_box(self):
        """Checks a box. Its triangles have two legs and a diagonal, and the smallest value of the
        adjacent triangles counts."""
        points, d, surface = self.nodes("box(0,0,0, 3,1,1)", "seglen/4")
        small, large = (2 + 2**0.5) / 3, (4 + 10**0.5) / 3  # at the ends, at the sides
        to_end = np.minimum(points[:, 0], 3 - points[:, 0])
        to_side = np.minimum(points[:, 1:], 1 - points[:, 1:]).min(axis=1)
        expected = np.minimum(small + GROWTH * to_end, large + GROWTH * to_side) / 4
        np.testing.assert_allclose(d, expected, rtol=1e-6)
        self.assertTrue(surface.any())

    def test_a_branch_alone(self):
        """Checks functions of the shape in one branch of a formula, which the origin does not take.
        """
        for asked in ("dist(1)", "gap(2)", "curvature(9)"):
            with self.subTest(asked):
                d = f"min({asked}, 0.2) + 0.05"
                self.place_body(self.square, f"x > 0.5 ? {d} : 0.1", "--field", f"d={d}", "-o", "nodes.csv",
                                "--set", "growth_limit=0", "--set", "steps=3", "--nodes-only", "-q")
                table = np.genfromtxt(self.folder / "nodes.csv", delimiter=",", names=True)
                expected = np.where(table["x"] > 0.5, table["d"], 0.1)
                np.testing.assert_allclose(table["spacing"], expected, rtol=1e-12)
                self.assertGreater(np.sum(expected != 0.1), 10)
        for wrong, words in (("dist(0.5)", "--spacing: dist(0.5): expected a tag"),
                             ("dist(1, 0.5)", "--spacing: dist(0.5): expected a tag"),
                             ("gap(0)", "--spacing: gap(0): expected a number"),
                             ("dist(77)", "argument tag = 77")):
            with self.subTest(wrong):
                self.assertIn(words, self.refuse("--domain", self.square, "--spacing",
                                                 f"x > 0.5 ? {wrong} : 0.1", "-o", "a.csv"))

    def test_numbers_that_are_none(self):
        for text in ("curvature(0)", "curvature(-3)", "curvature()", "curvature", "seglen(2)"):
            with self.subTest(text):
                self.refuse("--domain", self.square, "--spacing", text, "-o", "a.csv")


if __name__ == "__main__":
    unittest.main()
