# SPDX-License-Identifier: BSD-3-Clause
"""Tests --fragment with more solids in random positions than test_random_solids.py."""

import unittest

from random_solids import SolidsTest


class ManyRandomSolids(SolidsTest):
    def test_eight_solids(self):
        self.assertGreater(self.check_solids(8, 1, 0.06), 2)


if __name__ == "__main__":
    unittest.main()
