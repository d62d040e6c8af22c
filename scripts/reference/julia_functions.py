# SPDX-License-Identifier: BSD-3-Clause
"""Extracts the functions that users of PNPBS.jl can call, from its docstrings, and the C functions
that each of them reaches, as plain data."""

import re
from typing import NamedTuple

# Every call passes through these. The C functions that they call do not belong to the caller.
CHECKS = {"check", "check_without_context", "check_geo", "live"}
# C functions that users reach in other ways than by calling a function.
OTHERWISE = {"pnpbs_last_error": "PNPBSError", "pnpbs_geo_last_error": "PNPBSError",
             "pnpbs_mesh_get_connectivity_int32": "DistributedMesh"}

# C functions that a function uses internally without corresponding to them.
IN_PASSING = {"write_mesh": {"pnpbs_mesh_create", "pnpbs_mesh_destroy"}}


class Docstring(NamedTuple):
    names: tuple  # the documented names: ("set_spacing!",)
    signatures: tuple
    text: str
    file: str

    def first_object(self):
        """Returns the first argument, such as "placement"."""
        found = re.search(r"\((\w+)", self.signatures[0])
        return found[1] if found else ""


def signatures_of(lines):
    """Joins indented lines with the line before."""
    return tuple(re.split(r"\n(?! )", "\n".join(lines)))


def docstrings(text, file):
    found = []
    for body in re.findall(r'^"""\n(.*?)^"""$', text, re.S | re.M):
        head, _, rest = body.partition("\n\n")
        lines = head.rstrip().splitlines()
        if not all(line.startswith("    ") for line in lines):
            continue  # the docstring of a module
        signatures = signatures_of(line[4:] for line in lines)
        names = dict.fromkeys(re.match(r"[\w.]+!?", line)[0] for line in signatures)
        found.append(Docstring(tuple(names), signatures, rest.strip(), file))
    return found


def definitions(text):
    """Returns [(function's name, its source)] of the definitions at the left margin."""
    text = re.sub(r'^"""\n.*?^"""$', "", text, flags=re.S | re.M)
    text = re.sub(r"#.*$", "", text, flags=re.M)
    found = []
    for match in re.finditer(r"^(function )?(?:Base\.)?(\w+!?)\(", text, re.M):
        rest = text[match.start():]
        stop = re.search(r"^end\b" if match[1] else r"\n(?=\S)", rest[1:], re.M)
        found.append((match[2], rest[:stop.end() + 1] if stop else rest))
    return found


class Package:
    def __init__(self, folder):
        texts = {path.name: path.read_text() for path in sorted((folder / "src").glob("*.jl"))}
        raw = texts.pop("LibPNPBS.jl") + texts.pop("LibPNPBSGeo.jl")
        self.raw = set(re.findall(r"^(pnpbs_\w+)\(", raw, re.M))
        texts.pop("library.jl")  # the raw layer
        self.docstrings = [one for file, text in texts.items() for one in docstrings(text, file)]
        self.sources = {}
        for text in texts.values():
            for name, source in definitions(text):
                self.sources[name] = self.sources.get(name, "") + source
        self.documented = {name: one for one in self.docstrings for name in one.names}
        self.reached_by = {name: self.reached(name) - IN_PASSING.get(name, set())
                           for name in self.documented}

    def reached(self, name, seen=None):
        """Returns the C functions that a function calls, directly or through functions without a
        docstring."""
        seen = seen if seen is not None else {name}
        source = self.sources.get(name, "")
        found = set(re.findall(r"LibPNPBS(?:Geo)?\.(pnpbs_\w+)", source))
        for other in set(re.findall(r"\b([a-z]\w*!?)(?=[(,. ])", source)) - seen - CHECKS:
            if other in self.sources and other not in self.documented:
                seen.add(other)
                found |= self.reached(other, seen)
        return found

    def of_c_function(self, c_name):
        """Returns the docstrings of the functions that correspond to a C function."""
        if c_name in OTHERWISE:
            return [self.documented[OTHERWISE[c_name]]]
        return [one for one in self.docstrings
                if any(c_name in self.reached_by[name] for name in one.names)]
