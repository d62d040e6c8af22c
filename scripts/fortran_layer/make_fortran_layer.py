#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes the interface bodies of the Fortran layer, bindings/fortran/pnpbs_c.f90 and
pnpbs_geo_c.f90, from the C headers: constants, callbacks and functions with their arguments.

usage: make_fortran_layer.py [--check]

--check writes nothing and fails if an existing file differs from the generated one.
"""

import difflib
import pathlib
import sys
from typing import NamedTuple

ROOT = pathlib.Path(__file__).resolve().parents[2]
# The parser of the headers and of their comments.
sys.path[1:1] = [str(ROOT / "scripts" / "reference"), str(ROOT / "tests" / "linkage")]
import fortran_lines
from constants import constant_lines
from declarations import Header
from interface_bodies import callback_bodies, function_bodies

COMMAND = "cmake --build <folder> --target pnpbs-fortran-layer"


class Module(NamedTuple):
    name: str
    header: str
    included: str  # text of the header with further types, or ""
    purpose: str

    @property
    def header_path(self):
        return f"include/{self.header}"

    @property
    def path(self):
        return f"bindings/fortran/{self.name}.f90"


MODULES = (
    Module("pnpbs_c", "pnpbs/pnpbs.h", "", """\
!> The C interface of PNPBS (pnpbs/pnpbs.h), function by function, for the module pnpbs. Use that
!> module. tests/linkage/check_signatures.py compares every body below with the header, argument by
!> argument, by a reader of its own.
!>
!> The C function pnpbs_<name> is c_<name>, and its arguments have their names in C. Arrays that may
!> be NULL in C, and untyped addresses, are type(c_ptr), value, followed by the C type in a comment:
!> Fortran 2003 has no optional arguments in procedures with bind(C).
"""),
    Module("pnpbs_geo_c", "pnpbs/pnpbs_geo.h", "pnpbs/pnpbs.h", """\
!> The C interface of libpnpbs_geo (pnpbs/pnpbs_geo.h), function by function, for the module
!> pnpbs_geo. Use that module. Bodies have the form of those in pnpbs_c.f90.
"""),
)

ABOUT_CALLBACKS = """\
  ! Write callbacks as module procedures with bind(C): internal procedures need an executable stack,
  ! which many systems forbid. Never stop or jump out of one: return a nonzero value. Pass data
  ! through user, the c_loc of a target that outlives the calls. How often a callback is called,
  ! with which points and on which rank may differ from run to run.
"""


def opening(module):
    return f"""\
! SPDX-License-Identifier: BSD-3-Clause
! Made from {module.header_path} by scripts/fortran_layer: change that, and write this by
!   {COMMAND}
{module.purpose}module {module.name}
  use, intrinsic :: iso_c_binding
  implicit none
  public
"""


def layer(module, text, included=""):
    """Returns the file of a module, from the text of its header and of the header that this
    includes."""
    header = Header(text, included)
    constants, callbacks = constant_lines(header), callback_bodies(header)
    made = opening(module)
    if constants:
        made += f"\n{fortran_lines.section('status and constants')}\n\n"
        made += "\n".join(constants) + "\n"
    if callbacks:
        made += f"\n{fortran_lines.section('callbacks')}\n{ABOUT_CALLBACKS}\n"
        made += "  abstract interface\n" + "\n".join(callbacks) + "\n  end interface\n"
    made += f"\n{fortran_lines.section('functions')}\n\n"
    made += "  interface\n" + "\n".join(function_bodies(header)) + "\n  end interface\n"
    return made + f"end module {module.name}\n"


def layer_of(root, module):
    included = (root / "include" / module.included).read_text() if module.included else ""
    return layer(module, (root / module.header_path).read_text(), included)


def differences(name, there, made):
    """Returns the lines of a diff between an existing file and the generated one."""
    return list(difflib.unified_diff(there.splitlines(), made.splitlines(), f"{name} as it is",
                                     f"{name} as it should be", lineterm="", n=1))


def main():
    try:
        made = {ROOT / module.path: layer_of(ROOT, module) for module in MODULES}
    except ValueError as error:
        sys.exit(str(error))
    if "--check" in sys.argv:
        found = [line for path, text in made.items()
                 for line in differences(path.name, path.read_text(), text)]
        print("\n".join(found) or f"{len(made)} files are as the headers have them")
        sys.exit(f"write them anew: {COMMAND}" if found else 0)
    for path, text in made.items():
        path.write_text(text)


if __name__ == "__main__":
    main()
