#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Compares the C header with the Julia package's ccalls, argument by argument: count, type, and
passing by value or by reference. Also compares the signatures of callbacks, status codes and
constants. Prints each difference and fails if there is any.

usage: check_ccalls.py <pnpbs.h> <folder of PNPBS.jl> [--self-test]
pnpbs_geo.h, beside that header, is compared in the same way.

--self-test changes the header in many ways, one at a time, and fails unless each change is
detected."""
import re
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "linkage"))
import c_header

# The names of C types in a ccall. Other names are those of the header, which are the same in Julia.
JULIA_NAMES = {
    "int8_t": {"Int8"},
    "int32_t": {"Int32"},
    "int64_t": {"Int64"},
    "double": {"Cdouble", "Float64"},
}


# ---------------------------------------------------------------- the header ---------------------
def read_header(text):
    kinds = [{name: (c_type(function.result), [c_type(one.type) for one in function.arguments])
              for name, function in read(text).items()}
             for read in (c_header.functions, c_header.callbacks)]
    constants = {name: value for name, value in c_header.constants(text).items()
                 if not name.startswith("PNPBS_VERSION_")}
    return (*kinds, constants)


def c_type(text):
    """Returns (name of the type pointed to, number of pointers). const is removed, as it does not
    affect a call."""
    text = re.sub(r"\bconst\b", " ", text)
    return text.replace("*", " ").strip(), text.count("*")


# ---------------------------------------------------------------- the Julia files ----------------
def read_package(folder):
    raw = (folder / "src/LibPNPBS.jl").read_text()
    callbacks = read_callbacks((folder / "src/callbacks.jl").read_text())
    return read_functions(raw), callbacks, read_constants(raw), read_aliases(raw)


def read_shapes(folder):
    """Returns the same data for the library of shapes, which has no callbacks."""
    raw = (folder / "src/LibPNPBSGeo.jl").read_text()
    return read_functions(raw), {}, read_constants(raw), read_aliases(raw)


def read_constants(raw):
    return {n: int(v) for n, v in re.findall(r"^const (PNPBS_\w+) = (-?\d+)$", raw, re.M)}


def read_aliases(raw):
    return dict(re.findall(r"^const (pnpbs_\w+) = (\S+)$", raw, re.M))


def read_functions(raw):
    functions = {}
    pattern = (r"^(\w+)\(([^)]*)\) =\s*@ccall \$\(symbol\(:(\w+)\)\)\((.*?)\)::(\w+)$")
    for name, names, symbol, arguments, result in re.findall(pattern, raw, flags=re.S | re.M):
        parts = [part.split("::") for part in split_arguments(arguments)]
        forwarded = [part.strip() for part in names.split(",") if part.strip()]
        functions[name] = (julia_type(result), [julia_type(part[1]) for part in parts], symbol,
                           forwarded == [part[0].strip() for part in parts])
    return functions


def read_callbacks(text):
    callbacks = {}
    pattern = r"(\w+)_pointer\[\] = @cfunction\((\w+), (\w+),\s*\(([^)]*)\)\)"
    for kind, function, result, arguments in re.findall(pattern, text):
        declared = re.search(r"function " + function + r"\(([^)]*)\)", text)
        own = [julia_type(part.split("::")[1]) for part in split_arguments(declared[1])]
        callbacks[f"pnpbs_{kind}_fn"] = (
            julia_type(result), [julia_type(part) for part in split_arguments(arguments)], own)
    return callbacks


def split_arguments(text):
    return [part for part in (piece.strip() for piece in text.split(",")) if part]


def julia_type(text):
    text, pointers = text.strip(), 0
    while text.startswith("Ptr{") and text.endswith("}"):
        text, pointers = text[4:-1], pointers + 1
    return text, pointers


# ---------------------------------------------------------------- comparing ----------------------
def same(c, julia):
    (c_name, c_pointers), (name, pointers) = c, julia
    if c_name == "char":  # a Cstring, or bytes with a separate length
        return (name, pointers) in (("Cstring", c_pointers - 1), ("UInt8", c_pointers))
    if c_name == "void":
        return (name, pointers) == ("Cvoid", c_pointers)
    return name in JULIA_NAMES.get(c_name, {c_name}) and pointers == c_pointers


def spell(kind):
    return kind[0] + "*" * kind[1]


def signature_differences(name, c, result, arguments):
    c_result, c_list = c
    if not same(c_result, result):
        yield f"{name}: returns {spell(c_result)} in C, {spell(result)} in Julia"
    if len(c_list) != len(arguments):
        yield f"{name}: {len(c_list)} arguments in C, {len(arguments)} in Julia"
        return
    for i, (wanted, found) in enumerate(zip(c_list, arguments), 1):
        if not same(wanted, found):
            yield f"{name}: argument {i} is {spell(wanted)} in C, {spell(found)} in Julia"


def name_differences(what, wanted, found):
    for name in sorted(set(wanted) - set(found)):
        yield f"{name}: a {what} of the header, missing in Julia"
    for name in sorted(set(found) - set(wanted)):
        yield f"{name}: a {what} in Julia, missing in the header"


def differences(header, package):
    functions, callbacks, constants = header
    ccalls, pointers, numbers, aliases = package
    yield from name_differences("function", functions, ccalls)
    for name in sorted(set(functions) & set(ccalls)):
        result, arguments, symbol, forwarded = ccalls[name]
        yield from signature_differences(name, functions[name], result, arguments)
        if symbol != name:
            yield f"{name}: calls {symbol}"
        if not forwarded:
            yield f"{name}: the ccall's arguments are not the function's, in their order"
    yield from name_differences("callback", callbacks, pointers)
    for name in sorted(set(callbacks) & set(pointers)):
        result, arguments, own = pointers[name]
        yield from signature_differences(name, callbacks[name], result, arguments)
        if own != arguments:
            yield f"{name}: @cfunction and the function disagree"
    yield from name_differences("constant", constants, numbers)
    for name in sorted(set(constants) & set(numbers)):
        if constants[name] != numbers[name]:
            yield f"{name}: {constants[name]} in C, {numbers[name]} in Julia"
    # Types of the header: an enum is an Int32, handles and functions are pointers.
    for name, julia in sorted(aliases.items()):
        if julia != ("Int32" if name == "pnpbs_status" else "Ptr{Cvoid}"):
            yield f"{name}: stands for {julia}"


# ---------------------------------------------------------------- can it fail? -------------------
# Changes of the header: description, text, replacement.
MUTATIONS = [
    ("an argument less", "pnpbs_context context, int32_t dim,", "pnpbs_context context,"),
    ("an argument more", "_run(pnpbs_placement placement)",
     "_run(pnpbs_placement placement, int32_t more)"),
    ("a wider integer", "pnpbs_context context, int32_t dim,",
     "pnpbs_context context, int64_t dim,"),
    ("by reference, not by value", "placement, double d);", "placement, double *d);"),
    ("by value, not by reference", "domain, const double *point", "domain, double point"),
    ("another handle", "_run(pnpbs_placement placement)", "_run(pnpbs_domain placement)"),
    ("arguments exchanged", "(pnpbs_placement placement, int64_t n);",
     "(int64_t n, pnpbs_placement placement);"),
    ("another result", "const char *pnpbs_build_info(void)", "pnpbs_status pnpbs_build_info(void)"),
    ("a new function", "PNPBS_API pnpbs_status pnpbs_finalize(void);",
     "PNPBS_API pnpbs_status pnpbs_finalize(void);\nPNPBS_API pnpbs_status pnpbs_new(void);"),
    ("a function less", "PNPBS_API pnpbs_status pnpbs_finalize(void);", ""),
    ("a callback's argument", "int64_t nodes, double max_speed,\n",
     "int32_t nodes, double max_speed,\n"),
    ("a status renumbered", "X(PNPBS_STOPPED, 2,", "X(PNPBS_STOPPED, 3,"),
    ("a new status", "X(PNPBS_STOPPED, 2,", 'X(PNPBS_PAUSED, 3, "") X(PNPBS_STOPPED, 2,'),
    ("a constant changed", "#define PNPBS_INNER 1", "#define PNPBS_INNER 2"),
]


# Changes of the header of shapes.
MUTATIONS_OF_SHAPES = [
    ("an argument less", "const char *tag_field,\n", "\n"),
    ("a text by reference", "const char **note);", "const char *note);"),
    ("another handle", "pnpbs_context context,\n", "pnpbs_domain context,\n"),
    ("a wider integer", "shapes, int32_t index,", "shapes, int64_t index,"),
    ("a new function", "PNPBS_API const char *pnpbs_geo_build_info(void);",
     "PNPBS_API const char *pnpbs_geo_build_info(void);\nPNPBS_API pnpbs_status pnpbs_geo_new(void);"),
]


def self_test(text, package, mutations):
    missed = []
    for what, old, new in mutations:
        changed = text.replace(old, new, 1)
        if changed == text:
            missed.append(f"{what}: the header no longer has the text to change")
            continue
        found = list(differences(read_header(changed), package))
        if found:
            print(f"{what}: {found[0]}")
        else:
            missed.append(what)
    return missed


def check(path, package, mutations):
    """Returns whether a header and the Julia declarations agree, and whether all changes are
    detected."""
    text = path.read_text()
    header = read_header(text)
    found = list(differences(header, package))
    # The patterns above must match every declaration, as unmatched ones would never differ.
    declared = len(re.findall(r"^PNPBS_API ", text, re.M))
    if not declared or len(header[0]) != declared:
        found.append("not every declaration of the header was understood")
    print("\n".join(found) or f"{len(header[0])} functions, {len(header[1])} callbacks agree")
    if found or "--self-test" not in sys.argv:
        return not found
    missed = self_test(text, package, mutations)
    print("".join(f"not noticed: {what}\n" for what in missed), end="")
    return not missed


def main():
    header, folder = Path(sys.argv[1]), Path(sys.argv[2])
    good = [check(header, read_package(folder), MUTATIONS),
            check(header.with_name("pnpbs_geo.h"), read_shapes(folder), MUTATIONS_OF_SHAPES)]
    sys.exit(0 if all(good) else 1)


main()
