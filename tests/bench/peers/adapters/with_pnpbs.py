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
        # Status 3 means that the step limit was reached; the nodes are written nevertheless.
        used = measure(command, folder, time_limit, accepted=(0, 3))
        report = json.loads((folder / "report.json").read_text())
        points = np.loadtxt(folder / "nodes.csv", delimiter=",", skiprows=1, usecols=(1, 2))
        return tool.Outcome(points, used.seconds, report["seconds"]["total"], used.peak_bytes,
                            {"report": report})


class PnpbsInSpace(Pnpbs):
    accepted = (0, 3, 4)

    def run(self, case, folder, time_limit):
        body = {"box": "box(0,0,0, 1,1,1)", "ball": "ball(0,0,0, 1)"}.get(case.body.kind)
        if not body:
            body = "body.stl"
            case.body.write_stl(folder / body)
        command = [self.program, "--domain", body, "--spacing", case.formula(),
                   "--output", "nodes.node", "--output", "nodes.ele", "--report", "report.json",
                   "--threads", 1, "--quiet"]
        for option in self.options:
            command += ["--set", option]
        used = measure(command, folder, time_limit, accepted=self.accepted)
        report = json.loads((folder / "report.json").read_text())
        with open(folder / "nodes.ele") as file:
            count = int(file.readline().split()[0])
            tetrahedra = np.loadtxt(file, int, usecols=(1, 2, 3, 4), max_rows=count, ndmin=2)
        points = tool.read_node(folder / "nodes.node", 3)
        return tool.VolumeOutcome(points, tetrahedra - tetrahedra.min(), used,
                                  report["seconds"]["total"])


def spacing(case, folder):
    """Returns the spacing as a formula if there is one, and as a grid otherwise."""
    if case.has_formula:
        return ["--spacing", case.formula()]
    write_grid(case, folder / "spacing.asc")
    return ["--spacing-grid", "spacing.asc"]


def find(given):
    return given or tool.built("pnpbs") or tool.command("pnpbs")


def tools(given=None, more=()):
    """Returns the default setting, and one with the name and options of each of `more`."""
    return settings(Pnpbs, given, more)


def volume_tools(given=None, more=()):
    return settings(PnpbsInSpace, given, more)


def settings(kind, given, more):
    program = find(given)
    return [kind(program)] + [kind(program, name, options) for name, options in more]
