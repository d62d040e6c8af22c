# SPDX-License-Identifier: BSD-3-Clause
"""Decorator of tests of features that only some builds have."""


def exists_if(condition):
    """Returns a decorator of a test or of a class of tests, which removes it from builds that lack
    the feature. Such tests are not skipped, since a skip means that the machine lacks something."""
    return lambda test: test if condition else None
