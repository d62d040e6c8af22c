# SPDX-License-Identifier: BSD-3-Clause
"""Adapters of the compared tools, one file for each. Each file has a function tools() that lists
its Tool objects, one for each setting compared."""
