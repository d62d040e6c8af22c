# SPDX-License-Identifier: BSD-3-Clause
"""Tests that the Fortran interface bodies agree with the C header (Agreement), and that the
comparison detects single changes of an argument on either side (Changes).
usage: test_signatures.py <header> <its interfaces, pnpbs_c.f90 or pnpbs_geo_c.f90> Agreement |
Changes"""

import pathlib
import re
import sys
import unittest

import c_header
import check_signatures
import fortran_interfaces

HEADER, INTERFACES = (pathlib.Path(path).read_text() for path in sys.argv[1:3])
# Lower bounds, which show that nothing is overlooked: functions, constants, changes of arguments in
# C and of lines in Fortran; and the number of callbacks.
FUNCTIONS, CONSTANTS, IN_C, IN_FORTRAN, CALLBACKS = {
    "pnpbs.h": (60, 20, 1000, 500, 4), "pnpbs_geo.h": (13, -1, 150, 60, 0)
}[pathlib.Path(sys.argv[1]).name]
# Each comparison parses both sides, so of all single changes only every n-th is compared. The number is
# prime, so that changes of every kind are among them.
EVERY = 7


def is_caught(header, interfaces):
    try:
        return bool(check_signatures.differences(header, interfaces))
    except ValueError:  # it cannot be read
        return True


def changed_arguments(argument):
    """Yields an argument of the header with every kind of change that matters."""
    if "*" in argument:
        yield argument.replace("*", "", 1)
    else:
        yield re.sub(r"(\w+)\s*$", r"*\1", argument)
    yield argument.replace("const ", "", 1) if "const " in argument else "const " + argument
    for one, other in (("int32_t", "int64_t"), ("int64_t", "int32_t"), ("double", "float"),
                       ("int8_t", "int32_t"), ("pnpbs_context", "pnpbs_domain *"),
                       ("pnpbs_spacing_fn", "pnpbs_monitor_fn"), ("char", "int8_t"),
                       ("void *", "int32_t ")):
        if re.search(rf"\b{re.escape(one)}", argument):
            yield argument.replace(one, other, 1)
    yield argument + "2"
    yield ""  # argument left out
    yield argument + ", int32_t more"


def is_harmless(argument, changed):
    """Returns whether a change is irrelevant: const before a value does not matter to callers."""
    return "*" not in argument and changed == "const " + argument


class Agreement(unittest.TestCase):
    def test_they_agree(self):
        self.assertEqual(check_signatures.differences(HEADER, INTERFACES), [])
        self.assertGreater(len(c_header.functions(HEADER)), FUNCTIONS)
        self.assertEqual(len(c_header.callbacks(HEADER)), CALLBACKS)
        self.assertGreater(len(c_header.constants(HEADER)), CONSTANTS)


class Changes(unittest.TestCase):
    def test_every_changed_argument_in_c_is_seen(self):
        header = c_header.without_comments(HEADER)
        mutations = 0
        declarations = list(re.finditer(r"^PNPBS_API [^;]*?\(([^;]*)\);", header, re.S | re.M))
        declarations += re.finditer(r"^typedef int32_t \(\*\w+\)\(([^;]*)\);", header, re.S | re.M)
        for declaration in declarations:
            if declaration[1].strip() == "void":
                continue
            pieces = declaration[1].split(",")
            for k, piece in enumerate(pieces):
                for changed in changed_arguments(" ".join(piece.split())):
                    if is_harmless(" ".join(piece.split()), changed):
                        continue
                    others = pieces[:k] + ([changed] if changed else []) + pieces[k + 1:]
                    mutated = (header[:declaration.start(1)] + (",".join(others) or "void") +
                               header[declaration.end(1):])
                    mutations += 1
                    if mutations % EVERY == 0:
                        self.assertTrue(is_caught(mutated, INTERFACES), f"{piece} -> {changed}")
        self.assertGreater(mutations, IN_C)

    def test_every_changed_line_in_fortran_is_seen(self):
        lines = INTERFACES.splitlines()
        first = next(k for k, line in enumerate(lines)
                     if line.strip() in ("interface", "abstract interface"))
        mutations = 0
        for k in range(first + 1, len(lines)):
            line = lines[k].strip()
            if "::" not in line:
                continue
            changes = [""]
            for one, other in ((", value", ""), (", intent(in)", ", value"), ("! ", "! const "),
                               ("c_int64_t", "c_int32_t"), ("c_int32_t", "c_int64_t"),
                               ("c_int)", "c_int64_t)"), ("real(c_double)", "real(c_float)"),
                               ("c_ptr", "c_funptr")):
                if one in line:
                    changes.append(line.replace(one, other, 1))
            for changed in changes:
                mutated = "\n".join(lines[:k] + [changed] + lines[k + 1:])
                mutations += 1
                if mutations % EVERY == 0:
                    self.assertTrue(is_caught(HEADER, mutated), f"line {k + 1}: {line} -> {changed}")
        self.assertGreater(mutations, IN_FORTRAN)

    def test_missing_functions_and_other_constants_are_seen(self):
        header = c_header.without_comments(HEADER)
        for name in list(c_header.functions(HEADER))[::EVERY]:
            self.assertTrue(is_caught(header.replace(f"{name}(", f"{name}_2("), INTERFACES), name)
        for name, value in fortran_interfaces.constants(INTERFACES).items():
            mutated = re.sub(rf"\b{name} = {value}\b", f"{name} = {value + 50}", INTERFACES)
            self.assertTrue(is_caught(HEADER, mutated), name)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
