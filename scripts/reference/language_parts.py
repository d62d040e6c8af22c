# SPDX-License-Identifier: BSD-3-Clause
"""What the languages have for a C function, as parts of its entry."""

import re
import textwrap

from markdown import wrapped


def fortran_part(procedures):
    procedures = list(dict.fromkeys(procedures))
    lines = ["**Fortran**", "", "```fortran"]
    for number, one in enumerate(procedures):
        lines += [""] * (number > 0) + [one.call]
        lines += [f"! {line}" for line in one.declarations]
    lines.append("```")
    notes = [wrapped(f"- `{names}`: {text}", "  ") for one in procedures for names, text in one.notes]
    if notes:
        lines += [""] + notes
    return "\n".join(lines) + "\n"


def fortran_interface(name, text):
    """The interface of a callback as pnpbs_c.f90 has it."""
    match = re.search(rf"^( *)function {name}\(.*?end function", text, re.S | re.M)
    return textwrap.dedent(match[0]) if match else None


def described(one, place, here, shown, text):
    """The text of a function once where its place is, elsewhere a link to it."""
    if place not in here:
        return [f"Described at [`{re.sub(r'.*#', '', place)}`]({place})."]
    if one in shown:
        return []
    shown.add(one)
    return [text]


def julia_part(docstrings, here, shown, links, c_names):
    docstrings = list(dict.fromkeys(docstrings))
    if not docstrings:
        raw = ", ".join(f"`PNPBS.LibPNPBS.{name}`" for name in c_names)
        return f"**Julia**: only in the raw layer, {raw}.\n"
    lines = ["**Julia**"]
    for one in docstrings:
        lines += ["", "```julia", *one.signatures, "```", ""]
        lines += described(one, links.julia[one], here, shown, links.resolved(one.text))
    return "\n".join(lines) + "\n"


def python_part(functions, here, shown, links):
    lines = ["**Python**"]
    for one in functions:
        lines += ["", "```python", one.signature, "```", ""]
        lines += described(one, links.python[one], here, shown, one.text)
    return "\n".join(lines) + "\n" if functions else ""
