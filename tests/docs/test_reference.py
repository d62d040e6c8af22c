#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The reference is what the sources have now; and the check notices when it is not, and when a
language lacks a function.
usage: test_reference.py <libpnpbs.so>"""

import pathlib
import shutil
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "scripts" / "reference"))
import make_reference
from library_tables import Library

LIBRARY = Library(sys.argv.pop())
FORTRAN = "bindings/fortran/pnpbs.f90"
JULIA = "bindings/julia/PNPBS.jl/src/"
PYTHON = "bindings/python/pnpbs/"


class Reference(unittest.TestCase):
    def test_is_up_to_date(self):
        found = list(make_reference.differences(ROOT / "docs/reference",
                                                make_reference.pages(ROOT, LIBRARY)))
        self.assertEqual(found, [], "cmake --build <folder> --target pnpbs-reference writes it")


class Changes(unittest.TestCase):
    """One change at a time, to copies of the sources."""

    def setUp(self):
        self.root = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.root)
        for folder in ("include", "bindings", "docs/reference", "src/method"):
            shutil.copytree(ROOT / folder, self.root / folder)

    def change(self, file, old, new):
        path = self.root / file
        text = path.read_text()
        self.assertIn(old, text)
        path.write_text(text.replace(old, new))

    def found(self):
        return "\n".join(make_reference.differences(
            self.root / "docs/reference", make_reference.pages(self.root, LIBRARY)))

    def test_comment(self):
        self.change("include/pnpbs/pnpbs.h", "in space its volume, of surfaces alone their area.", "its size.")
        self.assertIn("+Returns the area of the inside, its size.", self.found())

    def test_fortran_argument(self):
        self.change(FORTRAN, "real(c_double), intent(in) :: point(:)",
                    "real(c_double), intent(in) :: point(2)")
        self.assertIn("+! real(c_double), intent(in) :: point(2)", self.found())

    def test_docstring(self):
        self.change(JULIA + "domain.jl", "add_hole!(domain, point)\n\n", "add_hole!(domain, x)\n\n")
        self.assertIn("+add_hole!(domain, x)", self.found())

    def test_docstring_of_python(self):
        self.change(PYTHON + "results.py", "Checks the invariants of", "Tests the invariants of")
        self.assertIn("+Tests the invariants of", self.found())

    def test_argument_of_python(self):
        self.change(PYTHON + "domain.py", "closed: bool = True", "closed: bool = False")
        self.assertIn("closed=False", self.found())

    def test_constant_of_the_method(self):
        self.change("src/method/constants.hpp", "kTouch = 1.3;", "kTouch = 1.31;")
        self.assertIn("+| `kTouch` | 1.31 | d | Distance below which bubbles touch", self.found())

    def test_constant_without_a_unit(self):
        self.change("src/method/constants.hpp", "[d] Chosen between these\n// shells", "Chosen")
        with self.assertRaisesRegex(ValueError, "kTouch = 1.3"):
            self.found()

    def test_page_too_many(self):
        (self.root / "docs/reference/old.md").write_text("what was\n")
        self.assertIn("-what was", self.found())

    def test_function_without_fortran(self):
        self.change(FORTRAN, "procedure :: rebalance => placement_rebalance\n", "\n")
        with self.assertRaisesRegex(ValueError, "rebalance: no procedure of the Fortran module"):
            self.found()

    def test_procedure_that_calls_another_function(self):
        self.change(FORTRAN, "c_particles_figures(", "c_particles_sizes(")
        with self.assertRaisesRegex(ValueError, "figures: no procedure of the Fortran module"):
            self.found()

    def test_function_without_julia(self):
        self.change(JULIA + "LibPNPBS.jl", "pnpbs_domain_measure(domain, measure) =", "measured() =")
        with self.assertRaisesRegex(ValueError, "measure: not in the Julia package"):
            self.found()

    def test_function_without_python(self):
        self.change(PYTHON + "placement.py", 'self._call("rebalance")', "pass")
        with self.assertRaisesRegex(ValueError, "rebalance: nothing in the Python package calls it"):
            self.found()

    def test_new_function(self):
        self.change("include/pnpbs/pnpbs.h", "/** Returns the area of the inside,",
                    "/** Its centre. Local. */\nPNPBS_API pnpbs_status pnpbs_domain_centre("
                    "pnpbs_domain domain, double *xy);\n\n/** Returns the area of the inside,")
        with self.assertRaisesRegex(ValueError, "centre: no procedure"):
            self.found()

    def test_raw_layer_only(self):
        self.change(JULIA + "domain.jl", "LibPNPBS.pnpbs_domain_measure(live(domain), inside)",
                    "0")
        self.assertIn("only in the raw layer, `PNPBS.LibPNPBS.pnpbs_domain_measure`", self.found())

    def test_neither_collective_nor_local(self):
        self.change("include/pnpbs/pnpbs.h", "surfaces alone their area. Local;", "surfaces alone their area;")
        with self.assertRaisesRegex(ValueError, "measure: .* collective or local"):
            self.found()


unittest.main()
