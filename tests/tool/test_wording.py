# SPDX-License-Identifier: BSD-3-Clause
"""Tests that the command acts on the codes of warnings and errors and not on their texts. With
libraries whose messages have no words (wording.cpp), it ends, warns and advises as with the real
ones."""

import json
import os
import re
import unittest

from command import BAD_INPUT, DATA, DONE, LEFT_OUT, NOT_CONFORMING, SPACING_MISSED, CommandTest

WORDLESS = {"LD_LIBRARY_PATH": os.environ["PNPBS_WORDLESS_LIBRARIES"]}
GEO = os.environ["PNPBS_GEO"] == "1"

ISLAND = [[18.8, 54.4], [19.2, 54.4], [19.2, 54.6], [18.8, 54.4]]
COAST = [[18.6, 54.2], [19.4, 54.2], [19.4, 54.8], [18.6, 54.8]]
BOW = [[18.6, 54.2], [19.4, 54.8], [19.4, 54.2], [18.6, 54.8], [18.6, 54.2]]


def feature(kind, coordinates):
    return {"type": "Feature", "properties": {}, "geometry": {"type": kind,
                                                              "coordinates": coordinates}}


class Wording(CommandTest):
    def geojson(self, *features):
        path = self.folder / "shapes.geojson"
        path.write_text(json.dumps({"type": "FeatureCollection", "features": features}))
        return path

    def same(self, *arguments, code):
        """Runs the command with both libraries. Returns the messages with the real one and with the
        one without words."""
        told = []
        for environment in {}, WORDLESS:
            _, err = self.run_command(*arguments, code=code, environment=environment)
            told.append(err.decode())
        for kind in "warning", "note":
            counts = [len(re.findall(rf"^pnpbs: {kind}: ", err, re.M)) for err in told]
            self.assertEqual(*counts, told)
        self.assertEqual(told[0].count("\n"), told[1].count("\n"), told)
        return told

    def test_a_poly_file(self):
        small = ("--domain", self.square, "--spacing", "0.5", "-o", "a.csv")
        true, wordless = self.same(*small, code=DONE)
        self.assertIn("the spacing is larger than features of the boundary", true)
        self.assertRegex(wordless, r"warning: x+ x+ x+ x+ x+ ")
        self.same(*small, "--set", "steps=x", code=BAD_INPUT)
        self.same("--domain", self.square, "--spacing", "-1", code=BAD_INPUT)
        self.same("--domain", self.square, "--spacing", "min(0.001+0.2*abs(y-0.5), 0.1)", "--set",
                  "method=paper", "-o", "a.csv", code=SPACING_MISSED)

    def test_elements(self):
        bracket = ("--domain", DATA / "bracket.stl", "--spacing", "7", "-o", "a.csv", "--set",
                   "conforming_rounds=0", "--set", "min_angle=10")
        for nodes_at, warned in ("boundary", True), ("centers", False):
            true, _ = self.same(*bracket, "--nodes-at", nodes_at, code=DONE)
            self.assertEqual("dihedral angles below" in true, warned)
        self.same("--domain", "ball(0,0,0, 1)", "--spacing", "5", "--set", "conforming_rounds=0",
                  "-o", "a.csv", code=NOT_CONFORMING)

    @unittest.skipUnless(GEO, "built without GDAL")
    def test_coasts(self):
        ask = ("--spacing", "5", "--unit", "km", "-o", "a.csv")
        left_out = self.geojson(feature("Polygon", [ISLAND]), feature("LineString", COAST))
        true, _ = self.same("--domain", left_out, *ask, code=LEFT_OUT)
        self.assertIn("outside the domain and left out", true)
        crossed = self.geojson(feature("Polygon", [BOW]))
        for told in self.same("--domain", crossed, *ask, code=BAD_INPUT):
            self.assertRegex(told, r"\(.*\) \[longitude 19\.0[0-9]*, latitude 54\.[0-9]*\]")
            self.assertTrue(told.endswith("'Polygons that cross'\n"), told)
        sphere = ("--sphere", "6371,0,0", "--spacing", "10", "-o", "a.csv")
        for told in self.same("--domain", crossed, *sphere, code=BAD_INPUT):
            self.assertRegex(told, r"\(longitude 19\.[0-9]*, latitude 54\.[0-9]*\)")
            self.assertTrue(told.endswith("'Polygons that cross'\n"), told)
        (self.folder / "lone.shp").write_bytes(bytes(100))
        true, _ = self.same("--domain", "lone.shp", *ask, code=BAD_INPUT)
        self.assertIn("provide its .shx", true)


if __name__ == "__main__":
    unittest.main()
