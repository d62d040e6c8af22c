# SPDX-License-Identifier: BSD-3-Clause
"""Formats Fortran source in lines of at most WIDTH characters."""

import textwrap

WIDTH = 100


def statement(text, indent):
    """Returns the lines of a statement, broken at blanks with continuation marks."""
    lines = textwrap.wrap(text, WIDTH - len(" &"), initial_indent=indent,
                          subsequent_indent=indent + "  ", break_long_words=False,
                          break_on_hyphens=False)
    return [line + " &" for line in lines[:-1]] + lines[-1:]


def comment(text, indent, hanging=""):
    """Returns the lines of a documentation comment, indented by `hanging` after the first line."""
    return textwrap.wrap(text, WIDTH, initial_indent=f"{indent}!> ",
                         subsequent_indent=f"{indent}!> {hanging}", break_long_words=False,
                         break_on_hyphens=False)


def commented(code, text, column):
    """Returns the lines of a statement with a trailing comment that begins at a column."""
    room = " " * column
    lines = textwrap.wrap(text, WIDTH, initial_indent=f"{room}!< ",
                          subsequent_indent=f"{room}!< ", break_long_words=False)
    return [code.ljust(column) + lines[0].lstrip()] + lines[1:]


def section(title):
    return f"  ! {'-' * 60} {title} ".ljust(96, "-")
