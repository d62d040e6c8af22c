#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes docs/reference: every function of the C header with its comment, and its counterparts in
the Fortran module, the Julia package and the Python package, read from their sources; the tables
queried from the built library; and the constants of the method.

usage: make_reference.py <libpnpbs.so> [--check]

--check writes nothing and fails if the existing pages differ from the generated ones.
"""

import difflib
import pathlib
import re
import sys

import fortran_procedures
import header_comments
import julia_functions
import method_constants
import python_functions
from language_parts import fortran_interface, fortran_part, julia_part, python_part
from library_tables import Library
from markdown import names_cell, table, wrapped

ROOT = pathlib.Path(__file__).resolve().parents[2]
NOTE = "<!-- Made by scripts/reference/make_reference.py from the sources: change those. -->\n"
# Functions of C, and those that have further arguments, which are optional in the languages.
EXTENDED = {"pnpbs_geo_read": "pnpbs_geo_read_regions",
            **{f"pnpbs_domain_add_{body}": f"pnpbs_domain_add_{body}_surface"
               for body in ("box", "ball", "cylinder")}}


class Sources:
    """All sources of the pages."""

    def __init__(self, root):
        header = (root / "include/pnpbs/pnpbs.h").read_text()
        mpi = (root / "include/pnpbs/pnpbs_mpi.h").read_text()
        self.opening = header_comments.opening(header)
        self.statuses = re.findall(r'X\((PNPBS_\w+), (-?\d+), "([^"]*)"\)', header)
        self.sections = list(header_comments.sections(header))
        self.sections.append(header_comments.Section("MPI", header_comments.entries_of(mpi)))
        geo = (root / "include/pnpbs/pnpbs_geo.h").read_text()
        shapes = header_comments.Section("shapes", header_comments.entries_of(geo))
        self.sections.append(shapes)
        self.functions = {name: entry for section in self.sections for entry in section.entries
                          for name in entry.functions}
        self.fortran = []
        for module, text in (("pnpbs", header), ("pnpbs_geo", geo)):
            exported = frozenset(header_comments.c_header.functions(text))
            self.fortran += fortran_procedures.procedures(
                (root / f"bindings/fortran/{module}.f90").read_text(), exported)
        self.interfaces = (root / "bindings/fortran/pnpbs_c.f90").read_text()
        self.julia = julia_functions.Package(root / "bindings/julia/PNPBS.jl")
        called = frozenset(c for name in self.functions for c in self.underlying(name))
        self.python = python_functions.Package(root / "bindings/python/pnpbs", called)

    def underlying(self, name):
        """Returns the C functions that the languages call: the function itself, or those that an
        inline function of the header calls, or the one that has more arguments."""
        if name in EXTENDED:
            return [EXTENDED[name]]
        entry = self.functions[name]
        if not entry.declaration.startswith("static inline"):
            return [name]
        return sorted(set(re.findall(r"return (pnpbs_\w+)\(", entry.declaration)))

    def fortran_of(self, name):
        return [one for c in self.underlying(name)
                for one in fortran_procedures.of_c_function(c, self.fortran)]

    def julia_of(self, name):
        return [one for c in self.underlying(name) for one in self.julia.of_c_function(c)]

    def python_of(self, name):
        return list(dict.fromkeys(one for c in self.underlying(name)
                                  for one in self.python.of_c_function(c)))

    def gaps(self):
        """Yields what the languages lack, one line each."""
        for name, entry in self.functions.items():
            if not entry.comment.reach:
                yield f"{name}: the comment does not say whether it is collective or local"
            if not self.fortran_of(name):
                yield f"{name}: no procedure of the Fortran module calls it"
            if not all(c in self.julia.raw for c in self.underlying(name)):
                yield f"{name}: not in the Julia package"
            if not self.python_of(name):
                yield f"{name}: nothing in the Python package calls it"


# ---------------------------------------------------------------- links --------------------------
def page_name(section):
    return section.title.lower().replace(" ", "_") + ".md"


def entry_names(entry):
    """Returns the names that an entry declares: functions, types or constants."""
    if entry.functions:
        return list(entry.functions)
    if "PNPBS_STATUS_LIST" in entry.declaration:
        return ["pnpbs_status"]
    declared = r"^(?:typedef .*?\*(pnpbs_\w+)\)?[;(]|#define (PNPBS_\w+))"
    return [one or other for one, other in re.findall(declared, entry.declaration, re.M)]


def anchor(name):
    return name.lower()


class Links:
    """Maps names to the sections that describe them."""

    def __init__(self, sources):
        self.c, self.julia, self.python = {}, {}, {}
        reached = {}  # C functions by docstring of Julia
        for section in sources.sections:
            for entry in section.entries:
                for name in entry_names(entry):
                    self.c[name] = f"{page_name(section)}#{anchor(name)}"
                for name in entry.functions:
                    for one in sources.julia_of(name):
                        reached.setdefault(one, []).append(name)
                    for one in sources.python_of(name):
                        self.python.setdefault(one, self.c[name])
        for one in sources.julia.docstrings:
            self.julia[one] = self.place_of(one, reached.get(one, []))
        self.julia_names = {name: place for one, place in self.julia.items() for name in one.names}

    def place_of(self, docstring, names):
        """Returns the section of the docstring's first argument, or else the first one."""
        own = [name for name in names if name.startswith(f"pnpbs_{docstring.first_object()}_")]
        return self.c[(own or names)[0]] if names else "README.md#beyond-c"

    def linked(self, text):
        """Returns a text of the header with its names as links; text in backquotes is unchanged."""
        def link(match):
            name = match[0]
            return f"[`{name}`]({self.c[name]})" if name in self.c else f"`{name}`"
        parts = re.split(r"(`[^`]*`)", text)
        parts[::2] = [re.sub(r"\b(?:pnpbs_\w*[a-z0-9]|PNPBS_[A-Z0-9_]*[A-Z0-9])\b", link, part)
                      for part in parts[::2]]
        return "".join(parts)

    def resolved(self, docstring):
        """Returns a docstring with Julia's cross-references as links."""
        def link(match):
            place = self.julia_names.get(match[1])
            return f"[`{match[1]}`]({place})" if place else f"`{match[1]}`"
        return re.sub(r"\[`([\w!]+)`\]\(@ref\)", link, docstring)


# ---------------------------------------------------------------- pieces of pages ----------------
def item(words, text, links):
    return wrapped(f"- {words} {links.linked(text)}".rstrip(), "  ")


def prototype(name, function):
    arguments = [f"{one.type} {one.name}".replace("* ", "*") for one in function.arguments]
    lines = [f"{function.result} {name}(".replace("* ", "*")]
    if len(lines[0] + ", ".join(arguments)) > 94:
        lines.append("   ")
    for number, argument in enumerate(arguments or ["void"], 1):
        piece = argument + (", " if number < len(arguments) else ");")
        if len(lines[-1] + piece) > 97:
            lines.append("    ")
        lines[-1] += (" " if lines[-1] == "   " else "") + piece
    return "\n".join(line.rstrip() for line in lines)


def description(comment, links):
    lines, before = [], ""
    for kind, what in comment.blocks:
        if before and not (kind == before == "item"):
            lines.append("")
        lines.append(wrapped(links.linked(what)) if kind == "text"
                     else item(f"`{what[0]}`", what[1], links))
        before = kind
    for parameter in comment.parameters:
        if before and before != "parameter":
            lines.append("")
        names = ", ".join(f"`{name}`" for name in parameter.names)
        direction = f" ({parameter.direction})" if parameter.direction else ""
        lines.append(item(f"{names}{direction}:", parameter.text, links))
        before = "parameter"
    if comment.errors:
        lines += ["", wrapped(links.linked(comment.errors))]
    return "\n".join(lines).strip("\n") + "\n"


def entry_text(entry, section, sources, links, shown):
    names = entry_names(entry)
    title = ", ".join(names)
    lines = []
    if len(names) > 1:
        lines.append("".join(f'<a id="{anchor(name)}"></a>' for name in names) + "\n")
    lines.append(f"### {title}\n")
    if names == ["pnpbs_status"]:
        return "\n".join(lines + [status_table(sources)])
    code = "\n".join(prototype(*pair) for pair in entry.functions.items()) or entry.declaration
    lines.append(f"```c\n{code}\n```\n")
    if entry.comment.reach:
        lines.append(f"**{entry.comment.reach}.**\n")
    lines.append(description(entry.comment, links))
    if entry.functions:
        lines.append(fortran_part([one for name in names for one in sources.fortran_of(name)]))
        here = [links.c[name] for name in names]
        lines.append(julia_part([one for name in names for one in sources.julia_of(name)], here,
                                shown, links, names))
        lines.append(python_part(list(dict.fromkeys(
            one for name in names for one in sources.python_of(name))), here, shown, links))
    elif not entry.functions and "(*" in entry.declaration:
        lines.append(f"**Fortran**\n\n```fortran\n"
                     f"{fortran_interface(names[0], sources.interfaces)}\n```\n")
    return "\n".join(lines)


def status_table(sources):
    rows = [[f"`{name}`", value, text, f"`:{name[6:].lower()}`",
             f"`{name[6:]}`"]
            for name, value, text in sources.statuses]
    return ("What every function returns: 0 done, above 0 an outcome whose results are valid, below 0 "
            "an error.\nFortran has the same names; Julia throws and Python raises a `PNPBSError` with the "
            "status below for an\nerror, and returns it for an outcome.\n\n" +
            table(["C and Fortran", "value", "meaning", "Julia", "Python's `Status`"], rows))


# ---------------------------------------------------------------- the pages ----------------------
def section_page(section, sources, links, shown, library):
    title = section.title[0].upper() + section.title[1:]
    text = NOTE + f"# {title}\n\n[Reference](README.md)\n\n"
    text += "\n".join(entry_text(entry, section, sources, links, shown)
                      for entry in section.entries)
    if section.title == "files":
        rows = [[f"`.{name}`", help, "yes" if binary else "no", "yes" if elements else "no"]
                for name, help, binary, elements in library.formats()]
        text += ("\n## Formats\n\n" + "The library's; the command adds pictures "
                 "([command.md](../command.md)).\n\n" +
                 table(["extension", "holds", "binary", "nodes and, on request, elements"], rows))
    return text


def options_page(library):
    rows = [[f"`{name}`", kind, default, span, help]
            for name, kind, default, span, help in library.options()]
    return (NOTE + "# Options\n\n[Reference](README.md)\n\n"
            "For contexts (placements created later start with them) and for placements: "
            "[`pnpbs_context_set`](context.md#pnpbs_context_set),\n"
            "[`pnpbs_placement_set`](placement.md#pnpbs_placement_set); in Fortran "
            "`call placement%set('steps', 100)`, in Julia\n`set!(placement; steps = 100)`, in Python "
            "`placement.set(steps=100)`, with the command `--set steps=100`. `pnpbs --help` prints the same list.\n\n" +
            table(["name", "type", "default", "range", "what it does"], rows))


def statistics_page(library):
    rows = [[f"`{name}`", kind, help] for name, kind, help in library.statistics()]
    return (NOTE + "# Statistics\n\n[Reference](README.md)\n\n"
            "Asked by [`pnpbs_placement_get_int64`](placement.md#pnpbs_placement_get_int64), `_double` "
            "or `_string`, by type; in Fortran\n`call placement%get('nodes', value)`, in Julia "
            "`statistic(placement, \"nodes\")`, in Python `placement.statistic(\"nodes\")`. They are "
            "the keys of the command's\n`--report`, where a dot is a level. What to make of them: "
            "[read the report](../guide/read_the_report.md).\n\n" +
            table(["name", "type", "what it is"], rows))


def index_table(sources, links):
    rows = []
    for name, entry in sources.functions.items():
        fortran = [re.search(r"(?:call |= )([\w%]+)", one.call)[1]
                   for one in sources.fortran_of(name)]
        julia = [re.match(r"[\w.]+!?", line)[0] for one in sources.julia_of(name)
                 for line in one.signatures]
        python = [one.name for one in sources.python_of(name)]
        rows.append([f"[`{name}`]({links.c[name]})", entry.comment.reach.lower(),
                     names_cell(fortran), names_cell(julia) or "raw layer only",
                     names_cell(python)])
    return table(["C", "", "Fortran", "Julia", "Python"], rows)


def beyond_c(sources, links):
    lines = ["What the languages have besides.\n", "**Fortran**\n"]
    own = [one for one in sources.fortran if not one.calls and "handle" in one.name]
    lines.append("```fortran\n" + "\n".join(one.call for one in own) + "\n```\n")
    lines.append("Handles as integers, for common blocks: "
                 "[fortran.md](../fortran.md#what-differs-from-c).\n")
    lines.append("**Julia**\n")
    for one in sources.julia.docstrings:
        if links.julia[one] != "README.md#beyond-c":
            continue
        lines.append("```julia\n" + "\n".join(one.signatures) + "\n```\n\n" +
                     links.resolved(one.text) + "\n")
    lines.append("**Python**\n")
    for one in sources.python.functions:
        if one not in links.python:
            lines.append(f"```python\n{one.signature}\n```\n\n{one.text}\n")
    return "\n".join(lines)


def constants_page(root):
    text = NOTE + """# Constants of the method

What the method is made of besides its [options](options.md): `src/method/constants.hpp` as a table.
*Chosen* says that there is no measurement on these pages.
"""
    found = method_constants.constants(root)
    for section in dict.fromkeys(one.section for one in found):
        text += f"\n## {section}\n\n"
        text += table(["constant", "value", "unit", "meaning", "source"],
                      [[f"`{one.name}`", one.text, one.unit, one.meaning, one.source]
                       for one in found if one.section == section])
    return text


def index_page(sources, links):
    text = NOTE + """# Reference

Every function in C, Fortran, Julia and Python, made from the comments of
[include/pnpbs/pnpbs.h](../../include/pnpbs/pnpbs.h), of the Fortran modules, and of the Julia and Python
packages.
How to use them for a task: [the guides](../README.md#guides).

| page | holds |
| --- | --- |
"""
    for section in sources.sections:
        names = [name for entry in section.entries for name in entry.functions]
        text += f"| [{section.title}]({page_name(section)}) | functions: {len(names)} |\n"
    text += ("| [options](options.md) | name, type, default and range of each |\n"
             "| [statistics](statistics.md) | the keys of the report |\n"
             "| [constants](constants.md) | the constants of the method that are no options |\n")
    for title, rows in sources.opening.items():
        text += f"\n## {title}\n\n"
        text += table(["", ""], [[word, links.linked(what)] for word, what in rows])
    text += """
In Fortran every procedure that returns no value takes `stat` and `errmsg` besides, both optional:
without `stat` an error stops the program. In Julia and Python an error is an exception. Local indices
and offsets count from 1 in Fortran and Julia, from 0 in C and Python. More: [fortran.md](../fortran.md),
[julia.md](../julia.md), [python.md](../python.md).

## All functions

"""
    return text + index_table(sources, links) + "\n## Beyond C\n\n" + beyond_c(sources, links)


def pages(root, library):
    """Returns {file name: text} of the reference."""
    sources = Sources(root)
    gaps = list(sources.gaps())
    if gaps:
        raise ValueError("\n".join(gaps))
    links, shown = Links(sources), set()
    made = {page_name(section): section_page(section, sources, links, shown, library)
            for section in sources.sections}
    made.update({"options.md": options_page(library), "statistics.md": statistics_page(library),
                 "constants.md": constants_page(root),
                 "README.md": index_page(sources, links)})
    return {name: text.rstrip("\n") + "\n" for name, text in made.items()}


def differences(folder, made):
    """Yields the lines of a diff between the existing pages and the generated ones."""
    there = {path.name: path.read_text() for path in folder.glob("*.md")}
    for name in sorted(there.keys() | made.keys()):
        yield from difflib.unified_diff(there.get(name, "").splitlines(),
                                        made.get(name, "").splitlines(), f"{name} as it is",
                                        f"{name} as it should be", lineterm="", n=1)


def main():
    folder = ROOT / "docs/reference"
    try:
        made = pages(ROOT, Library(sys.argv[1]))
    except ValueError as error:
        sys.exit(str(error))
    if "--check" in sys.argv:
        found = list(differences(folder, made))
        print("\n".join(found) or f"{len(made)} pages are as the sources have them")
        sys.exit("write them anew: --target pnpbs-reference" if found else 0)
    folder.mkdir(exist_ok=True)
    for old in folder.glob("*.md"):
        old.unlink()
    for name, text in made.items():
        (folder / name).write_text(text)


if __name__ == "__main__":
    main()
