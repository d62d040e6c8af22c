# SPDX-License-Identifier: BSD-3-Clause
"""Tests MPAS grids of spheres. Their arrays are consistent, and the weights of velocities along
edges are those of TRiSK, which is checked by properties that no other weights have (Thuburn,
Ringler, Skamarock and Klemp 2009). PNPBS_GEO says whether the command was built with GDAL."""

import json
import os
import unittest

import netCDF4
import numpy as np
import scipy.sparse

from builds import exists_if
from command import CommandTest

RADIUS = 6371220.0  # in metres


def unit(x):
    return x / np.linalg.norm(x, axis=-1, keepdims=True)


def arc(a, b):
    return np.arctan2(np.linalg.norm(np.cross(a, b), axis=-1), np.sum(a * b, axis=-1))


def triangle_area(a, b, c):
    """Returns the area by l'Huilier's theorem."""
    x, y, z = arc(b, c), arc(c, a), arc(a, b)
    s = (x + y + z) / 2
    return 4 * np.arctan(np.sqrt(np.maximum(0, np.tan(s / 2) * np.tan((s - x) / 2) * np.tan((s - y) / 2)
                                            * np.tan((s - z) / 2))))


class Grid:
    def __init__(self, path):
        with netCDF4.Dataset(path) as file:
            file.set_auto_mask(False)
            self.model = file.data_model
            self.sizes = {name: len(dimension) for name, dimension in file.dimensions.items()}
            self.attributes = {name: file.getncattr(name) for name in file.ncattrs()}
            self.values = {name: file[name][:] for name in file.variables}
        self.x = {of: np.column_stack([self[c + of] for c in "xyz"]) / RADIUS for of in ("Cell", "Edge", "Vertex")}

    def __getitem__(self, name):
        return self.values[name]

    def places(self, name, others=True):
        """Returns indices from 0, or -1 for none."""
        return self[name].astype(np.int64) - 1

    def rows_of(self, name, counts):
        """Returns the row index and the value of each used entry, that is, of the first `counts`
        entries of each row."""
        columns = self.places(name)
        used = np.arange(columns.shape[1]) < self[counts][:, None]
        assert np.all(columns[~used] == -1), name
        return np.repeat(np.arange(len(columns)), self[counts]), columns[used], used


class MpasGrids(CommandTest):
    def grid(self, *arguments, ranks=0, name="grid.nc"):
        arguments = (*arguments, "--output", name, "--format", "mpas", "--output", "graph.graph", "--output",
                     "nodes.csv", "--quiet", "--report", "report.json")
        if ranks:
            self.run_on_ranks(*arguments, ranks=ranks)
        else:
            self.run_command(*arguments)
        return Grid(self.folder / name)

    def report(self):
        return json.loads((self.folder / "report.json").read_text())

    def whole(self, **more):
        return self.grid("--sphere", f"{RADIUS},20,-30", "--spacing", "350e3 + 150e3*sin(pi*lat/180)^2", **more)

    def check_places(self, grid):
        for of, x in grid.x.items():
            lat, lon = grid["lat" + of], grid["lon" + of]
            np.testing.assert_allclose(np.linalg.norm(x, axis=1), 1, rtol=1e-15)
            np.testing.assert_allclose(
                np.column_stack([np.cos(lat) * np.cos(lon), np.cos(lat) * np.sin(lon), np.sin(lat)]), x, atol=2e-15)
            self.assertTrue(np.all((lon >= 0) & (lon <= 2 * np.pi)))
        cells = grid.places("cellsOnVertex")
        gaps = np.linalg.norm(grid.x["Cell"][cells] - grid.x["Vertex"][:, None], axis=2)
        whole = np.all(cells >= 0, axis=1)
        self.assertLess(np.ptp(gaps[whole], axis=1).max(), 2e-15)
        np.testing.assert_array_equal(grid["boundaryVertex"], ~whole)

    def check_neighbours(self, grid):
        on_edge, vertices = grid.places("cellsOnEdge"), grid.places("verticesOnEdge")
        self.assertTrue(np.all(on_edge[:, 0] >= 0))
        for name, other in (("edgesOnCell", on_edge), ("verticesOnCell", grid.places("cellsOnVertex"))):
            cell, what, _ = grid.rows_of(name, "nEdgesOnCell")
            self.assertTrue(np.all(np.any(other[what] == cell[:, None], axis=1)), name)
        # Each vertex of a cell lies between an edge and the next one, and so does each cell at a
        # vertex.
        count, edges = grid["nEdgesOnCell"], grid.places("edgesOnCell")
        for k in range(edges.shape[1]):
            here = np.flatnonzero(count > k)
            follows = edges[here, np.where(k + 1 < count[here], k + 1, 0)]
            vertex = grid.places("verticesOnCell")[here, k]
            for edge in (edges[here, k], follows):
                self.assertTrue(np.all(np.any(vertices[edge] == vertex[:, None], axis=1)))
            beside = grid.places("cellsOnCell")[here, k]
            np.testing.assert_array_equal(beside, on_edge[edges[here, k]].sum(axis=1) - here)
        for k in range(3):
            cell = grid.places("cellsOnVertex")[:, k]
            for edge in grid.places("edgesOnVertex")[:, [k, (k + 1) % 3]].T:
                here = (cell >= 0) & (edge >= 0)
                self.assertTrue(np.all(np.any(on_edge[edge[here]] == cell[here, None], axis=1)))

    def check_measures(self, grid):
        area = grid["areaCell"]
        cells, kites = grid.places("cellsOnVertex"), grid["kiteAreasOnVertex"]
        sums = np.bincount(cells[cells >= 0], kites[cells >= 0], len(area))
        np.testing.assert_allclose(sums, area, rtol=1e-13)
        cell, vertex, _ = grid.rows_of("verticesOnCell", "nEdgesOnCell")
        ends = np.append(np.flatnonzero(np.diff(cell)), len(cell) - 1)
        after = np.roll(vertex, -1)
        after[ends] = vertex[np.append(0, ends[:-1] + 1)]
        fans = triangle_area(grid.x["Cell"][cell], grid.x["Vertex"][vertex], grid.x["Vertex"][after])
        np.testing.assert_allclose(np.bincount(cell, fans) * RADIUS**2, area, rtol=1e-9)
        np.testing.assert_allclose(kites.sum(axis=1), grid["areaTriangle"], rtol=1e-13)
        np.testing.assert_array_equal(kites[cells < 0], 0)
        between = np.all(grid.places("cellsOnEdge") >= 0, axis=1)
        a, b = grid.x["Cell"][grid.places("cellsOnEdge")].swapaxes(0, 1)
        v, w = grid.x["Vertex"][grid.places("verticesOnEdge")].swapaxes(0, 1)
        np.testing.assert_allclose(grid["dvEdge"] / RADIUS, arc(v, w), atol=2e-15)
        np.testing.assert_allclose(grid["dcEdge"][between] / RADIUS, arc(a, b)[between], atol=2e-15)
        np.testing.assert_allclose(grid.x["Edge"][between], unit(a + b)[between], atol=2e-15)
        self.assertTrue(np.all(np.sum(np.cross(b - a, w - v) * grid.x["Edge"], axis=1)[between] >= 0))
        lon = grid["lonEdge"]
        east = np.column_stack([-np.sin(lon), np.cos(lon), 0 * lon])
        north = np.cross(grid.x["Edge"], east)
        turn = np.arctan2(np.sum((b - a) * north, axis=1), np.sum((b - a) * east, axis=1)) - grid["angleEdge"]
        self.assertLess(np.abs(np.angle(np.exp(1j * turn[between]))).max(), 1e-12)

    def check_weights(self, grid):
        """Energy is conserved: the matrix is antisymmetric in the right measure. Geostrophic modes
        are steady: the divergence of the velocities along the edges is that of those across them,
        by kites."""
        edge, other, used = grid.rows_of("edgesOnEdge", "nEdgesOnEdge")
        weights = scipy.sparse.csr_matrix((grid["weightsOnEdge"][used], (edge, other)),
                                          shape=(grid.sizes["nEdges"],) * 2)
        np.testing.assert_array_equal(grid["weightsOnEdge"][~used], 0)
        long_enough = grid["dvEdge"] > 1e-3 * grid["dcEdge"]
        measured = (scipy.sparse.diags(grid["dcEdge"]) @ weights @ scipy.sparse.diags(1 / grid["dvEdge"]))
        measured = measured[long_enough][:, long_enough]
        self.assertLess(abs(measured + measured.T).max(), 1e-13)
        self.assertGreater(abs(measured).max(), 0.2)
        across = np.random.default_rng(1).standard_normal(grid.sizes["nEdges"])
        first, second = grid.places("cellsOnEdge").T
        flux = across * grid["dvEdge"]
        n = grid.sizes["nCells"]
        divergence = np.bincount(first, flux, n)
        divergence -= np.bincount(second[second >= 0], flux[second >= 0], n)
        divergence /= grid["areaCell"]
        out = (weights @ across) * grid["dcEdge"]
        begins, ends = grid.places("verticesOnEdge").T
        n = grid.sizes["nVertices"]
        at_vertices = np.bincount(begins, out, n) - np.bincount(ends, out, n)
        cells = grid.places("cellsOnVertex")
        wanted = np.sum(grid["kiteAreasOnVertex"] * divergence[cells], axis=1)
        whole = np.all(cells >= 0, axis=1)
        self.assertLess(np.abs(at_vertices - wanted)[whole].max(), 1e-12 * np.abs(wanted).max())

    def check_all(self, grid):
        self.assertEqual(grid.model, "NETCDF3_64BIT_DATA")
        self.assertEqual(grid.sizes["maxEdges"], grid["nEdgesOnCell"].max())
        self.check_places(grid)
        self.check_neighbours(grid)
        self.check_measures(grid)
        self.check_weights(grid)

    def test_a_whole_sphere(self):
        grid = self.whole()
        self.check_all(grid)
        n = grid.sizes
        self.assertEqual(n["nCells"] - n["nEdges"] + n["nVertices"], 2)
        np.testing.assert_allclose([grid["areaCell"].sum(), grid["areaTriangle"].sum()], 4 * np.pi * RADIUS**2,
                                   rtol=1e-12)
        self.assertEqual({k: grid.attributes[k] for k in ("on_a_sphere", "sphere_radius", "is_periodic",
                                                         "Conventions", "mesh_spec")},
                         {"on_a_sphere": "YES", "sphere_radius": RADIUS, "is_periodic": "NO", "Conventions": "MPAS",
                          "mesh_spec": "1.0"})
        nodes = np.genfromtxt(self.folder / "nodes.csv", delimiter=",", names=True)
        np.testing.assert_allclose(grid.x["Cell"] * RADIUS, np.column_stack([nodes[k] for k in "xyz"]), rtol=1e-12,
                                   atol=1e-8)
        d = nodes["spacing"]
        np.testing.assert_allclose(grid["meshDensity"], (d.min() / d)**4, rtol=1e-12)
        np.testing.assert_allclose(grid["gridSpacing"], d, rtol=0.35)
        np.testing.assert_array_equal(grid["indexToCellID"], 1 + np.arange(n["nCells"]))
        self.check_qualities(grid)
        # The nodes of the closing patch do not move, so the statistics leave them out.
        bands = self.report()["cell"]["bands"]
        cells = sum(band["cells"] for band in bands)
        self.assertTrue(0.8 * n["nCells"] < cells < n["nCells"], f"{cells} of {n['nCells']}")
        self.assertGreaterEqual(min(band["min_edge_ratio"] for band in bands), grid["cellQuality"].min() - 1e-9)

    def check_qualities(self, grid):
        cell, edge, _ = grid.rows_of("edgesOnCell", "nEdgesOnCell")
        begins = np.flatnonzero(np.diff(cell, prepend=-1))
        least, most = (f.reduceat(grid["dvEdge"][edge], begins) for f in (np.minimum, np.maximum))
        np.testing.assert_allclose(grid["cellQuality"], least / most, atol=1e-12)
        sides = grid["dcEdge"][grid.places("edgesOnVertex")]
        np.testing.assert_allclose(grid["triangleQuality"], sides.min(axis=1) / sides.max(axis=1), rtol=1e-12)
        square = np.sort(sides, axis=1)**2
        np.testing.assert_array_equal(grid["obtuseTriangle"], square[:, 2] > square[:, 0] + square[:, 1])
        self.assertTrue(np.all((grid["triangleAngleQuality"] > 0) & (grid["triangleAngleQuality"] <= 1)))

    def check_report(self, grid, d):
        """Checks the statistics of the cells, in total and by bands of d at the cells."""
        report = self.report()
        pairs = grid.places("cellsOnEdge")
        between = np.all(pairs >= 0, axis=1)
        areas = np.sort(grid["areaCell"][pairs[between]], axis=1)
        middles = unit(grid.x["Vertex"][grid.places("verticesOnEdge")[between]].sum(axis=1))
        offsets = arc(middles, grid.x["Edge"][between]) * RADIUS / grid["dcEdge"][between]
        measures = {"edge_ratio": ("cell", "cells", "min", grid["cellQuality"], d),
                    "area_ratio": ("cell", "edges", "min", areas[:, 0] / areas[:, 1], d[pairs[between]].mean(axis=1)),
                    "dual_offset": ("edge", "edges", "max", offsets, d[pairs[between]].mean(axis=1))}
        bands = report["cell"]["bands"]
        ends = [band["to"] for band in bands]
        self.assertEqual([band["from"] for band in bands[1:]], ends[:-1])
        self.assertTrue({band["from"] for band in bands} <= {band["from"] for band in report["edge"]["bands"]})
        for name, (group, number, worst, values, at) in measures.items():
            of_worst = getattr(np, worst)
            of_all = [report[group][f"{which}_{name}"] for which in ("mean", worst)]
            np.testing.assert_allclose(of_all, [values.mean(), of_worst(values)], atol=1e-9)
            place = np.searchsorted(ends[:-1], at, side="right")
            for k, band in enumerate(bands):
                here = values[place == k]
                self.assertEqual(band[number], len(here))
                expected = [here.mean(), of_worst(here)] if len(here) else [np.nan] * 2
                told = [band[f"{which}_{name}"] for which in ("mean", worst)]
                np.testing.assert_allclose(np.array(told, float), expected, atol=1e-9)

    def test_bodies_have_no_such_figures(self):
        self.run_command("--domain", "box(0,0,0,1,1,1)", "--spacing", "0.25", "--report", "report.json", "--quiet")
        self.assertNotIn("bands", self.report()["cell"])
        self.assertIn("bands", self.report()["edge"])

    def test_the_graph_of_the_cells(self):
        grid = self.whole()
        lines = (self.folder / "graph.graph").read_text().splitlines()
        self.assertEqual(lines[0], f"{grid.sizes['nCells']} {grid.sizes['nEdges']}")
        for line, row, count in zip(lines[1:], grid["cellsOnCell"], grid["nEdgesOnCell"], strict=True):
            self.assertEqual([int(word) for word in line.split()], row[:count].tolist())

    @exists_if(os.environ.get("PNPBS_MPIEXEC"))
    def test_ranks_write_the_same(self):
        self.whole(ranks=1)
        files = [(self.folder / name).read_bytes() for name in ("grid.nc", "graph.graph")]
        figures = [self.report()[name] for name in ("cell", "edge", "quality")]
        for ranks in (2, 3, 5):
            self.whole(ranks=ranks)
            self.assertEqual([(self.folder / name).read_bytes() for name in ("grid.nc", "graph.graph")], files)
            self.assertEqual([self.report()[name] for name in ("cell", "edge", "quality")], figures)

    def test_what_is_refused(self):
        for name in ("grid.mpas", "grid.graph"):
            self.assertIn("cells of a sphere", self.refuse("--domain", self.square, "--spacing", "0.1", "--output", name))

    @exists_if(os.environ["PNPBS_GEO"] == "1")
    def test_a_sea_without_a_node_inside(self):
        pond = self.folder / "pond.geojson"
        pond.write_text(json.dumps({"type": "Polygon", "coordinates": [[[0, 0], [5, 0], [0, 5], [0, 0]]]}))
        for name in ("grid.mpas", "grid.graph"):
            message = self.refuse("--domain", pond, "--sphere", f"{RADIUS},0,-90", "--spacing", "500e3", "--quiet",
                                  "--output", name)
            self.assertIn("would have no cells, because all nodes are on the boundary", message)

    @exists_if(os.environ["PNPBS_GEO"] == "1")
    def test_a_sea_is_a_culled_grid(self):
        ring = [[40 * np.cos(t), 30 * np.sin(t)] for t in np.radians(range(0, 360, 15))]
        coast = self.folder / "island.geojson"
        coast.write_text(json.dumps({"type": "Polygon", "coordinates": [ring + ring[:1]]}))
        arguments = ("--domain", coast, "--sphere", f"{RADIUS},0,0", "--spacing", "300e3 + 0.05*dist", "--corner-angle",
                     "20")
        grid = self.grid(*arguments)
        self.check_all(grid)
        nodes = np.genfromtxt(self.folder / "nodes.csv", delimiter=",", names=True)
        inner = nodes[nodes["tag"] == 0]
        np.testing.assert_allclose(grid.x["Cell"] * RADIUS, np.column_stack([inner[k] for k in "xyz"]), rtol=1e-12,
                                   atol=1e-8)
        n = grid.sizes
        # The domain has one land. Vertices and edges beyond the outermost cells form a ring,
        # without the edges that lie between land only.
        self.assertEqual(n["nCells"] - n["nEdges"] + n["nVertices"], 1)
        self.assertGreater(np.sum(grid["cellsOnEdge"] == 0), 20)
        self.assertGreater(np.sum(grid["boundaryVertex"]), 20)
        self.assertLess(grid["areaCell"].sum(), 4 * np.pi * RADIUS**2)
        self.assertEqual(grid["meshDensity"].max(), 1)
        self.check_report(grid, inner["spacing"])
        if os.environ.get("PNPBS_MPIEXEC"):
            whole = (self.folder / "grid.nc").read_bytes()
            self.grid(*arguments, ranks=3)
            self.assertEqual((self.folder / "grid.nc").read_bytes(), whole)


if __name__ == "__main__":
    unittest.main()
