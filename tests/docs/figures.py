# SPDX-License-Identifier: BSD-3-Clause
"""Compares what commands print with what a page says that they print. Words must be the same. Figures
that follow from the method may differ a little, or each improvement would break every page; lines that
are the same on the page must still be printed alike, since they tell that results are the same."""

import re

SHARE = 0.05  # by which a figure may differ
MAX_EXACT = 50  # counts up to this are exact
HASH = r"(?<!\w)[0-9a-f]{16}(?!\w)"
NUMBER = r"(?<![\w.])-?\d+(?:\.\d+)?(?:e[-+]?\d+)?(?!\w|\.\d)"
FIGURE = re.compile(f"({HASH}|{NUMBER})")


def figures_agree(wanted, found):
    hashes = [bool(re.fullmatch(HASH, one)) for one in (wanted, found)]
    if wanted == found or any(hashes):
        return wanted == found or all(hashes)
    whole = wanted.lstrip("-").isdigit(), found.lstrip("-").isdigit()
    if whole[0] != whole[1] or (whole[0] and abs(int(wanted)) <= MAX_EXACT):
        return False
    return abs(float(found) - float(wanted)) <= SHARE * abs(float(wanted))


def lines_agree(wanted, found):
    # Words and figures by turns.
    one, other = FIGURE.split(wanted), FIGURE.split(found)
    return one[::2] == other[::2] and all(map(figures_agree, one[1::2], other[1::2]))


class Outputs:
    """Of one page."""

    def __init__(self):
        self.printed = {}  # for lines of the page

    def differ(self, expected, printed):
        """What is wrong with what was printed, or None."""
        wanted, found = expected.splitlines(), printed.splitlines()
        if len(wanted) != len(found) or not all(map(lines_agree, wanted, found)):
            return f"expected\n{expected}printed\n{printed}"
        for one, other in zip(wanted, found):
            first = self.printed.setdefault(one, other)
            if first != other:
                return f"the same line on the page, '{one}', is printed as\n{first}\n{other}\n"
        return None
