# SPDX-License-Identifier: BSD-3-Clause
"""The tables of options, statistics and formats, queried from the built library."""

import ctypes


class Library:
    def __init__(self, path):
        self.library = ctypes.CDLL(str(path))

    def rows(self, table, texts, flags=0):
        """Yields the rows of pnpbs_<table>_info: its strings, then its integers."""
        count = ctypes.c_int32()
        self.call(f"pnpbs_{table}_count", ctypes.byref(count))
        for index in range(count.value):
            strings = [ctypes.c_char_p() for _ in range(texts)]
            integers = [ctypes.c_int32() for _ in range(flags)]
            self.call(f"pnpbs_{table}_info", ctypes.c_int32(index),
                      *map(ctypes.byref, strings + integers))
            yield [one.value.decode() for one in strings] + [one.value for one in integers]

    def call(self, name, *arguments):
        status = getattr(self.library, name)(*arguments)
        if status != 0:
            raise RuntimeError(f"{name} returned {status}")

    def options(self):
        """Returns rows of [name, type, default, range, help]."""
        return list(self.rows("option", 5))

    def statistics(self):
        """Returns rows of [name, type, help]."""
        return list(self.rows("statistic", 3))

    def formats(self):
        """Returns rows of [name, help, binary, elements]."""
        return list(self.rows("format", 2, 2))
