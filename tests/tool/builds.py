# SPDX-License-Identifier: BSD-3-Clause
"""Tests of parts that only some builds have."""


def exists_if(condition):
    """Decorator of a test or of a class of tests. It removes them from builds without the part that they
    test. Such tests are not skipped: a skip says that the machine lacks something."""
    return lambda test: test if condition else None
