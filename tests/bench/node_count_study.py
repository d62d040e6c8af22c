#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Measures the error of `pnpbs --nodes` over domains and spacings.
  tests/bench/node_count_study.py [--program build/release/bin/pnpbs] [--nodes 300,3000,20000]
                                  [--cases lake,box]

Prints for each case the relative error of the number of nodes in percent, and the seconds taken.
"""

import argparse
import json
import os
import subprocess
import tempfile
import time

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
DATA = os.path.join(ROOT, "examples", "data")
CASES = {
    "lake": ("lake_victoria.poly", "1"),
    "lake-dist": ("lake_victoria.poly", "1+0.1*dist"),
    "lake-auto": ("lake_victoria.poly", "auto"),
    "great-lakes": ("great_lakes.poly", "1"),
    "islands-graded": ("great_lakes_islands.poly", "1+0.02*hypot(x,y)"),
    "islands-even": ("great_lakes_islands.poly", "1"),
    "ball": ("ball(0,0,0,1)", "1"),
    "ball-graded": ("ball(0,0,0,1)", "1+0.8*x"),
    "box": ("box(0,0,0,1,1,1)", "1"),
    "box-graded": ("box(0,0,0,1,1,1)", "0.02+0.05*x"),
    "cylinder": ("cylinder(0,0,0,0,0,2,0.5)", "1"),
    "bracket": ("bracket.stl", "1"),
    "bracket-auto": ("bracket.stl", "auto"),
    "eros": ("eros.off", "1"),
    "eros-auto": ("eros.off", "auto"),
    "kleopatra": ("kleopatra.obj", "1"),
}


def place(program, domain, spacing, nodes, report):
    path = os.path.join(DATA, domain)
    start = time.monotonic()
    subprocess.run([program, "--domain", path if os.path.exists(path) else domain, "--spacing", spacing,
                    "--nodes", str(nodes), "--quiet", "--report", report], check=True,
                   stderr=subprocess.DEVNULL)
    seconds = time.monotonic() - start
    with open(report, encoding="utf-8") as file:
        found = json.load(file)
    return found.get("statistics", found)["nodes"], seconds


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--program", default=os.path.join(ROOT, "build", "release", "bin", "pnpbs"))
    parser.add_argument("--nodes", default="300,3000,20000")
    parser.add_argument("--cases", default=",".join(CASES))
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        for case in arguments.cases.split(","):
            for wanted in arguments.nodes.split(","):
                placed, seconds = place(arguments.program, *CASES[case], wanted,
                                        os.path.join(folder, "report.json"))
                print(f"{case:16} {wanted:>8} wanted {placed:>8} placed "
                      f"{100 * (placed / float(wanted) - 1):+7.2f} %  {seconds:6.1f} s", flush=True)


if __name__ == "__main__":
    main()
