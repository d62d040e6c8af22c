#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests of the comparison on bodies: the input of other tools, and the page with their results."""
import argparse
import sys
import unittest
from pathlib import Path
from unittest import mock

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent), str(HERE.parent / "peers")]
import compare_page  # noqa: E402
from bodies import Body, box, l_block  # noqa: E402
from command_line import shown_command  # noqa: E402
from compare import chosen, made, merged, put_together, spacing_for  # noqa: E402
from adapters.tool import VolumeOutcome  # noqa: E402
from measure import Measured  # noqa: E402
from solids import joined, solids, surfaces  # noqa: E402


def cube(low, side, cavity=False):
    body = box()
    polygons = [p[::-1] for p in body.polygons] if cavity else body.polygons
    return Body("file", body.vertices * side + low, polygons)


class Solids(unittest.TestCase):
    """A cube lies inside the cavity of another cube, which lies beside a third one."""

    def setUp(self):
        self.parts = [cube(0, 3), cube(0.5, 2, cavity=True), cube(1, 1), cube(5, 1),
                      cube(1.25, 0.5, cavity=True)]
        self.body = joined(self.parts)

    def test_surfaces(self):
        self.assertEqual(sorted(round(s.volume(), 9) for s in surfaces(self.body)), [-8, -0.125, 1, 1, 27])

    def test_solids(self):
        self.assertEqual(sorted(round(s.volume(), 9) for s in solids(self.body)), [0.875, 1, 19])

    def test_cavities(self):
        points = np.array(self.body.cavities())
        self.assertEqual(len(points), 2)
        self.assertTrue(self.parts[0].contains(points).all())
        self.assertFalse(self.body.contains(points).any())
        self.assertEqual(l_block().cavities(), [])


class Spacing(unittest.TestCase):
    def test_cube(self):
        """The number of nodes is 1.575 per d^3, plus half a node per d^2 of the surface."""
        d = spacing_for(box(), 1000)
        self.assertAlmostEqual(1.575 / d ** 3 + 3 / d ** 2, 1000, 6)


X = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [9, 9, 9]], float)


class Made(unittest.TestCase):
    def outcome(self, corners):
        return VolumeOutcome(X, np.array([corners]), Measured(1, 2, 3, 0, ""), None)

    def test_turned(self):
        for corners in ([0, 1, 2, 3], [1, 0, 2, 3]):
            x, tetrahedra = made(self.outcome(corners), False)
            a, b, c, d = x[tetrahedra[0]]
            self.assertGreater(np.linalg.det([b - a, c - a, d - a]), 0)

    def test_without_tetrahedron(self):
        self.assertEqual([len(made(self.outcome([0, 1, 2, 3]), ours)[0]) for ours in (False, True)],
                         [4, 5])

    def test_put_together(self):
        both = put_together([self.outcome([0, 1, 2, 3]), self.outcome([1, 0, 2, 3])])
        self.assertEqual(both.tetrahedra.tolist(), [[0, 1, 2, 3], [6, 5, 7, 8]])
        self.assertEqual((len(both.points), both.used.seconds, both.used.cpu_seconds), (10, 2, 4))


def run(body, whole, angle, **more):
    return {"body": body, "tool": "A", "whole": whole, "exit_code": 0, "nodes": 100, "cpu_seconds": 0.1,
            "least_angle_elsewhere": angle, "least_angle_at_sharp_edges": None, "quality_mean": 0.9,
            "quality_one_percent": 0.5, "from_body": angle / 100, "to_body": 0.1, "torn_edges": 0,
            "torn_nodes": 0, "isolated": 0, "turned_over": 0, "pieces": 1, "pieces_of_body": 1,
            "euler": 2, "euler_of_body": 2, **more}


def part(tool, version, *runs, asked=9):
    return {"tools": [{"name": tool, "version": version}], "asked": asked, "no_bodies": ["z"], "command": tool,
            "runs": [{"body": body, "tool": tool, "nodes": nodes} for body, nodes in runs]}


class Merged(unittest.TestCase):
    def test_added(self):
        both = merged([part("A", 1, ("one", 10)), part("B", 2, ("one", 20))])
        self.assertEqual([tool["name"] for tool in both["tools"]], ["A", "B"])
        self.assertEqual([run["nodes"] for run in both["runs"]], [10, 20])
        self.assertEqual((both["no_bodies"], both["command"]), (["z"], "A\nB"))

    def test_the_last_counts(self):
        both = merged([part("A", 1, ("one", 10), ("two", 11)), part("A", 1, ("one", 30))])
        self.assertEqual([(run["body"], run["nodes"]) for run in both["runs"]], [("one", 30), ("two", 11)])

    def test_of_another_kind(self):
        for other in (part("A", 2), part("B", 1, asked=8)):
            with self.assertRaises(SystemExit):
                merged([part("A", 1), other])

    def test_chosen(self):
        some = [argparse.Namespace(name=name) for name in ("PNPBS, default", "gmsh, HXT", "TetGen")]
        self.assertEqual(chosen(some, []), some)
        self.assertEqual(chosen(some, ["pnpbs", "tet"]), [some[0], some[2]])


class Page(unittest.TestCase):
    RUNS = [run("one", True, 30.0), run("two", False, 10.0, torn_nodes=3, euler=0), run("three", True, 22.0),
            {"body": "four", "tool": "A", "failed": "it crashed"}]

    def test_row(self):
        row = compare_page.row("A", self.RUNS)
        self.assertEqual(row[1:5], [2, 1, 1, 1])
        self.assertEqual(row[7:9], ["22.00 / 10.00", "-"])
        self.assertEqual(row[11:13], ["-", "0.22 / 0.30"])
        self.assertEqual(compare_page.row("A", [run("two", False, 10.0, exit_code=6)])[4], 0)

    def test_volume(self):
        runs = [run("one", True, 30.0, volume=0.9, volume_of_body=1), run("two", True, 30.0),
                run("three", True, 30.0, volume=8.08, volume_of_body=8)]
        self.assertEqual(compare_page.row("A", runs)[11], "5.50 / 10.00")

    def test_refused(self):
        runs = [{"body": body, "tool": tool, "failed": failed} for body, tool, failed in (
            ("a", "PNPBS, default", "status 2: pnpbs: triangles cross"), ("b", "PNPBS, default", "not done"),
            ("c", "TetGen", "status 2: no"))] + [{**run("d", True, 1.0), "tool": "PNPBS, default"}]
        self.assertEqual(compare_page.refused({"runs": runs}), ["a"])

    def test_page(self):
        """The page has the machine, the row of the tool, the incomplete bodies, and the invalid
        files."""
        machine = dict.fromkeys(("date", "processor", "cores", "memory_gib", "system", "load"), "m")
        text = compare_page.page({"machine": machine, "note": "It rained.", "asked": 9, "command": "run me",
                                  "tools": [{"name": "A", "version": "1", "setting": "s"}], "left_out": [
                                      {"name": "B", "why": "not found"}], "no_bodies": ["rag.off"],
                                  "runs": self.RUNS})
        for words in ("It rained.", "run me", "| A | 2 | 1 | 1 | 1 |", "Left out: B, not found", "rag.off",
                      "| four | nothing: it crashed |", "4 bodies, d for 9 nodes"):
            self.assertIn(words, text)

    def test_lost(self):
        _, rows = compare_page.bodies_lost({"tools": [{"name": "A"}], "runs": self.RUNS})
        self.assertEqual(rows, [["two", "torn: 3 torn nodes, Euler 0 for 2"], ["four", "nothing: it crashed"]])

    def test_the_command_shown_has_no_folders_of_this_machine(self):
        with mock.patch("sys.argv", ["compare.py", "--output=/a", "--pnpbs", "/b/pnpbs", "--nodes", "9", "/c/d.off"]):
            self.assertEqual(shown_command("compare.py", {"--pnpbs": "PROGRAM", "--output": "FOLDER"}, ["/c/d.off"]),
                             "compare.py --output FOLDER --pnpbs PROGRAM --nodes 9 FILE...")


if __name__ == "__main__":
    unittest.main()
