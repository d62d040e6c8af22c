# SPDX-License-Identifier: BSD-3-Clause
"""Tests periodic domains in one process: the nodes and the elements fill the torus without a seam."""
import itertools
import unittest
import warnings

import numpy as np
import pnpbs
import scipy.spatial
from pnpbs import PNPBSError, Status

LOW, HIGH = np.array([-0.3, 0.2, 1.0]), np.array([0.7, 1.5, 1.9])


class Torus:
    """The results of a placement, with the images of nodes behind the nodes."""

    def __init__(self, placement, low, high, periodic):
        self.low, self.high = np.asarray(low, float), np.asarray(high, float)
        self.periodic = np.asarray(periodic, bool)
        nodes, ghosts = placement.nodes(), placement.ghosts()
        self.dim, self.count = nodes.points.shape[1], len(nodes.ids)
        self.points = np.vstack([nodes.points, ghosts.points])
        self.spacing = np.concatenate([nodes.spacing, ghosts.spacing])
        place = {number: k for k, number in enumerate(nodes.ids)}
        self.node = np.array([place[number] for number in [*nodes.ids, *ghosts.ids]])
        self.tags = nodes.tags
        self.elements = placement.triangles() if self.dim == 2 else placement.tetrahedra()
        self.adjacency = placement.adjacency()

    def periods(self):
        """Returns how many periods each node or image is away from its node."""
        way = self.points - self.points[self.node]
        return way / (self.high - self.low)

    def measures(self):
        x = self.points[self.elements]
        edges = x[:, 1:] - x[:, :1]
        return np.linalg.det(edges) / (2 if self.dim == 2 else 6)

    def edges(self):
        """Returns the edges of the elements, each once on the torus."""
        k = self.dim + 1
        pairs = np.vstack([self.elements[:, [a, b]] for a in range(k) for b in range(a)])
        way = np.rint(self.periods()[pairs[:, 1]] - self.periods()[pairs[:, 0]]).astype(int)
        a, b = self.node[pairs[:, 0]], self.node[pairs[:, 1]]
        turn = (b < a) | ((a == b) & (way[:, 0] < 0))
        a, b, way = np.where(turn, b, a), np.where(turn, a, b), np.where(turn[:, None], -way, way)
        _, first = np.unique(np.column_stack([a, b, way]), axis=0, return_index=True)
        return pairs[first]

    def ratios(self, edges):
        length = np.linalg.norm(self.points[edges[:, 1]] - self.points[edges[:, 0]], axis=1)
        return length / self.spacing[edges].mean(axis=1)


class Periodic(unittest.TestCase):
    def setUp(self):
        self.context = pnpbs.Context()
        self.addCleanup(self.context.close)

    def place(self, low, high, periodic, d, change=None, **options):
        dim = len(low)
        domain = pnpbs.Domain(self.context, dim).set_periodic(low, high, periodic)
        if change:
            change(domain)
        placement = pnpbs.Placement(domain, **options).set_spacing(d)
        placement.run()
        placement.check()
        torus = Torus(placement, low, high, np.broadcast_to(periodic, dim))
        self.assert_valid(torus)
        return domain, torus

    def assert_valid(self, torus):
        own = torus.points[: torus.count]
        across = torus.periodic
        self.assertTrue((own[:, across] >= torus.low[across]).all())
        self.assertTrue((own[:, across] < torus.high[across]).all())
        periods = torus.periods()
        np.testing.assert_allclose(periods, np.rint(periods), atol=1e-12)
        self.assertTrue((periods[:, ~across] == 0).all())
        self.assertTrue((torus.measures() > 0).all())
        self.assertTrue((np.abs(periods[torus.count :]).max(axis=1) > 0.5).all())

    def test_constant_spacing_in_the_plane(self):
        domain, torus = self.place(LOW[:2], HIGH[:2], True, 0.03)
        self.assertAlmostEqual(domain.measure(), 1.3, 12)
        self.assertAlmostEqual(torus.measures().sum(), 1.3, 10)
        # Euler's formula on the torus: V - E + F = 0, and three edges for each two triangles
        self.assertEqual(len(torus.elements), 2 * torus.count)
        self.assertEqual(len(torus.edges()), 3 * torus.count)
        offsets = torus.adjacency.offsets
        degrees = np.bincount(torus.node[torus.edges()].ravel())
        self.assertTrue((degrees == 6).all())
        self.assertEqual(len(offsets), torus.count + 1)

    def wave(self, shift=(0.0, 0.0, 0.0), finest=0.008, most=3.0):
        def d(x):
            turns = 2 * np.pi * (x - LOW[: x.shape[1]] - np.array(shift[: x.shape[1]])) / (
                HIGH - LOW)[: x.shape[1]]
            return finest * (1 + most * (1 - np.cos(turns)).mean(axis=1) / 2)

        return d

    def test_graded_spacing_has_no_seam(self):
        _, torus = self.place(LOW[:2], HIGH[:2], True, self.wave())
        edges = torus.edges()
        self.assertEqual(len(torus.elements), 2 * torus.count)
        seam = (edges >= torus.count).any(axis=1)
        ratios = torus.ratios(edges)
        self.assertGreater(seam.sum(), 100)
        self.assertLess(abs(ratios[seam].mean() - ratios[~seam].mean()), 0.015)
        self.assertLess(ratios[seam].max(), ratios[~seam].max() + 0.05)

    def test_shifted_input_gives_the_same_statistics(self):
        counts, means = [], []
        for shift in [(0, 0), (0.37, 0.11), (0.61, 0.9)]:
            _, torus = self.place(LOW[:2], HIGH[:2], True, self.wave(shift))
            counts.append(torus.count)
            means.append(torus.ratios(torus.edges()).mean())
        self.assertLess(np.ptp(counts), 0.01 * np.mean(counts))
        self.assertLess(np.ptp(means), 0.005)

    def test_channel_with_walls(self):
        domain, torus = self.place(LOW[:2], HIGH[:2], (True, False), 0.04)
        on_walls = torus.tags > 0
        y = torus.points[: torus.count][on_walls, 1]
        self.assertTrue(((y == LOW[1]) | (y == HIGH[1])).all())
        # V - E + F = 0 on the ring
        self.assertEqual(len(torus.elements), 2 * torus.count - on_walls.sum())
        self.assertAlmostEqual(torus.measures().sum(), domain.measure(), 10)

    def test_sides_have_their_tags(self):
        domain = pnpbs.Domain(self.context).set_periodic((0, 0), (1, 1), (False, True), (3, 4, 8, 9))
        placement = pnpbs.Placement(domain).set_spacing(0.1)
        placement.run()
        nodes = placement.nodes()
        self.assertEqual(set(nodes.tags[nodes.points[:, 0] == 0]), {3})
        self.assertEqual(set(nodes.tags[nodes.points[:, 0] == 1]), {4})

    def test_hole_across_the_corner(self):
        def hole(domain):
            domain.add_arc((LOW[0], HIGH[1]), 0.3, tag=5)

        domain, torus = self.place(LOW[:2], HIGH[:2], True, 0.03, hole)
        self.assertAlmostEqual(domain.measure(), 1.3 - np.pi * 0.09, 6)
        around = (torus.tags == 5).sum()
        # V - E + F = -1 on the torus with a hole
        self.assertEqual(len(torus.elements), 2 * torus.count - around + 2)
        turn = 2 * np.pi / around
        missing = 0.09 * (np.pi - np.sin(turn) * around / 2)
        self.assertAlmostEqual(torus.measures().sum(), domain.measure() + missing, 3)

    def test_inclusion_across_a_side(self):
        turns = np.linspace(0, 2 * np.pi, 200, endpoint=False)
        circle = np.column_stack([HIGH[0] + 0.2 * np.cos(turns), 0.8 + 0.2 * np.sin(turns)])

        def inclusion(domain):
            domain.add_polyline(circle, role="inner", corner_angle=30, tags=7)
            domain.add_region((HIGH[0] - 0.1, 0.8), 2)

        domain = pnpbs.Domain(self.context).set_periodic(LOW[:2], HIGH[:2])
        inclusion(domain)
        placement = pnpbs.Placement(domain).set_spacing(0.03)
        placement.run()
        placement.check()
        torus = Torus(placement, LOW[:2], HIGH[:2], (True, True))
        self.assertAlmostEqual(torus.measures().sum(), 1.3, 10)
        inside = torus.measures()[placement.element_tags() == 2].sum()
        self.assertAlmostEqual(inside, np.pi * 0.04, 2)

    def test_constant_spacing_in_space(self):
        domain, torus = self.place(LOW, HIGH, True, 0.09)
        self.assertAlmostEqual(domain.measure(), 1.17, 10)
        self.assertAlmostEqual(torus.measures().sum(), 1.17, 10)
        # Euler's formula on the torus: V - E + F - T = 0, and four faces for each two tetrahedra
        self.assertEqual(len(torus.edges()) - torus.count, len(torus.elements))

    def test_graded_spacing_in_space(self):
        _, torus = self.place(LOW, HIGH, True, self.wave(finest=0.07, most=0.6))
        self.assertAlmostEqual(torus.measures().sum(), 1.17, 9)
        edges = torus.edges()
        self.assertEqual(len(edges) - torus.count, len(torus.elements))
        seam = (edges >= torus.count).any(axis=1)
        ratios = torus.ratios(edges)
        self.assertLess(abs(ratios[seam].mean() - ratios[~seam].mean()), 0.02)

    def test_layer_in_space(self):
        domain = pnpbs.Domain(self.context, 3).set_periodic(LOW, HIGH, (True, True, False))
        placement = pnpbs.Placement(domain).set_spacing(0.09)
        placement.run()
        placement.check()
        torus = Torus(placement, LOW, HIGH, (True, True, False))
        self.assert_valid(torus)
        self.assertAlmostEqual(torus.measures().sum(), 1.17, 10)
        facets, _ = placement.boundary_triangles()
        x = torus.points[facets]
        areas = np.linalg.norm(np.cross(x[:, 1] - x[:, 0], x[:, 2] - x[:, 0]), axis=1) / 2
        self.assertAlmostEqual(areas.sum(), 2 * 1.3, 10)

    def test_cavity_across_a_corner_of_space(self):
        corners = [(s * 0.3, 0, 0) for s in (1, -1)] + [(0, s * 0.3, 0) for s in (1, -1)]
        corners = np.array(corners + [(0, 0, s * 0.3) for s in (1, -1)])
        faces = [(0, 2, 4), (2, 1, 4), (1, 3, 4), (3, 0, 4)]
        faces += [(b, a, 5) for a, b, _ in faces]

        def octahedron(domain):
            domain.add_surface(corners + (LOW[0], HIGH[1], LOW[2] + 0.1), faces, tags=4)

        domain, torus = self.place(LOW, HIGH, True, 0.09, octahedron)
        volume = 1.17 - 4 / 3 * 0.027
        self.assertAlmostEqual(domain.measure(), volume, 12)
        self.assertAlmostEqual(torus.measures().sum(), volume, 9)
        self.assertEqual(set(torus.tags), {0, 4})

    def test_second_run_with_another_spacing(self):
        domain = pnpbs.Domain(self.context).set_periodic(LOW[:2], HIGH[:2])
        placement = pnpbs.Placement(domain).set_spacing(0.05)
        placement.run()
        placement.set_spacing(self.wave(finest=0.015))
        placement.run()
        placement.check()
        torus = Torus(placement, LOW[:2], HIGH[:2], (True, True))
        self.assert_valid(torus)
        self.assertEqual(len(torus.elements), 2 * torus.count)

    def triangles_around(self, torus):
        """Returns the corners of all triangles and of their images, and d at the corners."""
        moves = [(a, b) for a in (-1, 0, 1) for b in (-1, 0, 1)]
        period = torus.high - torus.low
        x = np.vstack([torus.points[torus.elements] + move * period for move in moves])
        return x, np.tile(torus.elements, (len(moves), 1))

    def interpolated(self, torus, values, at):
        """Returns values at nodes and images, interpolated in the triangles around points."""
        x, corners = self.triangles_around(torus)
        edges = np.linalg.inv((x[:, 1:] - x[:, :1]).transpose(0, 2, 1))
        result = []
        for point in at:
            weights = np.einsum("tij,tj->ti", edges, point - x[:, 0])
            weights = np.column_stack([1 - weights.sum(axis=1), weights])
            inside = weights.min(axis=1).argmax()
            self.assertGreater(weights[inside].min(), -1e-9)
            result.append(weights[inside] @ values[corners[inside]])
        return np.array(result)

    def test_spacing_at_nodes(self):
        domain = pnpbs.Domain(self.context).set_periodic(LOW[:2], HIGH[:2])
        placement = pnpbs.Placement(domain).set_spacing(self.wave(finest=0.025))
        placement.run()
        before = Torus(placement, LOW[:2], HIGH[:2], (True, True))
        d = self.wave((0.5, 0.3), finest=0.02)(before.points)
        placement.set_spacing(d[: before.count])
        placement.run()
        placement.check()
        torus = Torus(placement, LOW[:2], HIGH[:2], (True, True))
        self.assert_valid(torus)
        self.assertEqual(len(torus.elements), 2 * torus.count)
        own = slice(torus.count)
        expected = self.interpolated(before, d, torus.points[own])
        np.testing.assert_allclose(torus.spacing[own], expected, rtol=1e-12)

    def test_spacing_at_nodes_beside_a_hole_across_the_corner(self):
        domain = pnpbs.Domain(self.context).set_periodic(LOW[:2], HIGH[:2])
        domain.add_arc((LOW[0], HIGH[1]), 0.3, tag=5)
        placement = pnpbs.Placement(domain).set_spacing(0.08)
        placement.run()
        before = Torus(placement, LOW[:2], HIGH[:2], (True, True))
        around = np.flatnonzero(before.tags == 5)
        corner = np.array([LOW[0], HIGH[1]])
        period = HIGH[:2] - LOW[:2]

        def from_corner(x):
            return (x - corner) - period * np.rint((x - corner) / period)

        d = 0.05 + 0.02 * from_corner(before.points)[:, 0] / 0.3
        placement.set_spacing(d[: before.count])
        placement.run()
        torus = Torus(placement, LOW[:2], HIGH[:2], (True, True))
        # A node on the hole has d of the two nodes before that are nearest on the circle.
        x = torus.points[: torus.count]
        for k in np.flatnonzero(torus.tags == 5):
            way = from_corner(before.points[around] - from_corner(x[k]))
            two = np.argsort(np.linalg.norm(way, axis=1))[:2]
            low, high = sorted(d[around[two]])
            self.assertTrue(low - 1e-12 <= torus.spacing[k] <= high + 1e-12)

    def test_transfer_across_seams(self):
        domain = pnpbs.Domain(self.context).set_periodic(LOW[:2], HIGH[:2])
        placement = pnpbs.Placement(domain).set_spacing(0.07)
        placement.run()
        before = Torus(placement, LOW[:2], HIGH[:2], (True, True))
        turns = 2 * np.pi * (before.points - LOW[:2]) / (HIGH - LOW)[:2]
        values = np.sin(turns[:, 0]) + np.cos(turns[:, 1])
        field = pnpbs.Transfer(placement, values[: before.count])
        random = np.random.default_rng(3)
        inside = LOW[:2] + random.random((200, 2)) * (HIGH - LOW)[:2]
        inside[:40, 0] = LOW[0]
        periods = random.integers(-3, 4, (200, 2))
        expected = self.interpolated(before, values, inside)
        np.testing.assert_allclose(field.at_points(inside), expected, atol=1e-12)
        beyond = inside + periods * (HIGH - LOW)[:2]
        np.testing.assert_allclose(field.at_points(beyond), expected, atol=1e-12)

        def integral(torus, values):
            return (torus.measures() * values[torus.elements].mean(axis=1)).sum()

        placement.set_spacing(self.wave(finest=0.03))
        placement.run()
        torus = Torus(placement, LOW[:2], HIGH[:2], (True, True))
        there = field.at_nodes(placement, conserve=True)
        self.assertAlmostEqual(integral(torus, there[torus.node]), integral(before, values), 12)

    def assert_status(self, status, part, function, *arguments, **keywords):
        with self.assertRaises(PNPBSError) as caught:
            function(*arguments, **keywords)
        self.assertEqual(caught.exception.status, status)
        self.assertIn(part, str(caught.exception))

    def test_bad_input(self):
        domain = pnpbs.Domain(self.context)
        wrong = Status.ERROR_ARGUMENT
        self.assert_status(wrong, "low[1] is 2", domain.set_periodic, (0, 2), (1, 2))
        self.assert_status(wrong, "no axis", domain.set_periodic, (0, 0), (1, 1), False)
        domain.set_periodic((0, 0), (1, 1))
        placement = pnpbs.Placement(domain).set_spacing(0.3)
        self.assert_status(Status.ERROR_SPACING, "less than 4 spacings", placement.run)

    def test_curves_that_do_not_meet(self):
        domain = pnpbs.Domain(self.context).set_periodic((0, 0), (1, 1))
        domain.add_polyline([(0, 0.3), (0.5, 0.4), (1, 0.31)], closed=False, role="inner")
        self.assert_status(Status.ERROR_DOMAIN, "curve 0 ends on a side of the periodic domain at "
                           "(0, 0.3), and no curve goes on from (1, 0.3)", domain.check)

    def test_surfaces_that_do_not_meet(self):
        domain = pnpbs.Domain(self.context, 3).set_periodic((0, 0, 0), (1, 1, 1))
        sheet = [(0, 0, 0.3), (1, 0, 0.4), (1, 1, 0.4), (0, 1, 0.3)]
        domain.add_surface(sheet, [(0, 1, 2), (0, 2, 3)], role="inner")
        self.assert_status(Status.ERROR_DOMAIN, "of surface 0 ends on a side of the periodic domain",
                           domain.check)

    def test_spacing_that_is_not_periodic(self):
        placement = pnpbs.Placement(pnpbs.Domain(self.context).set_periodic((0, 0), (1, 1)))
        placement.set_spacing(lambda x: 0.02 + 0.04 * x[:, 1])
        self.assert_status(Status.ERROR_SPACING, ", 0), and d = 0.06 at (0.0", placement.run)

    def sphere(self, centre, radius, rounds=2):
        """Returns the vertices and triangles of an icosahedron whose faces are divided."""
        golden = (1 + 5 ** 0.5) / 2
        x = [(0, s, t * golden) for s in (-1, 1) for t in (-1, 1)]
        x = np.array([np.roll(v, k) for v in x for k in range(3)], float)
        apart = np.linalg.norm(x[:, None] - x[None], axis=2)
        near = (apart > 1) & (apart < 2.1)
        faces = [(a, b, c) for a in range(12) for b in range(a) for c in range(b)
                 if near[a, b] and near[b, c] and near[a, c]]
        triangles = x[np.array(faces)]
        turned = np.linalg.det(triangles) < 0
        triangles[turned] = triangles[turned][:, ::-1]
        for _ in range(rounds):
            a, b, c = np.moveaxis(triangles, 1, 0)
            ab, bc, ca = a + b, b + c, c + a
            triangles = np.concatenate([np.stack(t, 1) for t in [
                (a, ab / 2, ca / 2), (b, bc / 2, ab / 2), (c, ca / 2, bc / 2),
                (ab / 2, bc / 2, ca / 2)]])
        triangles /= np.linalg.norm(triangles, axis=2)[..., None]
        points, corners = np.unique(triangles.reshape(-1, 3).round(12), axis=0, return_inverse=True)
        return points * radius + centre, corners.reshape(-1, 3)

    def spheres(self, count, share, seed=3):
        """Returns the centres and the radius of spheres that do not touch on the unit torus."""
        random = np.random.default_rng(seed)
        radius = (share / count * 3 / 4 / np.pi) ** (1 / 3)
        centres = random.random((count, 3))
        for _ in range(10000):
            way = centres[:, None] - centres[None]
            way -= np.rint(way)
            apart = np.linalg.norm(way, axis=2) + 9 * np.eye(count)
            overlap = np.maximum(0, 2.15 * radius - apart)
            if overlap.max() < 0.02 * radius:
                return centres, radius
            centres = (centres + 0.5 * ((overlap / apart)[..., None] * way).sum(axis=1)) % 1
        raise AssertionError("the spheres have no room")

    def test_channel_in_space(self):
        axes = (True, False, False)

        def d(x):
            return 0.1 * (1 + 0.3 * np.sin(2 * np.pi * x[:, 0]) ** 2)

        for length, spacing in [(1.07, 0.1), (1, d)]:
            domain, torus = self.place((0, 0, 0), (length, 0.5, 0.5), axes, spacing)
            self.assertAlmostEqual(torus.measures().sum(), 0.25 * length, 10)

    def test_crease_across_a_side(self):
        low, high = (0, 0, 0), (1, 1, 1)
        x, y = np.meshgrid([0, 0.53, 1], [0, 1])
        roof = np.column_stack([x.ravel(), y.ravel(), np.where(x == 0.53, 0.7, 0.3).ravel()])
        domain = pnpbs.Domain(self.context, 3).set_periodic(low, high, (True, True, False))
        domain.add_surface(roof, [(0, 1, 4), (0, 4, 3), (1, 2, 5), (1, 5, 4)], role="inner", tags=4)
        domain.add_region((0.5, 0.5, 0.1), 2).add_region((0.1, 0.1, 0.9), 3)

        def d(x):
            return 0.11 * (1 + 0.3 * np.sin(2 * np.pi * x[:, 1]) ** 2)

        placement = pnpbs.Placement(domain).set_spacing(d)
        placement.run()
        placement.check()
        torus = Torus(placement, low, high, (True, True, False))
        self.assert_valid(torus)
        inside = np.bincount(placement.element_tags(), torus.measures())
        np.testing.assert_allclose(inside, [0, 0, 0.5, 0.5], atol=1e-10)

    def test_polycrystal(self):
        centres = np.array([(0.1, 0.2, 0.3), (0.63, 0.7, 0.81)])  # nearly truncated octahedra
        grains = len(centres)
        shifts = np.array(list(itertools.product((0, -1, 1), repeat=3)))
        copies = (centres + shifts[:, None]).reshape(-1, 3)
        cells = scipy.spatial.Voronoi(copies)
        points, triangles, seen = [], [], set()
        for (a, b), face in zip(cells.ridge_points, cells.ridge_vertices):
            if min(a, b) >= grains:
                continue
            middle = np.round(copies[[a, b]].mean(axis=0) % 1, 9) % 1  # the same for all images
            if tuple(middle) not in seen:
                seen.add(tuple(middle))
                first = len(points)
                points.extend(cells.vertices[face])
                triangles += [(first, first + k, first + k + 1) for k in range(1, len(face) - 1)]
        domain = pnpbs.Domain(self.context, 3).set_periodic((0, 0, 0), (1, 1, 1))
        domain.add_surface(np.array(points), triangles, role="inner", tags=10, feature_angle=5)
        for k, centre in enumerate(centres):
            domain.add_region(centre, 2 + k)
        placement = pnpbs.Placement(domain).set_spacing(0.13)
        placement.run()
        placement.check()
        torus = Torus(placement, (0, 0, 0), (1, 1, 1), (True, True, True))
        self.assert_valid(torus)
        volumes = [scipy.spatial.ConvexHull(cells.vertices[cells.regions[cells.point_region[k]]])
                   .volume for k in range(grains)]
        found = np.bincount(placement.element_tags(), torus.measures())
        np.testing.assert_allclose(found, [0, 0, *volumes], atol=1e-9)

    def test_many_cavities(self):
        centres, radius = self.spheres(60, 0.3)
        domain = pnpbs.Domain(self.context, 3).set_periodic((0, 0, 0), (1, 1, 1))
        points, corners = self.sphere((0, 0, 0), radius)
        for centre in centres:
            domain.add_surface(points + centre, corners)
        domain.check()
        volume = 1 - len(centres) * np.linalg.det(points[corners]).sum() / 6
        self.assertAlmostEqual(domain.measure(), volume, 12)

    def test_spheres_across_a_side(self):
        low, high, radius = (0, 0, 0), (1.2, 0.7, 0.7), 0.22
        domain = pnpbs.Domain(self.context, 3).set_periodic(low, high, (True, False, False))
        points, corners = self.sphere((0, 0, 0), radius)
        for k, x in enumerate([-0.1, 0.5]):
            domain.add_surface(points + (x, 0.35, 0.35), corners, role="inner", tags=5)
            domain.add_region((x, 0.35, 0.35), 2 + k)
        placement = pnpbs.Placement(domain).set_spacing(0.1)
        with warnings.catch_warnings():
            warnings.simplefilter("error", pnpbs.ElementsWarning)
            placement.run()
        placement.check()
        torus = Torus(placement, low, high, (True, False, False))
        self.assert_valid(torus)
        regions = np.bincount(placement.element_tags(), torus.measures())
        self.assertAlmostEqual(regions.sum(), np.prod(high), 10)
        # Chords of a sphere with a radius of two spacings lie well inside of it.
        enclosed = np.linalg.det(points[corners]).sum() / 6
        self.assertEqual(len(regions), 4)
        self.assertLess(np.abs(regions[2:] / enclosed - 0.92).max(), 0.03)

    def test_unsupported(self):
        layer = pnpbs.Domain(self.context, 3)
        self.assert_status(Status.ERROR_UNSUPPORTED, "along axis 0 and not along axis 1",
                           layer.set_periodic, (0, 0, 0), (1, 1, 1), True, flat=(True, False, True))
        domain = pnpbs.Domain(self.context).set_periodic((0, 0), (1, 1))
        placement = pnpbs.Placement(domain).set_spacing(0.1)
        placement.run()
        self.assert_status(Status.ERROR_UNSUPPORTED, "periodic", placement.voronoi)


if __name__ == "__main__":
    unittest.main()
