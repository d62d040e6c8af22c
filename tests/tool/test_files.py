# SPDX-License-Identifier: BSD-3-Clause
"""Tests the files that the command writes, by readers of others."""

import json
import os
import re
import stat
import struct
import subprocess
import unittest
import xml.etree.ElementTree
import zlib

import meshio
import numpy
import vtk
from vtk.util.numpy_support import vtk_to_numpy

from command import COMMAND, DATA, FAILED, LAKE, SPACING_MISSED, SQUARE_AREA, CommandTest
from readers import point_array, read_csv, read_ele, read_msh, read_node, read_with_vtk


def read_png(data):
    """Returns width, height and pixel rows of a PNG without a palette. Only the size of the
    unfiltered rows is checked."""
    assert data[:8] == b"\x89PNG\r\n\x1a\n"
    at, pixels, header = 8, b"", None
    while at < len(data):
        length, kind = struct.unpack(">I4s", data[at : at + 8])
        body = data[at + 8 : at + 8 + length]
        (checksum,) = struct.unpack(">I", data[at + 8 + length : at + 12 + length])
        assert checksum == zlib.crc32(kind + body)
        if kind == b"IHDR":
            header = struct.unpack(">IIBBBBB", body)
        if kind == b"IDAT":
            pixels += body
        at += 12 + length
    width, height, depth, colour = header[:4]
    assert depth == 8 and colour in (2, 6)
    raw = zlib.decompress(pixels)
    assert len(raw) == height * (1 + width * (3 if colour == 2 else 4))
    return width, height, raw


class Agreement(CommandTest):
    """Checks that all formats of one run contain the same nodes."""

    def setUp(self):
        super().setUp()
        names = ["a.vtu", "a.pvtu", "a.msh", "a.msh2", "a.node", "a.ele", "a.csv", "a.svg", "a.png"]
        outputs = [word for name in names for word in ("--output", name)]
        self.place(*outputs, "--report", "a.json", spacing="0.05 + 0.05*x")
        beside = ["a_0.vtu", "a_facets.vtu", "a_facets.pvtu", "a_facets_0.vtu"]
        self.assertEqual(self.files(), sorted([*names, *beside, "a.json", "square.poly"]))
        self.report = json.loads((self.folder / "a.json").read_text())
        self.grid = read_with_vtk(self.folder / "a.vtu")

    def test_all(self):
        # Checks everything in one test, because one run is enough.
        self.check_vtu()
        self.check_meshio()
        self.check_pieces()
        self.check_msh("a.msh", "4.1 0 8")
        self.check_msh("a.msh2", "2.2 0 8")
        self.check_node()
        self.check_ele()
        self.check_facets()
        self.check_csv()
        self.check_svg()
        self.check_png()

    def check_vtu(self):
        points = vtk_to_numpy(self.grid.GetPoints().GetData())
        self.assertEqual(len(points), self.report["nodes"])
        self.assertTrue((points[:, 2] == 0).all())
        ids = point_array(self.grid, "id")
        self.assertEqual(len(set(ids)), len(ids))
        self.assertEqual(set(point_array(self.grid, "tag")), {0, 1, 2})
        spacing = point_array(self.grid, "spacing")
        numpy.testing.assert_allclose(spacing, 0.05 + 0.05 * points[:, 0], rtol=1e-3)
        self.check_triangles(points)

    def check_triangles(self, points):
        cells = self.grid.GetCells()
        corners = vtk_to_numpy(cells.GetConnectivityArray()).reshape(-1, 3)
        self.assertEqual({self.grid.GetCellType(i) for i in range(len(corners))}, {vtk.VTK_TRIANGLE})
        a, b, c = (points[corners[:, k], :2] for k in range(3))
        u, v, w = b - a, c - a, c - b
        twice = u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]
        self.assertTrue((twice > 0).all())
        self.assertAlmostEqual(twice.sum() / 2, SQUARE_AREA, places=9)
        lengths = [numpy.linalg.norm(side, axis=1) for side in (u, v, w)]
        quality = 4 * twice**2 / (numpy.prod(lengths, axis=0) * numpy.sum(lengths, axis=0))
        written = vtk_to_numpy(self.grid.GetCellData().GetArray("quality"))
        numpy.testing.assert_allclose(written, quality, rtol=1e-5)

    def check_meshio(self):
        mesh = meshio.read(self.folder / "a.vtu")
        numpy.testing.assert_array_equal(
            mesh.points, vtk_to_numpy(self.grid.GetPoints().GetData())
        )
        self.assertEqual([block.type for block in mesh.cells], ["triangle"])
        self.assertEqual(len(mesh.cells[0].data), self.grid.GetNumberOfCells())
        numpy.testing.assert_array_equal(mesh.point_data["id"], point_array(self.grid, "id"))

    # Checks that the edges of the boundary equal those of the .msh file, by indices of the same
    # nodes.
    def check_facets(self):
        points = vtk_to_numpy(self.grid.GetPoints().GetData())
        lines, tags = read_msh(self.folder / "a.msh", points)[0]["line"]
        for name, kind in (("a_facets.vtu", vtk.vtkXMLUnstructuredGridReader),
                           ("a_facets.pvtu", vtk.vtkXMLPUnstructuredGridReader)):
            facets = read_with_vtk(self.folder / name, kind)
            numpy.testing.assert_array_equal(vtk_to_numpy(facets.GetPoints().GetData()), points)
            numpy.testing.assert_array_equal(point_array(facets, "id"), point_array(self.grid, "id"))
            self.assertEqual({facets.GetCellType(i) for i in range(len(lines))}, {vtk.VTK_LINE})
            corners = vtk_to_numpy(facets.GetCells().GetConnectivityArray()).reshape(-1, 2)
            found = vtk_to_numpy(facets.GetCellData().GetArray("tag"))
            self.assertEqual(sorted(zip(corners.tolist(), found.tolist())),
                             sorted(zip(lines.tolist(), tags.tolist())))

    def check_pieces(self):
        whole = read_with_vtk(self.folder / "a.pvtu", vtk.vtkXMLPUnstructuredGridReader)
        numpy.testing.assert_array_equal(
            vtk_to_numpy(whole.GetPoints().GetData()), vtk_to_numpy(self.grid.GetPoints().GetData())
        )
        for name in ("id", "tag", "spacing"):
            numpy.testing.assert_array_equal(point_array(whole, name), point_array(self.grid, name))
        self.assertFalse(point_array(whole, "vtkGhostType").any())
        self.assertEqual(whole.GetNumberOfCells(), self.grid.GetNumberOfCells())

    def check_msh(self, name, version):
        self.assertEqual((self.folder / name).read_text().splitlines()[1], version)
        points = vtk_to_numpy(self.grid.GetPoints().GetData())
        cells, groups = read_msh(self.folder / name, points)
        self.assertEqual(list(cells), ["line", "triangle"])
        self.assertEqual(groups, {"tag_1": (1, 1), "tag_2": (2, 1), "domain": (1, 2)})
        triangles, inside = cells["triangle"]
        numpy.testing.assert_array_equal(triangles, self.corners())
        self.assertEqual(set(inside), {1})
        # The outer square has tag 1 and the inner one tag 2. Edges connect neighbouring nodes on
        # them.
        lines, tags = cells["line"]
        self.assertEqual(len(tags), self.report["boundary_nodes"])
        self.assertEqual(set(tags), {1, 2})
        lengths = numpy.linalg.norm(points[lines[:, 1]] - points[lines[:, 0]], axis=1)
        self.assertAlmostEqual(lengths[tags == 1].sum(), 4.0, places=9)
        self.assertAlmostEqual(lengths[tags == 2].sum(), 0.8, places=9)

    def corners(self):
        return vtk_to_numpy(self.grid.GetCells().GetConnectivityArray()).reshape(-1, 3)

    def check_ele(self):
        numpy.testing.assert_array_equal(read_ele(self.folder / "a.ele"), self.corners())

    def check_node(self):
        points, markers = read_node(self.folder / "a.node")
        numpy.testing.assert_array_equal(
            points, vtk_to_numpy(self.grid.GetPoints().GetData())[:, :2]
        )
        numpy.testing.assert_array_equal(markers, point_array(self.grid, "tag"))

    def check_csv(self):
        table = read_csv(self.folder / "a.csv")
        points = vtk_to_numpy(self.grid.GetPoints().GetData())
        numpy.testing.assert_array_equal(table["x"], points[:, 0])
        numpy.testing.assert_array_equal(table["y"], points[:, 1])
        for name in ("id", "tag", "spacing"):
            numpy.testing.assert_array_equal(table[name], point_array(self.grid, name))

    def check_svg(self):
        root = xml.etree.ElementTree.parse(self.folder / "a.svg").getroot()
        self.assertEqual(root.tag, "{http://www.w3.org/2000/svg}svg")
        box = list(map(float, root.get("viewBox").split()))
        self.assertGreater(min(box[2:]), 300)
        dots = sum(p.get("d", "").count("Z") for p in root.iter("{http://www.w3.org/2000/svg}path"))
        self.assertGreaterEqual(dots, self.report["nodes"])

    def check_png(self):
        width, height, raw = read_png((self.folder / "a.png").read_bytes())
        self.assertTrue(300 < width < 4000 and 300 < height < 4000)
        self.assertGreater(len(set(raw)), 100)  # not a blank page


class Report(CommandTest):
    def test_has_every_statistic(self):
        self.place("--report", "r.json", "--set", "steps=40")
        report = json.loads((self.folder / "r.json").read_text())
        names = [line.split()[0] for line in self.statistics() if line[2:3].strip()]
        self.assertGreater(len(names), 15)
        for name in names:
            value = report
            for key in name.split("."):
                self.assertIn(key, value, name)
                value = value[key]

    def statistics(self):
        return self.run_command("--list-statistics")[0].decode().splitlines()

    def test_tells_what_was_asked_and_what_came(self):
        self.place("--report", "r.json", "--set", "steps=200", "--growth-limit", "0.5")
        report = json.loads((self.folder / "r.json").read_text())
        self.assertEqual(report["domain"], str(self.square))
        self.assertEqual(report["spacing"], "0.06")
        self.assertEqual(report["options"], {"steps": "200", "growth_limit": "0.5"})
        self.assertIsInstance(report["warnings"], list)
        self.assertGreater(report["nodes"], 200)
        self.assertGreater(report["boundary_nodes"], 50)
        self.assertGreater(report["steps"], 0)
        self.assertGreater(report["seconds"]["total"], 0)
        self.assertIsInstance(report["stop_reason"], str)
        self.assertRegex(report["hash"], re.compile("^(0x)?[0-9a-f]{16}$"))

    def test_warnings_are_told_and_kept(self):
        _, err = self.place("--report", "r.json", domain=LAKE, spacing="30")
        report = json.loads((self.folder / "r.json").read_text())
        told = [line for line in err.decode().splitlines() if line.startswith("pnpbs: warning: ")]
        self.assertGreater(len(told), 0)
        self.assertEqual(told, ["pnpbs: warning: " + w for w in report["warnings"]])

    def test_tells_how_well_d_is_followed(self):
        self.place("--report", "r.json", spacing="0.02+0.03*y")
        report = json.loads((self.folder / "r.json").read_text())
        bands = report["edge"]["bands"]
        self.assertEqual(len(bands), 8)
        for band in bands:
            self.assertEqual(sorted(band), ["deviation", "edges", "from", "mean", "to"])
        self.assertAlmostEqual(bands[0]["from"], 0.02)
        self.assertAlmostEqual(bands[-1]["to"], 0.05)
        # The bands contain all edges except the few between two boundary nodes.
        edges = sum(band["edges"] for band in bands)
        self.assertLess(abs(sum(band["edges"] * band["mean"] for band in bands) / edges
                            - report["edge"]["mean"]), 0.02)
        self.assertTrue(0.5 < report["quality"]["min"] < report["quality"]["one_percent"]
                        < report["quality"]["mean"] < 1)

    def test_missed_spacing(self):
        """Checks a missed spacing. The paper's law compresses coarse regions beside a fine line.
        Files are written nevertheless."""
        self.square.write_text("4 2 0 0\n1 0 0\n2 1 0\n3 1 1\n4 0 1\n"
                               "4 0\n1 1 2\n2 2 3\n3 3 4\n4 4 1\n0\n")
        out, err = self.place("--report", "r.json", "-o", "a.csv", "--set", "method=paper",
                              spacing="min(0.001+0.2*abs(y-0.5), 0.1)", code=SPACING_MISSED)
        report = json.loads((self.folder / "r.json").read_text())
        self.assertIn("do not follow the spacing", report["warnings"][-1])
        self.assertEqual(err.decode().count("do not follow the spacing"), 1)
        self.assertIn("by bands of d", out.decode())
        self.assertTrue((self.folder / "a.csv").exists())

    def test_memory_is_that_of_the_end(self):
        """Checks that the memory is that of the command alone, without that of its parent process.
        """
        held = bytearray(800 << 20)  # more than sanitizers use
        out, _ = self.place("--report", "r.json", "-o", "a.msh", "-o", "a.vtu", spacing="0.01")
        del held
        memory = json.loads((self.folder / "r.json").read_text())["memory"]
        largest = memory["max_peak_bytes"]  # measured after peak_bytes, so it may be larger
        self.assertTrue(1 << 20 < memory["peak_bytes"] <= largest < 500 << 20, memory)
        self.assertIn(f"memory   {largest / (1 << 20):.3g} MiB at most", out.decode())

    def test_dry_run(self):
        out, err = self.place("--dry-run", "-o", "a.csv", "--report", "r.json", spacing="0.02")
        self.assertEqual(self.files(), ["square.poly"])
        self.assertEqual(err, b"")
        words = out.decode().split()
        expected = int("".join(words[2:words.index("memory")]))
        self.place("--report", "r.json", spacing="0.02")
        nodes = json.loads((self.folder / "r.json").read_text())["nodes"]
        self.assertLess(abs(expected / nodes - 1), 0.05)
        self.assertIn("MiB", out.decode())
        self.assertIn("400 000 nodes", self.place("--dry-run", "--threads", "1")[0].decode())
        self.assertNotIn("picture", out.decode())
        picture, _ = self.place("--dry-run", "-o", "a.csv", "-o", "a.png", spacing="0.02")
        self.assertRegex(picture.decode(), r"memory .* KiB for the picture\n")

    def test_too_little_memory(self):
        _, err = self.place("-o", "a.csv", "--set", "max_memory=1e-9", code=FAILED)
        self.assertIn("would need", err.decode())
        self.assertIn("max_memory", err.decode())
        self.assertEqual(self.files(), ["square.poly"])

    def test_same_nodes_for_any_number_of_threads(self):
        hashes = set()
        for threads in (1, 2):
            self.place("--report", "r.json", "--threads", threads, spacing="0.03+0.05*y")
            hashes.add(json.loads((self.folder / "r.json").read_text())["hash"])
        self.assertEqual(len(hashes), 1)


class StandardStreams(CommandTest):
    def test_domain_from_standard_input(self):
        self.place("--output", "a.csv", "--output", "b.node")
        text = self.square.read_bytes()
        out, _ = self.place("--output", "-", "--format", "csv", domain="-", stdin=text)
        self.assertEqual(out, (self.folder / "a.csv").read_bytes())

    def test_each_format_to_standard_output(self):
        for name in ("vtu", "msh", "node", "ele", "csv", "svg", "png"):
            with self.subTest(name):
                self.place("--output", "a." + name)
                out, err = self.place("--output", "-", "--format", name)
                if name != "vtu":  # pictures are compared by their bytes only
                    self.assertEqual(len(out) > 100, True)
                self.assertEqual(out, (self.folder / ("a." + name)).read_bytes())
                self.assertEqual(err, b"")

    def test_report_to_standard_output(self):
        out, _ = self.place("--report", "-", "--output", "a.csv")
        self.assertGreater(json.loads(out)["nodes"], 0)

    def test_summary_for_people(self):
        out, err = self.place("--output", "a.csv")
        nodes = len(read_csv(self.folder / "a.csv")["id"])
        self.assertIn(f"{nodes:,}".replace(",", " "), out.decode())
        self.assertIn("a.csv", out.decode())
        self.assertTrue(3 <= len(out.splitlines()) <= 7)
        self.assertEqual(err, b"")

    def test_quiet(self):
        self.assertEqual(self.place("--quiet", "-o", "a.csv"), (b"", b""))

    def test_reader_that_goes_away(self):
        process = self.start("--domain", LAKE, "--spacing", "3", "-o", "-", "--format", "csv",
                             "-o", "a.csv")
        process.stdout.close()
        err = process.stderr.read()
        process.stderr.close()
        self.assertEqual(process.wait(), 1)
        self.assertIn(b"standard output", err)
        self.assertEqual(self.files(), ["square.poly"])

    def test_closed_standard_output(self):
        script = f"'{COMMAND}' --domain square.poly --spacing 0.1 -o a.csv -q >&- 2>&-"
        self.assertEqual(subprocess.run(script, shell=True, cwd=self.folder).returncode, 0)
        self.assertEqual(len(read_csv(self.folder / "a.csv")), 5)


class SecondOrder(CommandTest):
    def test_types_and_streams(self):
        """Checks that formats without elements are written beside, and the types in a stream."""
        self.place("-o", "a.vtu", "-o", "a.csv", "--order", "2")
        grid = read_with_vtk(self.folder / "a.vtu")
        types = {grid.GetCellType(cell) for cell in range(grid.GetNumberOfCells())}
        self.assertEqual(types, {22})
        ids, nodes = point_array(grid, "id"), read_csv(self.folder / "a.csv")["id"]
        self.assertEqual(list(ids[:len(nodes)]), list(nodes))
        self.assertEqual(set(ids[len(nodes):]), {-1})
        out, _ = self.place("-o", "-", "--format", "msh2", "--order", "2", "--quiet")
        rows = out.decode().split("$Elements\n")[1].splitlines()[1:-1]
        self.assertEqual({row.split()[1] for row in rows}, {"8", "9"})

    def test_edges_that_stay_straight_are_reported(self):
        _, err = self.run_command("--domain", LAKE, "--corner-angle", "60", "--spacing", "8",
                                  "--nodes", "100", "-o", "a.msh", "--order", "2", "--quiet")
        self.assertIn("edges do not follow curves", err.decode())

    def test_what_is_refused(self):
        ask = ("--domain", self.square, "--spacing", "0.1", "--order")
        self.assertIn(".msh, .msh2, .vtu", self.refuse(*ask, "2", "-o", "a.msh", "-o", "a.xdmf"))
        self.assertIn("second order", self.refuse(*ask, "2", "-o", "a.pvtu"))
        self.assertIn("--nodes-only", self.refuse(*ask, "2", "-o", "a.msh", "--nodes-only"))
        self.assertIn("--order", self.refuse(*ask, "3", "-o", "a.msh"))
        self.assertIn("--order 2", self.refuse(*ask, "2", "-o", "a.csv", "--nodes-at", "centers"))


class NodesOnly(CommandTest):
    def test_no_triangles(self):
        self.place("-o", "a.vtu", "-o", "a.msh", "-o", "a.msh2", "--nodes-only")
        grid = read_with_vtk(self.folder / "a.vtu")
        nodes = grid.GetNumberOfPoints()
        corners = vtk_to_numpy(grid.GetCells().GetConnectivityArray())
        numpy.testing.assert_array_equal(corners, numpy.arange(nodes))
        points, tags = vtk_to_numpy(grid.GetPoints().GetData()), point_array(grid, "tag")
        # Version 4.1 numbers groups from 1, so the inner nodes have the first free number.
        for name, inner in (("a.msh", 3), ("a.msh2", 0)):
            cells, groups = read_msh(self.folder / name, points)
            self.assertEqual(list(cells), ["vertex"])
            corners, numbers = cells["vertex"]
            self.assertEqual(sorted(corners[:, 0]), list(range(nodes)))
            numpy.testing.assert_array_equal(
                numbers, numpy.where(tags == 0, inner, tags)[corners[:, 0]])
            self.assertEqual(groups["tag_1"], (1, 0))

    def test_pieces_are_no_stream(self):
        self.assertIn("pvtu", self.refuse("--domain", self.square, "--spacing", "0.1", "-o", "-",
                                          "--format", "pvtu"))


class Replacing(CommandTest):
    def test_keeps_permissions_and_links(self):
        target = self.folder / "real.csv"
        target.write_text("old")
        target.chmod(0o640)
        (self.folder / "link.csv").symlink_to("real.csv")
        self.place("--output", "link.csv")
        self.assertTrue((self.folder / "link.csv").is_symlink())
        self.assertEqual(stat.S_IMODE(target.stat().st_mode), 0o640)
        self.assertGreater(len(read_csv(target)["id"]), 100)

    def test_link_to_a_file_that_is_not_there_yet(self):
        (self.folder / "sub").mkdir()
        (self.folder / "sub" / "second.csv").symlink_to("new.csv")
        (self.folder / "first.csv").symlink_to("sub/second.csv")
        self.place("--output", "first.csv", "--report", "first.json")
        self.assertTrue((self.folder / "first.csv").is_symlink())
        self.assertTrue((self.folder / "sub" / "second.csv").is_symlink())
        self.assertGreater(len(read_csv(self.folder / "sub" / "new.csv")["id"]), 100)

    def test_inputs_are_not_replaced(self):
        (self.folder / "link").symlink_to("square.poly")
        os.link(self.square, self.folder / "same.csv")
        before = self.square.read_text()
        for output in ("square.poly", "./square.poly", "link", "same.csv"):
            with self.subTest(output):
                message = self.refuse("--domain", self.square, "--spacing", "0.1",
                                      "--output", output, "--format", "csv")
                self.assertIn("would overwrite an input file", message)
        self.assertIn("overwrite", self.refuse("--domain", self.square, "--spacing", "0.1",
                                             "--report", "square.poly"))
        self.assertEqual(self.square.read_text(), before)

    def test_new_files_follow_the_mask(self):
        mask = os.umask(0o027)
        try:
            self.place("--output", "a.csv")
        finally:
            os.umask(mask)
        self.assertEqual(stat.S_IMODE((self.folder / "a.csv").stat().st_mode), 0o640)

    def test_failure_leaves_the_old_file(self):
        (self.folder / "a.csv").write_text("old")
        message = self.refuse("--domain", self.square, "--spacing", "0.06", "--output", "a.csv",
                              "--report", "/dev/full", code=1)
        self.assertIn("/dev/full", message)
        self.assertEqual((self.folder / "a.csv").read_text(), "old")

    def test_devices_are_written_directly(self):
        self.place("--output", "/dev/null", "--format", "vtu")
        self.assertTrue(stat.S_ISCHR(os.stat("/dev/null").st_mode))


class Pictures(CommandTest):
    def test_bubbles(self):
        self.place("-o", "a.svg")
        self.place("-o", "b.svg", "--bubbles")
        plain, bubbles = ((self.folder / n).read_text() for n in ("a.svg", "b.svg"))
        xml.etree.ElementTree.fromstring(bubbles)
        self.assertGreater(bubbles.count(" C "), plain.count(" C ") + 1000)

    def test_odd_shapes(self):
        strip = "4 2 0 0\n1 0 0\n2 1000 0\n3 1000 1\n4 0 1\n4 0\n1 1 2\n2 2 3\n3 3 4\n4 4 1\n0\n"
        (self.folder / "strip.poly").write_text(strip)
        self.place("-o", "strip.png", domain="strip.poly", spacing="0.5")
        width, height, _ = read_png((self.folder / "strip.png").read_bytes())
        self.assertTrue(width < 4000 and 50 < height < 400)

    def test_many_nodes_stay_small(self):
        self.place("-o", "a.svg", "-o", "a.png", domain=DATA / "great_lakes.poly",
                   spacing="3", environment={"OMP_NUM_THREADS": "1"})
        self.assertLess((self.folder / "a.svg").stat().st_size, 6e6)
        self.assertLess((self.folder / "a.png").stat().st_size, 6e6)


class Locale(CommandTest):
    def test_decimal_comma_changes_nothing(self):
        written = set()
        for locale in ("C", "de_DE.UTF-8"):
            self.place("-o", "a.csv", spacing="0.05+0.025*x", environment={"LC_ALL": locale})
            written.add((self.folder / "a.csv").read_bytes())
        self.assertEqual(len(written), 1)


if __name__ == "__main__":
    unittest.main()
