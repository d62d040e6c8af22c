# SPDX-License-Identifier: BSD-3-Clause
"""The constants of a header as Fortran parameters."""

import re

import c_header
import fortran_lines
from declarations import description

INTEGER = "integer(c_int32_t), parameter :: "
STATUS = "integer(c_int), parameter :: "
VERSION = "The version this module was written for; pnpbs_version returns the library's."


def status_lines(text):
    """Returns the lines of the status codes, each followed by its meaning."""
    found = re.findall(r'\bX\(\s*(PNPBS_\w+),\s*(-?\d+),\s*"([^"]*)"\s*\)', text)
    code = [f"  {STATUS}{name} = {value}" for name, value, _ in found]
    column = max(map(len, code), default=0) + 2
    return [line for one, (_, _, meaning) in zip(code, found)
            for line in fortran_lines.commented(one, meaning, column)]


def defined(text):
    """Returns {name: value} of the macros that are integers."""
    return {name: value for name, value in c_header.constants(text).items()
            if re.search(rf"^#define\s+{name}\b", text, re.M)}


def parameters(comment, constants):
    return [*fortran_lines.comment(comment, "  "),
            *(f"  {INTEGER}{name} = {value}" for name, value in constants.items())]


def constant_lines(header):
    """Returns the lines of all constants: statuses, constants with a comment in the header, and the
    version."""
    groups = [status_lines(header.text)]
    rest = defined(header.text)
    for entry in header.entries:
        here = defined(entry.declaration)
        if here:
            groups.append(parameters(description(entry), here))
            rest = {name: value for name, value in rest.items() if name not in here}
    version = {name: value for name, value in rest.items() if "_VERSION_" in name}
    if rest.keys() - version.keys():
        raise ValueError(f"without a comment: {', '.join(sorted(rest.keys() - version.keys()))}")
    if version:
        groups.append(parameters(VERSION, version))
    lines = []
    for group in filter(None, groups):
        lines += ([""] if lines else []) + group
    return lines
