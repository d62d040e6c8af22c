# SPDX-License-Identifier: BSD-3-Clause
"""Formats the counterparts of a C function in the other languages, as parts of its entry."""

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
    """Returns the interface of a callback from pnpbs_c.f90."""
    match = re.search(rf"^( *)function {name}\(.*?end function", text, re.S | re.M)
    return textwrap.dedent(match[0]) if match else None


def described(one, place, here, shown, text):
    """Returns the text of a function once in its own section, and a link to it elsewhere."""
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
