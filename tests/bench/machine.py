# SPDX-License-Identifier: BSD-3-Clause
"""Describes the machine of the measurements."""
import os
import platform
from datetime import date
from importlib.metadata import version
from pathlib import Path


def describe():
    return {"date": date.today().isoformat(), "processor": processor(), "cores": os.cpu_count(),
            "memory_gib": memory_gib(), "system": system(), "load": load(),
            "python": platform.python_version(), "numpy": version("numpy"),
            "scipy": version("scipy")}


def processor():
    try:
        lines = Path("/proc/cpuinfo").read_text().splitlines()
    except OSError:
        return platform.processor() or platform.machine()
    told = {}
    for line in lines:
        key, _, value = line.partition(":")
        told.setdefault(key.strip(), value.strip())
    name = told.get("model name", platform.machine())
    if "cpu family" in told:
        name += f" (family {told['cpu family']}, model {told.get('model', '?')})"
    return name


def memory_gib():
    try:
        return round(os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES") / 2 ** 30, 1)
    except (ValueError, OSError):
        return None


def system():
    release = ".".join(platform.release().split(".")[:2])
    try:
        return f"{platform.freedesktop_os_release()['PRETTY_NAME']}, Linux {release}"
    except (AttributeError, OSError):  # not from Python 3.10 on, or not Linux
        return platform.platform()


def load():
    """Returns the load of the machine in the last minute. A benchmark needs less than 1."""
    try:
        return round(os.getloadavg()[0], 2)
    except OSError:
        return None
