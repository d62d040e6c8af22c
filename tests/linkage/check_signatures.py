# SPDX-License-Identifier: BSD-3-Clause
"""Compares the C header with the Fortran interface bodies.

The comparison covers every function, every argument (name, order, type, by value or by reference,
direction), every callback and every constant.
usage: check_signatures.py <header> <its interfaces, pnpbs_c.f90 or pnpbs_geo_c.f90>"""

import pathlib
import sys

import c_header
import fortran_interfaces

NUMBERS = {
    "int8_t": "integer(c_int8_t)",
    "int32_t": "integer(c_int32_t)",
    "int64_t": "integer(c_int64_t)",
    "double": "real(c_double)",
    "pnpbs_status": "integer(c_int)",  # an enumeration
}
HANDLES = {"pnpbs_context", "pnpbs_domain", "pnpbs_placement", "pnpbs_transfer", "pnpbs_mesh", "pnpbs_voronoi",
           "pnpbs_particles", "pnpbs_geo_shapes", "pnpbs_geo_grid"}


def difference(c, fortran):
    """Returns a description of how a Fortran argument differs from a C one, or None."""
    if fortran.name != c.name:
        return f"is named {fortran.name}"
    if fortran.type in ("type(c_ptr)", "type(c_funptr)") and fortran.note:
        return difference_of_address(c, fortran)
    if c.type in NUMBERS:
        return difference_of_value(fortran, NUMBERS[c.type])
    if c.type in HANDLES:
        return difference_of_value(fortran, "type(c_ptr)")
    pointee = c.type.removeprefix("const ")
    is_input = c.type.startswith("const ")
    if c.type == "const char *":
        return difference_of_reference(fortran, "character(kind=c_char)", {"in"}, arrays="always")
    if c.type == "const char **":
        return difference_of_reference(fortran, "type(c_ptr)", {"out"}, arrays="never")
    if c.type == "const char *const *":
        return difference_of_reference(fortran, "type(c_ptr)", {"in"}, arrays="always")
    if pointee.removesuffix(" *") in HANDLES and not is_input:
        return difference_of_reference(fortran, "type(c_ptr)", {"out", "inout"}, arrays="never")
    if pointee.endswith(" *") and pointee.removesuffix(" *") in NUMBERS:
        return difference_of_reference(fortran, NUMBERS[pointee.removesuffix(" *")],
                                       {"in"} if is_input else {"out", "inout"},
                                       arrays="always" if is_input else "perhaps")
    return f"is of a type that nobody knows in Fortran: {c.type}"


def difference_of_address(c, fortran):
    wanted = "type(c_funptr)" if c.type.endswith("_fn") else "type(c_ptr)"
    if fortran.type != wanted or not fortran.by_value or fortran.array or fortran.intent:
        return f"should be {wanted}, value"
    if c.type in NUMBERS or c.type in HANDLES:
        return "is no address in C"
    if fortran.note != c.type:
        return f"is noted as '{fortran.note}'"
    return None


def difference_of_value(fortran, wanted):
    if fortran.type != wanted or not fortran.by_value or fortran.array or fortran.note:
        return f"should be {wanted}, value"
    return None


def difference_of_reference(fortran, wanted, intents, arrays):
    fits = {"always": bool(fortran.array), "never": not fortran.array, "perhaps": True}[arrays]
    if fortran.type != wanted or fortran.by_value or fortran.intent not in intents or not fits:
        return f"should be {wanted}, intent({' or '.join(sorted(intents))}), by reference" + \
            (", an array" if arrays == "always" else "")
    return None


def differences_of_function(name, c, fortran):
    where = f"{name}: "
    if not fortran.imports:
        yield where + "not just 'import' and 'implicit none' besides its declarations"
    result = "type(c_ptr)" if c.result == "const char *" else NUMBERS.get(c.result)
    if fortran.result != result:
        yield where + f"returns {c.result} in C, {fortran.result} in Fortran"
    if len(c.arguments) != len(fortran.arguments):
        yield where + f"{len(c.arguments)} arguments in C, {len(fortran.arguments)} in Fortran"
        return
    for one, other in zip(c.arguments, fortran.arguments):
        wrong = difference(one, other)
        if wrong:
            yield where + f"'{one.type} {one.name}' {wrong}"


def differences_of_sets(what, c, fortran):
    for name in sorted(set(c) - set(fortran)):
        yield f"{what} {name} is not in Fortran"
    for name in sorted(set(fortran) - set(c)):
        yield f"{what} {name} is not in C"


def differences(header, interfaces):
    """Returns all differences between the two texts, one line each."""
    bodies = fortran_interfaces.functions(interfaces)
    pairs = [
        ("function", c_header.functions(header),
         {body.label: body for body in bodies.values() if body.label}),
        ("callback", c_header.callbacks(header),
         {name: body for name, body in bodies.items() if not body.label}),
    ]
    found = []
    for what, c, fortran in pairs:
        if not c and what == "function":
            found.append(f"no {what} found in C")
        found += differences_of_sets(what, c, fortran)
        for name in sorted(set(c) & set(fortran)):
            found += differences_of_function(name, c[name], fortran[name])
    c, fortran = c_header.constants(header), fortran_interfaces.constants(interfaces)
    found += differences_of_sets("constant", c, fortran)
    found += [f"{name} is {c[name]} in C, {fortran[name]} in Fortran"
              for name in sorted(set(c) & set(fortran)) if c[name] != fortran[name]]
    for name, body in bodies.items():
        if body.label and name != body.label.replace("pnpbs_", "c_", 1):
            found.append(f"{body.label} is named {name}")
    return found


def main():
    header, interfaces = (pathlib.Path(path).read_text() for path in sys.argv[1:3])
    found = differences(header, interfaces)
    for line in found:
        print(line, file=sys.stderr)
    if not found:
        print(f"{len(c_header.functions(header))} functions agree")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
