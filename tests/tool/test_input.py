# SPDX-License-Identifier: BSD-3-Clause
"""Tests the usage and invalid input: a helpful message, exit code 2 and no file."""

import json
import os
import random
import re
import struct
import unittest

from command import DONE, FAILED, LAKE, NOT_CONVERGED, SOURCE, SQUARE, CommandTest

GRID = """\
ncols 3
nrows 2
xllcenter 0
yllcenter 0
cellsize 0.5
nodata_value -9999
0.1 0.1 0.1
0.05 0.05 0.05
"""


class Usage(CommandTest):
    def test_help_lists_options_and_formats(self):
        text = self.run_command("--help")[0].decode()
        for word in ("--domain", "--spacing", "--set", ".vtu", "hypot", "growth_limit", "130"):
            self.assertIn(word, text)
        self.assertLessEqual(max(map(len, text.splitlines())), 100)

    def test_manual_page_has_the_same_options(self):
        text = self.run_command("--help")[0].decode()
        page = (SOURCE / "docs" / "pnpbs.1").read_text().replace("\\-", "-")
        self.assertEqual(set(re.findall(r"(?m)^  (?:-\w,)?(--[a-z-]+)", text)),
                         set(re.findall(r"--[a-z][a-z-]+", page)))

    def test_help_to_a_reader_that_goes_away(self):
        for ask in ("--help", "--list-statistics"):
            process = self.start(ask)
            process.stdout.close()
            self.assertEqual(process.stderr.read(), b"")
            process.stderr.close()
            self.assertEqual(process.wait(), DONE)

    def test_version(self):
        self.assertRegex(self.run_command("--version")[0].decode(), r"^pnpbs \d+\.\d+\.\d+\n")

    def test_unknown_options_get_the_nearest_name(self):
        for wrong, right in [("--ouput", "--output"), ("--Spacing=1", "--spacing"),
                             ("--repotr", "--report"), ("--bubble", "--bubbles")]:
            with self.subTest(wrong):
                message = self.refuse("--domain", self.square, "--spacing", "0.1", wrong, "x.csv")
                self.assertIn(f"did you mean {right}?", message)
        self.assertIn("unknown option --xyzzy\n", self.refuse("--xyzzy"))

    def test_stray_words(self):
        self.assertIn("'lake.poly'", self.refuse("lake.poly"))

    def test_something_is_missing(self):
        self.assertIn("--domain", self.refuse("--spacing", "1"))
        self.assertIn("--spacing", self.refuse("--domain", self.square))
        self.assertIn("--output", self.refuse("--domain", self.square, "--spacing", "1", "-o"))
        self.refuse()

    def test_contradictions(self):
        ask = ("--domain", self.square, "--spacing", "0.1")
        self.assertIn("exclude", self.refuse("--domain", self.square, "--spacing", "auto",
                                             "--spacing-grid", "g.asc"))
        self.assertIn("twice", self.refuse(*ask, "-o", "a.csv", "-o", "./a.csv"))
        self.assertIn("twice", self.refuse(*ask, "-o", "-", "--format", "csv", "--report", "-"))
        self.refuse(*ask, "--spacing", "0.2")

    def test_library_options(self):
        ask = ("--domain", self.square, "--spacing", "0.1", "-o", "a.csv", "--set")
        self.assertIn("steps", self.refuse(*ask, "stpes=3"))
        self.assertIn("KEY=VALUE", self.refuse(*ask, "steps"))
        self.assertIn("KEY=VALUE", self.refuse(*ask, "=3"))
        for value in ("", "x", "1.5", "-1", "1e99", "nan"):
            self.assertIn("steps", self.refuse(*ask, "steps=" + value))
        self.assertIn("growth_limit", self.refuse(*ask, "growth_limit=0,5"))

    def test_step_limit(self):
        self.place("--steps", "1", "--set", "sweeps=0", "-o", "a.csv", code=NOT_CONVERGED)
        self.assertIn("a.csv", self.files())


class Outputs(CommandTest):
    def test_unknown_formats(self):
        ask = ("--domain", self.square, "--spacing", "0.1", "--output")
        self.assertIn("vtu", self.refuse(*ask, "a.xyz"))
        self.assertIn("vtu", self.refuse(*ask, "a"))
        self.assertIn("--format", self.refuse(*ask, "-"))
        self.assertIn("did you mean csv?", self.refuse(*ask, "-", "--format", "cvs"))
        self.place("--output", "b.xyz", "--format", "node")
        self.assertIn("b.xyz", self.files())

    def test_unwritable_files_are_found_before_the_run(self):
        (self.folder / "folder.csv").mkdir()
        for path in ("missing/a.csv", "folder.csv", "/proc/a.csv", "square.poly/a.csv",
                     "x" * 300 + ".csv", ""):
            with self.subTest(path):
                # This spacing would take very long, so the error must come before the run.
                self.refuse("--domain", LAKE, "--spacing", "0.02", "--output", path)
        self.assertIn("missing/r.json", self.refuse("--domain", LAKE, "--spacing", "0.02",
                                                    "--report", "missing/r.json"))

    def test_read_only_folder(self):
        if os.geteuid() == 0:
            self.skipTest("root may write everywhere")
        self.folder.chmod(0o500)
        self.addCleanup(self.folder.chmod, 0o700)
        self.refuse("--domain", self.square, "--spacing", "0.1", "--output", "a.csv")


class Bodies(CommandTest):
    def octahedron(self, apex):
        vertices = [(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, apex), (0, 0, -1)]
        triangles = [(0, 2, 4), (2, 1, 4), (1, 3, 4), (3, 0, 4),
                     (2, 0, 5), (1, 2, 5), (3, 1, 5), (0, 3, 5)]
        lines = ["OFF", "6 8 0", *(" ".join(map(str, v)) for v in vertices),
                 *("3 " + " ".join(map(str, t)) for t in triangles)]
        (self.folder / "body.off").write_text("\n".join(lines) + "\n")
        return "body.off"

    def refuse_body(self, domain, *arguments, spacing="0.4", **more):
        return self.refuse("--domain", domain, "--spacing", spacing, "-o", "a.csv", *arguments,
                           **more)

    def test_a_vertex_far_away_is_told_before_anything_is_laid(self):
        message = self.refuse_body(self.octahedron(7e6))
        for word in ("the edge from (0, 0, 7e+06) to", "which is 7000000.0", "max_nodes allows"):
            self.assertIn(word, message)
        # The number of nodes is within the limit, but their memory is checked before the run as
        # well.
        message = self.refuse_body(self.octahedron(7e8), "--set", "max_nodes=2000000000",
                                   spacing="4", code=FAILED)
        self.assertIn("max_memory", message)

    def test_resolve_is_named_where_it_asks_for_too_many(self):
        thin = "box(0,0,0, 1,1,0.01)"
        asked = ("--set", "max_nodes=2000")
        self.assertIn("the option resolve reduces d",
                      self.refuse_body(thin, *asked, "--set", "resolve=1", spacing="0.2"))
        self.assertNotIn("resolve", self.refuse_body(thin, *asked, spacing="0.004"))

    def test_a_binary_stl_cut_short(self):
        triangle = struct.pack("<12fH", *[0.0] * 3, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0)
        for header in (b"solid part", b"part"):
            whole = header.ljust(80, b"\0") + struct.pack("<I", 100) + 100 * triangle
            (self.folder / "cut.stl").write_bytes(whole[:84 + 50 * 42 + 10])
            message = self.refuse_body("cut.stl")
            self.assertIn("2194 bytes, expected 5084 for the 100 triangles", message)
            self.assertIn("cut short after 42 of them", message)
            self.assertEqual("is binary, though its header begins with 'solid'" in message,
                             header.startswith(b"solid"))
            self.assertEqual("does not begin with 'solid'" in message,
                             not header.startswith(b"solid"))


class Expressions(CommandTest):
    def refuse_spacing(self, text):
        return self.refuse("--domain", self.square, "--spacing", text, "-o", "a.csv")

    def test_errors_show_the_place(self):
        cases = [
            ("1 + 0.02*hypt(x,y)", 10, "did you mean hypot?"),
            ("1 +", 4, "ends"),
            ("(1 + x", 7, "parenthesis"),
            ("1 + x)", 6, "parenthesis"),
            ("0,1 + x", 2, "point"),
            ("1 + z", 5, "'z'"),
            ("x = 1", 3, "=="),
            ("0.1 0.2", 5, "operator"),
            ("hypot(x)", 8, "few"),
            ("1 + hypot( )", 12, "two, or three"),
            ("1 + hypot(x, (y), min(1, 2), 4)", 31, "many arguments for 'hypot': it takes two"),
            ("hypot(hypot(x), y)", 14, "few"),
            ("hypot(x, y", 11, "parenthesis"),
            ("hypot(x, y, z)", 13, "'z': this domain is in the plane"),
            ("sin", 1, "parentheses"),
            ("x ? 1", None, ""),
            ('"x"', None, ""),
            ("é + $", 1, "é"),
            ("", None, "--spacing"),
            ("  ", 1, "empty"),
        ]
        for text, position, word in cases:
            with self.subTest(text):
                message = self.refuse_spacing(text)
                self.assertIn(word, message)
                if position:
                    first, line, mark = message.splitlines()
                    self.assertIn(f"position {position}:", first)
                    self.assertEqual(line[2:], text)
                    self.assertEqual(mark.index("^") - 2, min(position - 1, len(text)))

    def test_values_that_are_no_spacing(self):
        for text in ("0", "-1", "nan", "x - 0.5", "1/x", "0/0*x", "1e-300", "sqrt(x-2)", "1e-9+x-x"):
            with self.subTest(text):
                self.assertNotIn("internal", self.refuse_spacing(text))

    def test_a_jump_to_nearly_nothing(self):
        message = self.refuse_spacing("x > 0.5 ? 1 : 1e-160")
        self.assertIn("more nodes than", message)
        self.assertNotIn("inf", message)

    def test_long_ones(self):
        self.refuse_spacing("(" * 5000)
        self.refuse_spacing("1+" * 50000 + "1")

    def test_equal_ways_to_say_it(self):
        results = set()
        for text in ("0.1", " 0.1 ", "1/10", "0.2*cos(pi/3)*0 + 1e-1", "x>1e9 ? 5 : 0.1"):
            self.place("-o", "a.node", spacing=text)
            results.add((self.folder / "a.node").read_bytes())
        self.assertEqual(len(results), 1)

    def test_functions(self):
        # Checks functions in formulas. Each term is 1 if its function is correct.
        terms = ("hypot(3,4)/5", "hypot(2, 3, 6)/7", "hypot(3*(1+x), min(4,5)*(1+x))/(5+5*x)",
                 "pow(2,3)/8", "min(1,2,3)", "max(-1,0,1)", "abs(-1)", "sqrt(1)",
                 "exp(0)", "log(e)", "floor(1.9)", "ceil(0.1)", "mod(7,3)", "ln(e)", "log10(10)", "log2(2)",
                 "cbrt(1)", "cos(0)", "sin(pi/2)", "2^0", "atan2(0,1)+1")
        spacing = "0.1*(" + " + ".join(terms) + f")/{len(terms)}"
        self.place("--report", "a.json", spacing=spacing)
        self.place("--report", "b.json", spacing="0.1")
        reports = [json.loads((self.folder / n).read_text()) for n in ("a.json", "b.json")]
        self.assertAlmostEqual(reports[0]["nodes"], reports[1]["nodes"], delta=3)


class Grids(CommandTest):
    def place_on(self, text, *arguments, **more):
        (self.folder / "g.asc").write_text(text)
        return self.run_command("--domain", self.square, "--spacing-grid", "g.asc", *arguments,
                                **more)

    def refuse_grid(self, text):
        (self.folder / "g.asc").write_text(text)
        return self.refuse("--domain", self.square, "--spacing-grid", "g.asc", "-o", "a.csv")

    def test_northern_row_comes_first(self):
        self.place_on(GRID, "-o", "a.csv")
        rows = [line.split(",") for line in (self.folder / "a.csv").read_text().splitlines()[1:]]
        for _, _, y, _, spacing in rows:
            self.assertAlmostEqual(float(spacing), 0.05 + 0.1 * min(float(y), 0.5), delta=0.002)

    def test_corner_and_centre(self):
        self.place_on(GRID, "-o", "a.node")
        corner = GRID.replace("xllcenter 0", "XLLCORNER -0.25").replace("yllcenter 0",
                                                                        "yllcorner -0.25")
        self.place_on(corner, "-o", "b.node")
        self.assertEqual((self.folder / "a.node").read_bytes(),
                         (self.folder / "b.node").read_bytes())

    # Checks cells that are twice as wide as high: they have the same values at other positions.
    def test_cells_that_are_no_squares(self):
        self.place_on(GRID.replace("cellsize 0.5", "dx 0.5\nDY 0.25"), "-o", "a.csv")
        rows = [line.split(",") for line in (self.folder / "a.csv").read_text().splitlines()[1:]]
        for _, _, y, _, spacing in rows:
            self.assertAlmostEqual(float(spacing), 0.05 + 0.2 * min(float(y), 0.25), delta=0.002)
        columns = GRID.replace("0.1 0.1 0.1", "0.05 0.1 0.1").replace("0.05 0.05 0.05", "0.05 0.1 0.1")
        self.place_on(columns.replace("cellsize 0.5", "dx 0.25\ndy 0.5"), "-o", "b.csv")
        rows = [line.split(",") for line in (self.folder / "b.csv").read_text().splitlines()[1:]]
        for _, x, _, _, spacing in rows:
            self.assertAlmostEqual(float(spacing), 0.05 + 0.2 * min(float(x), 0.25), delta=0.002)
        # The corner of the grid is half a cell before the first centre.
        corner = GRID.replace("xllcenter 0", "xllcorner -0.25").replace("yllcenter 0",
                                                                        "yllcorner -0.125")
        self.place_on(corner.replace("cellsize 0.5", "dx 0.5\ndy 0.25"), "-o", "c.csv")
        self.assertEqual((self.folder / "a.csv").read_bytes(), (self.folder / "c.csv").read_bytes())

    # All values of a row are equal, so it does not matter from which cell of its row a gap takes
    # its value.
    def test_gaps_take_the_nearest_value(self):
        self.place_on(GRID, "-o", "a.node")
        gaps = GRID.replace("0.1 0.1 0.1", "0.1 0.1 -9999").replace("0.05 0.05 0.05",
                                                                    "-9999 0.05 -9999")
        self.place_on(gaps, "-o", "b.node")
        self.assertEqual((self.folder / "a.node").read_bytes(),
                         (self.folder / "b.node").read_bytes())

    def test_bad_grids_name_the_line(self):
        self.assertIn("g.asc:8:", self.refuse_grid(GRID.replace("0.05 0.05 0.05", "0.05 x 0.05")))
        self.assertIn("g.asc:1:", self.refuse_grid("nclos 3\n"))
        self.assertIn("6 values", self.refuse_grid(GRID.replace(" 0.05\n", "\n")))
        self.assertIn("no more", self.refuse_grid(GRID + "0.1\n"))
        self.assertIn("ncols", self.refuse_grid(GRID.replace("ncols 3\n", "")))
        self.assertIn("cellsize", self.refuse_grid(GRID.replace("cellsize 0.5", "cellsize 0")))
        self.assertIn("dy", self.refuse_grid(GRID.replace("cellsize", "dx")))
        self.assertIn("dx", self.refuse_grid(GRID.replace("cellsize 0.5", "dx -1\ndy 1")))
        self.assertIn("both", self.refuse_grid(GRID.replace("cellsize", "dx 1\ncellsize")))
        self.assertIn("cellsize, or dx", self.refuse_grid(GRID.replace("cellsize 0.5\n", "")))
        self.assertIn("nrows", self.refuse_grid(GRID.replace("nrows 2", "nrows 1e300")))
        self.refuse_grid(GRID.replace("ncols 3", "ncols 900000000"))
        self.refuse_grid("")
        self.assertIn("folder", self.refuse("--domain", self.square, "--spacing-grid", ".",
                                            "-o", "a.csv"))
        self.refuse_grid("\0" * 1000)
        self.refuse_grid(GRID.replace("0.05", "-9999").replace("0.1", "-9999"))
        self.refuse_grid(GRID.replace("0.05", "0"))
        self.refuse_grid(GRID.replace("0.05", "nan"))
        self.assertIn("missing.asc", self.refuse("--domain", self.square, "--spacing-grid",
                                                 "missing.asc"))


class Domains(CommandTest):
    """Tests damaged files through the command. The tests of the library cover all kinds of errors.
    """

    def refuse_domain(self, data):
        (self.folder / "bad.poly").write_bytes(data)
        from_file = self.refuse("--domain", "bad.poly", "--spacing", "0.1", "-o", "a.csv")
        from_stream = self.refuse("--domain", "-", "--spacing", "0.1", "-o", "a.csv", stdin=data)
        self.assertEqual(from_file.replace("bad.poly", "standard input"), from_stream)
        return from_file

    def test_bad_files(self):
        square = SQUARE.encode()
        for data in (b"", b"\n\n#\n", b"8 2 0 0\n1 0 0\n", square[: len(square) // 2],
                     bytes(random.Random(1).randrange(256) for _ in range(5000)),
                     b"\0" * 5000, b"9" * 100000, b"99999999999999999999 2 0 0\n",
                     b"1000000000000 2 0 0\n1 0 0\n",
                     square.replace(b"1 1 2 1", b"1 1 99 1"),
                     square.replace(b"2 1 0\n", b"2 nan 0\n"),
                     square.replace(b"2 1 0\n", b"2 1e999 0\n"),
                     square.replace(b"3 1 1\n4 0 1\n", b"4 0 1\n3 1 1\n"),
                     square.replace(b"4 4 1 1\n", b""), b"-1 2 0 0\n0 0\n0\n"):
            with self.subTest(data[:40]):
                self.refuse_domain(data)

    def test_missing_file_and_folder(self):
        self.assertIn("nowhere.poly", self.refuse("--domain", "nowhere.poly", "--spacing", "0.1"))
        self.refuse("--domain", self.folder, "--spacing", "0.1")
        self.refuse("--domain", "/dev/null", "--spacing", "0.1")

    def test_crossing_segments_are_named(self):
        bow_tie = b"4 2 0 0\n1 0 0\n2 1 1\n3 1 0\n4 0 1\n4 0\n1 1 2\n2 2 3\n3 3 4\n4 4 1\n0\n"
        self.assertIn("segment", self.refuse_domain(bow_tie))


if __name__ == "__main__":
    unittest.main()
