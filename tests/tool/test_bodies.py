# SPDX-License-Identifier: BSD-3-Clause
"""Tests domains in space: files that the command reads, the text that it prints, and input that it
rejects."""

import itertools
import json
import re
import struct
import unittest

import numpy
from vtk.util.numpy_support import vtk_to_numpy

from command import DATA, LAKE, NOT_CONFORMING, CommandTest
from readers import point_array, read_with_vtk

BOX = "box(0,0,0, 1,1,1)"

# A unit cube in TetGen's format. The second number of the first line says that it is in space.
FACES = ["1 2 3 4", "5 6 7 8", "1 2 6 5", "2 3 7 6", "3 4 8 7", "4 1 5 8"]
VERTICES = "8 3 0 0\n" + "".join(f"{1 + i} {x} {y} {z}\n" for i, (x, y, z) in enumerate(
    [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]))
CUBE = (VERTICES + "6 1\n" + "".join(f"1 0 {7 + k}\n4 {face}\n" for k, face in enumerate(FACES)) + "0\n")

LAYERS = """\
ncols 1
nrows 2
nlayers 2
xllcenter 0
yllcenter 0
zllcenter 0
dx 1
dy 1
dz 0.5
0.30 0.20
-1 0.20
nodata_value -1
"""


def tetrahedra_of(grid):
    """Returns the corners of the tetrahedra among the cells of a .vtu file."""
    corners = vtk_to_numpy(grid.GetCells().GetConnectivityArray())
    offsets = vtk_to_numpy(grid.GetCells().GetOffsetsArray())
    return numpy.array([corners[a:b] for a, b in zip(offsets[:-1], offsets[1:]) if b - a == 4])


def points_of(grid):
    return vtk_to_numpy(grid.GetPoints().GetData())


def volume_of(points, tetrahedra):
    a, b, c, d = (points[tetrahedra[:, k]] for k in range(4))
    return numpy.einsum("ij,ij->i", numpy.cross(b - a, c - a), d - a).sum() / 6


class Files(CommandTest):
    def test_bracket(self):
        out, _ = self.place_body(DATA / "bracket.stl", "3.5 + 0.03*hypot(x-62, y-14) + 0.01*z",
                                 "-o", "a.vtu", "-o", "a.png", "--report", "a.json")
        report = json.loads((self.folder / "a.json").read_text())
        grid = read_with_vtk(self.folder / "a.vtu")
        points = points_of(grid)
        self.assertEqual(len(points), report["nodes"])
        self.assertTrue(1000 < len(points) < 4000)
        numpy.testing.assert_allclose(
            point_array(grid, "spacing"),
            3.5 + 0.03 * numpy.hypot(points[:, 0] - 62, points[:, 1] - 14) + 0.01 * points[:, 2],
            rtol=1e-6)
        self.assertTrue(report["edge"]["bands"])
        self.assertRegex(out, r"(?m)^body     80 x 60 x 70, volume 86 524, elements fill 86 \d\d\d, surface 23 \d\d\d$")
        self.assertRegex(out, r"smallest dihedral angle \d")
        # The holes of the body are round, so coarse triangles deviate a little.
        self.assertAlmostEqual(volume_of(points, tetrahedra_of(grid)) / 86524, 1, delta=0.01)

    def test_each_kind_of_file(self):
        # Checks the volume in the summary.
        (self.folder / "cube.poly").write_text("# a comment first\n\n" + CUBE)
        (self.folder / "cube.smesh").write_text(VERTICES + "6 0\n" + "".join(
            f"4 {face}\n" for face in FACES) + "0\n")
        for domain, volume in ((DATA / "eros.off", "0.2913"), (DATA / "kleopatra.obj", "708 868"),
                               ("cube.poly", "1"), ("cube.smesh", "1"), (BOX, "1"),
                               ("ball( 1e3,0,-2.5 , 1 )", "4.188"),
                               ("cylinder(0,0,0, 0,3,4, 1)", "15.7"),
                               ("levelset(-2,-2,-2, 2,2,2, 0.05, max(x^2+y^2+z^2/4-1, z))", "4.18")):
            with self.subTest(str(domain)):
                out, _ = self.run_command("--domain", domain, "--spacing", "5", "--dry-run")
                self.assertRegex(out.decode(), rf"^body     .*, volume {volume}\d?\n")

    def test_level_set(self):
        ring = "levelset(-1.5,-1.5,-1.5, 1.5,1.5,1.5, 0.1, hypot(hypot(x,y)-1, z) - 0.4)"
        self.place_body(ring, "0.15", "-o", "a.vtu")
        grid = read_with_vtk(self.folder / "a.vtu")
        points, tags = points_of(grid), point_array(grid, "tag")
        f = numpy.hypot(numpy.hypot(points[:, 0], points[:, 1]) - 1, points[:, 2]) - 0.4
        self.assertTrue((tags == 1).sum() > 200)
        self.assertLess(abs(f[tags == 1]).max(), 1e-12)
        self.assertLess(f[tags == 0].max(), -0.05)

    def test_tags_of_facets(self):
        (self.folder / "cube.poly").write_text(CUBE)
        self.place_body("cube.poly", "0.3", "-o", "a.vtu")
        grid = read_with_vtk(self.folder / "a.vtu")
        points, tags = points_of(grid), point_array(grid, "tag")
        middle = (abs(points - 0.5) < 0.4).sum(axis=1) == 2
        for tag, axis, place in ((7, 2, 0), (8, 2, 1), (9, 1, 0), (10, 0, 1), (11, 1, 1), (12, 0, 0)):
            on = middle & (points[:, axis] == place)
            self.assertTrue(on.any())
            self.assertEqual(set(tags[on]), {tag})

    def test_feature_angle(self):
        self.place_body(DATA / "kleopatra.obj", "12", "-o", "a.vtu", "--report", "a.json")
        self.place_body(DATA / "kleopatra.obj", "12", "-o", "b.vtu", "--feature-angle", "20",
                        "--report", "b.json")
        self.assertNotEqual((self.folder / "a.vtu").read_bytes(),
                            (self.folder / "b.vtu").read_bytes())
        self.assertNotIn("feature_angle", json.loads((self.folder / "a.json").read_text()))
        self.assertEqual(json.loads((self.folder / "b.json").read_text())["feature_angle"], 20)

    def test_held_spacing_is_noted_before_it_takes_long(self):
        self.save_rough_globe("globe.off")
        _, err = self.place_body("globe.off", "0.4")
        note, warning = (err.find(f"pnpbs: {words}") for words in (
            "note: the elements do not follow the shape, or have small angles, at ",
            "warning: the spacing did not resolve the shape at "))
        self.assertTrue(0 <= note < warning, err)
        _, err = self.place_body("globe.off", "0.4", "--quiet")
        self.assertEqual(err, "")

    def test_surfaces_only(self):
        # Checks an open box: a cube without its lid.
        self.save_cube_without_lid("open.off")
        self.refuse("--domain", "open.off", "--spacing", "0.1", "-o", "a.vtu")
        out, _ = self.place_body("open.off", "0.1", "-o", "a.node", "-o", "a.face", "--check",
                                 "--report", "a.json", "--surfaces-only")
        self.assertRegex(out, r"(?m)^body     1 x 1 x 1, surface 5$")
        self.assertNotIn("dihedral", out)
        points = numpy.loadtxt(self.folder / "a.node", skiprows=1)[:, 1:4]
        corners = numpy.loadtxt(self.folder / "a.face", skiprows=1, dtype=int)[:, 1:4] - 1
        a, b, c = (points[corners[:, k]] for k in range(3))
        self.assertAlmostEqual(
            numpy.linalg.norm(numpy.cross(b - a, c - a), axis=1).sum() / 2, 5, delta=1e-9)
        self.assertIs(json.loads((self.folder / "a.json").read_text())["surfaces_only"], True)
        for option, word in (("--cut", "y=0.5"), ("--color", "quality")):
            self.assertIn("with --surfaces-only",
                          self.refuse("--domain", "open.off", "--spacing", "0.1",
                                      "--surfaces-only", "-o", "a.png", option, word))

    def test_repair(self):
        self.save_cube_without_lid("open.off")
        self.assertIn("--repair", self.refuse("--domain", "open.off", "--spacing", "0.1",
                                              "-o", "a.vtu"))
        out, err = self.place_body("open.off", "0.1", "-o", "a.vtu", "--check", "--report",
                                   "a.json", "--repair", "0.05")
        volume = float(re.search(r"volume ([0-9.]+)", out)[1])
        self.assertAlmostEqual(volume, 1, delta=0.01)  # half of all directions at the lid are open
        self.assertIn("repaired, with a resolution of 0.05", err)
        report = json.loads((self.folder / "a.json").read_text())
        self.assertEqual(report["repair"], 0.05)
        found = report["repaired"]
        self.assertEqual(found["resolution"], 0.05)
        self.assertLess(found["distance"], 1e-3)
        # The hole is deepest at the middle of the lid.
        self.assertAlmostEqual(found["hole_distance"], 0.5, delta=0.05)
        self.assertAlmostEqual(found["mean_distance"], 1 / 36, delta=0.01)
        self.assertLess(found["given_distance"], 0.01)
        self.assertEqual(found["lost_area"], 0)
        self.place_body(BOX, "0.4", "-o", "b.vtu", "--report", "b.json")
        self.assertEqual(set(json.loads((self.folder / "b.json").read_text())["repaired"].values()),
                         {0})
        self.place_body("open.off", "0.1", "--repair", "--dry-run")
        # A sound body stays as it is, with its tags, but its surface can also be rebuilt.
        (self.folder / "cube.poly").write_text(CUBE)
        for option, resolution, tags in (("--repair", 0, set(range(7, 13))),
                                         ("--resurface", 0.1, {7})):
            _, err = self.place_body("cube.poly", "0.3", option, "0.1", "-o", "b.vtu",
                                     "--report", "b.json")
            self.assertEqual("not repaired: the body is sound" in err, resolution == 0)
            report = json.loads((self.folder / "b.json").read_text())
            self.assertEqual(report["repaired"]["resolution"], resolution)
            self.assertEqual(report[option[2:]], 0.1)
            grid = read_with_vtk(self.folder / "b.vtu")
            points, found = points_of(grid), point_array(grid, "tag")
            sides = (abs(points - 0.5) < 0.4).sum(axis=1) == 2
            self.assertEqual(set(found[sides]), tags)
        self.assertIn("exclude each other",
                      self.refuse("--domain", "cube.poly", "--spacing", "0.3", "--repair",
                                  "--resurface", "0.1", "-o", "a.vtu"))
        self.assertIn("found '0'", self.refuse("--domain", "open.off", "--spacing", "0.1",
                                               "--repair=0", "--dry-run"))

    def test_repair_if_needed(self):
        self.save_cube_without_lid("open.off")
        _, err = self.place_body("open.off", "0.2", "-o", "a.vtu", "--check", "--repair", "auto")
        self.assertIn("the body is repaired, because it is refused otherwise: ", err)
        # The cube has a fin of a third of d. The fin is lost in the elements, so automatic repair
        # removes it.
        self.save_cube_with_fin("fin.off", half_width=0.055)
        torn = ["--domain", "fin.off", "--spacing", "0.34", "--set", "conforming_rounds=1",
                "-o", "a.vtu", "--report", "a.json"]
        self.run_command(*torn, code=NOT_CONFORMING)
        given = json.loads((self.folder / "a.json").read_text())
        self.assertEqual(given["unresolved_spacing"], 0.34)
        self.assertEqual(given["repaired"]["resolution"], 0)
        _, err = self.place_body("fin.off", "0.34", *torn[4:], "--check", "--repair", "auto")
        self.assertIn("the elements do not conform: the body is repaired", err)
        found = json.loads((self.folder / "a.json").read_text())
        self.assertEqual(found["repair"], "auto")
        self.assertEqual(found["repaired"]["resolution"], 0.34)
        # A body whose elements conform is not repaired.
        self.save_cube_with_fin("fin.off", half_width=0.1)
        out, err = self.place_body("fin.off", "0.2", "-o", "a.vtu", "--repair", "auto")
        self.assertIn("volume 1.15,", out)
        self.assertNotIn("repaired", err)
        self.assertIn("give the resolution", self.refuse(
            "--domain", "fin.off", "--spacing", "0.2", "--repair", "auto", "--checkpoint", "c",
            "-o", "a.vtu"))

    def test_picture_of_surfaces(self):
        # Checks that the picture contains all triangles and no cut.
        self.save_cube_without_lid("open.off")
        self.place_body("open.off", "0.2", "-o", "a.svg", "-o", "a.face", "--surfaces-only")
        triangles = int((self.folder / "a.face").read_text().split()[0])
        picture = (self.folder / "a.svg").read_text()
        self.assertNotIn("cut at", picture)
        self.assertGreaterEqual(len(re.findall("<path", picture)), triangles)

    def save_rough_globe(self, name):
        """Writes a globe with bumps and dents that d = 0.4 does not resolve."""
        rows = 12
        faces = [((i + up, j + up), (i + 1, j), (i, j + 1))
                 for i in range(rows) for j in range(rows - i)
                 for up in range(2 if i + j + 1 < rows else 1)]
        signs = numpy.array(list(itertools.product((1, -1), repeat=3)))
        octant = numpy.array([(i, j, rows - i - j) for face in faces for i, j in face])
        x = (signs[:, None] * octant[None] / numpy.linalg.norm(octant, axis=1)[:, None]).reshape(-1, 3)
        x *= (1 + 0.7 * numpy.prod(numpy.sin(6.5 * x + [0, 1, 2]), axis=1))[:, None]
        text = f"OFF\n{len(x)} {len(x) // 3} 0\n" + "".join("%.17g %.17g %.17g\n" % tuple(p) for p in x)
        text += "".join(f"3 {t} {t + 1} {t + 2}\n" for t in range(0, len(x), 3))
        (self.folder / name).write_text(text)

    def save_cube_with_fin(self, name, half_width):
        low, high = 0.5 - half_width, 0.5 + half_width
        outline = [(0, 0), (1, 0), (1, low), (2, (1 + 2 * low) / 4), (2, (1 + 2 * high) / 4),
                   (1, high), (1, 1), (0, 1), (0, high), (0, low)]
        ends = [(0, 1, 2, 9), (9, 2, 5, 8), (2, 3, 4, 5), (8, 5, 6, 7)]
        faces = [end[::-1] for end in ends] + [[10 + v for v in end] for end in ends]
        faces += [(i, (i + 1) % 10, 10 + (i + 1) % 10, 10 + i) for i in range(10)]
        text = f"OFF\n20 {len(faces)} 0\n"
        text += "".join(f"{x} {y} {z}\n" for z in (0, 1) for x, y in outline)
        text += "".join("4 " + " ".join(map(str, face)) + "\n" for face in faces)
        (self.folder / name).write_text(text)

    def save_cube_without_lid(self, name):
        vertices = [line.split()[1:] for line in VERTICES.splitlines()[1:]]
        faces = [[int(v) - 1 for v in face.split()] for face in FACES if face != "5 6 7 8"]
        text = f"OFF\n{len(vertices)} {len(faces)} 0\n"
        text += "".join(" ".join(vertex) + "\n" for vertex in vertices)
        text += "".join("4 " + " ".join(map(str, face)) + "\n" for face in faces)
        (self.folder / name).write_text(text)


class Grids(CommandTest):
    def place_on(self, text):
        (self.folder / "g.asc").write_text(text)
        process = self.start("--domain", BOX, "--spacing-grid", "g.asc", "-o", "a.vtu", "-q")
        process.communicate()
        grid = read_with_vtk(self.folder / "a.vtu")
        return points_of(grid), point_array(grid, "spacing")

    # The grid has values at y = 0 and y = 1 in two layers, z = 0 and z = 0.5. A gap in the upper
    # layer takes the value of the cell below it.
    def test_layers(self):
        header, values = LAYERS.split("dz 0.5\n")
        header += "dz 0.5\nnodata_value -1\n"
        points, spacing = self.place_on(header + "0.3\n0.2\n0.3\n-1\n")
        numpy.testing.assert_allclose(spacing, 0.2 + 0.1 * points[:, 1], rtol=1e-3)
        points, spacing = self.place_on(header + "0.2\n0.2\n0.3\n0.3\n")
        numpy.testing.assert_allclose(spacing, 0.2 + 0.2 * numpy.minimum(points[:, 2], 0.5), rtol=1e-3)

    def test_a_flat_grid_holds_for_all_heights(self):
        points, spacing = self.place_on("ncols 1\nnrows 2\nxllcorner -0.5\nyllcorner -0.5\n"
                                        "cellsize 1\n0.3\n0.2\n")
        numpy.testing.assert_allclose(spacing, 0.2 + 0.1 * points[:, 1], rtol=1e-3)

    def test_bad_grids(self):
        good = LAYERS.replace("nodata_value -1\n", "").replace("0.30 0.20\n-1 0.20\n", "1\n1\n1\n1\n")
        for text, word in ((good.replace("dz 0.5\n", ""), "dz"),
                           (good.replace("zllcenter 0\n", ""), "zllcorner"),
                           (good.replace("nlayers 2", "nlayers 1.5"), "nlayers"),
                           (good.replace("nlayers 2", "nlayers 3"), "6 values"),
                           (good + "1\n", "no more")):
            (self.folder / "g.asc").write_text(text)
            self.assertIn(word, self.refuse("--domain", BOX, "--spacing-grid", "g.asc"))
        (self.folder / "g.asc").write_text(good)
        self.assertIn("nlayers", self.refuse("--domain", LAKE, "--spacing-grid", "g.asc"))


class Refusals(CommandTest):
    def refuse_domain(self, domain, *arguments, spacing="0.5"):
        return self.refuse("--domain", domain, "--spacing", spacing, "-o", "a.png", *arguments)

    def test_damaged_stl(self):
        whole = (DATA / "bracket.stl").read_bytes()
        bad = self.folder / "bad.stl"
        bad.write_bytes(whole[:20000])
        self.assertRegex(self.refuse_domain("bad.stl"), "bad.stl: .*20000 bytes, expected 268084")
        at = 84 + 50 * 17 + 12  # the first corner of the 18th triangle
        bad.write_bytes(whole[:at] + struct.pack("<f", numpy.nan) + whole[at + 4:])
        self.assertIn(f"bad.stl: at byte {at}", self.refuse_domain("bad.stl"))
        bad.write_bytes(whole[:80] + struct.pack("<I", 5359) + whole[84:-50])
        self.assertIn("triangle", self.refuse_domain("bad.stl", spacing="5"))
        bad.write_text("solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0\n")
        self.assertIn("bad.stl:5:", self.refuse_domain("bad.stl"))

    def test_other_files(self):
        (self.folder / "a.step").write_text("ISO-10303-21;\nHEADER;\n")
        message = self.refuse_domain("a.step")
        self.assertIn("a.step:1:", message)
        self.assertIn("does not end in .stl, .off, .obj, .ply, .smesh, .msh", message)
        self.assertIn("nowhere.stl", self.refuse_domain("nowhere.stl"))
        self.assertIn("folder.obj", self.refuse_domain(self.folder_called("folder.obj")))

    def folder_called(self, name):
        (self.folder / name).mkdir()
        return name

    def test_bodies_in_words(self):
        for text, word in (("bal(0,0,0,1)", "did you mean ball?"), ("blob(1)", "known: box"),
                           ("ball(0,0,0)", "centre and radius"), ("ball(0,0,0,x)", "centre and radius"),
                           ("ball(0,0,0,)", "centre and radius"), ("ball(0,0,0,0)", "radius"),
                           ("ball(0,0,0,nan)", "centre and radius"), ("box(0,0,0,1,1)", "corners"),
                           ("box(0,0,0,1,1,0)", "high"), ("cylinder(0,0,0,0,0,0,1)", "end"),
                           ("levelset(x)", "two opposite corners of a box, the resolution"),
                           ("levelset(0,0,0, 1,1,1, a, x)", "two opposite corners"),
                           ("levelset(0,0,0, 1,1,1, 0, x)", "resolution"),
                           ("levelset(0,0,0, 1,1,1, 0.1, x-2)", "on the border"),
                           ("levelset(0,0,0, 1,1,1, 0.1, 1/0)", "f is inf at"),
                           ("levelset(0,0,0, 1,1,1, 0.1, w)", "--domain, position 2: unknown name"),
                           ("levelet(0,0,0, 1,1,1, 0.1, x)", "did you mean levelset?")):
            with self.subTest(text):
                self.assertIn(word, self.refuse_domain(text))
        (self.folder / "lake(1)").write_bytes(LAKE.read_bytes())  # file names take precedence
        self.run_command("--domain", "lake(1)", "--spacing", "20", "-o", "a.csv")

    def test_what_is_for_the_other_dimension(self):
        plane = ("--domain", self.square, "--spacing", "0.1", "-o", "a.png")
        self.assertIn("--cut is for bodies", self.refuse(*plane, "--cut", "x=0.5"))
        self.assertIn("--feature-angle is for bodies", self.refuse(*plane, "--feature-angle", "30"))
        self.assertIn("--surfaces-only is for surfaces in space",
                      self.refuse("--domain", self.square, "--spacing", "0.1", "-o", "a.csv",
                                  "--surfaces-only"))
        self.assertIn("--repair is for surfaces in space",
                      self.refuse("--domain", self.square, "--spacing", "0.1", "-o", "a.csv",
                                  "--repair"))
        self.assertIn("--bubbles", self.refuse_domain(BOX, "--bubbles"))
        message = self.refuse("--domain", self.square, "--spacing", "0.1 + z", "-o", "a.csv")
        self.assertIn("position 7: unknown name 'z': this domain is in the plane", message)
        self.assertIn("did you mean", self.refuse_domain(BOX, spacing="1 + hypt(z,x)"))

    def test_numbers(self):
        for angle in ("-1", "181", "x", "", "30,40"):
            self.assertIn("--feature-angle", self.refuse_domain(BOX, "--feature-angle", angle))
        for text in ("0", "z - 2", "nan", "1e-9"):
            self.refuse_domain(BOX, spacing=text)

    def test_a_spacing_far_larger_than_the_body(self):
        self.place_body(BOX, "50", "-o", "a.vtu", "-o", "a.png", "-o", "a.svg")
        points = points_of(read_with_vtk(self.folder / "a.vtu"))
        corners = {tuple(point) for point in points}
        self.assertEqual(corners, {(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)})


if __name__ == "__main__":
    unittest.main()
