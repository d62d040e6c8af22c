# SPDX-License-Identifier: BSD-3-Clause
"""Reads the table of the constants of the method, src/method/constants.hpp."""

import re
from typing import NamedTuple

FILE = "src/method/constants.hpp"
SECTION = re.compile(r"// ---- (.+) ----")
COMMENT = re.compile(r"// (.*)")
CONSTANT = re.compile(r"inline constexpr (?:double|int) (k\w+) = ([\d.]+(?: / [\d.]+)?);")
PARTS = re.compile(r"(.+\.) \[([^]]+)\] (.+)\.")


class Constant(NamedTuple):
    section: str
    name: str
    text: str  # the value as text
    unit: str
    meaning: str
    source: str

    @property
    def value(self):
        over, _, under = self.text.partition(" / ")
        return float(over) / float(under or 1)


def constants(root):
    """Returns all constants in order. A constant without an explanation is an error."""
    found, section, comment = [], None, []
    lines = (root / FILE).read_text().partition("namespace pnpbs::method {")[2].splitlines()
    for line in lines:
        if match := SECTION.fullmatch(line):
            section = match[1]
        elif match := COMMENT.fullmatch(line):
            comment.append(match[1])
            continue
        elif "constexpr" in line:
            constant, parts = CONSTANT.fullmatch(line), PARTS.fullmatch(" ".join(comment))
            if not constant or not parts or not section:
                raise ValueError(f"{FILE}: expected a section, a comment \"meaning. [unit] source.\" "
                                 f"and a number at: {line}")
            found.append(Constant(section, constant[1], constant[2], parts[2], parts[1][:-1], parts[3]))
        comment = []
    if not found:
        raise ValueError(f"{FILE}: no constants")
    return found


def named_values(root):
    return {one.name: one.value for one in constants(root)}
