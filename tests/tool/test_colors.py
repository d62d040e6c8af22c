# SPDX-License-Identifier: BSD-3-Clause
"""Tests pictures with coloured triangles."""

import re
import unittest
import xml.etree.ElementTree

from command import BAD_INPUT, CommandTest

SVG = "{http://www.w3.org/2000/svg}"
HREF = "{http://www.w3.org/1999/xlink}href"
BY = ("quality", "edge", "spacing")
CLASSES = 49
INK, OPEN = (0x1F, 0x2A, 0x37), (0x1F, 0x8F, 0xD6)
TRIANGLE = r"M \S+ \S+ L \S+ \S+ L \S+ \S+ Z"

# With d = 1 the corners of the square are the only nodes, so both triangles are halves of it. Their
# quality is 2 sqrt(2) - 2 and their mean edge (2 + sqrt(2)) / 3.
UNIT_SQUARE = "4 2 0 0\n1 0 0\n2 1 0\n3 1 1\n4 0 1\n4 0\n1 1 2\n2 2 3\n3 3 4\n4 4 1\n0\n"
TWO_TRIANGLES = {
    # the text of the colour bar, the position of the two triangles on it, and its colours around
    # this position
    "quality": ("quality 2 r_in / R: 0.828 to 0.828", "0.8 0.85 0.9 0.95 1",
                (2 * 2**0.5 - 2 - 0.8) / 0.2, 0x3B0F70, 0x8C2981, 0.25),
    "edge": ("mean edge over d: 1.14 to 1.14", "0.8 0.9 1 1.1 1.2",
             ((2 + 2**0.5) / 3 - 0.8) / 0.4, 0xEF8A62, 0xB2182B, 1),
    "spacing": ("spacing d: 1 to 1", "1", 0.5, 0x245F8F, 0x2F8F9D, 0.5),
}


def parts(colour):
    return [(colour >> shift & 255) / 255 for shift in (16, 8, 0)]


def fills(root):
    """Returns the colours of the areas above the legend, with the number of triangles in each."""
    found = []
    for path in root.iter():
        if path.tag == SVG + "use":
            break  # the legend begins here
        fill = re.search(r"fill:rgb\((.+?)%,(.+?)%,(.+?)%\)", path.get("style", ""))
        if fill:
            colour = [float(part) / 100 for part in fill.groups()]
            found.append((colour, len(re.findall(TRIANGLE, path.get("d", "")))))
    return [entry for entry in found if entry[1]]


def lines(root):
    """Returns the number of straight lines in paths of each of the colours of curves."""
    found = {}
    for path in root.iter(SVG + "path"):
        stroke = re.search(r"stroke:rgb\((.+?)%,(.+?)%,(.+?)%\)", path.get("style", ""))
        count = len(re.findall(r"M \S+ \S+ L \S+ \S+ (?!L)", path.get("d", "") + " "))
        colour = tuple(round(float(part) * 2.55) for part in stroke.groups()) if stroke else None
        if colour in (INK, OPEN) and count:
            found.setdefault(colour, count)  # the scale bar and its like come later
    return found


def pattern(things):
    """Returns the same list for two sequences that differ only by the names of their items."""
    names = {}
    return [names.setdefault(thing, len(names)) for thing in things]


def shows(root, words):
    """Returns whether glyphs repeat somewhere in the picture like the letters of `words`."""
    glyphs = [use.get(HREF) for use in root.iter(SVG + "use")]
    wanted = pattern(words)
    return any(pattern(glyphs[at : at + len(words)]) == wanted for at in range(len(glyphs)))


class Colors(CommandTest):
    def picture(self, by, *arguments, **more):
        self.place("-o", "c.svg", "--color", by, "-q", *arguments, **more)
        return xml.etree.ElementTree.parse(self.folder / "c.svg").getroot()

    def test_two_triangles(self):
        (self.folder / "unit.poly").write_text(UNIT_SQUARE)
        for by, (title, ticks, place, below, above, above_at) in TWO_TRIANGLES.items():
            with self.subTest(by):
                root = self.picture(by, domain="unit.poly", spacing="1")
                words = f"Triangles by {title} ({', '.join(ticks.split())})"
                self.assertEqual(root.findtext(SVG + "desc"), words)
                self.assertTrue(shows(root, title + ticks.replace(" ", "")))
                middle = (int(place * CLASSES) + 0.5) / CLASSES
                part = 1 + (middle - above_at) / 0.25
                ((colour, count),) = fills(root)[:1]
                self.assertEqual(count, 2)
                for k in range(3):
                    expected = (1 - part) * parts(below)[k] + part * parts(above)[k]
                    self.assertAlmostEqual(colour[k], expected, delta=1e-4)

    def test_every_triangle_has_its_color(self):
        self.place("-o", "a.ele", "-o", "plain.svg")
        count = int((self.folder / "a.ele").read_text().split()[0])
        self.place("-o", "none.svg", "--color", "none")
        plain = (self.folder / "plain.svg").read_bytes()
        self.assertEqual((self.folder / "none.svg").read_bytes(), plain)
        written = {plain}
        for by in BY:
            colours = fills(self.picture(by, spacing="0.06"))
            self.assertEqual(sum(n for _, n in colours), count)
            written.add((self.folder / "c.svg").read_bytes())
        self.assertEqual(len(written), 4)

    def test_pixels_differ(self):
        written = set()
        for by in ("none", *BY):
            self.place("-o", "a.png", "--color", by)
            written.add((self.folder / "a.png").read_bytes())
        self.assertEqual(len(written), 4)

    def test_spacing_that_varies_much_has_a_logarithmic_bar(self):
        (self.folder / "unit.poly").write_text(UNIT_SQUARE)
        for least, inner in (("0.004", ["0.01", "0.02", "0.05"]), ("0.0002", ["0.001", "0.01"])):
            root = self.picture("spacing", domain="unit.poly", spacing=least + "+0.06*hypot(x,y)")
            words = root.findtext(SVG + "desc")
            low, *between, high = re.search(r"\((.*)\)", words).group(1).split(", ")
            self.assertEqual(between, inner)
            self.assertIn(f"d: {low} to {high} ", words)
            self.assertLess(float(low), 1.2 * float(least))
            self.assertTrue(0.08 < float(high) < 0.09)
            self.assertTrue(shows(root, "".join([low, *between, high])))

    def test_the_scale_bar_has_the_unit(self):
        unit = "cocococo"  # letters that no other text repeats in this way
        (self.folder / "unit.poly").write_text(UNIT_SQUARE)
        for domain, colour in (("unit.poly", "none"), ("unit.poly", "edge"), ("box(0,0,0, 1,1,1)", "quality")):
            with self.subTest(domain, colour=colour):
                ask = {"domain": domain, "spacing": "0.2"}
                self.assertFalse(shows(self.picture(colour, **ask), unit))
                self.assertTrue(shows(self.picture(colour, "--unit", unit, **ask), unit))

    def test_open_boundaries_have_a_colour(self):
        """Checks that the sides of the square with the tag 2 are blue and the others dark."""
        (self.folder / "unit.poly").write_text(
            "4 2 0 0\n1 0 0\n2 1 0\n3 1 1\n4 0 1\n4 1\n1 1 2 2\n2 2 3 1\n3 3 4 1\n4 4 1 1\n0\n")
        for name, expected in (("Open sea", {OPEN: 1, INK: 3}), ("sea", {INK: 4})):
            root = self.picture("none", "--name", f"2={name}", domain="unit.poly", spacing="0.5")
            self.assertEqual(lines(root), expected)
            self.assertEqual(shows(root, "boundaryopen"), OPEN in expected)

    def test_triangles_too_small_to_be_seen_become_pixels(self):
        strip = UNIT_SQUARE.replace("3 1 1", "3 1 0.1", 1).replace("4 0 1", "4 0 0.1", 1)
        (self.folder / "strip.poly").write_text(strip)
        root = self.picture("edge", domain="strip.poly", spacing="0.0025")
        self.assertEqual(fills(root), [])
        self.assertEqual(len(list(root.iter(SVG + "image"))), 1)
        self.assertLess((self.folder / "c.svg").stat().st_size, 1e6)

    def test_wrong_names(self):
        for wrong, hint in (("qualty", "did you mean quality?"), ("red", "'red'"), ("", "''")):
            _, err = self.place("-o", "a.svg", "--color", wrong, code=BAD_INPUT)
            self.assertIn("--color", err.decode())
            self.assertIn(hint, err.decode())
            self.assertIn("none, quality, edge, spacing", err.decode())

    def test_nothing_to_color(self):
        _, err = self.place("-o", "a.vtu", "--color", "edge", code=BAD_INPUT)
        self.assertIn("--color: there is no picture", err.decode())
        self.assertIn(".png", err.decode())
        self.place("-o", "a.vtu", "--color", "none")
        _, err = self.place("-o", "a.svg", "--color", "edge", "--bubbles", code=BAD_INPUT)
        self.assertIn("--bubbles and --color exclude each other", err.decode())


if __name__ == "__main__":
    unittest.main()
