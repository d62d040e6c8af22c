# SPDX-License-Identifier: BSD-3-Clause
"""Generates the interface bodies of functions and callbacks."""

import c_header
import fortran_lines
from declarations import description, result_type, with_fortran_shapes


def declaration_lines(declarations):
    """Yields one line per declaration; consecutive ones that differ only in their names share a
    line."""
    groups = []
    for one in declarations:
        if groups and not one.note and groups[-1][0] == (one.type, ""):
            groups[-1][1].append(one.entity)
        else:
            groups.append(((one.type, one.note), [one.entity]))
    for (kind, note), entities in groups:
        if note:
            yield f"      {kind} :: {entities[0]} ! {note}"
        else:
            yield from rows(f"      {kind} :: ", entities)


def rows(head, entities):
    """Yields as many declarations as the names need."""
    line = head + entities[0]
    for one in entities[1:]:
        if len(f"{line}, {one}") > fortran_lines.WIDTH:
            yield line
            line = head + one
        else:
            line += f", {one}"
    yield line


def body(head, name, declarations, result):
    return [*fortran_lines.statement(head, "    "), "      import", "      implicit none",
            *declaration_lines(declarations), f"      {result} :: {name}", "    end function"]


def names_of(function):
    return ", ".join(argument.name for argument in function.arguments)


def function_body(header, c_name, function):
    name = c_name.replace("pnpbs_", "c_", 1)
    declarations = [header.declaration(c_name, argument) for argument in function.arguments]
    return body(f'function {name}({names_of(function)}) bind(C, name="{c_name}")', name,
                declarations, result_type(c_name, function.result))


def callback_body(header, name, function, entry):
    text = description(entry)
    lines = fortran_lines.comment(with_fortran_shapes(text), "    ")
    longest = max((len(", ".join(one.names)) for one in entry.comment.parameters), default=0)
    for one in entry.comment.parameters:
        start = f"@param {', '.join(one.names):{longest}}  "
        hanging = " " * len(start)
        [first, *others] = fortran_lines.comment("." * len(start) + one.text, "    ", hanging)
        lines += [first.replace("." * len(start), start, 1), *others]
    declarations = [header.callback_declaration(name, argument, text)
                    for argument in function.arguments]
    return lines + body(f"function {name}({names_of(function)}) bind(C)", name, declarations,
                        result_type(name, function.result))


def separated(bodies):
    """Joins the lines of all bodies, separated by empty lines."""
    lines = []
    for one in bodies:
        lines += ([""] if lines else []) + one
    return lines


def callback_bodies(header):
    return separated(callback_body(header, name, function, entry) for entry in header.entries
                     for name, function in c_header.callbacks(entry.declaration).items())


def function_bodies(header):
    functions = c_header.functions(header.text)
    for name in functions:
        if name not in header.of_function:
            raise ValueError(f"{name} has no comment")
    return separated(function_body(header, name, function)
                     for name, function in functions.items())
