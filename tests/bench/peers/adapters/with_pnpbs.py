# SPDX-License-Identifier: BSD-3-Clause
"""PNPBS, by its command."""
import json

import numpy as np
from adapters import tool
from adapters.esri_grid import write_grid
from measure import measure


class Pnpbs(tool.Tool):
    needs = "the command pnpbs, in build/release/bin, on PATH or by --pnpbs"

    def __init__(self, program, name="default", options=()):
        self.program, self.options = program, list(options)
        self.name = f"PNPBS, {name}"
        self.setting = " ".join(self.options) or "as it comes"

    def available(self):
        return self.program is not None

    def version(self):
        return tool.answer_of(self.program, "--version").splitlines()[0]

    def run(self, case, folder, time_limit):
        case.domain.write_poly(folder / "case.poly")
        command = [self.program, "--domain", "case.poly", *spacing(case, folder),
                   "--output", "nodes.csv", "--report", "report.json", "--threads", 1, "--quiet"]
        for option in self.options:
            command += ["--set", option]
        # Status 3: the step limit came first, the nodes are written.
        used = measure(command, folder, time_limit, accepted=(0, 3))
        report = json.loads((folder / "report.json").read_text())
        points = np.loadtxt(folder / "nodes.csv", delimiter=",", skiprows=1, usecols=(1, 2))
        return tool.Outcome(points, used.seconds, report["seconds"]["total"], used.peak_bytes,
                            {"report": report})


def spacing(case, folder):
    """As a formula where there is one, else on a grid."""
    if case.has_formula:
        return ["--spacing", case.formula()]
    write_grid(case, folder / "spacing.asc")
    return ["--spacing-grid", "spacing.asc"]


def find(given):
    return given or tool.built("pnpbs") or tool.command("pnpbs")


def tools(given=None, more=()):
    """The default, and (name, options) for each of `more`."""
    program = find(given)
    return [Pnpbs(program)] + [Pnpbs(program, name, options) for name, options in more]
