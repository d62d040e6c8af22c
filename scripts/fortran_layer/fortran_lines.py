# SPDX-License-Identifier: BSD-3-Clause
"""Lines of Fortran that are not longer than WIDTH."""

import textwrap

WIDTH = 100


def statement(text, indent):
    """The lines of a statement, continued by & where there is a blank."""
    lines = textwrap.wrap(text, WIDTH - len(" &"), initial_indent=indent,
                          subsequent_indent=indent + "  ", break_long_words=False,
                          break_on_hyphens=False)
    return [line + " &" for line in lines[:-1]] + lines[-1:]


def comment(text, indent, hanging=""):
    """The lines of a comment for the documentation, deeper by `hanging` after the first."""
    return textwrap.wrap(text, WIDTH, initial_indent=f"{indent}!> ",
                         subsequent_indent=f"{indent}!> {hanging}", break_long_words=False,
                         break_on_hyphens=False)


def commented(code, text, column):
    """The lines of a statement with a comment behind it, which begins at a column."""
    room = " " * column
    lines = textwrap.wrap(text, WIDTH, initial_indent=f"{room}!< ",
                          subsequent_indent=f"{room}!< ", break_long_words=False)
    return [code.ljust(column) + lines[0].lstrip()] + lines[1:]


def section(title):
    return f"  ! {'-' * 60} {title} ".ljust(96, "-")
