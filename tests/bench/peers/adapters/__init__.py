# SPDX-License-Identifier: BSD-3-Clause
"""One file for each tool. Each has a function tools() that lists its Tool objects, one for each
setting compared."""
