# SPDX-License-Identifier: BSD-3-Clause
"""Runs a file of tests by unittest. Exits with 77, which ctest lists as skipped, where a Python package
is missing that only scripts/setup.sh --all installs.
usage: run_suite.py <file>"""

import runpy
import sys

OF_ALL_TESTS = {"pyvista", "vtk", "vtkmodules"}

sys.argv = sys.argv[1:]
try:
    runpy.run_path(sys.argv[0], run_name="__main__")
except ModuleNotFoundError as error:
    if error.name.partition(".")[0] not in OF_ALL_TESTS:
        raise
    print(f"Skipped: the Python package {error.name} was not found (scripts/setup.sh --all installs it).")
    sys.exit(77)
