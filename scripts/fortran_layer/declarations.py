# SPDX-License-Identifier: BSD-3-Clause
"""Derives the declarations in a Fortran interface body for the arguments and the result of a C
function.

Most of it follows from the C type. Whether a non-const pointer is an array, and whether an array
may be NULL, follows from the comments of the header: the texts of parameters ("[n][dim] ..., or
NULL") and sentences such as "any array may be NULL"."""

import re
from typing import NamedTuple

import header_comments

NUMBERS = {"int8_t": "integer(c_int8_t)", "int32_t": "integer(c_int32_t)",
           "int64_t": "integer(c_int64_t)", "double": "real(c_double)",
           "pnpbs_status": "integer(c_int)"}
TEXT = "character(kind=c_char)"
ADDRESS = "type(c_ptr)"

# Functions whose output arrays the module passes by address, although their comments do not mention
# NULL.
BY_ADDRESS = {"pnpbs_placement_get_adjacency", "pnpbs_placement_get_exchange",
              "pnpbs_placement_get_stars"}
# Arguments that the module always passes, although they may be NULL.
BY_REFERENCE = {("pnpbs_geo_grid_values", "inside"), ("pnpbs_geo_depth_spacing", "slopes")}

MAY_BE_NULL = re.compile(r"\b(arrays?|outputs?) may be NULL")


class Declaration(NamedTuple):
    type: str  # with attributes: "real(c_double), intent(in)"
    entity: str  # "coordinates(*)"
    note: str = ""  # the C type behind an address


def handles(text):
    """Returns the handle types of a header."""
    return frozenset(re.findall(r"^typedef struct \w+ \*(\w+);", text, re.M))


def is_input(argument):
    """Returns whether a call reads the target of a pointer. A "const char **" is an output, since
    the call fills the pointer."""
    return argument.type.startswith("const ") and argument.type != "const char **"


def description(entry):
    return " ".join(text for kind, text in entry.comment.blocks if kind == "text")


class Header:
    """The comments of a header about the arguments of its functions."""

    def __init__(self, text, included=""):
        self.text = text
        self.handles = handles(included) | handles(text)
        self.entries = header_comments.entries_of(text)
        self.of_function = {name: entry for entry in self.entries for name in entry.functions}

    def parameter(self, function, name):
        """Returns the text of a parameter, following references such as "as pnpbs_..." to another
        function."""
        if function not in self.of_function:
            raise ValueError(f"parameters refer to {function}, which has no comment")
        for one in self.of_function[function].comment.parameters:
            if name in one.names:
                other = re.match(r"as (pnpbs_\w+)", one.text)
                return self.parameter(other[1], name) if other else one.text
        return ""

    def is_array(self, function, argument):
        return (is_input(argument) or function in BY_ADDRESS
                or self.parameter(function, argument.name).startswith("["))

    def may_be_null(self, function, argument):
        if (function, argument.name) in BY_REFERENCE:
            return False
        if "NULL" in self.parameter(function, argument.name):
            return True
        return not is_input(argument) and (
            function in BY_ADDRESS
            or bool(MAY_BE_NULL.search(description(self.of_function[function]))))

    # ------------------------------------------------------------ declarations ------------------
    def declaration(self, function, argument):
        """Returns the declaration of an argument of a function."""
        c_type, name = argument.type, argument.name
        simple = self.simple_declaration(argument)
        if simple:
            return simple
        if c_type == "const char *":
            return Declaration(f"{TEXT}, intent(in)", f"{name}(*)")
        pointee = self.pointee(function, argument)
        if self.is_array(function, argument):
            if self.may_be_null(function, argument):
                return Declaration(f"{ADDRESS}, value", name, c_type)
            # A failed call leaves the array unchanged, so it cannot be intent(out).
            intent = "in" if is_input(argument) else "inout"
            return Declaration(f"{pointee}, intent({intent})", f"{name}(*)")
        intent = "inout" if function.endswith("_destroy") else "out"
        return Declaration(f"{pointee}, intent({intent})", name)

    def simple_declaration(self, argument):
        """Returns the declaration of an argument passed by value, or None."""
        c_type, name = argument.type, argument.name
        if c_type in NUMBERS:
            return Declaration(f"{NUMBERS[c_type]}, value", name)
        if c_type in self.handles:
            return Declaration(f"{ADDRESS}, value", name)
        if c_type == "void *":
            return Declaration(f"{ADDRESS}, value", name, c_type)
        if re.fullmatch(r"pnpbs_\w+_fn", c_type):
            return Declaration("type(c_funptr), value", name, c_type)
        return None

    def pointee(self, where, argument):
        """Returns the Fortran type of the target of a C pointer."""
        if argument.type in ("const char **", "const char *const *"):
            return ADDRESS
        match = re.fullmatch(r"(?:const )?(\w+) \*", argument.type)
        if match and match[1] in NUMBERS:
            return NUMBERS[match[1]]
        if match and match[1] in self.handles and not is_input(argument):
            return ADDRESS
        raise ValueError(f"{where}: no Fortran type for '{argument.type} {argument.name}'")

    def callback_declaration(self, callback, argument, comment):
        """Returns the declaration of a callback's argument. Its comment contains the shapes of
        arrays."""
        simple = self.simple_declaration(argument)
        if simple:
            return simple
        shape = re.search(rf"\b{argument.name}((?:\[\w+\])+)", comment)
        if not shape:
            raise ValueError(f"{callback}: its comment gives {argument.name} no shape")
        intent = "in" if is_input(argument) else "out"
        return Declaration(f"{self.pointee(callback, argument)}, intent({intent})",
                           f"{argument.name}({', '.join(fortran_shape(shape[1]))})")


def result_type(function, c_type):
    if c_type == "const char *":
        return ADDRESS
    if c_type not in NUMBERS:
        raise ValueError(f"{function}: no Fortran type for the result '{c_type}'")
    return NUMBERS[c_type]


def fortran_shape(text):
    """Returns the Fortran shape of [n][dim]: dim, n."""
    return re.findall(r"\w+", text)[::-1]


def with_fortran_shapes(text):
    """Replaces shapes in a comment: x[n][dim] becomes x(dim,n)."""
    return re.sub(r"\b(\w+)((?:\[\w+\])+)",
                  lambda match: f"{match[1]}({','.join(fortran_shape(match[2]))})", text)
