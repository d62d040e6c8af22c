# SPDX-License-Identifier: BSD-3-Clause
"""Tests that the interface bodies of the Fortran layer are the output of the generator for the
header. For a changed header, the generator must produce changed bodies that the independent
comparison accepts.
usage: test_fortran_layer.py <header> <its interfaces, pnpbs_c.f90 or pnpbs_geo_c.f90>"""

import itertools
import pathlib
import re
import sys
import unittest

import c_header
import check_signatures

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "scripts" / "fortran_layer"))
import make_fortran_layer
from declarations import BY_ADDRESS, BY_REFERENCE

PATHS = [pathlib.Path(path) for path in sys.argv[1:3]]
HEADER, INTERFACES = (path.read_text() for path in PATHS)
[MODULE] = [one for one in make_fortran_layer.MODULES if one.name == PATHS[1].stem]
INCLUDED = (ROOT / "include" / MODULE.included).read_text() if MODULE.included else ""
IS_WHOLE = MODULE.name == "pnpbs_c"  # whether the module has callbacks and constants
DECLARATION = re.compile(r"^PNPBS_API [^;]*?(\w+)\(([^;]*)\);", re.S | re.M)
CALLBACK = re.compile(r"^typedef int32_t \(\*(\w+)\)\(([^;]*)\);", re.S | re.M)
# The generator takes a while for a whole header, so every n-th function and constant is changed.
EVERY = 7


def made(header):
    return make_fortran_layer.layer(MODULE, header, INCLUDED)


def with_arguments(header, declaration, arguments):
    """Returns the header with other arguments in one declaration."""
    return header[:declaration.start(2)] + arguments + header[declaration.end(2):]


def with_one_more(declaration, argument):
    return argument if declaration[2] == "void" else f"{declaration[2]}, {argument}"


def body(text, name):
    """Returns the interface body of a C function."""
    fortran_name = name.replace("pnpbs_", "c_", 1)
    return re.search(rf"^    function {fortran_name}\(.*?end function", text, re.S | re.M)[0]


class FortranLayer(unittest.TestCase):
    def test_is_up_to_date(self):
        found = make_fortran_layer.differences(PATHS[1].name, INTERFACES, made(HEADER))
        self.assertEqual(found, [], f"{make_fortran_layer.COMMAND} writes it")

    def test_no_line_is_too_long(self):
        self.assertEqual([line for line in made(HEADER).splitlines() if len(line) > 100], [])

    def test_tables_have_what_the_headers_have(self):
        functions = c_header.functions(INCLUDED + HEADER)
        named = BY_ADDRESS | {name for name, _ in BY_REFERENCE}
        if not IS_WHOLE:
            self.assertEqual(named - functions.keys(), set())
        for name, argument in BY_REFERENCE:
            if name in functions:
                self.assertIn(argument, [one.name for one in functions[name].arguments])


class Follows(unittest.TestCase):
    def assert_follows(self, header, what):
        """Checks that the layer of a changed header differs and agrees with this header. Returns
        the layer."""
        layer = made(header)
        self.assertTrue(make_fortran_layer.differences("", INTERFACES, layer), what)
        self.assertEqual(check_signatures.differences(header, layer), [], what)
        return layer


class Changes(Follows):
    """Tests single changes of copies of the header."""

    def test_argument_added(self):
        found = list(DECLARATION.finditer(HEADER))
        self.assertEqual(len(found), len(c_header.functions(HEADER)))
        added = itertools.cycle((("int32_t more", "integer(c_int32_t), value"),
                                 ("const double *more", "real(c_double), intent(in)"),
                                 ("void *more", "type(c_ptr), value")))
        for declaration, (argument, fortran) in zip(found[::EVERY], added):
            arguments = with_one_more(declaration, argument)
            layer = self.assert_follows(with_arguments(HEADER, declaration, arguments),
                                        f"{declaration[1]}: {argument}")
            self.assertRegex(body(layer, declaration[1]), re.escape(fortran) + r" ::.*\bmore\b")

    def test_argument_removed(self):
        for declaration in list(DECLARATION.finditer(HEADER))[::EVERY]:
            if declaration[2] != "void":
                arguments = declaration[2].rpartition(",")[0] or "void"
                self.assert_follows(with_arguments(HEADER, declaration, arguments),
                                    declaration[1])

    def test_function_removed(self):
        for declaration in list(DECLARATION.finditer(HEADER))[::EVERY]:
            header = HEADER[:declaration.start()] + HEADER[declaration.end():]
            if f"  as {declaration[1]}\n" in HEADER:  # others refer to its parameters
                with self.assertRaisesRegex(ValueError, f"refer to {declaration[1]}"):
                    made(header)
                continue
            self.assertNotIn(f'"{declaration[1]}"', self.assert_follows(header, declaration[1]))

    def test_array_that_may_be_null(self):
        for text in re.findall(r"\[(?:n|count)\](?:\[\d\])?(?: local indices)?, or NULL", HEADER):
            self.assert_follows(HEADER.replace(text, text.replace(", or NULL", "")), text)

    def test_type_that_fortran_lacks(self):
        declaration = DECLARATION.search(HEADER)
        for argument in ("float more", "pnpbs_unknown more", "int64_t **more"):
            with self.assertRaisesRegex(ValueError, f"{declaration[1]}: no Fortran type for"):
                made(with_arguments(HEADER, declaration, with_one_more(declaration, argument)))

    def test_function_without_a_comment(self):
        with self.assertRaisesRegex(ValueError, "pnpbs_new has no comment"):
            made("PNPBS_API pnpbs_status pnpbs_new(void);\n" + HEADER)


@unittest.skipUnless(IS_WHOLE, "the header has no callbacks and no constants")
class ChangesOfTheWhole(Follows):
    """Tests changes of callbacks and constants."""

    def test_constant_changed(self):
        for name, value in list(c_header.constants(HEADER).items())[::EVERY]:
            header = re.sub(rf"(\b{name}\b,? ){value}\b", rf"\g<1>{value + 50}", HEADER)
            self.assertIn(f"parameter :: {name} = {value + 50}",
                          self.assert_follows(header, name))

    def test_constant_added(self):
        header = HEADER.replace("#define PNPBS_INNER 1\n",
                                "#define PNPBS_INNER 1\n#define PNPBS_OTHER 2\n")
        self.assertIn("parameter :: PNPBS_OTHER = 2", self.assert_follows(header, "a role"))
        header = HEADER.replace("#define PNPBS_VERSION_MAJOR",
                                "#define PNPBS_OTHER 2\n#define PNPBS_VERSION_MAJOR")
        with self.assertRaisesRegex(ValueError, "without a comment: PNPBS_OTHER"):
            made(header)

    def test_argument_of_a_callback_added(self):
        found = list(CALLBACK.finditer(HEADER))
        self.assertEqual(len(found), len(c_header.callbacks(HEADER)))
        for callback in found:
            self.assert_follows(
                with_arguments(HEADER, callback, f"{callback[2]}, int32_t more"), callback[1])
            with self.assertRaisesRegex(ValueError, "its comment gives more no shape"):
                made(with_arguments(HEADER, callback, f"{callback[2]}, double *more"))

    def test_comment_of_a_callback_changed(self):
        layer = made(HEADER.replace("fills d[n] for coordinates[n][dim].",
                                    "fills d[n][dim] for coordinates[n][dim]."))
        self.assertIn("fills d(dim,n) for coordinates(dim,n).", layer)
        self.assertIn("intent(out) :: d(dim, n)", layer)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
