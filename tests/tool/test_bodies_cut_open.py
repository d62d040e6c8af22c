# SPDX-License-Identifier: BSD-3-Clause
"""Tests pictures of bodies against faces computed from the tetrahedra in the .vtu file."""

import math
import re
import unittest
import xml.etree.ElementTree

import matplotlib.image
import numpy
from vtk.util.numpy_support import vtk_to_numpy

from command import CommandTest
from readers import point_array, read_with_vtk
from test_bodies import points_of, tetrahedra_of

SVG = "{http://www.w3.org/2000/svg}"
NUMBER = r"(-?[\d.]+)"
FACE = re.compile(r"M {0} {0} L {0} {0} L {0} {0} Z".format(NUMBER))
FILL = re.compile(r"fill:rgb\((.+?)%,(.+?)%,(.+?)%\)")
SKIN = numpy.array([0xB9, 0xCA, 0xDB]) / 255
FLESH = numpy.array([0xF0, 0xDC, 0xAE]) / 255
PALETTES = {
    "quality": (0x3B0F70, 0x8C2981, 0xDE4968, 0xFE9F6D, 0xFCFDBF),
    "edge": (0x2166AC, 0x67A9CF, 0xF4F2EE, 0xEF8A62, 0xB2182B),
}
CLASSES = 49
TURNED, RAISED = math.radians(26), math.radians(22)


def view_of(normal):
    """Returns the axes of the view: to the right, upwards and towards the viewer."""
    normal = numpy.array(normal, float) / numpy.linalg.norm(normal)
    floor = abs(normal[2]) > 0.8
    right = numpy.cross((0, 1, 0) if floor else (0, 0, 1), normal)
    right /= numpy.linalg.norm(right)
    up = numpy.cross(normal, right)
    rise = -RAISED if floor else RAISED
    toward = (math.cos(rise) * (math.cos(TURNED) * normal + math.sin(TURNED) * right)
              + math.sin(rise) * up)
    across = numpy.cross(up, toward)
    across /= numpy.linalg.norm(across)
    return numpy.array([across, numpy.cross(toward, across), toward])


def hue(colours):
    """Returns the part of colours that shading does not change."""
    return colours / colours.sum(axis=1, keepdims=True)


def palette_colours(stops, fractions):
    stops = numpy.array([[(c >> s & 255) / 255 for s in (16, 8, 0)] for c in stops])
    middle = (numpy.minimum((fractions * CLASSES).astype(int), CLASSES - 1) + 0.5) / CLASSES
    place = numpy.linspace(0, 1, len(stops))
    return numpy.stack([numpy.interp(middle, place, stops[:, k]) for k in range(3)], axis=1)


class Shell:
    """The faces of the tetrahedra behind a plane that face the viewer."""

    def __init__(self, points, tetrahedra, normal, offset):
        self.points = points
        kept = points[tetrahedra].mean(axis=1) @ normal <= offset
        faces = numpy.concatenate([numpy.delete(tetrahedra, k, axis=1) for k in range(4)])
        inner = numpy.concatenate([tetrahedra[:, k] for k in range(4)])
        owner = numpy.tile(numpy.arange(len(tetrahedra)), 4)
        _, group, count = numpy.unique(numpy.sort(faces, axis=1), axis=0, return_inverse=True,
                                       return_counts=True)
        beside = numpy.bincount(group.ravel(), kept[owner])[group.ravel()]
        seen = kept[owner] & (beside == 1)
        a, b, c = (points[faces[:, k]] for k in range(3))
        outward = numpy.cross(b - a, c - a)
        outward *= numpy.sign(numpy.einsum("ij,ij->i", outward, a - points[inner]))[:, None]
        self.view = view_of(normal)
        seen &= outward @ self.view[2] > 0
        self.faces, self.owner = faces[seen], owner[seen]
        self.cut = count[group.ravel()][seen] == 2
        self.projected = points[self.faces] @ self.view.T  # [faces][corners][right, up, nearness]


class Pictures(CommandTest):
    def shell(self, domain, spacing, plane, normal, offset, *arguments):
        """Draws a picture with the command. Returns the shell that it should show."""
        self.place_body(domain, spacing, "-o", "a.vtu", "-o", "a.svg", "-o", "a.png", "--cut", plane,
                        *arguments)
        self.grid = read_with_vtk(self.folder / "a.vtu")
        self.tetrahedra = tetrahedra_of(self.grid)
        return Shell(points_of(self.grid), self.tetrahedra, numpy.array(normal, float), offset)

    def drawn(self):
        """Returns the triangles of the picture in drawing order, and their colours."""
        self.root = xml.etree.ElementTree.parse(self.folder / "a.svg").getroot()
        triangles, colours = [], []
        for path in self.root.iter(SVG + "path"):
            face, fill = FACE.match(path.get("d", "")), FILL.search(path.get("style", ""))
            if face and fill and "stroke:rgb" in path.get("style"):  # not a part of the colour bar
                triangles.append([float(number) for number in face.groups()])
                colours.append([float(part) / 100 for part in fill.groups()])
        return numpy.array(triangles).reshape(-1, 3, 2), numpy.array(colours)

    def fitted(self, triangles, shell):
        """Returns the triangles of the picture in the coordinates of the view."""
        flat = shell.projected[:, :, :2].reshape(-1, 2)
        ours = triangles.reshape(-1, 2) * (1, -1)
        scale = numpy.ptp(flat, axis=0) / numpy.ptp(ours, axis=0)
        self.assertAlmostEqual(scale[0], scale[1], delta=1e-4 * scale[0])
        return (ours - ours.min(axis=0)).reshape(-1, 3, 2) * scale + flat.min(axis=0)

    def check_faces(self, shell, palette, values, low, high):
        triangles, colours = self.drawn()
        self.assertEqual(len(triangles), len(shell.faces))
        fitted = self.fitted(triangles, shell)
        # Each drawn triangle must equal one of the shell, which is found by its centre.
        centres, wanted = fitted.mean(axis=1), shell.projected[:, :, :2].mean(axis=1)
        gap = numpy.linalg.norm(centres[:, None] - wanted[None], axis=2)
        face = gap.argmin(axis=1)
        size = numpy.ptp(wanted, axis=0).max()
        self.assertLess(gap.min(axis=1).max(), 1e-4 * size)
        self.assertEqual(len(set(face)), len(face))
        skin = ~shell.cut[face]
        self.assertTrue(skin.any() and not skin.all())
        numpy.testing.assert_allclose(hue(colours[skin]), hue(numpy.tile(SKIN, (skin.sum(), 1))),
                                      atol=2e-3)
        fraction = numpy.clip((values[shell.owner[face[~skin]]] - low) / (high - low), 0, 1)
        expected = palette_colours(palette, fraction)
        # A value on the border of two classes may have the colour of either.
        off = abs(hue(colours[~skin]) - hue(expected)).max(axis=1)
        self.assertLess(numpy.mean(off > 2e-3), 0.01)
        self.assertLess(off.max(), 0.05)
        return fitted, face

    # Checks that at any point the triangle drawn last is the one that a ray from the viewer hits
    # first.
    def check_order(self, shell, fitted, face):
        rng = numpy.random.default_rng(1)
        low, high = fitted.reshape(-1, 2).min(axis=0), fitted.reshape(-1, 2).max(axis=0)
        checked = 0
        for place in rng.uniform(low, high, (400, 2)):
            a, b, c = (fitted[:, k] - place for k in range(3))
            cross = [u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0] for u, v in ((b, c), (c, a), (a, b))]
            area = sum(cross)
            weights = numpy.stack(cross, axis=1) / area[:, None]
            hit = numpy.flatnonzero((weights > 1e-3).all(axis=1))
            if not len(hit) or ((weights > -1e-3).all(axis=1)).sum() > len(hit):
                continue
            corners = shell.projected[face[hit]]
            # Each face uses its own corners, since drawn corners may be in another order.
            depth = [numpy.linalg.solve(numpy.c_[corner[:, :2], numpy.ones(3)], corner[:, 2])
                     @ [*place, 1] for corner in corners]
            self.assertEqual(hit[-1], hit[numpy.argmax(depth)])
            checked += 1
        self.assertGreater(checked, 100)

    def test_quality(self):
        shell = self.shell("cylinder(0,0,0, 2,0,0, 1)", "0.25", "x=1.2", (1, 0, 0), 1.2)
        quality = vtk_to_numpy(self.grid.GetCellData().GetArray("quality"))[:len(self.tetrahedra)]
        self.drawn()
        words = self.root.findtext(SVG + "desc")
        title, low, high = re.match(r"Body cut at x = 1.2, tetrahedra by (.+) \(([\d.]+),.* (1)\)$",
                                    words).groups()
        self.assertEqual(title, f"quality 3 r_in / R: {quality.min():.3g} to {quality.max():.3g}")
        shown = self.check_faces(shell, PALETTES["quality"], quality, float(low), float(high))
        self.check_order(shell, *shown)

    def test_edges_along_a_slanted_plane(self):
        shell = self.shell("box(0,0,0, 2,1.5,1)", "0.22 + 0.05*x", "0.5,-1,2, 1", (0.5, -1, 2), 1,
                           "--color", "edge")
        spacing = point_array(self.grid, "spacing")
        value = numpy.zeros(len(self.tetrahedra))
        for k in range(4):
            for m in range(k):
                a, b = self.tetrahedra[:, k], self.tetrahedra[:, m]
                length = numpy.linalg.norm(shell.points[a] - shell.points[b], axis=1)
                value += length / (spacing[a] + spacing[b]) / 3
        self.drawn()
        words = self.root.findtext(SVG + "desc")
        self.assertIn("Body cut at 0.5 x - y + 2 z = 1, tetrahedra by mean edge over d", words)
        low, high = re.search(r"\(([\d.]+),.* ([\d.]+)\)$", words).groups()
        shown = self.check_faces(shell, PALETTES["edge"], value, float(low), float(high))
        self.check_order(shell, *shown)

    # By default the cut is orthogonal to the shortest extent. Without a colour the cut is plain.
    def test_plain_pixels(self):
        self.place_body("box(0,0,0, 4,3,1)", "0.3", "-o", "a.vtu", "-o", "a.png", "--color", "none")
        pixels = matplotlib.image.imread(self.folder / "a.png")[:, :, :3]
        height, width = pixels.shape[:2]
        self.assertTrue(1400 <= max(height, width) <= 2700)
        self.assertTrue((pixels[0] == 1).all() and (pixels[:, 0] == 1).all())
        body = pixels[: int(0.9 * height)]
        body = body[(body < 0.99).any(axis=2)]
        shares = [numpy.mean(abs(hue(body) - hue(colour[None])).max(axis=1) < 0.01)
                  for colour in (FLESH, SKIN)]
        grid = read_with_vtk(self.folder / "a.vtu")
        shell = Shell(points_of(grid), tetrahedra_of(grid), numpy.array([0, 0, 1.0]), 0.5)
        x = shell.projected[:, :, :2]
        u, v = x[:, 1] - x[:, 0], x[:, 2] - x[:, 0]
        area = abs(u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]) / 2
        cut = area[shell.cut].sum() / area.sum()
        self.assertGreater(shares[0], 0.8 * cut)  # the rest of the pixels shows edges
        self.assertLess(shares[0], cut)
        self.assertTrue(0.5 * (1 - cut) < shares[1] < 1 - cut)

    def test_each_cut_and_color_differs(self):
        written = set()
        for arguments in ((), ("--cut", "x=0.5"), ("--cut", "y=0.5"), ("--cut", "z=0.5"),
                          ("--cut", "-1,0,0,-0.5"), ("--color", "edge"), ("--color", "spacing"),
                          ("--color", "none")):
            self.place_body("box(0,0,0, 1,1,1)", "0.4", "-o", "a.png", *arguments)
            written.add((self.folder / "a.png").read_bytes())
        self.assertEqual(len(written), 7)  # the default is x=0.5

    def test_wrong_cuts(self):
        ask = ("--domain", "box(0,0,0, 2,1,1)", "--spacing", "0.4", "-o", "a.png", "--cut")
        for plane, name in (("x=2.5", "x = 2.5"), ("y=-1", "y = -1"), ("1,1,1,4.5", "x + y + z = 4.5"),
                            ("0,0,-1,0", "-z = 0")):
            message = self.refuse(*ask, plane)
            self.assertIn(f"--cut: the plane {name} misses the body, which has x from 0 to 2", message)
        for text in ("0.5", "w=1", "x=", "x=1,2", "=1", "1,2,3", "1,2,3,4,5", "0,0,0,1", "x=nan", "x"):
            message = self.refuse(*ask, text)
            self.assertIn("--cut: expected x=NUMBER", message)
            self.assertIn(f"'{text}'", message)
        self.assertIn("there is no picture", self.refuse(*ask[:4], "-o", "a.vtu", "--cut", "x=1"))


if __name__ == "__main__":
    unittest.main()
