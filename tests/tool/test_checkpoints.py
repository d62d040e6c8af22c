# SPDX-License-Identifier: BSD-3-Clause
"""Tests checkpoints of the command. A run that is stopped at any time and restarted ends with the
same nodes, and VTK can open the file."""

import json
import signal
import subprocess
import time
import unittest

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOHDF import vtkHDFReader

from command import COMMAND, DONE, INTERRUPTED, NOT_CONVERGED, CommandTest

PLANE = ("--spacing", "0.01 + 0.02*x", "--set", "effort=best")
# Steps take long enough for a signal to arrive between them.
LONG = ("--spacing", "0.003 + 0.003*x", "--set", "effort=best", "--set", "tolerance_mean=0",
        "--set", "steps=400", "--nodes-only")


class Checkpoints(CommandTest):
    def report(self, *arguments):
        process = self.start(*arguments, "--report", "-", "-q")
        out, err = process.communicate()
        self.assertIn(process.returncode, (DONE, NOT_CONVERGED), err.decode())
        return json.loads(out)

    def test_a_finished_run_is_not_run_again(self):
        square = ("--domain", self.square, *PLANE)
        first = self.report(*square, "--checkpoint", "a.vtkhdf")
        again = self.report(*square, "--restart", "a.vtkhdf", "-o", "a.csv")
        self.assertEqual(first["finished"], 1)
        for key in ("hash", "steps", "inserted", "deleted", "stop_reason", "warnings"):
            self.assertEqual(first[key], again[key])
        self.assertEqual(self.files(), ["a.csv", "a.vtkhdf", "square.poly"])

    def test_stopped_again_and_again(self):
        square = ("--domain", self.square, *LONG)
        expected = self.report(*square)["hash"]
        restart = ()
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGKILL):
            process = self.start(*square, *restart, "--checkpoint", "a.vtkhdf",
                                 "--checkpoint-every", "30", "--report", "-", "-q")
            path = self.folder / "a.vtkhdf"
            before = path.stat().st_mtime_ns if path.exists() else 0
            deadline = time.monotonic() + 300
            while not path.exists() or path.stat().st_mtime_ns == before:
                self.assertLess(time.monotonic(), deadline)
                self.assertIsNone(process.poll(), "it should still be running")
                time.sleep(0.005)
            process.send_signal(number)
            _, err = process.communicate(timeout=300)
            if number != signal.SIGKILL:
                self.assertEqual(process.returncode, INTERRUPTED, err)
                self.assertIn(b"--restart 'a.vtkhdf' continues from step", err)
                self.assertEqual(self.files(), ["a.vtkhdf", "square.poly"])
            restart = ("--restart", "a.vtkhdf")
        self.assertEqual(self.report(*square, *restart)["hash"], expected)

    def restart(self, *options):
        """Restarts from step.vtkhdf, a checkpoint of a run that ended after 20 steps. Returns the
        report and its warnings about options."""
        report = self.report("--domain", self.square, "--spacing", "0.01 + 0.02*x", "--restart",
                             "step.vtkhdf", *options, "--checkpoint", "again.vtkhdf")
        self.assertEqual(report["finished"], 1)
        return report, [w for w in report["warnings"] if w.startswith("options changed")]

    def test_more_steps_and_other_options(self):
        first = self.report("--domain", self.square, "--spacing", "0.01 + 0.02*x", "--set",
                            "steps=20", "--checkpoint", "step.vtkhdf")
        self.assertEqual(first["stop_reason"], "step limit")

        same, warnings = self.restart("--set", "steps=20")
        self.assertEqual((same["steps"], warnings), (first["steps"], []))
        more, warnings = self.restart("--set", "steps=25")
        self.assertEqual(more["steps"], first["steps"] + 5)  # 25 in total
        self.assertEqual(warnings,
                         ["options changed since the checkpoint: steps = 25 (20 before)"])
        fewer, warnings = self.restart("--set", "steps=10")
        self.assertEqual(fewer["hash"], first["hash"])
        self.assertIn("have no effect", warnings[0])

        settled, _ = self.restart("--set", "steps=500")
        self.assertEqual(settled["stop_reason"], "rest")
        self.assertGreater(settled["steps"], more["steps"])
        (self.folder / "again.vtkhdf").rename(self.folder / "step.vtkhdf")
        even_more, warnings = self.restart("--set", "steps=600")
        self.assertEqual(even_more["hash"], settled["hash"])
        self.assertIn("the bubbles rest", warnings[0])
        self.assertIn("tolerance_mean", warnings[0])
        better, warnings = self.restart("--set", "steps=500", "--set", "effort=best")
        self.assertGreater(better["steps"], settled["steps"])
        self.assertNotEqual(better["hash"], settled["hash"])
        self.assertIn("sweeps = 8 (6 before)", warnings[0])

    def test_a_stopped_run_ends_early_by_fewer_steps(self):
        square = ("--domain", self.square, "--spacing", "0.02", "--set", "steps=1000000", "--set",
                  "tolerance_mean=0")
        process = self.start(*square, "--checkpoint", "a.vtkhdf", "--checkpoint-every", "5", "-q")
        deadline = time.monotonic() + 300
        while not (self.folder / "a.vtkhdf").exists():
            self.assertLess(time.monotonic(), deadline)
            time.sleep(0.005)
        process.send_signal(signal.SIGKILL)
        process.communicate(timeout=300)
        report = self.report(*square, "--restart", "a.vtkhdf", "--set", "steps=1")
        self.assertEqual((report["finished"], report["stop_reason"]), (1, "step limit"))

    def test_options_that_a_restart_cannot_change(self):
        self.report("--domain", self.square, "--spacing", "0.2", "--set", "steps=20",
                    "--checkpoint", "a.vtkhdf")
        again = ("--domain", self.square, "--spacing", "0.2", "--restart", "a.vtkhdf")
        forgotten = self.refuse(*again)
        self.assertIn("set steps=20 to continue as before, or another value", forgotten)
        self.assertIn("the spacing depends on it",
                      self.refuse(*again, "--set", "steps=20", "--set", "growth_limit=0.1"))
        self.assertIn("set the same options",
                      self.refuse(*again, "--set", "steps=30", "--set", "restart_options=same"))

    def test_what_is_refused(self):
        square = ("--domain", self.square, "--spacing", "0.2", "-o", "a.csv")
        (self.folder / "text.vtkhdf").write_text("no HDF5")
        for arguments, words in (
                (("--checkpoint-every", "3"), "needs --checkpoint"),
                (("--checkpoint", "a", "--checkpoint-every", "3d"), "30min"),
                (("--checkpoint", "a", "--checkpoint-every", "-1"), "30min"),
                (("-o", "a.vtkhdf", "--checkpoint", "a.vtkhdf"), "is the checkpoint"),
                (("-o", "a.vtkhdf", "--restart", "a.vtkhdf"), "is the checkpoint"),
                (("--restart", "none.vtkhdf"), "none.vtkhdf"),
                (("--restart", "text.vtkhdf"), "no HDF5 file"),
                (("--checkpoint", "none/a.vtkhdf"), "none/a.vtkhdf")):
            with self.subTest(words):
                self.assertIn(words, self.refuse(*square, *arguments))

    def test_what_finds_no_room_leaves_the_old_file(self):
        path = self.folder / "a.vtkhdf"
        path.write_text("old")
        for blocks in (3, 50, 150):  # of 1024 bytes each: too few for the layout, or for the nodes
            with self.subTest(blocks):
                process = subprocess.run(
                    ["bash", "-c", f'ulimit -f {blocks}; exec "$0" "$@"', COMMAND, "--domain",
                     self.square, "--spacing", "0.01", "-q", "--checkpoint", path],
                    cwd=self.folder, capture_output=True, check=False)
                self.assertIn(b"cannot write checkpoint", process.stderr)
                self.assertGreater(process.returncode, 0, process.stderr)
                self.assertEqual(path.read_text(), "old")
                self.assertEqual(self.files(), ["a.vtkhdf", "square.poly"])

    def check_file(self, domain, spacing, dimension):
        report = self.report("--domain", domain, "--spacing", spacing, "--checkpoint", "a.vtkhdf",
                             "-o", "a.csv")
        reader = vtkHDFReader()
        reader.SetFileName(str(self.folder / "a.vtkhdf"))
        self.assertTrue(reader.CanReadFile(str(self.folder / "a.vtkhdf")))
        reader.Update()
        grid = reader.GetOutputDataObject(0)
        self.assertEqual(grid.GetNumberOfPoints(), report["nodes"])
        self.assertEqual(grid.GetNumberOfCells(), report["nodes"])
        self.assertEqual({grid.GetCellType(i) for i in range(grid.GetNumberOfCells())}, {1})
        self.assertEqual([grid.GetCell(i).GetPointId(0) for i in range(grid.GetNumberOfCells())],
                         list(range(report["nodes"])))
        data = grid.GetPointData()
        ids, tags, d = (vtk_to_numpy(data.GetArray(name)) for name in ("id", "tag", "spacing"))
        points = vtk_to_numpy(grid.GetPoints().GetData())
        order = np.argsort(ids)
        rows = np.loadtxt(self.folder / "a.csv", delimiter=",", skiprows=1)
        found = np.column_stack([ids, points[:, :dimension], tags, d])[order]
        np.testing.assert_array_equal(found, rows)

    def test_vtk_opens_it_in_the_plane(self):
        self.check_file(self.square, "0.1", 2)

    def test_vtk_opens_it_in_space(self):
        self.check_file("box(0,0,0, 1,1,1)", "0.3", 3)


if __name__ == "__main__":
    unittest.main()
