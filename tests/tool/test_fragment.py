# SPDX-License-Identifier: BSD-3-Clause
"""Tests --fragment: groups of a file that cross and touch become regions of one body."""

import itertools
import json
import os
import unittest

import meshio
import numpy

from command import CommandTest


def box(low, high):
    """Returns the twelve triangles of a box, counter-clockwise as seen from outside."""
    triangles = []
    for axis, side in itertools.product(range(3), range(2)):
        u, v = (axis + 1) % 3, (axis + 2) % 3
        corners = []
        for s, t in ((0, 0), (1, 0), (1, 1), (0, 1)):
            x = [0, 0, 0]
            x[axis] = (low, high)[side][axis]
            x[u] = (low, high)[s][u]
            x[v] = (low, high)[t][v]
            corners.append(x)
        for a, b, c in ((0, 1, 2), (0, 2, 3)):
            triangles.append([corners[a], corners[b] if side else corners[c],
                              corners[c] if side else corners[b]])
    return triangles


def solid(name, triangles):
    facets = "".join("facet normal 0 0 0\nouter loop\n"
                     + "".join("vertex {} {} {}\n".format(*x) for x in triangle)
                     + "endloop\nendfacet\n" for triangle in triangles)
    return f"solid {name}\n{facets}endsolid {name}\n"


# Two blocks side by side, a third one across both, and a sheet through all that ends outside.
MODEL = (solid("left", box((0, 0, 0), (1, 1, 1))) + solid("right", box((1, 0.2, 0.1), (2, 1, 0.9)))
         + solid("bar", box((0.4, 0.5, 0.3), (1.7, 0.8, 0.6)))
         + solid("sheet", [[(-1, -1, 0.45), (3, -1, 0.45), (1, 4, 0.45)]]))
VOLUMES = {"left": 1 - 0.6 * 0.3 * 0.3, "right": 0.64 - 0.7 * 0.3 * 0.3, "bar": 1.3 * 0.3 * 0.3}


def volumes_by_region(path):
    """Returns the volume of the tetrahedra of each region of a .vtu file."""
    mesh = meshio.read(path)
    corners = mesh.points[mesh.cells_dict["tetra"]]
    volumes = numpy.linalg.det(corners[:, 1:] - corners[:, :1]) / 6
    regions = mesh.cell_data_dict["region"]["tetra"]
    return {int(tag): volumes[regions == tag].sum() for tag in numpy.unique(regions)}


class Fragment(CommandTest):
    def setUp(self):
        super().setUp()
        self.model = self.folder / "model.stl"
        self.model.write_text(MODEL)

    def test_regions_have_their_volumes(self):
        self.run_command("--domain", self.model, "--fragment", "--spacing", 0.07,
                         "--output", "a.vtu", "--check")
        found = volumes_by_region(self.folder / "a.vtu")
        self.assertEqual(sorted(found), [1, 2, 3])
        for tag, name in enumerate(VOLUMES, 1):
            self.assertAlmostEqual(found[tag], VOLUMES[name], 12, name)

    def test_regions_have_the_names_of_groups(self):
        self.run_command("--domain", self.model, "--fragment", "--spacing", 0.1,
                         "--output", "a.msh")
        names = meshio.read(self.folder / "a.msh").field_data
        volumes = {int(tag): name for name, (tag, dimension) in names.items() if dimension == 3}
        self.assertEqual({tag: volumes[tag] for tag in (1, 2, 3)},
                         {1: "left", 2: "right", 3: "bar"})

    @unittest.skipUnless(os.environ.get("PNPBS_MPIEXEC"), "no MPI")
    def test_nodes_are_the_same_on_any_ranks(self):
        hashes = set()
        for ranks in (1, 2, 3):
            self.run_on_ranks("--domain", self.model, "--fragment", "own", "--spacing", 0.12,
                              "--report", "report.json", ranks=ranks)
            hashes.add(json.loads((self.folder / "report.json").read_text())["hash"])
        self.assertEqual(len(hashes), 1)

    def test_messages_name_the_option(self):
        self.assertIn("--fragment", self.refuse("--domain", self.model, "--spacing", 0.12))
        for options, words in ((["--fragment", "all"], "expected last, first or own"),
                               (["--fragment", "--repair"], "excludes --repair"),
                               (["--fragment", "--surfaces-only"], "exclude each other")):
            message = self.refuse("--domain", self.model, "--spacing", 0.12, *options)
            self.assertIn(words, message)


if __name__ == "__main__":
    unittest.main()
