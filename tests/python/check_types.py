#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests the types that the package guarantees with py.typed. mypy checks the package and a typed
program in strict mode and the examples in normal mode, and the program runs. mypy must reject a
program that violates the types.
usage: check_types.py <folder of pnpbs> <source folder> <folder for mypy's cache>"""
import os
import subprocess
import sys
import tempfile
from pathlib import Path

package, source, cache = map(Path, sys.argv[1:])
program = Path(__file__).with_name("typed_program.py")


def mypy(*arguments):
    """Runs mypy in the folder above the package, where `import pnpbs` finds the package."""
    command = [sys.executable, "-m", "mypy", f"--cache-dir={cache}", *map(str, arguments)]
    return subprocess.run(command, cwd=package.parent,
                          env=dict(os.environ, MYPYPATH=str(package.parent))).returncode


def is_refused(text, message):
    with tempfile.TemporaryDirectory() as folder:
        wrong = Path(folder) / "wrong.py"
        wrong.write_text(text)
        done = subprocess.run([sys.executable, "-m", "mypy", f"--cache-dir={cache}", str(wrong)],
                              cwd=package.parent, env=dict(os.environ, MYPYPATH=str(package.parent)),
                              capture_output=True, text=True)
    if done.returncode != 1 or message not in done.stdout:
        print(f"not refused: {text}{done.stdout}{done.stderr}")
    return done.returncode == 1 and message in done.stdout


codes = [mypy("--strict", package, program),
         # SciPy has no types of its own.
         mypy("--check-untyped-defs", "--disable-error-code=import-untyped",
              *sorted((source / "examples/python").glob("*/*.py"))),
         subprocess.run([sys.executable, "-B", str(program)]).returncode]
refused = is_refused("import pnpbs\n\npnpbs.Placement(3).run()\n", "incompatible type")
sys.exit(0 if (package / "py.typed").exists() and not any(codes) and refused else 1)
