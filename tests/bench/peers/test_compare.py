#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests of compare.py from its command line: a case of 500 nodes with PNPBS and the installed
peers, a peer that fails, and a machine without peers. PNPBS_COMMAND is the command to compare."""
import importlib.util
import json
import os
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

sys.path[:0] = [str(Path(__file__).resolve().parent), str(Path(__file__).resolve().parents[1])]

from adapters import tool  # noqa: E402
from tables import grouped  # noqa: E402

PROGRAM = Path(__file__).with_name("compare.py")
COMMAND = os.environ["PNPBS_COMMAND"]


def compare(output, *arguments, environment=None):
    return subprocess.run([sys.executable, "-B", PROGRAM, "--nodes", "500", "--output", output,
                           "--pnpbs", COMMAND, *arguments], capture_output=True, text=True,
                          stdin=subprocess.DEVNULL, env={**os.environ, **(environment or {})},
                          check=False)


class Compare(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)
        self.output = self.folder / "out"

    def results(self, name="comparison"):
        return json.loads((self.output / f"{name}.json").read_text())

    def test_ours_and_what_is_here(self):
        done = compare(self.output, "--cases", "graded-square", "--repeat", "2",
                       "--ours", "few sweeps: sweeps=2 sweep_weight=0.5")
        self.assertEqual(done.returncode, 0, done.stderr + done.stdout)
        results = self.results()
        tools = [r["tool"] for r in results["placements"]]
        self.assertEqual(tools[:2], ["PNPBS, default", "PNPBS, few sweeps"])
        words = (self.output / "comparison.md").read_text()
        for result in results["placements"]:
            self.assertNotIn("failed", result)
            m = result["measures"]
            self.assertTrue(400 < m["nodes"] < 650, result)
            self.assertTrue(0.85 < m["quality_mean"] <= 1, result)
            self.assertAlmostEqual(m["covered"], 1, 6)
            self.assertTrue(0 < result["inner_seconds"] <= result["seconds"], result)
            self.assertGreater(result["peak_bytes"], 1e6)
            self.assertIn(f"| {result['tool']} | {m['nodes']} |", words)
            self.assertIn(result["tool"], done.stdout)
        for one in results["tools"]:
            self.assertIn(f"| {one['name']} | {one['version']} |", words)
        for left_out in results["left_out"]:
            self.assertIn(f"- {left_out['name']}: {left_out['why']}", words)
        self.assertIn("dmsh, optimesh", [t["name"] for t in results["left_out"]])
        self.assertEqual(results["forces"][0]["tool"], "PNPBS")
        self.assertTrue(5 < results["forces"][0]["listed"] < 8, results["forces"])
        # The command on the page contains no folder of this machine.
        self.assertNotIn(str(self.folder), words)
        if importlib.util.find_spec("matplotlib"):
            for name in ("quality_speed", "histogram"):
                picture = self.output / "images" / f"comparison_{name}.png"
                self.assertEqual(picture.read_bytes()[1:4], b"PNG")
                self.assertLess(picture.stat().st_size, 200e3)
                self.assertIn(f"images/comparison_{name}.png", words)

        again = self.folder / "again"
        done = compare(again, "--from", self.output / "comparison.json")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual((again / "comparison.md").read_text(), words)

    def test_d_without_a_formula(self):
        """Each tool follows d, whatever form of the spacing it uses."""
        done = compare(self.output, "--nodes", "8000", "--cases", "graded-airfoil", "--no-forces",
                       "--tools", "PNPBS,Delaunay,Triangle,unoptimised")
        self.assertEqual(done.returncode, 0, done.stderr + done.stdout)
        for result in self.results()["placements"]:
            m = result["measures"]
            self.assertTrue(7500 < m["nodes"] < 10400, result)
            self.assertAlmostEqual(m["covered"], 1, 3)
            self.assertGreater(len(m["edge_bands"]), 3)
            self.assertTrue(0.8 < min(m["edge_bands"]) < max(m["edge_bands"]) < 1.1, result)

    def test_in_space(self):
        """PNPBS runs on all kinds of bodies, and the installed peers on one."""
        done = compare(self.output, "--volumes", "--nodes", "600", "--cases", "uniform-cube")
        self.assertEqual(done.returncode, 0, done.stderr + done.stdout)
        self.judge_volumes(done.stdout)
        page = (self.output / "comparison_volumes.md").read_text()
        again = self.folder / "again"
        done = compare(again, "--from", self.output / "comparison_volumes.json")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual((again / "comparison_volumes.md").read_text(), page)
        done = compare(self.output, "--volumes", "--nodes", "1500", "--tools", "PNPBS", "--cases",
                       "graded-cube,uniform-ball,uniform-l-block,uniform-kleopatra")
        self.assertEqual(done.returncode, 0, done.stderr + done.stdout)
        self.judge_volumes(done.stdout)
        for result in self.results("comparison_volumes")["placements"]:
            self.assertGreater(result["measures"]["angle_least"], 10, result)

    def test_spacing_from_the_shape(self):
        """PNPBS runs both kinds of cases, and the installed peers one."""
        done = compare(self.output, "--shape", "--nodes", "1500", "--cases", "follow-airfoil")
        self.assertEqual(done.returncode, 0, done.stderr + done.stdout)
        for result in self.results("comparison_shape")["placements"]:
            m = result["measures"]
            self.assertTrue(1200 < m["nodes"] < 2000, result)
            self.assertTrue(0.85 < m["inside_mean"] < 1.05, result)
            self.assertTrue(0.02 < m["edge_deviation"] < 0.2, result)
            self.assertGreater(result["even_seconds"], 0)
        done = compare(self.output, "--shape", "--nodes", "1500", "--tools", "PNPBS", "--cases",
                       "auto-airfoil,follow-bracket")
        self.assertEqual(done.returncode, 0, done.stderr + done.stdout)
        airfoil, bracket = self.results("comparison_shape")["placements"]
        self.assertGreater(airfoil["measures"]["per_turn"][1], 20, airfoil)
        self.assertTrue(0.9 < bracket["measures"]["edge_mean"] < 1.2, bracket)
        page = (self.output / "comparison_shape.md").read_text()
        self.assertIn("nodes per turn", page)
        self.assertIn("farthest off, at", page)
        again = self.folder / "again"
        done = compare(again, "--from", self.output / "comparison_shape.json")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual((again / "comparison_shape.md").read_text(), page)

    def judge_volumes(self, printed):
        results = self.results("comparison_volumes")
        page = (self.output / "comparison_volumes.md").read_text()
        self.assertEqual(results["placements"][0]["tool"], "PNPBS, default")
        for result in results["placements"]:
            self.assertNotIn("failed", result)
            m = result["measures"]
            self.assertTrue(0.6 < m["nodes"] / result["asked"] < 1.4, result)
            self.assertTrue(0.6 < m["quality_mean"] < 1, result)
            self.assertTrue(0.9 < m["edge_mean"] < 1.4, result)
            self.assertTrue(0.9 < m["covered"] < 1.001, result)
            self.assertAlmostEqual(m["delaunay"]["covered"], m["covered"], 1)
            self.assertGreater(result["cpu_seconds"], 0)
            self.assertIn(f"| {result['tool']} | {grouped(m['nodes'])} |", page)
            self.assertIn(result["tool"], printed)

    def fake(self, name, text):
        """Creates a folder for --path with a program of this name and text."""
        folder = self.folder / "bin"
        folder.mkdir(exist_ok=True)
        (folder / name).write_text(text)
        (folder / name).chmod(0o755)
        return folder

    def test_a_tool_that_fails_is_told(self):
        fake = self.fake("gmsh", "#!/bin/sh\n[ \"$1\" = --version ] && exec echo 4.13.1\n"
                                 "echo 'out of paper' >&2\nexit 7\n")
        done = compare(self.output, "--cases", "uniform-square", "--tools", "PNPBS,gmsh",
                       "--no-forces", "--path", fake)
        self.assertEqual(done.returncode, 1)
        failed = [r for r in self.results()["placements"] if "failed" in r]
        self.assertEqual({r["tool"].split(",")[0] for r in failed}, {"gmsh"})
        self.assertEqual({r["failed"] for r in failed}, {"status 7: out of paper"})
        words = (self.output / "comparison.md").read_text()
        self.assertIn("| gmsh, frontal | failed: status 7: out of paper |", words)
        self.assertIn("failed: status 7: out of paper", done.stdout)
        self.assertIn("| PNPBS, default | ", words)

    def test_a_tool_that_does_not_start_is_left_out(self):
        """A tool is broken if it returns a bad status, if its interpreter is missing, or if its
        answer is that of another program. The other tools run, and nothing has failed."""
        fake = self.fake("lmp", "#!/bin/sh\necho 'lmp: no libfftw3.so.3' >&2\nexit 127\n")
        self.fake("gmsh", "#!/nowhere/sh\n")
        self.fake("jigsaw", "#!/bin/sh\necho 'a saw for wood'\n")
        alone = {"PATH": str(fake)}  # otherwise the next program with this name would be used
        done = compare(self.output, "--cases", "uniform-square", "--tools", "PNPBS,gmsh,JIGSAW",
                       environment=alone)
        self.assertEqual(done.returncode, 0, done.stderr)
        results = self.results()
        self.assertEqual([r["tool"] for r in results["placements"]], ["PNPBS, default"])
        self.assertEqual([r["tool"] for r in results["forces"]], ["PNPBS"])
        self.assertEqual([t["name"] for t in results["tools"]], ["PNPBS, default"])
        why = {t["name"]: t["why"] for t in results["left_out"]}
        page = (self.output / "comparison.md").read_text()
        for name, reason in (("LAMMPS", "status 127: lmp: no libfftw3.so.3"),
                             ("gmsh, frontal", "No such file or directory"),
                             ("JIGSAW, default", "a saw for wood")):
            self.assertTrue(why[name].startswith("found, but does not start: "), why)
            self.assertIn(reason, why[name])
            self.assertIn(f"- {name}: {why[name]}", page)

        # A program of another name answers, and one prints nothing.
        for text, reason in (("echo 'line printer'\n", "not that of LAMMPS: line printer"),
                             ("exit 0\n", "it says nothing")):
            self.fake("lmp", "#!/bin/sh\n" + text)
            done = compare(self.output, "--cases", "uniform-square", "--tools", "PNPBS",
                           environment=alone)
            self.assertEqual(done.returncode, 0, done.stderr)
            why = {t["name"]: t["why"] for t in self.results()["left_out"]}
            self.assertIn(reason, why["LAMMPS"])

    def test_a_version_that_is_not_supported_is_left_out(self):
        """The gmsh of Debian 12 has Distance fields without the option Sampling."""
        fake = self.fake("gmsh", "#!/bin/sh\n[ \"$1\" = --version ] && echo 4.8.4 && exit 0\n"
                                 "echo \"Unknown option 'Sampling'\" >&2\nexit 1\n")
        for kind, file in (([], "comparison"), (["--volumes"], "comparison_volumes"),
                           (["--shape"], "comparison_shape")):
            done = compare(self.output, *kind, "--cases",
                           {"--volumes": "uniform-cube", "--shape": "follow-airfoil"}.get(
                               "".join(kind), "uniform-square"),
                           "--tools", "PNPBS,gmsh", "--no-forces", environment={"PATH": str(fake)})
            self.assertEqual(done.returncode, 0, done.stderr + done.stdout)
            results = self.results(file)
            self.assertEqual({r["tool"] for r in results["placements"]}, {"PNPBS, default"})
            why = {t["name"]: t["why"] for t in results["left_out"] if "gmsh" in t["name"]}
            self.assertGreaterEqual(len(why), 1)
            page = (self.output / f"{file}.md").read_text()
            for name, reason in why.items():
                self.assertTrue(reason.startswith("found, but not supported: version 4.8.4; needs 4.9"),
                                reason)
                self.assertIn(f"- {name}: {reason}", page)

    def test_versions_are_compared_by_their_numbers(self):
        for version in ("4.9", "4.9.0", "4.10.5", "4.13.1-git-1234abc", "5"):
            tool.require_version(version, "4.9", "")
        for version in ("4.8.4", "4.8.4+ds2", "3.0", "4", "nothing like it"):
            with self.assertRaisesRegex(tool.NotSupported, "needs 4.9 or later"):
                tool.require_version(version, "4.9", "")

    def test_nothing_installed(self):
        empty = self.folder / "empty"
        empty.mkdir()
        done = compare(self.output, "--cases", "uniform-annulus", "--tools", "PNPBS,JIGSAW",
                       environment={"PATH": str(empty)})
        self.assertEqual(done.returncode, 0, done.stderr)
        results = self.results()
        self.assertEqual([r["tool"] for r in results["placements"]], ["PNPBS, default"])
        self.assertIn("JIGSAW, default", [t["name"] for t in results["left_out"]])
        self.assertIn("LAMMPS", [t["name"] for t in results["left_out"]])
        done = compare(self.output, "--tools", "JIGSAW", environment={"PATH": str(empty)})
        self.assertEqual(done.returncode, 1)
        self.assertIn("no tool to run", done.stderr)
        self.assertIn("needs the command jigsaw", done.stderr)

    def test_interrupt(self):
        """The signal arrives between the first run, by PNPBS, and the end of a fake run that would
        last very long."""
        fake = self.fake("gmsh", "#!/bin/sh\n[ \"$1\" = --version ] && exec echo 4.13.1\n"
                                 f"touch {self.folder}/begun\nexec sleep 3000\n")
        # The process group is separate, so that the signal reaches all of its processes, as from a
        # terminal.
        running = subprocess.Popen(
            [sys.executable, "-B", PROGRAM, "--nodes", "500", "--cases", "uniform-square",
             "--tools", "PNPBS,gmsh", "--no-forces", "--output", self.output, "--path", fake,
             "--pnpbs", COMMAND], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True,
            stdin=subprocess.DEVNULL, start_new_session=True)
        deadline = time.monotonic() + 300
        while not (self.folder / "begun").exists() and time.monotonic() < deadline:
            time.sleep(0.05)
        os.killpg(running.pid, signal.SIGINT)
        told = running.communicate(timeout=300)[1]
        self.assertEqual(running.returncode, 130)
        self.assertIn("interrupted", told)
        self.assertNotIn("Traceback", told)
        self.assertEqual([r["tool"] for r in self.results()["placements"]], ["PNPBS, default"])

    def test_bad_arguments(self):
        for arguments, told in ((("--cases", "nowhere"), "unknown case nowhere"),
                                (("--volumes", "--cases", "uniform-square"), "unknown case"),
                                (("--shape", "--cases", "uniform-square"), "unknown case"),
                                (("--ours", "best"), "name: key=value"),
                                (("--repeat", "0"), "--repeat")):
            done = compare(self.output, *arguments)
            self.assertEqual(done.returncode, 2)
            self.assertIn(told, done.stderr)


if __name__ == "__main__":
    unittest.main()
