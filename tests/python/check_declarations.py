#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Compares the C header with the declarations of the Python package: every function, every
argument, every type of callback, every constant.
usage: check_declarations.py <pnpbs.h> <folder of pnpbs> [--self-test]

--self-test changes the header in many ways, one at a time, and fails unless each change is
detected."""
import ctypes
import importlib
import re
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "linkage"))
import c_header

# The types of arguments of callbacks. Other pointers and text do not occur there.
CALLBACK_TYPES = {"int32_t": ctypes.c_int32, "int64_t": ctypes.c_int64, "double": ctypes.c_double,
                  "double *": ctypes.POINTER(ctypes.c_double),
                  "const double *": ctypes.POINTER(ctypes.c_double), "void *": ctypes.c_void_p}

HANDLES = ("pnpbs_context", "pnpbs_domain", "pnpbs_placement", "pnpbs_transfer", "pnpbs_mesh",
           "pnpbs_voronoi", "pnpbs_particles")


def function_differences(functions, declared):
    for name in sorted(set(functions) | set(declared)):
        c, own = functions.get(name), declared.get(name)
        if c is None or own is None:
            yield f"{name}: missing in {'the header' if c is None else 'Python'}"
            continue
        if own[0] != c.result:
            yield f"{name}: returns {c.result} in C, {own[0]} in Python"
        if own[1] != tuple((a.type, a.name) for a in c.arguments):
            yield f"{name}: {c.arguments} in C, {own[1]} in Python"


def callback_differences(callbacks, declared):
    for name in sorted(set(callbacks) | set(declared)):
        c, own = callbacks.get(name), declared.get(name)
        if c is None or own is None:
            yield f"{name}: missing in {'the header' if c is None else 'Python'}"
            continue
        if (own._restype_, list(own._argtypes_)) != (
                CALLBACK_TYPES[c.result], [CALLBACK_TYPES[a.type] for a in c.arguments]):
            yield f"{name}: {c} in C, {own._argtypes_} in Python"


def constant_differences(constants, interface):
    wanted = {name: value for name, value in constants.items() if "_VERSION_" not in name}
    errors = importlib.import_module(f"{interface.__package__}.errors")
    own = {f"PNPBS_{status.name}": status.value for status in errors.Status}
    warnings = importlib.import_module(f"{interface.__package__}._warnings")
    for prefix, codes in (("WARNING", warnings.WarningCode), ("REASON", errors.ErrorReason)):
        own |= {f"PNPBS_{prefix}_{code.name}": code.value for code in codes}
    own |= {"PNPBS_BOUNDARY": interface.BOUNDARY, "PNPBS_INNER": interface.INNER}
    own |= {f"PNPBS_{name}": getattr(interface, name) for name in ("BOUNDED", "PERIODIC", "FLAT")}
    own |= {f"PNPBS_OVERLAP_{name.upper()}": rule for name, rule in interface.OVERLAPS.items()}
    for name in sorted(set(wanted) | set(own)):
        if wanted.get(name) != own.get(name):
            yield f"{name}: {wanted.get(name)} in C, {own.get(name)} in Python"


def differences(text, interface):
    declared = interface.declarations(interface.DECLARATIONS)
    yield from function_differences(c_header.functions(text), declared)
    yield from callback_differences(c_header.callbacks(text), interface.CALLBACKS)
    yield from constant_differences(c_header.constants(text), interface)
    # Checks the types to which declarations are converted when the library is called.
    for result, arguments in declared.values():
        for c_type in [result] + [c_type for c_type, _ in arguments]:
            is_pointer = c_type.endswith(("*", "_fn")) or c_type in HANDLES
            simple = interface.ctypes_of(c_type) in interface._NUMBERS.values()
            if is_pointer == simple:
                yield f"{c_type} becomes {interface.ctypes_of(c_type)}"


MUTATIONS = [
    ("pnpbs_context context, int32_t dim,", "pnpbs_context context,"),
    ("_run(pnpbs_placement placement)", "_run(pnpbs_placement placement, int32_t more)"),
    ("pnpbs_context context, int32_t dim,", "pnpbs_context context, int64_t dim,"),
    ("placement, double d);", "placement, double *d);"),
    ("_run(pnpbs_placement placement)", "_run(pnpbs_domain placement)"),
    ("const char *pnpbs_build_info(void)", "pnpbs_status pnpbs_build_info(void)"),
    ("PNPBS_API pnpbs_status pnpbs_finalize(void);", ""),
    ("int64_t nodes, double max_speed,\n", "int32_t nodes, double max_speed,\n"),
    ("X(PNPBS_STOPPED, 2,", "X(PNPBS_STOPPED, 3,"),
    ("#define PNPBS_INNER 1", "#define PNPBS_INNER 2"),
]


MUTATIONS_OF_SHAPES = [
    ("const char *tag_field,\n", "\n"),
    ("const char **note);", "const char *note);"),
    ("PNPBS_API const char *pnpbs_geo_build_info(void);", ""),
]


def not_noticed(text, mutations, found_in):
    missed = [(old, new) for old, new in mutations if text.replace(old, new, 1) == text or
              not list(found_in(text.replace(old, new, 1)))]
    for old, new in missed:
        print(f"not noticed: {old!r} -> {new!r}")
    return missed


def main():
    header, folder = Path(sys.argv[1]), Path(sys.argv[2])
    text, text_of_geo = header.read_text(), header.with_name("pnpbs_geo.h").read_text()
    sys.path.insert(0, str(folder.parent))
    interface = importlib.import_module(f"{folder.name}._interface")
    found = list(differences(text, interface))
    for one in text, text_of_geo:
        declared = len(re.findall(r"^PNPBS_API ", one, re.M))
        if not declared or len(c_header.functions(one)) != declared:
            found.append("not every declaration of the header was understood")
    print("\n".join(found) or f"{len(c_header.functions(text))} functions agree")
    # The library of shapes has only functions and the codes of notes.
    geo = c_header.functions(text_of_geo)
    shapes = importlib.import_module(f"{folder.name}.shapes")
    of_shapes = list(function_differences(geo, interface.declarations(shapes.DECLARATIONS)))
    print("\n".join(of_shapes) or f"{len(geo)} functions of shapes agree")
    own_notes = {f"PNPBS_GEO_NOTE_{code.name}": code.value for code in shapes.NoteCode if code}
    if own_notes != c_header.constants(text_of_geo):
        of_shapes.append("the codes of notes differ from those of the header")
    found += of_shapes
    if "--self-test" in sys.argv:
        found += not_noticed(text, MUTATIONS, lambda changed: differences(changed, interface))
        own = interface.declarations(shapes.DECLARATIONS)
        found += not_noticed(text_of_geo, MUTATIONS_OF_SHAPES, lambda changed: function_differences(
            c_header.functions(changed), own))
    sys.exit(1 if found else 0)


main()
