# SPDX-License-Identifier: BSD-3-Clause
"""Tests of parts that only some builds have."""


def exists_if(condition):
    """Returns a decorator of a test or a class of tests that removes it if the build lacks the part
    under test. Such tests are not skipped, as a skip means that the machine lacks something."""
    return lambda test: test if condition else None
