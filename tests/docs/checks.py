# SPDX-License-Identifier: BSD-3-Clause
"""What checks of the sources and pages have in common: <folder> [--self-test]."""

import contextlib
import io
import pathlib


def main(arguments, faults, self_test):
    """Prints what faults(folder) finds, a line each; the exit status. The check itself is tested first
    if that is asked for."""
    if "--self-test" in arguments:
        with contextlib.redirect_stdout(io.StringIO()):
            self_test()
    found = list(faults(pathlib.Path(arguments[0])))
    for line in found:
        print(line)
    return 1 if found else 0
