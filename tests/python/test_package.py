# SPDX-License-Identifier: BSD-3-Clause
"""Tests the Python package in one process."""
import contextlib
import ctypes
import gc
import importlib
import importlib.util
import io
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest
import unittest.mock
import warnings

import netCDF4
import numpy as np
import pnpbs
from mesh_checks import check_mesh, measures
from pnpbs import PNPBSError, Status, _levels

DATA = pathlib.Path(os.environ["PNPBS_SOURCE_DIR"]) / "examples" / "data"
SQUARE = [(0, 0), (1, 0), (1, 1), (0, 1)]


def graded(x):
    return 0.05 + 0.05 * x[:, 0]


def numbers_of_nodes(rows):
    """Returns the node numbers in the order of a .msh file of version 4.1 with these lines."""
    at, numbers = rows.index("$Nodes") + 2, []
    while rows[at] != "$EndNodes":
        count = int(rows[at].split()[3])
        numbers += map(int, rows[at + 1 : at + 1 + count])
        at += 1 + 2 * count
    return numbers


class Case(unittest.TestCase):
    def setUp(self):
        self.context = pnpbs.Context()
        self.addCleanup(self.context.close)

    def square(self, **options):
        domain = pnpbs.Domain(self.context).add_polyline(SQUARE)
        return pnpbs.Placement(domain, **options)

    def assert_status(self, status, function, *arguments, **keywords):
        with self.assertRaises(PNPBSError) as caught:
            function(*arguments, **keywords)
        self.assertEqual(caught.exception.status, status)
        return str(caught.exception)


class Results(Case):
    def setUp(self):
        super().setUp()
        self.placement = self.square().set_spacing(graded)
        self.assertEqual(self.placement.run(), Status.OK)

    def test_nodes(self):
        nodes = self.placement.nodes()
        n = self.placement.node_count
        self.assertEqual(nodes.points.shape, (n, 2))
        self.assertEqual(sorted(nodes.ids), list(range(n)))
        on_boundary = (np.isclose(nodes.points, 0) | np.isclose(nodes.points, 1)).any(axis=1)
        np.testing.assert_array_equal(nodes.tags != 0, on_boundary)
        np.testing.assert_array_equal(nodes.spacing, graded(nodes.points))

    def test_adjacency(self):
        points, lists = self.placement.nodes().points, self.placement.adjacency()
        self.assertEqual(len(lists), len(points))
        self.assertEqual(len(lists[3:5]), 2)
        np.testing.assert_array_equal(lists[-1], lists[len(lists) - 1])
        with self.assertRaises(IndexError):
            lists[len(lists)]
        pairs = {(i, j) for i, row in enumerate(lists) for j in row}
        self.assertEqual(pairs, {(j, i) for i, j in pairs})
        near = {(i, j) for i in range(len(points)) for j in range(len(points)) if i != j
                and np.hypot(*(points[i] - points[j])) < 0.05}  # the smallest d
        self.assertTrue(near and near <= pairs)

    def test_triangles(self):
        points, triangles = self.placement.nodes().points, self.placement.triangles()
        a, b, c = (points[triangles[:, k]] for k in range(3))
        u, v = b - a, c - a
        areas = (u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]) / 2
        self.assertTrue((areas > 0).all())
        self.assertAlmostEqual(areas.sum(), 1, 12)
        edges, tags = self.placement.boundary_edges()
        lengths = np.linalg.norm(points[edges[:, 0]] - points[edges[:, 1]], axis=1)
        self.assertAlmostEqual(lengths.sum(), 4, 12)
        self.assertTrue((tags != 0).all())
        stars = self.placement.stars()
        self.assertEqual(stars.triangle.values.sum(), 3 * len(triangles))

    def test_tables_and_statistics(self):
        self.assertEqual(self.placement.statistic("nodes"), self.placement.node_count)
        self.assertEqual(set(self.placement.statistics()),
                         {row.name for row in pnpbs.statistic_table()})
        self.assertEqual(len(self.placement.statistic("hash")), 16)
        self.assertIn("steps", {row.name for row in pnpbs.option_table()})
        self.assertIn("vtu", " ".join(row.name for row in pnpbs.format_table()))
        bands = self.placement.edge_bands()
        self.assertTrue((abs(bands.mean - 1) < 0.1).all() and len(bands.mean) > 3)
        cells = self.placement.cell_bands("edge_ratio")
        np.testing.assert_array_equal(cells.d_from, bands.d_from)
        self.assertTrue(((0 < cells.worst) & (cells.worst <= cells.mean) & (cells.mean < 1)).all())
        self.assertEqual(cells.worst.min(), self.placement.statistic("cell.min_edge_ratio"))
        with self.assertRaisesRegex(pnpbs.PNPBSError, "dual_offset"):
            self.placement.cell_bands("dual_ofset")
        self.assertEqual(pnpbs.library_version()[:2], (0, 2))
        self.assertIn("Kokkos", pnpbs.build_info())
        self.assertEqual([pnpbs.file_dimension(name) for name in ("part.stl", "land.geojson")], [3, 2])
        self.placement.check()

    def test_numbering_without_ranks(self):
        self.assertEqual(self.placement.ghost_count(), 0)
        self.assertEqual(len(self.placement.exchange_pattern().ranks), 0)
        first, count, ghosts = self.placement.numbering()
        self.assertEqual((first, count, len(ghosts)), (0, self.placement.node_count, 0))

    def test_files(self):
        with tempfile.TemporaryDirectory() as folder:
            paths = [pathlib.Path(folder, name) for name in ("nodes.vtu", "nodes.csv")]
            self.placement.write(*paths, elements=[True, False])
            with open(paths[1], encoding="ascii") as file:
                self.assertEqual(len(file.readlines()), self.placement.node_count + 1)
            message = self.assert_status(Status.ERROR_FILE, self.placement.write,
                                         pathlib.Path(folder, "none", "nodes.vtu"))
            self.assertIn("nodes.vtu", message)

    def test_files_by_meshio(self):
        meshio = importlib.import_module("meshio")
        with tempfile.TemporaryDirectory() as folder:
            for name in "a.inp", "a.mesh", "a.exo":
                self.assertEqual(self.placement.write(pathlib.Path(folder) / name), Status.OK)
                read = meshio.read(pathlib.Path(folder) / name)
                np.testing.assert_allclose(read.points[:, :2], self.placement.mesh().coordinates)
                self.assertEqual(len(read.cells_dict["triangle"]), len(self.placement.triangles()))
            for names, order in ((["c.inp"], 2), (["c.vtu", "c.inp"], 1)):
                with self.assertRaisesRegex(ValueError, "c.inp' would be written by meshio, which takes one"):
                    self.placement.write(*(pathlib.Path(folder) / name for name in names), order=order)
            with self.assertRaisesRegex(ValueError, "would be a picture: draw it with `plot`"):
                self.placement.write(pathlib.Path(folder) / "a.png")

    def test_elements_in_the_formats_that_have_them(self):
        with tempfile.TemporaryDirectory() as folder:
            files = [pathlib.Path(folder) / name for name in ("a.vtu", "a.csv")]
            self.placement.write(*files, elements=True)
            self.placement.write(pathlib.Path(folder) / "b.vtu", elements=True)
            self.placement.write(pathlib.Path(folder) / "b.csv")
            for file in files:
                self.assertEqual(file.read_bytes(), (pathlib.Path(folder) / f"b{file.suffix}").read_bytes())

    def test_output_fields(self):
        nodes = self.placement.nodes()
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "a.msh")
            self.placement.add_output_field("u", range(len(nodes.ids)))
            self.placement.add_output_field("flow", nodes.points).write(path)
            rows = path.read_text(encoding="ascii").splitlines()
            at = rows.index('"flow"') + 7
            found = np.array([row.split() for row in rows[at : at + len(nodes.ids)]], float)
            np.testing.assert_array_equal(found[:, 0], numbers_of_nodes(rows))
            found = found[np.argsort(found[:, 0])]
            np.testing.assert_array_equal(found[:, 1:3], nodes.points[np.argsort(nodes.ids)])
            self.assertIn('"u"', self.assert_status(
                Status.ERROR_ARGUMENT, self.placement.add_output_field, "u", nodes.spacing))
            self.placement.clear_output_fields().write(path)
            self.assertNotIn('"flow"', path.read_text(encoding="ascii"))

    def test_checkpoints(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "a.vtkhdf")
            if "HDF5: none" in pnpbs.build_info():
                self.assert_status(Status.ERROR_UNSUPPORTED, self.placement.write_checkpoint, path)
                return
            turns = []

            def write_once(_fraction, step, _nodes, _max_speed):
                if step > 0 and not turns:
                    try:
                        whole.write_checkpoint(path)
                        turns.append(step)
                    except pnpbs.PNPBSError as error:
                        self.assertEqual(error.status, Status.ERROR_STATE)
                return False

            whole = self.square(levels=0).set_spacing(graded).set_monitor(write_once)
            whole.run()
            again = self.square(levels=0).set_spacing(graded).read_checkpoint(path)
            self.assertEqual(again.statistic("steps"), turns[0])
            again.run()
            self.assertEqual(again.statistic("hash"), whole.statistic("hash"))
            other = self.square(levels=0).set_spacing(0.2)
            message = self.assert_status(Status.ERROR_SPACING, other.read_checkpoint, path)
            self.assertIn("a.vtkhdf", message)

    def test_nodes_given_again_are_the_start(self):
        nodes = self.placement.nodes()
        inner = nodes.tags == 0
        other = self.square(steps=0, sweeps=0).set_spacing(graded)
        other.set_nodes(nodes.points[inner], ids=np.arange(inner.sum()))
        other.initialise()
        found = {tuple(p) for p in other.nodes().points}
        self.assertLessEqual({tuple(p) for p in nodes.points[inner]}, found)
        with self.assertRaises(ValueError):
            other.set_nodes(nodes.points[inner], ids=[1, 2])

    def test_population_and_steps(self):
        placement = self.square().set_spacing(0.1)
        placement.initialise()
        self.assertGreaterEqual(placement.adjust_population().inserted, 0)
        self.assertEqual(placement.step(1), Status.NOT_CONVERGED)
        placement.rebalance()
        estimate = placement.estimate()
        self.assertAlmostEqual(estimate.nodes / placement.node_count, 1, delta=0.1)

    def test_warnings(self):
        placement = self.square().set_spacing(lambda x: np.minimum(0.02 + 2 * abs(x[:, 0] - 0.5), 0.2))
        with self.assertWarns(pnpbs.SpacingWarning) as caught:
            placement.initialise()
        data = caught.warning.data
        self.assertEqual((data.code, data.count), (pnpbs.WarningCode.GROWTH, 0))
        self.assertAlmostEqual(data.value, 2, delta=0.1)
        self.assertAlmostEqual(data.point[0], 0.5, delta=0.15)
        self.assertEqual(len(data.point), 2)
        self.assertIn(data.text, placement.warnings())
        self.assertEqual(len(placement.warning_data()), len(placement.warnings()))
        self.assertTrue(str(caught.filename).endswith("test_package.py"))
        with warnings.catch_warnings(record=True) as again:  # each warning is issued once
            warnings.simplefilter("always")
            placement.step(1)
        self.assertEqual(again, [])
        self.assertEqual(pnpbs.WarningCode(999), pnpbs.WarningCode.UNKNOWN)


class Spacings(Case):
    def test_all_kinds_agree(self):
        hashes = []
        grid = 0.05 + 0.05 * np.linspace(0, 1, 5)[:, None] * np.ones(3)
        for d in ({"d": graded}, {"d": grid, "origin": (0, 0), "step": (0.25, 0.5)}):
            placement = self.square().set_spacing(**d)
            placement.run()
            hashes.append(placement.nodes().points)
        self.assertEqual(len(hashes[0]), len(hashes[1]))
        np.testing.assert_allclose(hashes[0], hashes[1], atol=1e-6)

    def test_hints_show_spots_between_the_samples(self):
        """Two spots in a box, each much narrower than the distance of the samples of d; a point
        outside the box is ignored."""
        spots = np.array([[0.2137, 0.3519, 0.6271], [0.7711, 0.6093, 0.3377]])

        def distances(x):
            return np.linalg.norm(x[:, None] - spots, axis=2)

        def spacing(x):
            return np.where((distances(x) < 0.012).any(axis=1), 0.004, 0.2)

        domain = pnpbs.Domain(self.context, dim=3).add_box((0, 0, 0), (1, 1, 1))
        placement = pnpbs.Placement(domain).set_spacing(spacing)
        placement.run()
        self.assertEqual(np.sum(distances(placement.nodes().points) < 0.012), 0)
        with self.assertRaisesRegex(ValueError, "shape"):
            placement.add_spacing_hints(np.zeros((1, 2)))
        placement.add_spacing_hints(np.zeros((0, 3))).add_spacing_hints([*(spots + 0.003), (9, 9, 9)])
        placement.run()
        inside = np.sum(distances(placement.nodes().points) < 0.012, axis=0)
        self.assertTrue((inside > 60).all(), inside)  # 4/3 pi r^3 / (0.707 d^3) = 160
        placement.check()

    def test_a_number_for_all_points(self):
        placement = self.square().set_spacing(lambda x: 0.1)
        self.assertEqual(placement.run(), Status.OK)
        other = self.square().set_spacing(0.1)
        other.run()
        np.testing.assert_array_equal(placement.nodes().points, other.nodes().points)

    def test_strict(self):
        placement = self.square(steps=1, coarsest_steps=1).set_spacing(0.05)
        with self.assertRaisesRegex(pnpbs.OutcomeError, "NOT_CONVERGED") as caught:
            placement.run(strict=True)
        self.assertEqual(caught.exception.status, Status.NOT_CONVERGED)
        self.assertGreater(placement.node_count, 100)
        with self.assertWarnsRegex(pnpbs.PNPBSWarning, "not come to rest; allow more steps"):
            self.assertEqual(placement.run(), Status.NOT_CONVERGED)
        placement.set(steps=1000)
        self.assertEqual(placement.run(strict=True), Status.OK)

    def test_values_at_given_points(self):
        points = np.array([[-1, -1], [2, -1], [2, 2], [-1, 2.0]])
        d = 0.05 + 0.02 * (points[:, 0] + 1)
        corners = [[0, 1, 2], [3, 2, 0]]
        rows = "".join(f"{x},{y},7,{v}\n" for (x, y), v in zip(points, d))
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        path = pathlib.Path(folder.name) / "points.csv"
        path.write_text("x,y,other,d\n" + rows)
        for set_spacing in (lambda p: p.set_spacing_mesh(points, d, corners),
                            lambda p: p.set_spacing_points(points, d),
                            lambda p: p.set_spacing_file(path, "d")):
            placement = set_spacing(self.square(steps=20))
            placement.run()
            nodes = placement.nodes()
            np.testing.assert_allclose(nodes.spacing, 0.07 + 0.02 * nodes.points[:, 0], atol=1e-9)
        self.assert_status(Status.ERROR_ARGUMENT, placement.set_spacing_mesh, points, d, [[0, 1, 4]])
        self.assert_status(Status.ERROR_SPACING, placement.set_spacing_points, points, -d)
        self.assert_status(Status.ERROR_FILE, placement.set_spacing_file, path, "e")
        self.assert_status(Status.ERROR_FILE, placement.set_spacing_file, path)
        with self.assertRaises(ValueError):
            placement.set_spacing_points(points, d[:3])
        with self.assertRaises(ValueError):
            placement.set_spacing_mesh(points, d, [[0, 1, 2, 3]])

    def test_adapting(self):
        placement = self.square().set_spacing(0.1)
        placement.run()
        before = placement.node_count
        placement.set_spacing(placement.nodes().spacing / 2)
        placement.run()
        self.assertAlmostEqual(placement.node_count / before, 4, delta=0.8)
        self.assert_status(Status.ERROR_ARGUMENT, placement.set_spacing, [0.1, 0.1])

    def test_wrong_answers(self):
        placement = self.square().set_spacing(lambda x: [0.1, 0.1])
        with self.assertRaisesRegex(ValueError, "spacing function"):
            placement.run()
        placement.set_spacing(lambda x: -graded(x))
        self.assertIn("-0.", self.assert_status(Status.ERROR_SPACING, placement.run))
        placement.set_spacing(lambda x: 1 / 0)
        with self.assertRaises(ZeroDivisionError):
            placement.run()
        for d, error, words in (("auto", TypeError, "d is 'auto'"), (None, TypeError, "d is None"),
                                ([1 + 1j], TypeError, "real numbers"),
                                (np.ones((3, 2)), ValueError, "one dimension")):
            with self.assertRaisesRegex(error, words):
                placement.set_spacing(d)
        placement.set_spacing(0.1)
        self.assertEqual(placement.run(), Status.OK)


class Domains(Case):
    def test_in_the_plane(self):
        domain = pnpbs.Domain(self.context)
        domain.add_polyline([(0, 0), (4, 0), (4, 2), (0, 2)], tags=[1, 2, 3, 4])
        domain.add_arc((1, 1), 0.5, tag=5).add_fixed_nodes([(3, 1)], tags=9)
        domain.add_curve(lambda t: np.stack([2.5 + 0.3 * np.cos(t), 1 + 0.2 * np.sin(t)], axis=1), 0,
                         2 * np.pi, tag=6)
        self.assertAlmostEqual(domain.measure(), 8 - np.pi * (0.25 + 0.06), 3)
        low, high = domain.bounds()
        np.testing.assert_array_equal([low, high], [[0, 0], [4, 2]])
        self.assertEqual(set(domain.outline().tags), {1, 2, 3, 4, 5, 6})
        placement = pnpbs.Placement(domain).set_spacing(0.2)
        domain.close()
        placement.run()
        nodes = placement.nodes()
        self.assertEqual(set(nodes.tags), {0, 1, 2, 3, 4, 5, 6, 9})
        np.testing.assert_array_equal(nodes.points[nodes.tags == 9], [(3, 1)])

    def test_graphs_and_files(self):
        square = np.array(SQUARE, float)
        points = np.concatenate([square, 0.25 + square / 2])
        ring = [(0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4)]
        domain = pnpbs.Domain(self.context).add_pslg(points, ring, holes=[(0.5, 0.5)])
        self.assertAlmostEqual(domain.measure(), 0.75)
        lake = pnpbs.Domain(self.context).read_poly(DATA / "lake_victoria.poly").check()
        text = (DATA / "lake_victoria.poly").read_text(encoding="ascii")
        self.assertEqual(pnpbs.Domain(self.context).parse_poly(text).measure(), lake.measure())
        self.assert_status(Status.ERROR_FILE, lake.read_poly, "nowhere.poly")

    def test_outline(self):
        domain = pnpbs.Domain(self.context).add_polyline(SQUARE)
        domain.add_polyline([(0.4, 0.4), (0.6, 0.4), (0.5, 0.6)])
        self.assertEqual(domain.tag_outline(lambda x: x[:, 1] > 0.9, 5), 1)
        self.assertEqual(domain.tag_outline(lambda x: x[:, 1] > 2, 6), 0)
        placement = pnpbs.Placement(domain).set_spacing(0.1)
        placement.run()
        nodes = placement.nodes()
        self.assertTrue((nodes.points[nodes.tags == 5][:, 1] == 1).all())
        self.assertGreater((nodes.tags == 5).sum(), 8)
        with self.assertRaises(ZeroDivisionError):
            domain.tag_outline(lambda x: 1 / 0, 5)
        self.assert_status(Status.ERROR_ARGUMENT, domain.tag_outline, lambda x: x[:, 1] > 0, 0)

    def test_graphs_finer_than_d(self):
        turn = np.arange(400) * 2 * np.pi / 400
        small = [(0.1, 0), (0, 0.1), (-0.1, 0), (0, -0.1)]
        points = np.concatenate([np.stack([np.cos(turn), np.sin(turn)], axis=1), small])
        after = np.concatenate([np.roll(np.arange(400), -1), [401, 402, 403, 400]])
        ring = np.stack([np.arange(404), after], axis=1)

        def graph():
            return pnpbs.Domain(self.context).add_pslg(points, ring, holes=[(0, 0)])

        domain = graph().set_corner_angle(30)
        left_out = domain.simplify(lambda x: np.full(len(x), 0.2), tolerance=0.05, smallest=2)
        self.assertEqual(left_out.curves, 1)
        self.assertTrue(300 < left_out.vertices < 400)
        self.assertAlmostEqual(domain.measure(), np.pi, delta=0.1)
        self.assertEqual(graph().simplify(0.2, 0.05, 2), left_out)
        self.assertEqual(graph().simplify(0.2, 0), (0, 0))
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "d.csv"
            path.write_text("x,y,d\n0,0,0.2\n1,1,0.2\n")
            self.assertEqual(graph().simplify_by_file(path, "d", 0.05, 2), left_out)
            self.assert_status(Status.ERROR_FILE, graph().simplify_by_file, path, "e")
        self.assert_status(Status.ERROR_ARGUMENT, domain.simplify, 0.2, -1)
        self.assert_status(Status.ERROR_ARGUMENT, domain.set_corner_angle, 200)
        self.assert_status(Status.ERROR_ARGUMENT, domain.set_snap, -1)
        with self.assertRaises(ZeroDivisionError):
            domain.simplify(lambda x: 1 / 0)

    def test_tag_and_tags(self):
        for names in {"tag": 7}, {"tags": 7}:
            domain = pnpbs.Domain(self.context).add_polyline(SQUARE, **names)
            domain.add_fixed_nodes([(0.5, 0.5)], **names)
            placement = pnpbs.Placement(domain).set_spacing(0.2)
            placement.run()
            self.assertEqual(set(placement.nodes().tags), {0, 7})
        with self.assertRaisesRegex(TypeError, "tag and tags are both given"):
            pnpbs.Domain(self.context).add_polyline(SQUARE, tag=1, tags=2)

    def test_domains_show_what_they_hold(self):
        domain = pnpbs.Domain(self.context)
        self.assertEqual(repr(domain), "<pnpbs.Domain, 2D: empty>")
        domain.add_polyline(SQUARE).add_arc((0.3, 0.3), 0.1).add_arc((0.7, 0.7), 0.1)
        self.assertEqual(repr(domain), "<pnpbs.Domain, 2D: polyline, 2 arc>")

    def test_offsets(self):
        body = pnpbs.Domain(self.context).add_polyline(SQUARE)

        def offset(*arguments, **keywords):
            return pnpbs.Domain(self.context).add_offset(body, *arguments, **keywords)

        inset = offset(-np.inf, -0.42, 0.1, tag=7)
        self.assertAlmostEqual(inset.measure(), (1 - 2 * 0.042)**2, 9)
        self.assertEqual(set(inset.outline().tags), {7})
        self.assertAlmostEqual(offset(-np.inf, -0.042).measure(), inset.measure(), 9)
        # A finer resolution has more points on the arcs around the outer corners.
        coarse, fine = (len(offset(0, 0.42, 0.1, h).outline().tags) for h in (0.05, 0.01))
        self.assertGreater(fine, 2 * coarse)
        # The inset lies between four straight lines.
        left, right = 0.042 / 0.979, 0.958 / 1.021
        self.assertAlmostEqual(offset(-np.inf, -0.42, lambda x: 0.1 + 0.05 * x[:, 0]).measure(),
                               0.916 * (right - left) - 0.021 * (right**2 - left**2), 9)
        self.assertIn("tag", self.assert_status(Status.ERROR_ARGUMENT, offset, -np.inf, -0.42, 0.1,
                                                tag=0))
        self.assert_status(Status.ERROR_DOMAIN, offset, -np.inf, -0.6)
        self.assert_status(Status.ERROR_SPACING, offset, -np.inf, -0.42, 0)
        self.assertIn("body", self.assert_status(
            Status.ERROR_ARGUMENT, pnpbs.Domain(self.context, dim=3).add_offset, body, -np.inf, -1))
        with self.assertRaises(ZeroDivisionError):
            offset(-np.inf, -0.42, lambda x: 1 / 0)

    def test_offsets_in_space(self):
        box = pnpbs.Domain(self.context, dim=3).add_box((0, 0, 0), (1, 1, 1))
        calls = []

        def even(x):
            calls.append(len(x))
            return np.full(len(x), 0.25)

        inset = pnpbs.Domain(self.context, dim=3).add_offset(box, -np.inf, -0.46, even, tag=6)
        self.assertAlmostEqual(inset.measure(), 0.77**3, 3)
        placement = pnpbs.Placement(inset, steps=20).set_spacing(0.25 * 1.147)
        # The function is kept alive, although the domain is closed and deleted.
        inset.close()
        box.close()
        del inset, even
        gc.collect()
        before = len(calls)
        placement.run()
        self.assertGreater(len(calls), before)
        nodes = placement.nodes()
        on_surface = np.abs(nodes.points[nodes.tags == 6] - 0.5).max(axis=1)
        np.testing.assert_allclose(on_surface, 0.385, atol=1e-12)

    def test_wrong_arguments(self):
        domain = pnpbs.Domain(self.context)
        for wrong in ([1, 2, 3], [[1, 2, 3]], [["a", "b"]]):
            with self.assertRaises(ValueError):
                domain.add_polyline(wrong)
        with self.assertRaisesRegex(ValueError, "'outer'"):
            domain.add_polyline(SQUARE, role="outer")
        with self.assertRaisesRegex(ValueError, "tags"):
            domain.add_polyline(SQUARE, tags=[1, 2])
        with self.assertRaisesRegex(ValueError, "float64; integers"):
            domain.add_polyline(SQUARE, tags=[1.5] * 4)
        self.assert_status(Status.ERROR_ARGUMENT, domain.add_polyline, [(0, np.nan), (1, 0), (1, 1)])
        domain.add_polyline([(0, 0), (1, 1), (1, 0), (0, 1)])
        self.assertIn("cross", self.assert_status(Status.ERROR_DOMAIN, domain.check))

    def test_in_space(self):
        domain = pnpbs.Domain(self.context, dim=3)
        domain.add_box((0, 0, 0), (1, 1, 1)).add_ball((0.5, 0.5, 0.5), 0.25, tag=2)
        placement = pnpbs.Placement(domain).set_spacing(0.15)
        placement.run()
        points, tetrahedra = placement.nodes().points, placement.tetrahedra()
        a, b, c, d = (points[tetrahedra[:, k]] for k in range(4))
        volumes = np.einsum("ij,ij->i", np.cross(b - a, c - a), d - a) / 6
        self.assertTrue((volumes > 0).all())
        triangles, tags = placement.boundary_triangles()
        self.assertEqual(set(tags), {1, 2})
        # By the divergence theorem, the boundary triangles enclose the volume.
        a, b, c = (points[triangles[:, k]] for k in range(3))
        self.assertAlmostEqual(np.einsum("ij,ij->", a, np.cross(b, c)) / 6, volumes.sum(), 12)
        self.assertAlmostEqual(volumes.sum(), 1 - 4 / 3 * np.pi * 0.25**3, delta=0.02)
        normals = placement.normals()
        on_ball = placement.nodes().tags == 2
        outward = (0.5 - points[on_ball]) / 0.25
        self.assertGreater(np.einsum("ij,ij->i", normals[on_ball], outward).min(), 0.99)

    def test_inner_bodies(self):
        # An inner body divides the domain, and only it: the cube around it has the same tag.
        bodies = {"box": ((0.3, 0.3, 0.3), (0.7, 0.7, 0.7)), "ball": ((0.5, 0.5, 0.5), 0.25),
                  "cylinder": ((0.5, 0.5, 0.3), (0.5, 0.6, 0.7), 0.2)}
        for name, arguments in bodies.items():
            alone = getattr(pnpbs.Domain(self.context, dim=3), f"add_{name}")(*arguments)
            domain = pnpbs.Domain(self.context, dim=3).add_box((0, 0, 0), (1, 1, 1))
            getattr(domain, f"add_{name}")(*arguments, role="inner")
            domain.add_region((0.5, 0.5, 0.5), 3)
            self.assertIn(name, repr(domain))
            self.assertNotIn("surface", repr(domain))
            self.assertAlmostEqual(domain.measure(), 1, 12)
            points = np.random.default_rng(1).random((200, 3))
            np.testing.assert_allclose(
                np.minimum(domain.distance(points), alone.distance(points)),
                domain.distance(points, tag=1), atol=2e-4 * 0.25)
            placement = pnpbs.Placement(domain).set_spacing(0.15)
            placement.run()
            points = placement.nodes().points
            inside = placement.tetrahedra()[placement.element_tags() == 3]
            sides = points[inside[:, 1:]] - points[inside[:, :1]]
            self.assertAlmostEqual(np.linalg.det(sides).sum() / 6 / alone.measure(), 1, delta=0.2)
            for wrong in (("side",), (1,)):
                with self.assertRaises(ValueError):
                    getattr(domain, f"add_{name}")(*arguments, 1, *wrong)
        for role, tag in (("inner", 1), ("boundary", 2)):  # only a solid has a region tag
            domain = pnpbs.Domain(self.context, dim=3).add_box((0, 0, 0), (1, 1, 1))
            domain.add_ball((0.5, 0.5, 0.5), 0.25, role=role).set_fragment()
            self.assertEqual(domain.regions_at([(0.5, 0.5, 0.5)]), tag)
        domain = pnpbs.Domain(self.context, dim=3)
        self.assert_status(Status.ERROR_ARGUMENT, domain.add_ball, (0, 0, 0), -1, role="inner")
        self.assert_status(Status.ERROR_ARGUMENT, domain.add_box, (0, 0, 0), (1, 1, 0), role="inner")

    def test_one_tag_by_either_name(self):
        plane = pnpbs.Domain(self.context)
        plane.add_arc((0, 0), 1, tags=2).add_polyline([(3, 0), (4, 0), (3, 1)], tag=3)
        plane.add_curve(lambda t: np.stack([8 + np.cos(t), np.sin(t)], axis=1), 0, 2 * np.pi, tags=4)
        graph = pnpbs.Domain(self.context)
        graph.add_pslg([(0, 0), (1, 0), (0, 1)], [(0, 1), (1, 2), (2, 0)], tag=5)
        body = pnpbs.Domain(self.context, dim=3).add_box((0, 0, 0), (1, 1, 1), tags=6)
        body.add_ball((3, 0, 0), 1, tags=7).add_cylinder((6, 0, 0), (7, 0, 0), 1, tags=8)
        body.add_level_set(lambda x: np.linalg.norm(x - (12, 0, 0), axis=1) - 1, (10, -2, -2),
                           (14, 2, 2), 0.2, tags=9)
        for domain, tags in ((plane, (2, 3, 4)), (graph, (5,)), (body, (6, 7, 8, 9))):
            for tag in tags:
                self.assertEqual(domain.distance([(0.3,) * domain.dim], tag=tag).shape, (1,))
        with self.assertRaises(TypeError):
            plane.add_arc((0, 0), 1, tag=1, tags=1)
        with self.assertRaises(ValueError):
            plane.add_arc((0, 0), 1, tags=[1, 2])

    def test_results_before_a_run(self):
        plane = self.square().set_spacing(0.1)
        body = pnpbs.Placement(pnpbs.Domain(self.context, dim=3).add_ball((0, 0, 0), 1))
        for read in (plane.nodes, plane.boundary_edges, plane.triangles, plane.adjacency, plane.plot,
                     body.nodes, body.normals, body.tetrahedra):
            self.assertIn("call run", self.assert_status(Status.ERROR_STATE, read))
        self.assertEqual(plane.node_count, 0)

    def test_surfaces(self):
        corners = np.array([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], float)
        domain = pnpbs.Domain(self.context, dim=3)
        domain.add_surface(corners, [(0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3)], tags=4)
        self.assertAlmostEqual(domain.measure(), 1 / 6)
        ring = pnpbs.Domain(self.context, dim=3).add_level_set(
            lambda x: np.hypot(np.hypot(x[:, 0], x[:, 1]) - 1, x[:, 2]) - 0.4, (-2, -2, -1),
            (2, 2, 1), 0.1)
        self.assertAlmostEqual(ring.measure() / (2 * np.pi**2 * 0.16), 1, delta=0.02)
        eros = pnpbs.Domain(self.context, dim=3).read_surface(DATA / "eros.off").set_filled(False)
        self.assertGreater(eros.measure(), 0)
        domain = pnpbs.Domain(self.context, dim=3)
        domain.add_surface(corners, [(0, 1, 3), (0, 2, 1), (1, 2, 3), (0, 2, 3)])
        self.assertAlmostEqual(domain.set_repair(0.02).measure(), 1 / 6, delta=1e-15)
        self.assertAlmostEqual(domain.set_resurfaced(0.02).measure(), 1 / 6, delta=1e-3)
        # Two tetrahedra overlap in one with half of their edges.
        domain = pnpbs.Domain(self.context, dim=3)
        for shift in (0, 0.5):
            domain.add_surface(corners + (shift, 0, 0), [(0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3)])
        with self.assertRaisesRegex(pnpbs.PNPBSError, "set_fragment"):
            domain.measure()
        self.assertAlmostEqual(domain.set_fragment("own").measure(), (2 - 1 / 8) / 6)
        with self.assertRaisesRegex(ValueError, "overlap is 'all'"):
            domain.set_fragment("all")
        with self.assertRaisesRegex(ValueError, "corners"):
            domain.add_surface(corners, [(0, 1)])

    def test_on_a_sphere(self):
        places = np.array([(turn, -70) for turn in range(-178, 182, 2)], float)
        ring = pnpbs.sphere_points(1, places)
        self.assertEqual(ring.shape, (180, 3))
        np.testing.assert_allclose(np.linalg.norm(ring, axis=1), 1, atol=1e-15)
        np.testing.assert_allclose(pnpbs.sphere_degrees(2 * ring), places, atol=1e-12)
        self.assertEqual(pnpbs.sphere_points(1, []).shape, (0, 3))
        domain = pnpbs.Domain.on_sphere(self.context, 1, (0, 0, -1))
        self.assertEqual(domain.dim, 3)
        domain.add_polyline(ring, corner_angle=30)
        self.assertAlmostEqual(domain.measure(), 2 * np.pi * (1 + np.sin(np.radians(70))), 3)
        segments = domain.outline().segments
        self.assertEqual(segments.shape[1:], (2, 3))
        np.testing.assert_allclose(np.linalg.norm(segments, axis=2), 1, atol=1e-14)
        np.testing.assert_allclose(segments[:, :, 2], -np.sin(np.radians(70)), atol=1e-3)
        placement = pnpbs.Placement(domain).set_spacing(0.1)
        domain.close()
        self.assertEqual((placement.dim, placement.sphere_radius), (3, 1))
        self.assertEqual(placement.run(), Status.OK)
        points, triangles = placement.nodes().points, placement.triangles()
        self.assertEqual(points.shape, (placement.node_count, 3))
        np.testing.assert_allclose(np.linalg.norm(points, axis=1), 1, atol=1e-15)
        a, b, c = (points[triangles[:, k]] for k in range(3))
        self.assertGreater(np.einsum("ij,ij->i", np.cross(b - a, c - a), a + b + c).min(), 0)
        sides = np.unique(np.sort(triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)), axis=0)
        self.assertEqual(len(points) - len(sides) + len(triangles), 1)
        edges, tags = placement.boundary_edges()
        self.assertEqual(3 * len(triangles), 2 * len(sides) - len(edges))
        self.assertEqual(set(tags), {1})
        self.assertAlmostEqual(points[edges, 2].max(), -np.sin(np.radians(70)), 3)
        mesh = placement.mesh()
        self.assertEqual((mesh.dim, mesh.elements.shape), (3, triangles.shape))
        self.assertEqual(mesh.facets.shape, edges.shape)

    def test_grids_on_a_sphere(self):
        """The grid is in degrees of longitude and latitude. The first index runs along longitudes.
        """
        sphere = pnpbs.Domain.on_sphere(self.context, 1, (0, 1, 1))
        lon, lat = np.meshgrid(np.arange(-180, 180, 10), np.arange(-85, 90, 10), indexing="ij")
        d = 0.1 + 0.03 * np.cos(np.radians(lat)) * np.sin(np.radians(lon))
        placement = pnpbs.Placement(sphere).set_spacing(d, origin=(-180, -85), step=(10, 10))
        placement.run()
        nodes = placement.nodes()
        expected = 0.1 + 0.03 * nodes.points[:, 1]
        np.testing.assert_allclose(nodes.spacing, expected, atol=2 * 0.03 * np.radians(10)**2 / 8)
        self.assertGreater(np.ptp(nodes.spacing), 0.055)
        self.assertEqual([w for w in placement.warnings() if "covers only" in w], [])
        with self.assertRaisesRegex(ValueError, "2 dimensions"):
            placement.set_spacing(d[:, :, None], origin=(0, 0, 0), step=(1, 1, 1))
        with self.assertRaisesRegex(PNPBSError, "latitude from -90"):
            placement.set_spacing(d, origin=(0, -95), step=(10, 10))

    def test_meshes_and_points_on_a_sphere(self):
        """d at the previous nodes gives about the same number of nodes."""
        sphere = pnpbs.Domain.on_sphere(self.context, 1, (0, 1, 1))
        placement = pnpbs.Placement(sphere).set_spacing(lambda x: 0.1 + 0.03 * x[:, 2])
        placement.run()
        nodes, triangles = placement.nodes(), placement.triangles()
        for again in (pnpbs.Placement(sphere).set_spacing_mesh(nodes.points, nodes.spacing, triangles),
                      pnpbs.Placement(sphere).set_spacing_points(nodes.points, nodes.spacing)):
            again.run()
            self.assertLess(abs(again.node_count / placement.node_count - 1), 0.02)
            np.testing.assert_allclose(again.nodes().spacing,
                                       0.1 + 0.03 * again.nodes().points[:, 2], atol=1e-3)
        with self.assertRaisesRegex(ValueError, "corners"):
            placement.set_spacing_mesh(nodes.points, nodes.spacing, [(0, 1, 2, 3)])

    def test_wrong_arguments_on_a_sphere(self):
        def refusal(function, *arguments):
            return self.assert_status(Status.ERROR_ARGUMENT, function, *arguments)

        on_sphere = pnpbs.Domain.on_sphere
        self.assertIn("radius is 0", refusal(on_sphere, self.context, 0, (0, 0, -1)))
        self.assertIn("outside", refusal(on_sphere, self.context, 1, (0, 0, 0)))
        self.assertIn("radius is 0", refusal(pnpbs.sphere_points, 0, [(0, 0)]))
        self.assertIn("degrees[1][1] = 91", refusal(pnpbs.sphere_points, 1, [(0, 0), (0, 91)]))
        self.assertIn("coordinates[0]", refusal(pnpbs.sphere_degrees, [(0, 0, 0)]))
        with self.assertRaisesRegex(ValueError, "outside"):
            on_sphere(self.context, 1, (0, -1))
        with self.assertRaisesRegex(ValueError, "degrees"):
            pnpbs.sphere_points(1, [(0, 0, 1)])
        with self.assertRaisesRegex(ValueError, "coordinates"):
            pnpbs.sphere_degrees([(0, 1)])
        domain = on_sphere(self.context, 1, (0, 0, -1))
        self.assertIn("on a sphere", refusal(domain.add_arc, (0, 0), 0.1))
        with self.assertRaisesRegex(ValueError, "coordinates"):
            domain.add_polyline(SQUARE)
        domain.close()
        self.assertEqual(repr(domain), "<pnpbs.Domain, closed>")


def integral(points, cells, f=None):
    """Returns the integral of f, or 1, over elements of second order with the nodes of VTK, and the
    least Jacobian at the quadrature points."""
    corners = {6: 3, 10: 4}[cells.shape[1]]
    edges = [(0, 1), (1, 2), (0, 2), (0, 3), (1, 3), (2, 3)][:corners * (corners - 1) // 2]
    at, weights = np.polynomial.legendre.leggauss(4)
    at, weights = (at + 1) / 2, weights / 2
    total, least = 0, np.inf
    slopes = np.vstack([-np.ones(corners - 1), np.eye(corners - 1)])  # of the barycentric coordinates
    for k in np.ndindex(*[4] * (corners - 1)):
        left, weight, local = 1, 1, []
        for i in k:  # the cube collapsed to a simplex
            weight *= weights[i] * left
            local.append(left * at[i])
            left -= local[-1]
        w = np.array([left, *local])
        shapes = np.array([*(w * (2 * w - 1)), *(4 * w[a] * w[b] for a, b in edges)])
        gradients = np.vstack([(4 * w - 1)[:, None] * slopes,
                               *(4 * (w[a] * slopes[b] + w[b] * slopes[a])[None] for a, b in edges)])
        jacobians = np.linalg.det(np.einsum("ekd,kr->edr", points[cells], gradients))
        value = 1 if f is None else f(np.einsum("ekd,k->ed", points[cells], shapes))
        total, least = total + weight * (jacobians * value).sum(), min(least, jacobians.min())
    return total, least


class SecondOrder(Case):
    """Elements with mid nodes on the boundary."""

    def place(self, domain, d):
        placement = pnpbs.Placement(domain).set_spacing(d)
        placement.run()
        return placement

    def points(self, placement):
        """Returns nodes and mid nodes, to which elements of second order refer."""
        return np.vstack([placement.nodes().points, placement.edges().midpoints])

    def slopes(self, sizes, errors):
        return np.diff(np.log(np.abs(errors))) / np.diff(np.log(sizes))

    def test_the_area_of_a_ring_converges_with_order_4(self):
        errors = []
        for d in (0.2, 0.1, 0.05):
            domain = pnpbs.Domain(self.context).add_arc((0, 0), 1, tag=2)
            domain.add_curve(lambda t: 0.4 * np.stack([np.cos(t), np.sin(t)], 1), 0, 2 * np.pi, tag=3)
            placement = self.place(domain, d)
            points, edges = self.points(placement), placement.edges()
            area, least = integral(points, placement.triangles(order=2))
            self.assertGreater(least, 0)
            self.assertEqual(edges.straight, 0)
            errors.append(area - np.pi * (1 - 0.4**2))
            np.testing.assert_array_equal(np.sort(edges.numbers), np.arange(len(edges.numbers)))
            facets = placement.boundary_edges(order=2)
            radii = np.linalg.norm(points[facets.corners], axis=2)
            np.testing.assert_allclose(radii[facets.tags == 2], 1, rtol=1e-12)
            np.testing.assert_allclose(radii[facets.tags == 3], 0.4, rtol=1e-7)
        self.assertLess(abs(errors[-1]), 1e-6)
        self.assertGreater(self.slopes((0.2, 0.1, 0.05), errors).min(), 3.5)

    def test_the_volume_of_a_ball_converges_with_order_4(self):
        sizes, errors = (0.6, 0.4, 0.25), []
        domain = pnpbs.Domain(self.context, dim=3)
        domain.add_level_set(lambda x: np.linalg.norm(x, axis=1) - 1, (-1.3,) * 3, (1.3,) * 3, 0.1)
        for d in sizes:
            placement = self.place(domain, d)
            points = self.points(placement)
            volume, least = integral(points, placement.tetrahedra(order=2))
            self.assertGreater(least, 0)
            errors.append(volume - 4 / 3 * np.pi)
            on_surface = points[placement.boundary_triangles(order=2).corners]
            np.testing.assert_allclose(np.linalg.norm(on_surface, axis=2), 1, rtol=1e-9)
        self.assertGreater(self.slopes(sizes, errors).min(), 3)

    def test_rims_and_inner_surfaces(self):
        """The rim of a cylinder is curved, and so is an inner ball; volumes are as good as their
        triangles, and straight elements are ten times worse."""
        domain = pnpbs.Domain(self.context, dim=3).add_cylinder((0, 0, 0), (0, 0, 2), 1)
        domain.add_ball((0, 0, 1), 0.6, role="inner", tag=4).add_region((0, 0, 1), 7)
        placement = self.place(domain, 0.2)
        points, elements = self.points(placement), placement.tetrahedra(order=2)
        inside = elements[placement.element_tags() == 7]
        ball = pnpbs.Domain(self.context, dim=3).add_ball((0, 0, 1), 0.6)
        for cells, exact in ((elements, domain.measure()), (inside, ball.measure())):
            x = points[cells[:, :4]]
            straight = np.linalg.det(x[:, 1:] - x[:, :1]).sum() / 6
            error = integral(points, cells)[0] - exact
            self.assertLess(abs(error), 0.05 * abs(straight - exact))
        self.assertGreater(integral(points, elements)[1], 0)

    def test_spheres_and_surfaces(self):
        sphere = pnpbs.Domain.on_sphere(self.context, 2, (0, 0, -1))
        shell = pnpbs.Domain(self.context, dim=3).add_ball((0, 0, 0), 2).set_filled(False)
        for domain, get, near in ((sphere, "triangles", 1e-12), (shell, "boundary_triangles", 2e-4)):
            placement = self.place(domain, 0.3)
            cells = getattr(placement, get)(order=2)
            points = self.points(placement)[getattr(cells, "corners", cells)]
            self.assertEqual(points.shape[1:], (6, 3))
            np.testing.assert_allclose(np.linalg.norm(points, axis=2), 2, atol=near)

    def test_files(self):
        for dim in (2, 3):
            domain = pnpbs.Domain(self.context, dim=dim)
            if dim == 2:
                domain.add_arc((0, 0), 1, tag=3).add_arc((0.2, 0), 0.4, role="inner", tag=4)
                domain.add_region((0.2, 0), 9)
            else:
                domain.add_ball((0, 0, 0), 1, tag=3)
            placement = self.place(domain, 0.25)
            placement.add_output_field("f", placement.nodes().points @ np.arange(1, dim + 1))
            points = self.points(placement)
            exact = integral(points, (placement.triangles, placement.tetrahedra)[dim - 2](order=2))
            cell, facet = (("triangle6", "line3"), ("tetra10", "triangle6"))[dim - 2]
            facets = (placement.boundary_edges, placement.boundary_triangles)[dim - 2](order=2)
            meshio = importlib.import_module("meshio")
            with tempfile.TemporaryDirectory() as folder:
                paths = [pathlib.Path(folder, f"a.{name}") for name in ("msh", "msh2", "vtu")]
                placement.write(*paths, order=2)
                for path in paths:
                    mesh = meshio.read(path, file_format="vtu" if path.suffix == ".vtu" else "gmsh")
                    cells = mesh.cells_dict
                    self.assertEqual(len(mesh.points), len(points))
                    self.assertAlmostEqual(integral(mesh.points[:, :dim], cells[cell])[0], exact[0], 12)
                    ends = np.array(cells[cell])[:, :2]
                    values = mesh.point_data["f"]
                    np.testing.assert_allclose(values[cells[cell][:, dim + 1]],
                                               values[ends].mean(axis=1), atol=1e-15)
                    if path.suffix == ".vtu":
                        beside = meshio.read(path.with_name("a_facets.vtu"))
                        found, tags = beside.cells_dict[facet], beside.cell_data["tag"][0]
                        self.assertEqual(mesh.point_data["id"].min(), -1)
                    else:
                        found = cells[facet]
                        tags = mesh.cell_data_dict["gmsh:physical"][facet]
                    for tag in set(facets.tags):
                        self.assertEqual(
                            {tuple(np.sort(np.round(x, 12).ravel())) for x in
                             points[facets.corners[facets.tags == tag]]},
                            {tuple(np.sort(np.round(x, 12).ravel())) for x in
                             mesh.points[:, :dim][found[tags == tag]]})
                self.assertIn(".csv", self.assert_status(
                    Status.ERROR_ARGUMENT, placement.write, pathlib.Path(folder, "a.csv"), order=2))
                with self.assertRaises(ValueError):
                    placement.write(paths[0], order=3)

    def test_sheets_closer_than_the_sagitta(self):
        """The middles of edges are nearer to the other sphere, but move to their own."""
        sheets = pnpbs.Domain(self.context, dim=3).set_filled(False)
        sheets.add_ball((0, 0, 0), 1, tag=1).add_ball((0, 0, 0), 0.985, tag=2)
        placement = self.place(sheets, 0.4)
        facets, points = placement.boundary_triangles(order=2), self.points(placement)
        radii = np.linalg.norm(points[facets.corners], axis=2)
        np.testing.assert_allclose(radii[facets.tags == 1], 1, atol=1e-4)
        np.testing.assert_allclose(radii[facets.tags == 2], 0.985, atol=1e-4)

    def test_elements_that_would_fold_are_straight(self):
        """A hole that nodes hardly resolve: its edges bulge into the triangles around it."""
        domain = pnpbs.Domain(self.context).add_polyline([(-2, -2), (2, -2), (2, 2), (-2, 2)])
        domain.add_curve(lambda t: 0.35 * np.stack([np.cos(t), 6 * np.sin(t) * np.sin(t / 2)**2], 1),
                         0, 2 * np.pi, tag=3)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            placement = self.place(domain, 0.9)
        _, least = integral(self.points(placement), placement.triangles(order=2))
        self.assertGreater(least, 0)
        self.assertGreater(placement.edges().straight, 0)

    def test_poisson_converges_with_order_3(self):
        """Solves -Laplace u = 4 on a disk, of which u = 1 - r^2 is the solution with u = 0 on it, and
        of a right-hand side with a solution of no polynomial."""
        sizes, errors = (0.3, 0.15, 0.075), []
        for d in sizes:
            placement = self.place(pnpbs.Domain(self.context).add_arc((0, 0), 1), d)
            points, elements = self.points(placement), placement.triangles(order=2)
            skfem = importlib.import_module("skfem")
            mesh = skfem.MeshTri2(points.T, elements.T)
            basis = skfem.Basis(mesh, skfem.ElementTriP2(), intorder=6)
            exact = lambda x: np.cos(np.pi / 2 * (x[0]**2 + x[1]**2))

            @skfem.BilinearForm
            def stiffness(u, v, _):
                return u.grad[0] * v.grad[0] + u.grad[1] * v.grad[1]

            @skfem.LinearForm
            def load(v, w):
                s = w.x[0]**2 + w.x[1]**2
                return v * (2 * np.pi * np.sin(np.pi / 2 * s) + np.pi**2 * s * np.cos(np.pi / 2 * s))

            @skfem.Functional
            def squared_error(w):
                return (w.u - exact(w.x))**2

            solution = skfem.solve(*skfem.condense(stiffness.assemble(basis), load.assemble(basis),
                                                   D=basis.get_dofs()))
            errors.append(squared_error.assemble(basis, u=solution)**0.5)
        self.assertGreater(self.slopes(sizes, errors).min(), 2.7)


class Meshes(Case):
    def placed(self, domain, d):
        placement = pnpbs.Placement(domain, steps=20).set_spacing(d)
        placement.run()
        return placement

    def test_in_the_plane(self):
        domain = pnpbs.Domain(self.context).add_polyline(SQUARE)
        domain.add_polyline([(0.3, 0.4), (0.7, 0.6)], role="inner", closed=False, tags=7)
        placement = self.placed(domain, 0.1)
        mesh = placement.mesh()
        check_mesh(self, mesh, 0)
        self.assertEqual(mesh.elements.shape[1], 3)
        self.assertAlmostEqual(measures(mesh).sum(), 1, 12)
        self.assertEqual((mesh.first_node, mesh.owned_nodes, mesh.all_nodes),
                         (0, *[placement.node_count] * 2))
        self.assertEqual((mesh.first_element, mesh.owned_elements, mesh.all_elements),
                         (0, *[len(placement.triangles())] * 2))
        nodes = placement.nodes()
        at = [nodes.ids.tolist().index(i) for i in mesh.ids]
        np.testing.assert_array_equal(mesh.coordinates, nodes.points[at])
        np.testing.assert_array_equal(mesh.tags, nodes.tags[at])

        edges, tags = placement.boundary_edges()
        self.assertEqual({(*row, tag) for row, tag in zip(mesh.ids[mesh.facets].tolist(),
                                                          mesh.facet_tags.tolist())},
                         {(*row, tag) for row, tag in zip(nodes.ids[edges].tolist(), tags.tolist())})
        self.assertIn(7, mesh.facet_tags)
        np.testing.assert_array_equal(mesh.facet_inner, mesh.facet_tags == 7)
        np.testing.assert_array_equal(mesh.facet_elements[:, 1] >= 0, mesh.facet_inner)
        self.assertEqual((len(mesh.shared_nodes), len(mesh.sharing_ranks)), (0, 0))

        more = placement.mesh(ghost_layers=16)  # a single rank has no ghosts
        np.testing.assert_array_equal(more.elements, mesh.elements)
        self.assertIn(f", 2D, {mesh.all_nodes} nodes, ", repr(mesh))
        with self.assertRaises(AttributeError):
            mesh.dim = 3

    def divided_square(self):
        domain = pnpbs.Domain(self.context).add_polyline(SQUARE, tags=4)
        domain.add_polyline([(0.5, 0), (0.5, 1)], role="inner", closed=False, tags=7)
        return domain.add_region((0.2, 0.5), 3).add_region([0.8, 0.5], 7)

    def test_regions(self):
        domain = self.divided_square()
        placement = self.placed(domain, 0.1)
        mesh, points, corners = placement.mesh(), placement.nodes().points, placement.triangles()
        sides = points[corners[:, 1:]] - points[corners[:, :1]]
        for areas, x, tags in (
                (np.linalg.det(sides) / 2, points[corners], placement.element_tags()),
                (measures(mesh), mesh.coordinates[mesh.elements], mesh.element_tags)):
            self.assertEqual(tags.dtype, np.int32)
            np.testing.assert_array_equal(tags, np.where(x[:, :, 0].mean(axis=1) < 0.5, 3, 7))
            for tag in 3, 7:
                self.assertAlmostEqual(areas[tags == tag].sum(), 0.5, 12)
        self.assertIn("tag", self.assert_status(Status.ERROR_ARGUMENT, domain.add_region,
                                                (0.2, 0.5), 0))
        with self.assertRaisesRegex(ValueError, "point"):
            domain.add_region((0.2, 0.5, 0), 3)
        domain.add_region((0.2, 0.9), 4)
        self.assertIn("region 2 at (0.2, 0.9)",
                      self.assert_status(Status.ERROR_DOMAIN, domain.check))

    def check_cracks(self, placement, elements, tag, copies):
        """Checks the cracks of a placement that they cut into two halves of the same size."""
        self.assertIs(placement.set_cracks([tag]), placement)
        pairs, facets, opened = (placement.crack_nodes(), placement.crack_facets(),
                                 placement.cracked_elements())
        points = placement.nodes().points
        n = len(points)
        self.assertEqual((len(pairs.nodes), pairs.all), (copies, copies))
        self.assertEqual(pairs.numbers.tolist(), list(range(copies)))
        originals = np.concatenate([np.arange(n), pairs.nodes])
        np.testing.assert_array_equal(originals[opened], elements)
        np.testing.assert_array_equal(originals[facets.front], originals[facets.back])
        self.assertTrue((facets.front < n).all() and (facets.back >= n).all())
        self.assertEqual(set(facets.tags), {tag})
        self.assertAlmostEqual(facets.covered, 1, 7)
        # Elements behind the crack have copies, those in front of it have none.
        x = points[elements].mean(axis=1)
        corner, *others = points[facets.front[0]]
        normal = (np.cross(*(other - corner for other in others)) if len(others) == 2
                  else np.array([corner[1] - others[0][1], others[0][0] - corner[0]]))
        behind = (x - corner) @ normal < 0
        np.testing.assert_array_equal(np.isin(opened, facets.back).any(axis=1),
                                      np.isin(elements, originals[facets.back]).any(axis=1) & behind)
        self.assertFalse(np.isin(opened[behind], facets.front).any())
        placement.set_cracks([99])
        self.assertIn("has the tag 99", self.assert_status(Status.ERROR_ARGUMENT,
                                                           placement.crack_nodes))
        self.assert_status(Status.ERROR_ARGUMENT, placement.set_cracks, 0)
        np.testing.assert_array_equal(placement.set_cracks([]).cracked_elements(), elements)

    def test_cracks(self):
        placement = self.placed(self.divided_square(), 0.1)
        on_line = (placement.nodes().points[:, 0] == 0.5).sum()
        self.check_cracks(placement, placement.triangles(), 7, on_line)
        domain = pnpbs.Domain(self.context, dim=3).add_box((0, 0, 0), (1, 1, 1), tag=5)
        sheet = [(0.5, 0, 0), (0.5, 1, 0), (0.5, 1, 1), (0.5, 0, 1)]
        domain.add_surface(sheet, [(0, 1, 2), (0, 2, 3)], role="inner", tags=6).set_fragment()
        placement = self.placed(domain, 0.25)
        on_sheet = (placement.nodes().points[:, 0] == 0.5).sum()
        self.check_cracks(placement, placement.tetrahedra(), 6, on_sheet)

    def test_in_space(self):
        domain = pnpbs.Domain(self.context, dim=3).add_box((0, 0, 0), (2, 1, 1), tag=5)
        wall = [(1, 0.2, 0.2), (1, 0.8, 0.2), (1, 0.8, 0.8), (1, 0.2, 0.8)]
        domain.add_surface(wall, [(0, 1, 2), (0, 2, 3)], role="inner", tags=6)
        placement = self.placed(domain.add_region((0.1, 0.1, 0.1), 4), 0.25)
        mesh = placement.mesh()
        check_mesh(self, mesh, 0)
        self.assertEqual(set(mesh.element_tags), {4})
        self.assertEqual(placement.element_tags().tolist(), [4] * len(placement.tetrahedra()))
        regions = placement.regions()
        self.assertEqual((regions.tags.tolist(), regions.nodes.tolist(), regions.elements.tolist()),
                         ([4], [mesh.all_nodes], [len(mesh.elements)]))
        self.assertAlmostEqual(regions.measures[0], 2, 12)
        self.assertEqual(domain.regions_at([(0.1, 0.1, 0.1), (1.9, 0.9, 0.9)]).tolist(), [4, 4])
        halves = self.divided_square()
        self.assertEqual(halves.regions_at([(0.4, 0.2), (0.6, 0.2)], 2).tolist(), [[3, 3], [7, 7]])
        self.assertEqual(sorted(halves.regions_at([(0.5, 0.2)], 2)[0]), [3, 7])
        self.assertEqual(mesh.elements.shape[1], 4)
        self.assertAlmostEqual(measures(mesh).sum(), 2, 12)
        self.assertIn(6, mesh.facet_tags)
        np.testing.assert_array_equal(mesh.facet_inner, mesh.facet_tags == 6)
        # The facets are counter-clockwise as seen from outside, so together they enclose the box.
        a, b, c = mesh.coordinates[mesh.facets[mesh.facet_tags == 5]].transpose(1, 0, 2)
        self.assertAlmostEqual(np.einsum("ij,ij->", a, np.cross(b, c)) / 6, 2, 12)
        first, second = mesh.facet_elements[mesh.facet_inner].T
        self.assertTrue((first != second).all() and (second >= 0).all())

    def test_on_surfaces_alone(self):
        domain = pnpbs.Domain(self.context, dim=3).add_box((0, 0, 0), (1, 1, 1), tag=5)
        placement = self.placed(domain.set_filled(False), 0.3)
        mesh = placement.mesh()
        check_mesh(self, mesh, 0)
        self.assertEqual((mesh.dim, mesh.elements.shape[1], mesh.facets.shape), (3, 3, (0, 2)))
        self.assertEqual(set(mesh.element_tags), {5})
        self.assertIn("surfaces alone", self.assert_status(Status.ERROR_ARGUMENT,
                                                           placement.element_tags))
        placement.close()
        self.assertEqual(mesh.coordinates.shape, (mesh.all_nodes, 3))

    def test_voronoi_cells(self):
        plate = pnpbs.Domain(self.context).add_polyline(SQUARE)
        box = pnpbs.Domain(self.context, dim=3).add_box((0, 0, 0), (1, 1, 1))
        for domain, d in (plate, 0.1), (box, 0.25):
            placement = self.placed(domain, d)
            nodes, cells = placement.nodes(), placement.voronoi()
            placement.close()
            self.assertAlmostEqual(cells.volumes.sum(), 1, 12)
            rows = np.repeat(np.arange(len(nodes.ids)), cells.neighbours.lengths())
            others = np.searchsorted(nodes.ids, cells.neighbours.values)
            np.testing.assert_array_equal(cells.numbers, others)
            ways = nodes.points[others] - nodes.points[rows]
            np.testing.assert_allclose(cells.distances[:, None] * cells.normals, ways, atol=1e-15)
            sums = cells.boundary.copy()
            np.add.at(sums, rows, cells.areas[:, None] * cells.normals)
            np.testing.assert_allclose(sums, 0, atol=1e-13)
            faces = dict(zip(zip(rows.tolist(), others.tolist()), cells.areas.tolist()))
            self.assertEqual(faces, {(j, i): area for (i, j), area in faces.items()})
            self.assertIn(f"{len(nodes.ids)} cells, {len(rows)} faces", repr(cells))
        self.assert_status(Status.ERROR_STATE, pnpbs.Placement(box).voronoi)

    def test_voronoi_cells_of_a_sphere_are_those_of_its_grid(self):
        sphere = pnpbs.Domain.on_sphere(self.context, 3, (0, 1, 1))
        placement = self.placed(sphere, lambda x: 0.3 + 0.05 * x[:, 2])
        cells = placement.voronoi()
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "grid.mpas"
            placement.write(path)
            grid = netCDF4.Dataset("grid", memory=path.read_bytes())
        with grid:
            np.testing.assert_allclose(cells.volumes, grid["areaCell"][:], rtol=1e-12)
            rows = np.repeat(np.arange(len(cells.volumes)), cells.neighbours.lengths())
            order = np.lexsort(grid["cellsOnEdge"][:].T)
            ends = grid["cellsOnEdge"][:][order] - 1
            first = rows < cells.numbers
            faces = np.lexsort((rows[first], cells.numbers[first]))
            np.testing.assert_array_equal(np.column_stack([rows[first], cells.numbers[first]])[faces], ends)
            np.testing.assert_allclose(cells.areas[first][faces], grid["dvEdge"][:][order], rtol=1e-9)
            np.testing.assert_allclose(cells.distances[first][faces], grid["dcEdge"][:][order], rtol=1e-12)
        placement.close()

    def check_particles(self, placement, body):
        """Checks the particles of a body with measure 1."""
        particles = pnpbs.Particles(placement, body)
        self.assertEqual(particles.points.shape, (particles.count, body.dim))
        self.assertEqual(particles.count + particles.left_out, placement.node_count)
        self.assertEqual(set(particles.tags), {0, 7})
        np.testing.assert_array_equal(particles.ids, np.unique(particles.ids))
        self.assertAlmostEqual(particles.volumes.sum(), 1, 12)
        self.assertTrue(((particles.points > 0) & (particles.points < 1)).all())
        i, j = np.triu_indices(particles.count, 1)
        distances = np.linalg.norm(particles.points[i] - particles.points[j], axis=1)
        closest = (2 * distances / (particles.spacing[i] + particles.spacing[j])).min()
        self.assertAlmostEqual(particles.closest, closest, 12)
        self.assertGreater(particles.closest, 0.6)
        self.assertIn(f"{particles.count} here, {particles.count} in all", repr(particles))
        return particles

    def check_files_of_particles(self, particles):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "particles.csv")
            particles.write(path)
            self.assertEqual(len(path.read_text().splitlines()), particles.count + 1)
            particles.add_output_field("mass", 2 * particles.volumes)
            particles.add_output_field("velocity", particles.points)
            particles.write(path, os.path.join(folder, "a.vtu"))
            table = np.genfromtxt(path, delimiter=",", names=True, deletechars="")
            for name, values in (("id", particles.ids), ("x", particles.points[:, 0]),
                                 ("tag", particles.tags), ("spacing", particles.spacing),
                                 ("volume", particles.volumes), ("mass", 2 * particles.volumes),
                                 ("velocity:1", particles.points[:, 1])):
                np.testing.assert_array_equal(table[name], values, name)
            self.assertTrue(os.path.isfile(os.path.join(folder, "a.vtu")))
            elements = os.path.join(folder, "a.ele")
            self.assert_status(Status.ERROR_ARGUMENT, particles.write, elements)
            self.assert_status(Status.ERROR_FILE, particles.write, "/nowhere/particles.csv")
        self.assertIn("mass", self.assert_status(Status.ERROR_ARGUMENT, particles.add_output_field,
                                                 "mass", particles.volumes))

    def test_particles(self):
        body = pnpbs.Domain(self.context).add_polyline(SQUARE)
        box = pnpbs.Domain(self.context, dim=3).add_box((0, 0, 0), (1, 1, 1))
        for one, high, d, factor in (body, -0.42, 0.1, 1.076), (box, -0.46, 0.2, 1.147):
            inset = pnpbs.Domain(self.context, dim=one.dim).add_offset(one, -np.inf, high, d, tag=7)
            placement = self.placed(inset, factor * d)
            particles = self.check_particles(placement, one)
            placement.close()
            self.check_files_of_particles(particles)
            particles.close()
            particles.close()
            self.assertAlmostEqual(particles.volumes.sum(), 1, 12)
            self.assert_status(Status.ERROR_HANDLE, particles.write, "particles.csv")

    def test_bodies_without_particles(self):
        body = pnpbs.Domain(self.context).add_polyline(SQUARE)
        inset = pnpbs.Domain(self.context).add_offset(body, -np.inf, -0.42, 0.1)
        self.assert_status(Status.ERROR_STATE, pnpbs.Particles, pnpbs.Placement(inset), body)
        placement = self.placed(inset, 0.1076)
        wide = pnpbs.Domain(self.context).add_polyline([(-1, -1), (2, -1), (2, 2), (-1, 2)])
        message = self.assert_status(Status.ERROR_DOMAIN, pnpbs.Particles, placement, wide)
        self.assertIn("fill", message)
        # Nodes on the boundary of the inset fill it, but they must lie strictly inside the body.
        self.assert_status(Status.ERROR_DOMAIN, pnpbs.Particles, placement, inset)
        box = pnpbs.Domain(self.context, dim=3).add_box((0, 0, 0), (1, 1, 1))
        message = self.assert_status(Status.ERROR_ARGUMENT, pnpbs.Particles, placement, box)
        self.assertIn("body", message)
        body.close()
        self.assert_status(Status.ERROR_HANDLE, pnpbs.Particles, placement, body)

    def test_for_other_packages_in_the_plane(self):
        domain = pnpbs.Domain(self.context).add_polyline(SQUARE, tags=4)
        domain.add_polyline([(0.3, 0.4), (0.7, 0.6)], role="inner", closed=False, tags=7)
        mesh = self.placed(domain, 0.1).mesh()
        taken = mesh.to_meshio()
        np.testing.assert_array_equal(taken.points, mesh.coordinates)
        np.testing.assert_array_equal(taken.cells_dict["triangle"], mesh.elements)
        np.testing.assert_array_equal(taken.cells_dict["line"], mesh.facets)
        np.testing.assert_array_equal(taken.cell_data["tag"][1], mesh.facet_tags)
        np.testing.assert_array_equal(taken.point_data["id"], mesh.ids)
        grid, edges = mesh.to_pyvista(), mesh.to_pyvista(facets=True)
        self.assertAlmostEqual(grid.area, 1, 12)
        lengths = edges.compute_cell_sizes()["Length"]
        self.assertAlmostEqual(lengths[edges["tag"] == 4].sum(), 4, 12)
        self.assertAlmostEqual(lengths[edges["tag"] == 7].sum(), np.hypot(0.4, 0.2), 12)
        there = mesh.to_skfem()
        np.testing.assert_array_equal(np.sort(there.boundaries["tag_4"]), there.boundary_facets())
        self.assertEqual(len(there.boundaries["tag_7"]), np.count_nonzero(mesh.facet_tags == 7))
        ends = there.p[:, there.facets[:, there.boundaries["tag_7"]]]
        np.testing.assert_allclose(ends[1] - 0.4, (ends[0] - 0.3) / 2, atol=1e-12)

    def test_for_other_packages_with_regions(self):
        mesh = self.placed(self.divided_square(), 0.1).mesh()
        np.testing.assert_array_equal(mesh.to_meshio().cell_data_dict["tag"]["triangle"],
                                      mesh.element_tags)
        grid, there = mesh.to_pyvista(), mesh.to_skfem()
        areas = grid.compute_cell_sizes()["Area"]
        self.assertEqual((set(there.subdomains), set(there.boundaries)),
                         ({"tag_3", "tag_7"}, {"tag_4", "tag_7"}))
        middles = there.p[:, there.t].mean(axis=1)
        for tag, is_left in (3, True), (7, False):
            self.assertAlmostEqual(areas[grid["tag"] == tag].sum(), 0.5, 12)
            np.testing.assert_array_equal(np.sort(there.subdomains[f"tag_{tag}"]),
                                          np.flatnonzero((middles[0] < 0.5) == is_left))

    def test_for_other_packages_in_space(self):
        domain = pnpbs.Domain(self.context, dim=3).add_box((0, 0, 0), (2, 1, 1), tag=5)
        mesh = self.placed(domain, 0.25).mesh()
        self.assertAlmostEqual(mesh.to_pyvista().volume, 2, 12)
        self.assertAlmostEqual(mesh.to_pyvista(facets=True).area, 10, 12)
        self.assertEqual(set(mesh.to_meshio().cells_dict), {"tetra", "triangle"})
        there = mesh.to_skfem()
        self.assertEqual(there.t.shape, (4, mesh.owned_elements))
        self.assertFalse(there.subdomains)
        np.testing.assert_array_equal(np.sort(there.boundaries["tag_5"]), there.boundary_facets())

    def test_for_other_packages_on_surfaces_alone(self):
        domain = pnpbs.Domain(self.context, dim=3).add_box((0, 0, 0), (1, 1, 1), tag=5)
        mesh = self.placed(domain.set_filled(False), 0.3).mesh()
        self.assertAlmostEqual(mesh.to_pyvista().area, 6, 12)
        self.assertEqual(set(mesh.to_meshio().cells_dict), {"triangle"})
        with self.assertRaisesRegex(ValueError, "surfaces in space"):
            mesh.to_skfem()

    def test_what_is_none(self):
        placement = self.square()
        self.assert_status(Status.ERROR_STATE, placement.mesh)
        placement.set_spacing(0.3).initialise()
        for layers in (-1, 17):
            message = self.assert_status(Status.ERROR_ARGUMENT, placement.mesh, ghost_layers=layers)
            self.assertIn(f"ghost_layers = {layers}", message)
        placement.close()
        self.assert_status(Status.ERROR_HANDLE, placement.mesh)


@unittest.skipUnless(importlib.util.find_spec("matplotlib"), "no Matplotlib")
class Pictures(Case):
    def setUp(self):
        super().setUp()
        import matplotlib.pyplot
        matplotlib.use("Agg")
        self.pyplot = matplotlib.pyplot
        self.addCleanup(self.pyplot.close, "all")

    def placed(self, domain, d):
        placement = pnpbs.Placement(domain, steps=20).set_spacing(d)
        placement.run()
        return placement

    @staticmethod
    def legend(ax):
        return [text.get_text() for text in ax.get_legend().get_texts()]

    def test_in_the_plane(self):
        domain = pnpbs.Domain(self.context).add_polyline(SQUARE, tags=4)
        domain.add_arc((0.5, 0.5), 0.2, tag=7)
        placement = self.placed(domain, 0.1)
        mesh, nodes = placement.mesh(), placement.nodes()
        ax = mesh.plot()
        drawn = {lines.get_label(): lines for lines in ax.collections}
        self.assertEqual(self.legend(ax), ["tag 4", "tag 7"])
        for tag in (4, 7):
            np.testing.assert_array_equal(drawn[f"tag {tag}"].get_segments(),
                                          mesh.coordinates[mesh.facets[mesh.facet_tags == tag]])
        colours = [tuple(lines.get_colors()[0]) for lines in drawn.values()]
        self.assertEqual(len(set(colours)), 2)
        edges = len(np.unique(np.sort(mesh.elements[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)), axis=0))
        x = ax.lines[0].get_xdata()
        self.assertEqual(len(x), 3 * edges)  # two ends and a gap for each edge

        self.assertIs(placement.plot(ax), ax)
        self.assertEqual(sorted(self.legend(ax)), ["no tag", "tag 4", "tag 7"])
        points = {line.get_label(): line.get_xydata() for line in ax.lines}
        for tag, label in ((0, "no tag"), (4, "tag 4"), (7, "tag 7")):
            np.testing.assert_array_equal(points[label], nodes.points[nodes.tags == tag])
        low, high = ax.get_xlim()
        self.assertTrue(low < 0 and high > 1)
        ax.figure.canvas.draw()

    def test_in_space(self):
        placement, alone = (
            self.placed(pnpbs.Domain(self.context, dim=3).add_box((0, 0, 0), (2, 1, 1), tag=5)
                        .set_filled(filled), 0.4) for filled in (True, False))
        for mesh, triangles in ((placement.mesh(), lambda m: m.facets),
                                (alone.mesh(), lambda m: m.elements)):
            ax = self.pyplot.figure().add_subplot(projection="3d")
            self.assertIs(mesh.plot(ax), ax)
            self.assertEqual(self.legend(ax), ["tag 5"])
            ax.figure.canvas.draw()
            self.assertEqual([len(one.get_paths()) for one in ax.collections], [len(triangles(mesh))])
        ax = placement.plot(self.pyplot.figure().add_subplot(projection="3d"))
        self.assertEqual(self.legend(ax), ["tag 5", "no tag"])
        self.assertEqual(sum(len(line.get_data_3d()[0]) for line in ax.lines), placement.node_count)

    @unittest.skipUnless(importlib.util.find_spec("pyvista"), "no PyVista")
    def test_in_space_by_pyvista(self):
        class Plotter:
            """PyVista's own Plotter requires a screen when it is created, so it is replaced."""

            def __init__(self):
                self.drawn, self.has_legend = [], False

            def add_mesh(self, surface, color, label, show_edges):
                self.drawn.append((surface.area, color, label))

            def add_points(self, points, color, label, **_):
                self.drawn.append((len(points), color, label))

            def add_legend(self):
                self.has_legend = True

        domain = pnpbs.Domain(self.context, dim=3).add_box((0, 0, 0), (2, 1, 1), tag=5)
        placement = self.placed(domain, 0.4)
        with unittest.mock.patch("pyvista.Plotter", Plotter):
            canvas, points = placement.mesh().plot(), placement.plot()
        self.assertEqual([(round(area, 12), label) for area, _, label in canvas.drawn], [(10, "tag 5")])
        self.assertTrue(canvas.has_legend)
        self.assertEqual([label for _, _, label in points.drawn], ["tag 5", "no tag"])
        self.assertEqual(sum(count for count, _, _ in points.drawn), placement.node_count)


class Progress(Case):
    def setUp(self):
        super().setUp()
        self.placement = self.square().set_spacing(0.05)

    def shown(self):
        with contextlib.redirect_stderr(io.StringIO()) as text:
            self.assertEqual(self.placement.run(progress=True), Status.OK)
        return re.split(r"[\r\n]+", text.getvalue())

    def test_as_text(self):
        fractions = []
        self.placement.set_monitor(lambda fraction, *_: fractions.append(fraction))
        with unittest.mock.patch.dict(sys.modules, {"tqdm.auto": None}):
            lines = self.shown()
        self.assertEqual([line[:4] for line in lines if line], [f"{f:4.0%}" for f in fractions])
        self.assertEqual(lines[-2], f"100% [{'#' * 40}] {self.placement.node_count} nodes ")
        # The monitor of the user remains, and the progress bar is removed.
        count = len(fractions)
        with contextlib.redirect_stderr(io.StringIO()) as text:
            self.placement.set_spacing(0.04).run()
        self.assertEqual(text.getvalue(), "")
        self.assertGreater(len(fractions), count)

    def test_ends_with_an_exception(self):
        self.placement.set_monitor(lambda *_: 1 / 0)
        with unittest.mock.patch.dict(sys.modules, {"tqdm.auto": None}), \
                contextlib.redirect_stderr(io.StringIO()) as text:
            with self.assertRaises(ZeroDivisionError):
                self.placement.run(progress=True)
        self.assertTrue(text.getvalue().endswith("\n"))

    def test_a_monitor_stops_it(self):
        self.placement.set_monitor(lambda *_: True)
        with contextlib.redirect_stderr(io.StringIO()):
            self.assertEqual(self.placement.run(progress=True), Status.STOPPED)

    @unittest.skipUnless(importlib.util.find_spec("tqdm"), "no tqdm")
    def test_by_tqdm(self):
        lines = [line for line in self.shown() if line]
        self.assertTrue(lines[0].startswith("  0%|"))
        self.assertTrue(lines[-1].startswith("100%|"))
        self.assertIn(f"{self.placement.node_count} nodes", lines[-1])


class Summaries(Case):
    def test_of_what_is_open(self):
        placement = self.square().set_spacing(0.02)
        self.assertEqual(repr(placement), "<pnpbs.Placement, 2D, 0 nodes on this rank>")
        placement.run()
        n = placement.node_count
        self.assertTrue(1000 < n < 10**6)
        self.assertEqual(repr(placement),
                         f"<pnpbs.Placement, 2D, {n // 1000} {n % 1000:03} nodes on this rank>")
        self.assertEqual(repr(self.context), "<pnpbs.Context, one process>")
        self.assertEqual(repr(pnpbs.Domain(self.context, dim=3)), "<pnpbs.Domain, 3D: empty>")
        self.assertEqual(repr(placement.nodes()), f"<pnpbs.Nodes, points ({n}, 2), ids ({n},), "
                                                  f"tags ({n},), spacing ({n},)>")
        self.assertEqual(repr(placement.numbering()),
                         f"<pnpbs.Numbering, first 0, count {n}, ghosts (0,)>")
        for result in (placement.ghosts(), placement.exchange_pattern(), placement.stars(),
                       placement.boundary_edges(), placement.domain.outline()):
            self.assertLess(len(repr(result)), 250)
            self.assertNotIn("array", repr(result))


class Handles(Case):
    def test_closing(self):
        placement = self.square().set_spacing(0.2)
        self.context.close()
        self.context.close()
        self.assertFalse(placement.is_open or placement.domain.is_open)
        self.assert_status(Status.ERROR_HANDLE, placement.run)
        self.assert_status(Status.ERROR_HANDLE, pnpbs.Domain, self.context)
        for handle in (self.context, placement, placement.domain):
            self.assertIn("closed", repr(handle))

    def test_closing_in_a_callback_is_refused(self):
        placement = self.square()
        refused = []

        def d(x):
            if not refused:
                for handle in (placement, placement.domain, self.context):
                    with self.assertRaises(pnpbs.PNPBSError) as raised:
                        handle.close()
                    refused.append(str(raised.exception))
            return np.full(len(x), 0.2)

        placement.set_spacing(d).run()
        self.assertEqual(len(refused), 3)
        for words in refused:
            self.assertIn("in progress", words)
        self.assertGreater(placement.node_count, 10)
        placement.close()
        self.assertFalse(placement.is_open)

    def test_with(self):
        with pnpbs.Context(steps=3) as context:
            with pnpbs.Placement(pnpbs.Domain(context).add_polyline(SQUARE)) as placement:
                self.assertEqual(placement.set_spacing(0.05).run(), Status.NOT_CONVERGED)
            self.assertFalse(placement.is_open)
        self.assertFalse(context.is_open)

    def test_options(self):
        self.assertIn("steps", self.assert_status(Status.ERROR_KEY, self.context.set, step=3))
        self.assertIn("-3", self.assert_status(Status.ERROR_ARGUMENT, self.square, steps=-3))
        self.square(method="paper", steps=10, tolerance_mean=0.05)

    def test_integers_that_do_not_fit(self):
        wide = 2**32 + 1
        domain = pnpbs.Domain(self.context).add_polyline(SQUARE, tags=np.int64(2**31 - 1))
        placement = pnpbs.Placement(domain).set_spacing(0.3)
        placement.run()
        self.assertEqual(placement.nodes().tags.max(), 2**31 - 1)
        for function, bits in ((lambda: placement.mesh(ghost_layers=wide), 32),
                               (lambda: pnpbs.Domain(self.context, dim=-wide), 32),
                               (lambda: domain.distance([(0, 0)], tag=wide), 32),
                               (lambda: placement.step(2**64 + 1), 64),
                               (lambda: placement.set(steps=2**64 + 1), 64)):
            with self.assertRaisesRegex(ctypes.ArgumentError, rf"\w+ is -?\d+, .* {bits} bits"):
                function()
        with self.assertRaisesRegex(ctypes.ArgumentError, "ghost_layers is 4294967297, "):
            placement.mesh(wide)
        with self.assertRaises(ctypes.ArgumentError):
            placement.mesh(1.5)
        for tags in (wide, [1, 2, wide, 3], np.array([1, 2, wide, 3])):
            with self.assertRaisesRegex(ValueError, "tags has 4294967297, .* 32 bits"):
                domain.add_polyline(SQUARE, tags=tags)

    def test_what_is_no_communicator(self):
        with self.assertRaises(TypeError):
            pnpbs.Context("world")


class Threads(unittest.TestCase):
    def spins(self, **variables):
        """Returns the spin count that GCC's OpenMP reports when it is loaded, and the value of the
        variable afterwards."""
        program = "import os, pnpbs; pnpbs.build_info(); print(os.environ.get('GOMP_SPINCOUNT'))"
        environment = {name: value for name, value in os.environ.items()
                       if name not in ("OMP_WAIT_POLICY", "GOMP_SPINCOUNT")}
        done = subprocess.run([sys.executable, "-c", program], check=True, capture_output=True, text=True,
                              env={**environment, "OMP_DISPLAY_ENV": "verbose", **variables})
        told = re.search(r"GOMP_SPINCOUNT = '(\d+)'", done.stderr)
        return told and int(told[1]), done.stdout.strip()

    def test_they_soon_sleep_while_they_wait(self):
        if self.spins()[0] is None:
            self.skipTest("another OpenMP than GCC's")
        self.assertEqual(self.spins(), (1000, "None"))
        self.assertEqual(self.spins(GOMP_SPINCOUNT="7"), (7, "7"))
        self.assertGreater(self.spins(OMP_WAIT_POLICY="active")[0], 10**6)


class Stopping(Case):
    def test_by_the_monitor(self):
        calls = []

        def monitor(fraction, step, nodes, max_speed):
            calls.append((fraction, step, nodes, max_speed))
            return len(calls) > 3

        placement = self.square().set_spacing(0.02).set_monitor(monitor)
        self.assertEqual(placement.run(), Status.STOPPED)
        placement.set_monitor(None)
        self.assertEqual(placement.run(), Status.OK)
        self.assertEqual(len(calls), 4)

    def test_by_an_exception(self):
        def monitor(*_):
            raise LookupError("enough")

        placement = self.square().set_spacing(0.05).set_monitor(monitor)
        with self.assertRaisesRegex(LookupError, "enough"):
            placement.run()
        placement.check()

    def test_by_ctrl_c(self):
        placement = self.square(tolerance_mean=0, tolerance_max=0, steps=10**6).set_spacing(0.01)
        began = threading.Event()
        placement.set_monitor(lambda *_: began.set())

        def interrupt():
            began.wait()
            time.sleep(0.2)
            os.kill(os.getpid(), signal.SIGINT)

        thread = threading.Thread(target=interrupt)
        thread.start()
        with self.assertRaises(KeyboardInterrupt):
            placement.run()
        thread.join()
        placement.check()


class Fields(Case):
    def test_sums(self):
        placement = self.square().set_spacing(0.2)
        placement.run()
        values = np.full(placement.node_count, 0.1)
        values[:2] = 1e30, -1e30
        exact = (placement.node_count - 2) * 0.1
        self.assertAlmostEqual(placement.sum(values), exact, 12)
        pairs = np.stack([values, np.ones_like(values)], axis=1)
        np.testing.assert_allclose(placement.sum(pairs), [exact, placement.node_count])
        self.assertEqual(placement.dot(np.ones_like(values), np.ones_like(values)),
                         placement.node_count)
        with self.assertRaises(ValueError):
            placement.dot(values, pairs)
        self.assertIs(placement.update_ghosts(values), values)
        for wrong in ([1.0], values[::2], values.astype(np.float32)):
            with self.assertRaises(ValueError):
                placement.update_ghosts(wrong)

    def test_transfer(self):
        placement = self.square().set_spacing(0.1)
        placement.run()

        def linear(x):
            return np.stack([1 + 2 * x[:, 0] - x[:, 1], x[:, 1]], axis=1)

        def quadratic(x):
            return x[:, 0] ** 2 - 2 * x[:, 0] * x[:, 1] + 3

        points = placement.nodes().points
        bent = pnpbs.Transfer(placement, quadratic(points), order=2)
        self.assertEqual(bent.linear_nodes, 0)
        with pnpbs.Transfer(placement, linear(points)) as field:
            self.assertEqual(field.linear_nodes, -1)
            placement.set_spacing(graded)
            placement.run()
            np.testing.assert_allclose(field.at_nodes(placement), linear(placement.nodes().points),
                                       atol=1e-12)
            np.testing.assert_allclose(bent.at_nodes(placement), quadratic(placement.nodes().points),
                                       atol=1e-12)
            asked = np.array([(0.3, 0.4), (0.9, 0.1)])
            np.testing.assert_allclose(field.at_points(asked), linear(asked), atol=1e-12)
        self.assertFalse(field.is_open)
        with self.assertRaises(ValueError):
            pnpbs.Transfer(placement, placement.nodes().spacing, order=3)

    def test_spacing_from_the_shape(self):
        domain = pnpbs.Domain(self.context).add_arc((0, 0), 1, tag=3)
        np.testing.assert_allclose(domain.distance([(0, 0), (0.5, 0)]), [1, 0.5], atol=1e-6)
        np.testing.assert_allclose(domain.distance([(0, 2)], tag=3), [1], atol=1e-6)
        np.testing.assert_allclose(domain.shape_spacing([(1, 0), (0, 0)], nodes_per_turn=60),
                                   [2 * np.pi / 60, 2 * np.pi / 60 + 0.15], rtol=1e-3)
        placement = pnpbs.Placement(domain).set_spacing_from_shape(nodes_per_turn=60)
        placement.run()
        self.assertAlmostEqual(np.count_nonzero(placement.nodes().tags), 60, delta=2)

    def test_tags_with_names(self):
        domain = pnpbs.Domain(self.context).add_polyline(SQUARE, tags=7)
        domain.set_tag_name(1, 7, "wall")
        self.assertEqual(domain.tag_names(), {(1, 7): "wall"})


class TheLibraryForThisProcessor(unittest.TestCase):
    def test_best_level(self):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            common = folder / "libpnpbs.so"
            level = {v: folder / "glibc-hwcaps" / f"x86-64-{v}" / "libpnpbs.so.0" for v in ("v3", "v4")}
            self.assertEqual(_levels.best_level(common, _levels._V4), common)
            for library in level.values():
                library.parent.mkdir(parents=True)
                library.touch()
                self.assertEqual(_levels.common_folder(library), folder)
            self.assertEqual(_levels.common_folder(common), folder)
            self.assertEqual(_levels.best_level(common, _levels._V4), level["v4"])
            self.assertEqual(_levels.best_level(common, _levels._V3), level["v3"])
            self.assertEqual(_levels.best_level(common, _levels._V4 - {"avx2"}), common)
            self.assertEqual(_levels.best_level(common, set()), common)

    def test_processor_flags(self):
        with tempfile.TemporaryDirectory() as name:
            cpuinfo = pathlib.Path(name) / "cpuinfo"
            self.assertEqual(_levels.processor_flags(cpuinfo), set())
            cpuinfo.write_text("processor\t: 0\nflags\t\t: fpu avx2\n\nflags\t\t: other\n")
            self.assertEqual(_levels.processor_flags(cpuinfo), {"fpu", "avx2"})


class TheCommandOfAWheel(unittest.TestCase):
    def test_is_that_of_the_package_in_use(self):
        script = DATA.parents[1] / "bindings" / "python" / "command.py"
        with tempfile.TemporaryDirectory() as name:
            package, installed = pathlib.Path(name) / "pnpbs", pathlib.Path(name) / "scripts" / "pnpbs"
            installed.parent.mkdir()
            shutil.copy(script, installed)
            command = package / "bin" / "pnpbs"
            command.parent.mkdir(parents=True)
            (package / "__init__.py").write_text("raise SystemExit('the package is not loaded')")
            command.write_text("#!/bin/sh\nprintf '%s,' \"$@\"\nexit 3\n")
            command.chmod(0o755)
            done = subprocess.run([sys.executable, "-B", installed, "--x=a b", ""], capture_output=True,
                                  check=False, env={**os.environ, "PYTHONPATH": name}, text=True)
            self.assertEqual((done.returncode, done.stdout, done.stderr), (3, "--x=a b,,", ""))


if __name__ == "__main__":
    unittest.main()
