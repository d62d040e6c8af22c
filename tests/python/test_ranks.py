# SPDX-License-Identifier: BSD-3-Clause
"""Tests the Python package over the ranks of mpi4py's world. The program is started by mpirun."""
import math
import pathlib
import shutil
import sys
import tempfile
import unittest

import numpy as np
from mesh_checks import check_mesh, measures
from mpi4py import MPI
import pnpbs
from pnpbs import PNPBSError, Status

WORLD = MPI.COMM_WORLD
LAST = WORLD.size - 1


def graded(x):
    return 0.03 + 0.05 * x[:, 0]


def placed_square(context):
    domain = pnpbs.Domain(context).add_polyline([(0, 0), (1, 0), (1, 1), (0, 1)])
    placement = pnpbs.Placement(domain).set_spacing(graded)
    placement.run()
    return placement


def placed_box(context):
    domain = pnpbs.Domain(context, 3).add_box((0, 0, 0), (1, 1, 1))
    placement = pnpbs.Placement(domain, steps=20).set_spacing(0.2)
    placement.run()
    return placement


def rows_by_id(placement):
    """Returns a sum over the elements around each node of this rank, in the order of the elements,
    by id."""
    own, ghosts = placement.nodes(), placement.ghosts()
    ids = np.concatenate([own.ids, ghosts.ids])
    points = np.concatenate([own.points, ghosts.points])
    rows = dict.fromkeys(own.ids.tolist(), 0.0)
    for corners in placement.incident_elements():
        term = math.fsum((points[corners[1:]] - points[corners[0]])[0] ** 2)
        for corner in corners[corners < len(own.ids)]:
            rows[int(ids[corner])] += term / 3
    return rows


class Ranks(unittest.TestCase):
    def setUp(self):
        self.context = pnpbs.Context(WORLD)
        self.placement = placed_square(self.context)

    def tearDown(self):
        self.context.close()

    def test_mid_nodes_are_those_of_one_process(self):
        """Checks elements of second order in a ball: each edge has one number and one mid node on
        all ranks, as in one process, and the elements refer to them."""
        def place(context):
            domain = pnpbs.Domain(context, 3).add_ball((0, 0, 0), 1)
            placement = pnpbs.Placement(domain, steps=20).set_spacing(0.4)
            placement.run()
            return placement, placement.edges()

        def of_numbers(edges):
            return dict(zip(edges.numbers.tolist(), map(tuple, edges.midpoints.tolist())))

        with pnpbs.Context() as alone:
            placement, edges = place(alone)
            expected, count = of_numbers(edges), len(placement.tetrahedra())
        placement, edges = place(self.context)
        found = of_numbers(edges)
        self.assertEqual(found, {number: expected[number] for number in found})
        self.assertEqual(set().union(*WORLD.allgather(set(found))), set(expected))
        elements = placement.tetrahedra(order=2)
        self.assertEqual(WORLD.allreduce(len(elements)), count)
        first = placement.node_count + placement.ghost_count()
        for mid, (a, b) in enumerate([(0, 1), (1, 2), (0, 2), (0, 3), (1, 3), (2, 3)], 4):
            np.testing.assert_array_equal(edges.ends[elements[:, mid] - first],
                                          np.sort(elements[:, [a, b]], axis=1))
        facets = placement.boundary_triangles(order=2).corners
        radii = np.linalg.norm(edges.midpoints[facets[:, 3:] - first], axis=2)
        np.testing.assert_allclose(radii, 1, rtol=2e-4)

    def test_nodes_are_those_of_one_process(self):
        with pnpbs.Context() as alone:
            self.assertEqual(self.placement.statistic("hash"), placed_square(alone).statistic("hash"))
        self.assertEqual(WORLD.allreduce(self.placement.node_count),
                         self.placement.statistic("nodes"))
        self.placement.check()

    def test_voronoi_cells_are_those_of_one_process(self):
        cells, ids = self.placement.voronoi(), self.placement.nodes().ids
        with pnpbs.Context() as alone:
            placement = placed_square(alone)
            same, at = placement.voronoi(), np.searchsorted(placement.nodes().ids, ids)
        np.testing.assert_array_equal(cells.volumes, same.volumes[at])
        np.testing.assert_array_equal(cells.boundary, same.boundary[at])
        for row, other in zip(cells.neighbours, at):
            np.testing.assert_array_equal(row, same.neighbours[other])

    def test_ghosts(self):
        own, ghosts = self.placement.nodes(), self.placement.ghosts()
        self.assertEqual(len(ghosts.ids) > 0, WORLD.size > 1)
        ids = np.concatenate([own.ids, ghosts.ids])
        values = ids * 1.0
        values[len(own.ids):] = -1
        self.placement.update_ghosts(values)
        np.testing.assert_array_equal(values, ids)
        pairs = np.stack([ids, 2.0 * ids], axis=1)
        pairs[len(own.ids):] = 0
        self.placement.begin_update_ghosts(pairs)
        self.placement.end_update_ghosts(pairs)
        np.testing.assert_array_equal(pairs, np.stack([ids, 2 * ids], axis=1))

        # The exchange pattern must transfer the same ids.
        pattern = self.placement.exchange_pattern()
        requests = [WORLD.isend(own.ids[pattern.send[k]], int(rank))
                    for k, rank in enumerate(pattern.ranks)]
        for k, rank in enumerate(pattern.ranks):
            np.testing.assert_array_equal(WORLD.recv(source=int(rank)), ids[pattern.receive[k]])
        MPI.Request.waitall(requests)

    def test_rows_from_incident_elements_have_the_same_bits(self):
        for placed in (placed_square, placed_box):
            everything = WORLD.allgather(rows_by_id(placed(self.context)))
            together = {i: row for rows in everything for i, row in rows.items()}
            with pnpbs.Context() as alone:
                self.assertEqual(together, rows_by_id(placed(alone)))

    def test_sums_from_ghosts(self):
        elements, n = self.placement.incident_elements(), self.placement.node_count
        around, sums = np.zeros((2, n + self.placement.ghost_count()))
        np.add.at(around, elements.ravel(), 1)
        belonging = elements[elements[:, 0] < n]
        self.assertEqual(len(belonging), len(self.placement.triangles()))
        self.assertEqual(WORLD.allreduce(len(elements)) > WORLD.allreduce(len(belonging)),
                         WORLD.size > 1)
        np.add.at(sums, belonging.ravel(), 1)
        pairs = np.stack([sums, -sums], axis=1)
        self.placement.add_from_ghosts(sums)
        np.testing.assert_array_equal(sums[:n], around[:n])
        self.assertIs(self.placement.add_from_ghosts(pairs), pairs)
        np.testing.assert_array_equal(pairs, np.stack([sums, -sums], axis=1))
        with self.assertRaises((ValueError, PNPBSError)):
            self.placement.add_from_ghosts([1.0] if WORLD.rank == LAST else sums)

    def test_meshes(self):
        for placed in (placed_square, placed_box):
            placement = placed(self.context)
            with pnpbs.Context() as alone:
                whole = placed(alone).mesh()
            for layers in (0, 1, 2):
                mesh = placement.mesh(layers)
                check_mesh(self, mesh, WORLD.rank)
                owned = measures(mesh)[:mesh.owned_elements]
                self.assertAlmostEqual(WORLD.allreduce(owned.sum()), 1, 12)
                # Each owned item must occur once over all ranks.
                numbers = np.concatenate(WORLD.allgather(mesh.numbers[:mesh.owned_nodes]))
                np.testing.assert_array_equal(numbers, np.arange(whole.all_nodes))
                numbers = np.concatenate(WORLD.allgather(
                    mesh.element_numbers[:mesh.owned_elements]))
                np.testing.assert_array_equal(numbers, np.arange(whole.all_elements))
                self.assertEqual((mesh.all_nodes, mesh.all_elements),
                                 (whole.all_nodes, whole.all_elements))
                self.assertEqual(mesh.first_node, placement.numbering().first)
                self.assertEqual(WORLD.allreduce(np.sum(mesh.facet_owners == WORLD.rank)),
                                 len(whole.facets))
                at_own_nodes = (mesh.elements < mesh.owned_nodes).any(axis=1).sum()
                if layers:  # contains all elements at the nodes of this rank
                    self.assertEqual(at_own_nodes, len(placement.incident_elements()))
                self.assertEqual(len(mesh.elements) > mesh.owned_elements,
                                 layers > 0 and WORLD.size > 1)
                shared = {other: [i for i, ranks in zip(mesh.ids[mesh.shared_nodes].tolist(),
                                                        mesh.sharing_ranks) if other in ranks]
                          for other in range(WORLD.size)}
                for other, theirs in enumerate(WORLD.allgather(shared)):
                    self.assertEqual(shared[other], theirs[WORLD.rank])
            with self.assertRaisesRegex(PNPBSError, "ghost_layers = -1"):
                placement.mesh(-1)
            if WORLD.size > 1:
                with self.assertRaisesRegex(PNPBSError, "all ranks must give the same"):
                    placement.mesh(int(WORLD.rank == LAST))

    def test_files_of_meshes(self):
        folder = WORLD.bcast(tempfile.mkdtemp() if WORLD.rank == 0 else None)
        for layers in ({}, {"ghost_layers": 0}):
            mesh = self.placement.mesh(**{"ghost_layers": 1, **layers})
            self.assertIs(self.placement.write_mesh(pathlib.Path(folder) / "mesh", **layers),
                          self.placement)
            lines = pathlib.Path(folder, f"mesh_{WORLD.rank + 1}.msh").read_text().splitlines()
            owned_facets = np.count_nonzero(mesh.facet_owners == WORLD.rank)
            for section, rows in (("Nodes", len(mesh.numbers)),
                                  ("Elements", len(mesh.elements) + owned_facets)):
                header = lines[lines.index(f"${section}") + 1].split()
                self.assertEqual(int(header[1]), rows)
            ghosts = len(mesh.elements) - mesh.owned_elements
            self.assertEqual("$GhostElements" in lines, ghosts > 0)
            if ghosts:
                self.assertEqual(int(lines[lines.index("$GhostElements") + 1]), ghosts)
        for prefix, message in (("", "prefix is empty"), (folder + "/none/mesh", "mesh_1.msh")):
            with self.assertRaisesRegex(PNPBSError, message):
                self.placement.write_mesh(prefix)
        WORLD.Barrier()
        if WORLD.rank == 0:
            shutil.rmtree(folder)

    def test_sums_have_the_same_bits(self):
        own = self.placement.nodes()
        values = np.sin(1e3 * own.points[:, 0]) / 3
        everything = WORLD.allgather((own.ids, values))
        whole = np.zeros(1 + max(ids.max() for ids, _ in everything))
        for ids, part in everything:
            whole[ids] = part
        with pnpbs.Context() as alone:
            serial = placed_square(alone)
            expected = serial.sum(whole[serial.nodes().ids])
        self.assertEqual(self.placement.sum(values), expected)

    def test_what_fails_on_one_rank_fails_on_all(self):
        def spacing(x):
            if WORLD.rank == LAST:
                raise LookupError("not today")
            return np.full(len(x), 0.05)

        self.placement.set_spacing(spacing)
        with self.assertRaises(LookupError if WORLD.rank == LAST else PNPBSError) as caught:
            self.placement.run()
        if WORLD.rank != LAST:
            self.assertEqual(caught.exception.status, Status.ERROR_CALLBACK)
        self.placement.set_spacing(0.05)
        self.placement.run()
        places = self.placement.node_count + self.placement.ghost_count()  # collective calls
        wrong = [1.0] if WORLD.rank == LAST else np.zeros(places)
        with self.assertRaises((ValueError, PNPBSError)):
            self.placement.update_ghosts(wrong)
        ids = [1, 2] if WORLD.rank == LAST else [10 + WORLD.rank]
        with self.assertRaises((ValueError, PNPBSError)):
            self.placement.set_nodes([(0.5, 0.5 + WORLD.rank / 10)], ids=ids)


if __name__ == "__main__":
    # Only one rank reports, but a failure on another rank still makes the run fail.
    if WORLD.rank:
        sys.stderr = open("/dev/null", "w", encoding="ascii")
    # This context is not closed, so it must be closed when Python ends.
    left_open = pnpbs.Context(WORLD)
    unittest.main()
