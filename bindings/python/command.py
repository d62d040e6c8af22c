#!python
# SPDX-License-Identifier: BSD-3-Clause
"""Starts the command `pnpbs` that is part of the package in this environment, without importing the
package."""
import importlib.util
import os
import sys

package = importlib.util.find_spec("pnpbs")
if package is None or package.origin is None:
    sys.exit("pnpbs: this Python has no package pnpbs; install it again")
command = os.path.join(os.path.dirname(package.origin), "bin", "pnpbs")
os.execv(command, ["pnpbs", *sys.argv[1:]])
