# SPDX-License-Identifier: BSD-3-Clause
"""What compare.py asks of a tool that places nodes, and what they have in common."""
import dataclasses
import importlib.util
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np

BUILD = Path(__file__).resolve().parents[4] / "build"


@dataclasses.dataclass
class Outcome:
    points: np.ndarray       # (n, 2)
    seconds: float           # wall time of the process, start and files included
    inner_seconds: float     # as the tool tells it, without start and files; None if it does not
    peak_bytes: int
    more: dict = dataclasses.field(default_factory=dict)


class Tool:
    name = ""      # as the table has it, with the setting
    setting = ""   # one line on what it was told to do
    needs = ""     # what would make it available

    def available(self):
        raise NotImplementedError

    def version(self):
        raise NotImplementedError

    def run(self, case, folder, time_limit):
        """Places the nodes of a case, with files in a folder. Outcome; raises measure.Failed."""
        raise NotImplementedError


def command(name):
    return shutil.which(name)


def built(name):
    """A program of ours in one of the build folders, or None."""
    for build in ("release", "main", "debug"):
        for path in (BUILD / build / name, BUILD / build / "bin" / name,
                     BUILD / build / "tests" / "bench" / name):
            if path.is_file():
                return str(path)
    return None


def module(name):
    return importlib.util.find_spec(name) is not None


def version_of_package(name):
    from importlib.metadata import PackageNotFoundError, version

    try:
        return version(name)
    except PackageNotFoundError:
        return "unknown version"


def output_of(*command):
    done = subprocess.run(command, capture_output=True, text=True, stdin=subprocess.DEVNULL,
                          check=False)
    return (done.stdout + done.stderr).strip()


def python(script, *arguments):
    """Command for a script beside the adapters, in the Python that runs compare.py."""
    return [sys.executable, "-B", Path(__file__).with_name(script), *arguments]


def numbers_of_case(case):
    return [repr(value) for value in (case.constant, case.slope, case.x0, case.y0)]


def told_seconds(text):
    """The value of the line "seconds 1.23"."""
    for line in text.splitlines():
        if line.startswith("seconds "):
            return float(line.split()[1])
    return None


def read_node(path):
    """Triangle's .node file."""
    with open(path) as file:
        count = int(file.readline().split()[0])
        return np.loadtxt(file, usecols=(1, 2), max_rows=count, ndmin=2)
