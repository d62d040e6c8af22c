# SPDX-License-Identifier: BSD-3-Clause
"""Tests that the library keeps the interface that it guarantees to linked programs, and that the
comparison detects every single change that would break one.
usage: test_abi.py <record> <header> <library> <C compiler>"""

import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

import abi
import c_header

RECORD, HEADER, LIBRARY, COMPILER = sys.argv[1:5]
TEXT = pathlib.Path(HEADER).read_text()
NAME, VERSIONS, TABLES = abi.soname(LIBRARY), abi.symbol_versions(LIBRARY), abi.of_tables(LIBRARY)
NOW = abi.describe(TEXT, NAME, VERSIONS, TABLES)
BEFORE = abi.recorded(RECORD) if pathlib.Path(RECORD).exists() else []


def breaks(header=TEXT, name=NAME, versions=VERSIONS, tables=TABLES):
    """Returns what a change breaks, compared with the unchanged library."""
    return abi.compare(NOW, abi.describe(header, name, versions, tables))[0]


def compiles(lines, header=TEXT):
    """Returns whether the compiler reads the header as these lines say."""
    with tempfile.TemporaryDirectory() as folder:
        (pathlib.Path(folder) / "pnpbs").mkdir()
        (pathlib.Path(folder) / "pnpbs" / "pnpbs.h").write_text(header)
        return subprocess.run([COMPILER, "-std=c99", "-Werror", "-fsyntax-only", "-I", folder, "-x",
                               "c", "-"], input=abi.as_c(lines), text=True,
                              capture_output=True, check=False).returncode == 0


class Promise(unittest.TestCase):
    def test_is_kept(self):
        broken, new = abi.compare(BEFORE, NOW)
        self.assertEqual(broken, [], "this breaks programs; docs/releasing.md tells what to do:\n" +
                         "\n".join(broken))
        self.assertEqual(new, [], "record it with 'cmake --build <build folder> --target "
                         "pnpbs-record-abi':\n" + "\n".join(new))

    def test_is_what_the_compiler_reads(self):
        self.assertTrue(compiles(BEFORE))

    def test_covers_the_interface(self):
        kinds = [line.split(" ")[0] for line in BEFORE]
        self.assertEqual(kinds.count("function"), len(VERSIONS))
        self.assertEqual(kinds.count("callback"), 4)
        self.assertEqual(kinds.count("handle"), 7)
        for kind, least in (("constant", 19), ("option", 10), ("choice", 2), ("statistic", 20),
                            ("format", 5)):
            self.assertGreaterEqual(kinds.count(kind), least, kind)
        self.assertEqual(len(set(map(abi.key, BEFORE))), len(BEFORE), "two lines about one thing")


class Changes(unittest.TestCase):
    def test_none(self):
        self.assertEqual(breaks(), [])

    def test_every_removed_function(self):
        declarations = re.findall(r"^PNPBS_API[^;]*;", TEXT, re.S | re.M)
        self.assertGreater(len(declarations), 60)
        for declaration in declarations:
            self.assertEqual(len(breaks(TEXT.replace(declaration, "", 1))), 1, declaration)

    def test_every_function_no_longer_exported(self):
        for name in VERSIONS:
            others = {other: VERSIONS[other] for other in VERSIONS if other != name}
            self.assertEqual(len(breaks(versions=others)), 1, name)
            self.assertEqual(len(breaks(versions={**VERSIONS, name: "PNPBS_2"})), 1, name)

    def test_every_changed_type_of_an_argument(self):
        header = c_header.without_comments(TEXT)
        others = {"int32_t": "int64_t", "int64_t": "int32_t", "double": "float", "char": "int8_t",
                  "int8_t": "int32_t", "void": "char", "pnpbs_context": "pnpbs_domain",
                  "pnpbs_domain": "pnpbs_placement", "pnpbs_placement": "pnpbs_context",
                  "pnpbs_status": "int64_t", "pnpbs_curve_fn": "pnpbs_spacing_fn",
                  "pnpbs_spacing_fn": "pnpbs_monitor_fn", "pnpbs_monitor_fn": "pnpbs_curve_fn"}
        changes = 0
        for declaration in re.finditer(r"^(PNPBS_API|typedef int32_t \(\*)[^;]*\(([^;]*)\);",
                                       header, re.S | re.M):
            for word in re.finditer(rf"\b({'|'.join(others)})\b", declaration[2]):
                if declaration[2] == "void":
                    continue
                start = declaration.start(2) + word.start()
                changed = header[:start] + others[word[1]] + header[start + len(word[1]):]
                changes += 1
                self.assertEqual(len(breaks(changed)), 1, f"{word[1]} in {declaration[0]}")
        self.assertGreater(changes, 200)

    def test_every_constant(self):
        constants = [line.split(" ")[1:] for line in NOW if line.startswith("constant ")]
        for name, value in constants:
            for pattern in (rf"(X\({name}, ){value}\b", rf"(#define {name} ){value}\b"):
                changed, times = re.subn(pattern, rf"\g<1>{int(value) + 40}", TEXT)
                if times:
                    break
            self.assertEqual(times, 1, name)
            self.assertEqual(len(breaks(changed)), 1, name)
            self.assertFalse(compiles([f"constant {name} {value}"], changed), name)

    def test_every_row_of_the_tables(self):
        for k, line in enumerate(TABLES):
            self.assertEqual(len(breaks(tables=TABLES[:k] + TABLES[k + 1:])), 1, line)
            if not line.startswith("choice "):
                changed = TABLES[:k] + [line + "s"] + TABLES[k + 1:]
                self.assertEqual(len(breaks(tables=changed)), 1, line)

    def test_the_library_s_name(self):
        self.assertEqual(len(breaks(name="libpnpbs.so.77")), 1)

    def test_what_is_new_breaks_nothing_but_is_told(self):
        header = TEXT + "\nPNPBS_API pnpbs_status pnpbs_more(int32_t count);\n"
        broken, new = abi.compare(NOW, abi.describe(header, NAME, {**VERSIONS, "pnpbs_more": "PNPBS_1"},
                                                    TABLES + ["statistic more integer"]))
        self.assertEqual(broken, [])
        self.assertEqual(new, ["new: function pnpbs_status pnpbs_more(int32_t) PNPBS_1",
                               "new: statistic more integer"])

    def test_the_compiler_sees_changes_too(self):
        for one, other in (("int64_t *count", "int32_t *count"),
                           ("const double *coordinates", "const float *coordinates"),
                           ("int32_t dim, const double *t", "int64_t dim, const double *t"),
                           ("void *user", "char *user")):
            self.assertTrue(one in TEXT, one)
            self.assertFalse(compiles(NOW, TEXT.replace(one, other, 1)), one)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=1)
