# SPDX-License-Identifier: BSD-3-Clause
"""The interface between compare.py and a tool that places nodes, and common parts of the tools."""
import dataclasses
import importlib.util
import re
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
from measure import Measured
from spacing_table import table_of

BUILD = Path(__file__).resolve().parents[4] / "build"


@dataclasses.dataclass
class Outcome:
    points: np.ndarray       # (n, 2)
    seconds: float           # wall time of the process, start and files included
    inner_seconds: float     # reported by the tool, without start and files, or None
    peak_bytes: int
    more: dict = dataclasses.field(default_factory=dict)


@dataclasses.dataclass
class VolumeOutcome:
    points: np.ndarray       # (n, 3)
    tetrahedra: np.ndarray   # (m, 4)
    used: Measured           # of the process, start and files included
    inner_seconds: float     # reported by the tool, without start and files, or None


@dataclasses.dataclass
class ShapeOutcome:
    points: np.ndarray       # (n, 2 or 3)
    used: list               # Measured of its successive processes, start and files included
    field_seconds: float     # CPU seconds of the sizes alone; None if a tool has no such step
    even_points: int         # number of nodes placed with a constant d
    even_seconds: float      # CPU seconds for those, start and files included


class DoesNotStart(Exception):
    """An installed tool cannot be used; the text says why."""


class NotSupported(Exception):
    """The version of a tool lacks what is compared; the text says which version it is and which is
    needed."""


class Tool:
    name = ""      # name in the table, with the setting
    setting = ""   # one line that describes the setting
    needs = ""     # what the user must install

    def available(self):
        raise NotImplementedError

    def version(self):
        """Returns the version that the tool itself reports, so that a broken or too old tool is
        detected before the first case. Raises DoesNotStart, NotSupported."""
        raise NotImplementedError

    def run(self, case, folder, time_limit):
        """Places the nodes of a case, with files in a folder. Returns an Outcome, in space a
        VolumeOutcome. Raises measure.Failed."""
        raise NotImplementedError


class ByShape:
    """A tool of cases that are a shape. Its method place(case, folder, time_limit) returns points,
    a list of Measured, and the CPU seconds for the sizes alone or None."""

    def run(self, case, folder, time_limit):
        points, used, field_seconds = self.place_in(folder / "sizes", case, time_limit)
        even_points, even, _ = self.place_in(folder / "even", case.even(len(points)), time_limit)
        return ShapeOutcome(points, used, field_seconds, len(even_points),
                            sum(u.cpu_seconds for u in even))

    def place_in(self, folder, case, time_limit):
        folder.mkdir()
        return self.place(case, folder, time_limit)


def command(name):
    return shutil.which(name)


def built(name):
    """Returns the path of a PNPBS program in one of the build folders, or None."""
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


def answer_of(*command, any_status=False, time_limit=60):
    """Returns the output of a command that prints its version. Raises DoesNotStart, also if its
    exit status is not 0, unless any status is accepted."""
    try:
        done = subprocess.run([str(word) for word in command], capture_output=True, text=True,
                              errors="replace", stdin=subprocess.DEVNULL, timeout=time_limit,
                              check=False)
    except OSError as error:
        raise DoesNotStart(str(error)) from None
    except subprocess.TimeoutExpired:
        raise DoesNotStart(f"no answer within {time_limit:g} s") from None
    told = (done.stdout + done.stderr).strip()
    if not told or (done.returncode != 0 and not any_status):
        raise DoesNotStart(f"status {done.returncode}: {last_line(told)}")
    return told


def require_version(version, least, why):
    """Raises NotSupported if the leading numbers of a version are below those of another."""
    def numbers(text):
        return [int(part) for part in re.match(r"[\d.]*", text)[0].split(".") if part]

    if numbers(version) < numbers(least):
        raise NotSupported(f"version {version}; needs {least} or later, {why}")


def last_line(text):
    return text.splitlines()[-1].strip() if text else "it says nothing"


def require_import(package):
    answer_of(sys.executable, "-c", f"import {package}; print('it is there')")


def python(script, *arguments):
    """Returns the command for a script in this folder, with the Python that runs compare.py."""
    return [sys.executable, "-B", Path(__file__).with_name(script), *arguments]


def words_of_spacing(case, folder):
    """Returns d in the form that our scripts and programs read: numbers, or the name of a table."""
    if case.has_formula:
        return [repr(value)
                for value in (case.constant, case.slope, case.x0, case.y0, case.x_counts)]
    table_of(case).write(folder / "spacing.txt")
    return ["spacing.txt"]


def told_seconds(text):
    """Returns the value of the line "seconds 1.23"."""
    for line in text.splitlines():
        if line.startswith("seconds "):
            return float(line.split()[1])
    return None


def read_node(path, dimension=2):
    """Reads a .node file of Triangle or TetGen."""
    with open(path) as file:
        count = int(file.readline().split()[0])
        return np.loadtxt(file, usecols=range(1, dimension + 1), max_rows=count, ndmin=2)


def read_npz(path):
    """Reads points and tetrahedra that our scripts have written."""
    with np.load(path) as found:
        return found["points"], found["tetrahedra"]
