# SPDX-License-Identifier: BSD-3-Clause
"""Tests --fragment with a few solids in random positions: boxes, balls and tori."""

import unittest

from random_solids import SolidsTest


class RandomSolids(SolidsTest):
    def test_crossing_solids_become_regions(self):
        # Nodes move along the surfaces between regions where elements would have less than 3.
        self.assertGreater(self.check_solids(5, 3, 0.07), 5)


if __name__ == "__main__":
    unittest.main()
