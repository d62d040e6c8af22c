#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The types that the package promises with py.typed: mypy, as strict as it is, of the package, of a
program with types and, less strict, of the examples; and the program runs.
usage: check_types.py <folder of pnpbs> <source folder> <folder for mypy's cache>"""
import os
import subprocess
import sys
from pathlib import Path

package, source, cache = map(Path, sys.argv[1:])
program = Path(__file__).with_name("typed_program.py")


def mypy(*arguments):
    """From the folder above the package, where `import pnpbs` finds it."""
    command = [sys.executable, "-m", "mypy", f"--cache-dir={cache}", *map(str, arguments)]
    return subprocess.run(command, cwd=package.parent,
                          env=dict(os.environ, MYPYPATH=str(package.parent))).returncode


codes = [mypy("--strict", package, program),
         mypy("--check-untyped-defs", *sorted((source / "examples/python").glob("*/*.py"))),
         subprocess.run([sys.executable, "-B", str(program)]).returncode]
sys.exit(0 if (package / "py.typed").exists() and not any(codes) else 1)
