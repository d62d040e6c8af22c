# SPDX-License-Identifier: BSD-3-Clause
"""Lists what programs linked with the library rely on, one line each: functions with their types
and symbol versions, callbacks, constants, handles, and the keys of the tables. The guaranteed lines
are in abi/pnpbs-<SOVERSION>.abi, and the current library must have all of them. libpnpbs_geo has
such a file as well, without tables.

usage: abi.py --check <file> <header> <library>     fails if the file differs from the library
       abi.py --record <file> <header> <library>    adds new lines to the file
       abi.py --show <header> <library>             prints the lines of the library"""

import ctypes
import pathlib
import re
import subprocess
import sys

import c_header

HEADING = """\
# The symbols that programs linked with {soname} use. docs/releasing.md describes this file.
# Written by: cmake --build <build folder> --target pnpbs-record-abi
"""


# ---------------------------------------------------------------- what the header declares ------

def signature(name, function):
    arguments = ", ".join(argument.type for argument in function.arguments) or "void"
    return f"{function.result} {name}({arguments})"


def of_header(text):
    """Returns the lines of callbacks, constants and handles, and the functions as {name:
    signature}."""
    lines = [f"callback {signature(name, callback)}"
             for name, callback in c_header.callbacks(text).items()]
    # The version may change, so it is left out.
    lines += [f"constant {name} {value}" for name, value in c_header.constants(text).items()
              if not name.startswith("PNPBS_VERSION_")]
    lines += [f"handle {name}" for name in re.findall(
        r"typedef\s+struct\s+\w+\s*\*\s*(pnpbs_\w+)\s*;", c_header.without_comments(text))]
    functions = {name: signature(name, function)
                 for name, function in c_header.functions(text).items()}
    return lines, functions


# ---------------------------------------------------------------- what the library has ----------

def tool(*command):
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def soname(library):
    return re.search(r"SONAME.*\[(.*)\]", tool("readelf", "-d", library))[1]


def symbol_versions(library):
    """Returns {function: version}."""
    symbols = tool("nm", "-D", "--defined-only", "--with-symbol-versions", library)
    return dict(re.findall(r" T (pnpbs_\w+)@@?(\w+)", symbols))


def rows(library, table, columns):
    """Yields the rows of a table of the library. `columns` are types of ctypes."""
    count = ctypes.c_int32()
    if getattr(library, f"pnpbs_{table}_count")(ctypes.byref(count)) != 0:
        raise RuntimeError(f"no count of {table}s")
    for index in range(count.value):
        values = [column() for column in columns]
        if getattr(library, f"pnpbs_{table}_info")(
                ctypes.c_int32(index), *(ctypes.byref(value) for value in values)) != 0:
            raise RuntimeError(f"no {table} {index}")
        yield [value.value.decode() if isinstance(value, ctypes.c_char_p) else value.value
               for value in values]


def of_tables(path):
    """Returns the lines of options, statistics and file formats."""
    library = ctypes.CDLL(path)
    text, number = ctypes.c_char_p, ctypes.c_int32
    lines = []
    for name, kind, _, allowed, _ in rows(library, "option", [text] * 5):
        lines.append(f"option {name} {kind}")
        if kind == "choice":
            lines += [f"choice {name}={choice.strip()}" for choice in allowed.split("|")]
    for name, kind, _ in rows(library, "statistic", [text] * 3):
        lines.append(f"statistic {name} {kind}")
    for name, _, binary, elements in rows(library, "format", [text, text, number, number]):
        lines.append(f"format {name} {'binary' if binary else 'text'}, "
                     f"{'nodes and elements' if elements else 'one kind'}")
    return lines


# ---------------------------------------------------------------- all of it, and comparing ------

def describe(header, name, versions, tables):
    """Returns all lines from the text of the header, a SONAME, {function: version} and the lines of
    tables."""
    lines, functions = of_header(header)
    lines += [f"function {text} {versions.get(function, 'not exported')}"
              for function, text in functions.items()]
    return [f"library {name}"] + sorted(lines) + tables


def describe_files(header, library):
    text, versions = pathlib.Path(header).read_text(), symbol_versions(library)
    tables = of_tables(library) if "pnpbs_option_count" in versions else []
    return describe(text, soname(library), versions, tables)


def recorded(path):
    lines = pathlib.Path(path).read_text().splitlines()
    return [line for line in lines if line and not line.startswith("#")]


def key(line):
    """Returns the kind and the name of the item that a line describes."""
    kind, rest = line.split(" ", 1)
    if kind in ("function", "callback"):
        return kind, re.search(r"(\w+)\(", rest)[1]
    return kind, rest.split(" ")[0]


def compare(before, now):
    """Returns (changes that break programs, new items), as sentences."""
    of_now = {key(line): line for line in now}
    breaks = []
    for line in before:
        if key(line) not in of_now:
            breaks.append(f"removed: {line}")
        elif of_now[key(line)] != line:
            breaks.append(f"changed: {line}\n     to: {of_now[key(line)]}")
    known = {key(line) for line in before}
    return breaks, [f"new: {line}" for line in now if key(line) not in known]


def as_c(lines):
    """Returns C code that compiles with the header only if the compiler reads the declarations in
    the same way."""
    code = ["#include <pnpbs/pnpbs.h>"]
    for number, line in enumerate(lines):
        kind, rest = line.split(" ", 1)
        if kind == "function":
            code.append(rest.rsplit(" ", 1)[0] + ";")
        elif kind == "callback":
            name = key(line)[1]
            code += [f"extern {name} callback_{number};",
                     "extern " + rest.replace(f"{name}(", f"(*callback_{number})(", 1) + ";"]
        elif kind == "constant":
            name, value = rest.split(" ")
            code.append(f"typedef char constant_{number}[{name} == ({value}) ? 1 : -1];")
        elif kind == "handle":
            code.append(f"typedef char handle_{number}[sizeof({rest}) == sizeof(void *) ? 1 : -1];")
    return "\n".join(code) + "\n"


def main():
    if len(sys.argv) == 4 and sys.argv[1] == "--show":
        print("\n".join(describe_files(*sys.argv[2:])))
        return 0
    if len(sys.argv) == 5 and sys.argv[1] == "--check":
        broken, new = compare(recorded(sys.argv[2]), describe_files(*sys.argv[3:]))
        print("\n".join(["broken: " + line for line in broken] + new))
        return 1 if broken or new else 0
    if len(sys.argv) != 5 or sys.argv[1] != "--record":
        print(__doc__, file=sys.stderr)
        return 2
    path, now = pathlib.Path(sys.argv[2]), describe_files(*sys.argv[3:])
    breaks, new = compare(recorded(path), now) if path.exists() else ([], now)
    if breaks:
        print("\n".join(breaks), file=sys.stderr)
        print(f"{path} is a promise: nothing was recorded (see docs/releasing.md)", file=sys.stderr)
        return 1
    path.write_text(HEADING.format(soname=now[0].split(" ")[1]) + "\n".join(now) + "\n")
    print(f"{path}: {len(now)} lines, {len(new)} of them new")
    return 0


if __name__ == "__main__":
    sys.exit(main())
