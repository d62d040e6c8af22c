#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The numbers of the method on the pages are those of the code. Behind such a number a page names the
constant, or a product or difference of some, in a comment that readers do not see:
    nearer than 1.3 <!-- kTouch --> desired distances
usage: check_constants.py <folder> [--self-test]"""

import math
import pathlib
import re
import sys
import tempfile

import checks

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "scripts" / "reference"))
import method_constants

WORDS = {"a fifth": 0.2, "a quarter": 0.25, "half": 0.5, "one": 1, "two": 2, "three": 3, "four": 4,
         "five": 5, "six": 6, "eight": 8}
NUMBER = rf"(?P<number>\d+(?:\.\d+)?|\b(?:{'|'.join(WORDS)})\b)"
MARK = re.compile(r"<!-- (?P<formula>[^>]*\bk[A-Z][^>]*?) -->")
MARKED = re.compile(NUMBER + r"\s+" + MARK.pattern, re.I)
TERM = re.compile(r"k\w+|\d+(?:\.\d+)?")


def value_of(formula, known):
    """Of names and numbers with * and - between them."""
    product = [math.prod(known[term] if term.startswith("k") else float(term)
                         for term in TERM.findall(part)) for part in formula.split(" - ")]
    return product[0] - sum(product[1:])


def faults(root):
    """What is wrong, a line each."""
    known, used = method_constants.named_values(root), 0
    for page in sorted((root / "docs").rglob("*.md")):
        text, name = page.read_text(), page.relative_to(root)
        marked = {match.start("formula"): match for match in MARKED.finditer(text)}
        for mark in MARK.finditer(text):
            used += 1
            formula, match = mark["formula"], marked.get(mark.start("formula"))
            if not match:
                yield f"{name}: no number before {formula}"
                continue
            unknown = [term for term in TERM.findall(formula) if term[0] == "k" and term not in known]
            if unknown:
                yield f"{name}: no constant {unknown[0]} in {method_constants.FILE}"
                continue
            number = match["number"].lower()
            told = WORDS[number] if number in WORDS else float(number)
            if not math.isclose(told, value_of(formula, known), rel_tol=1e-9):
                yield f"{name}: {number} for {formula}, which is {value_of(formula, known):.6g}"
    if not used:
        yield f"{root}/docs: no page names a constant"


def self_test():
    with tempfile.TemporaryDirectory() as name:
        root = pathlib.Path(name)
        table = root / method_constants.FILE
        table.parent.mkdir(parents=True)
        table.write_text("namespace pnpbs::method {\n// ---- One ----\n\n"
                         "// How far. [d] Chosen.\ninline constexpr double kFar = 1.5;\n"
                         "// How\n// many. [rings] Paper.\ninline constexpr int kMany = 2;\n")
        (root / "docs").mkdir()
        page = root / "docs/page.md"
        for text, expected in (
                ("as far as 1.5 <!-- kFar --> d and Two\n<!-- kMany --> rings, 3\n<!-- kMany * kFar -->, "
                 "0.5 <!-- kMany - kFar --> or 3.0 <!-- 2 * kFar --> <!-- no constant -->", []),
                ("1.6 <!-- kFar -->", ["docs/page.md: 1.6 for kFar, which is 1.5"]),
                ("1.5 <!-- kNear -->", [f"docs/page.md: no constant kNear in {method_constants.FILE}"]),
                ("some <!-- kFar -->", ["docs/page.md: no number before kFar"]),
                ("1.5", [f"{root}/docs: no page names a constant"])):
            page.write_text(text)
            if list(faults(root)) != expected:
                sys.exit(f"the check is wrong: it finds {list(faults(root))} in {text}")
            if main([name]) != bool(expected):
                sys.exit(f"the check ends with {main([name])} where it finds {expected}")
        table.write_text(table.read_text().replace("[d] ", ""))
        try:
            method_constants.constants(root)
        except ValueError:
            return
        sys.exit("the check is wrong: a constant without a unit passes")


def main(arguments):
    return checks.main(arguments, faults, self_test)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
