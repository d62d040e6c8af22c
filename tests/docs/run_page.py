#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Does what a page tells its reader to do, word for word, with an installed copy of PNPBS.

  ```c place.c      a name behind the language: the block is written to that file
  ```sh             with a ```text block right behind it: its commands are run, in the order of the
  ```text           page, all in one folder, and print this, figures nearly (figures.py)
  ```sh             alone: for the reader, not run

Every named file must be used by a command that is run, and no program may be without a name. The
folder has `examples`, as a clone has. Compilers are called with warnings as errors.

usage: run_page.py <prefix> <page> [--update]
--update, or PNPBS_UPDATE_PAGES in the environment, writes what is printed into the page.
"""

import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

from figures import Outputs
from pages import blocks

ROOT = pathlib.Path(__file__).resolve().parents[2]
STRICT_C = "-std=c99 -Wall -Wextra -pedantic -Werror"
STRICT_FORTRAN = "-fimplicit-none -Wall -Werror -ffpe-trap=invalid,zero,overflow"
TOOLS = {
    "cc": STRICT_C,
    "mpicc": STRICT_C,
    "gfortran": "-std=f2003 " + STRICT_FORTRAN,
    "mpifort": STRICT_FORTRAN,  # MPI's own module and mpif.h are not Fortran 2003
    "julia": "",  # as its users start it: with other options, d may differ in the last bit
    "python3": "-B",
}
NOT_ALL_TESTED = 77  # which ctest reports as skipped
PROGRAMS = {
    "c": r"\bint main\(",
    "fortran": r"^\s*end program",
    "julia": r"",
    "python": r"^import pnpbs",
}


def only(paths):
    found = list(paths)
    if len(found) != 1:
        sys.exit(f"expected one, found {found}")
    return found[0]


def compiler(name):
    return os.environ.get("PNPBS_TEST_" + name.upper()) or shutil.which(name)


def put_tools(folder):
    """The compilers under their names, with the flags above."""
    folder.mkdir()
    for name, flags in TOOLS.items():
        path = compiler(name)
        if path:
            script = folder / name
            script.write_text(f'#!/bin/sh\nexec "{path}" {flags} "$@"\n')
            script.chmod(0o755)


def environment(prefix, work):
    packages = only(prefix.rglob("pnpbs.pc")).parent
    # Programs must find the library by the settings of the page alone.
    inherited = {name: value for name, value in os.environ.items()
                 if name not in ("LD_LIBRARY_PATH", "LD_RUN_PATH", "PNPBS_LIBRARY")}
    return dict(
        inherited,
        PATH=f"{work / 'tools'}:{prefix / 'bin'}:{os.environ['PATH']}",
        PKG_CONFIG_PATH=str(packages),
        JULIA_LOAD_PATH=f"@stdlib:{prefix}/share/pnpbs/julia:"
                        f"{ROOT}/bindings/julia/PNPBS.jl/test/stand_in",
        JULIA_DEPOT_PATH=str(work / "depot"), PYTHONPATH=f"{prefix}/share/pnpbs/python", OMP_NUM_THREADS="1",
        # MPI's compilers call these, not the tools above, which would add flags twice.
        OMPI_CC=compiler("cc") or "cc", OMPI_FC=compiler("gfortran") or "gfortran",
        # More ranks than cores, and commands on the page that need not say so.
        OMPI_MCA_rmaps_base_oversubscribe="1", OMPI_MCA_hwloc_base_binding_policy="none",
        OMPI_MCA_mpi_yield_when_idle="1")


def missing_tool(commands, path):
    for name in re.findall(r"(?:^|[|&;]\s*|-np \d+ )([a-z]\w*)", commands, re.M):
        if name in TOOLS and not shutil.which(name, path=path):
            return name
    return None


def run(block, expected, outputs, folder, variables):
    """What is wrong with what the commands print, or None; and what they print."""
    done = subprocess.run(["sh", "-e", "-c", block.text], cwd=folder, env=variables, text=True,
                          stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                          stderr=subprocess.PIPE)
    if done.returncode != 0:
        return f"exit code {done.returncode}\n{done.stdout}{done.stderr}", expected
    difference = outputs.differ(expected, done.stdout)
    return difference and difference + done.stderr, done.stdout


def with_output(page, block, expected, printed):
    """The page, the text that follows a block of commands replaced."""
    lines = page.splitlines(keepends=True)
    before = "".join(lines[:block.line - 1])
    rest = page[len(before):]
    shown = f"```text\n{expected}```\n"
    return before + rest.replace(shown, f"```text\n{printed}```\n", 1)


def unused(page, commands):
    """Programs and files that no command would meet, a line each."""
    for block in page:
        program = PROGRAMS.get(block.language)
        if block.file and not re.search(rf"\b{re.escape(block.file)}\b", commands):
            yield f"line {block.line}: no command that is run uses {block.file}"
        elif not block.file and program is not None and re.search(program, block.text, re.M):
            yield f"line {block.line}: a program without the name of a file"


def run_page(prefix, page, update=None):
    """Returns lines that say what is wrong with a page, or None if nothing is, but a block could not be
    run because a tool is missing. update(page) receives the page as it should be."""
    found = blocks(page)
    pairs = [(one, other.text) for one, other in zip(found, found[1:])
             if one.language == "sh" and other.language == "text" and other.follows]
    if not pairs:
        return ["nothing on this page is run"]
    wrong = list(unused(found, "".join(one.text for one, _ in pairs)))
    outputs, ran, is_complete = Outputs(), [], True
    with tempfile.TemporaryDirectory() as name:
        work = pathlib.Path(name)
        put_tools(work / "tools")
        variables = environment(prefix, work)
        folder = work / "page"
        folder.mkdir()
        (folder / "examples").symlink_to(ROOT / "examples")
        for block in found:
            if block.file:
                (folder / block.file).write_text(block.text)
        for block, expected in pairs:
            tool = missing_tool(block.text, variables["PATH"])
            if tool:
                print(f"line {block.line}: skipped, as {tool} was not found")
                is_complete = False
                continue
            difference, printed = run(block, expected, outputs, folder, variables)
            ran.append((block, expected, printed))
            print(f"line {block.line}: " + ("differs" if difference else "as the page has it"))
            if difference:
                wrong.append(f"line {block.line}: {difference}")
    if update:
        # From the last one up, so that the lines before stay where they are.
        for block, expected, printed in reversed(ran):
            page = with_output(page, block, expected, printed)
        update(page)
    return wrong if wrong or is_complete else None


def main():
    prefix, page = (pathlib.Path(one).resolve() for one in sys.argv[1:3])
    is_updating = "--update" in sys.argv or os.environ.get("PNPBS_UPDATE_PAGES")
    update = page.write_text if is_updating else None
    wrong = run_page(prefix, page.read_text(), update)
    if wrong is None:
        sys.exit(NOT_ALL_TESTED)
    print("\n".join(wrong))
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main()
