# SPDX-License-Identifier: BSD-3-Clause
"""Runs tables of cases: input files, the arguments of the command, and what must come out."""

import dataclasses
import json
import os
import shlex
import unittest

from command import DONE, CommandTest


@dataclasses.dataclass
class Case:
    """A case. `figures` are values of the report by their names, in which a dot is a level; a pair
    is a range. Standard error must contain `says`, and must not contain `omits`."""

    name: str
    files: dict  # contents by name, as text or bytes
    arguments: str
    code: int = DONE
    figures: dict = dataclasses.field(default_factory=dict)
    says: tuple = ()
    omits: tuple = ()
    needs_gdal: bool = False


class Runner(CommandTest):
    def run_case(self, case):
        if case.needs_gdal and os.environ["PNPBS_GEO"] != "1":
            self.skipTest("This build has no GDAL.")
        for name, content in case.files.items():
            content = content if isinstance(content, bytes) else content.encode()
            (self.folder / name).write_bytes(content)
        report = ("--report", "report.json") if case.figures else ()
        messages = self.run_command(*shlex.split(case.arguments), *report, code=case.code)[1].decode()
        for text in case.says:
            self.assertIn(text, messages)
        for text in case.omits:
            self.assertNotIn(text, messages)
        self.check_figures(case.figures)

    def check_figures(self, figures):
        for name, expected in figures.items():
            value = json.loads((self.folder / "report.json").read_text())
            for level in name.split("."):
                value = value[level]
            if isinstance(expected, tuple):
                self.assertTrue(expected[0] <= value <= expected[1], f"{name} is {value}")
            else:
                self.assertEqual(value, expected, name)


def run(cases):
    """Runs every case as a test of its own. Exits the process."""
    assert cases
    tests = {f"test_{k:03}": lambda self, case=case: self.run_case(case)
             for k, case in enumerate(cases)}
    assert len({case.name for case in cases}) == len(cases)
    for test, case in zip(tests.values(), cases):
        test.__doc__ = case.name
    suite = unittest.defaultTestLoader.loadTestsFromTestCase(type("Cases", (Runner,), tests))
    raise SystemExit(not unittest.TextTestRunner(verbosity=2).run(suite).wasSuccessful())
