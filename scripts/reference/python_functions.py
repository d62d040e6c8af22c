# SPDX-License-Identifier: BSD-3-Clause
"""Extracts the functions that users of the Python package can call, from its docstrings, and the C
functions that each of them reaches, as plain data."""

import ast
import inspect
import re
from typing import NamedTuple

# For each class: the prefix of the C functions that its methods call by the rest of the name, and
# the name of an object in signatures.
CLASSES = {"Context": ("context", "context"), "Domain": ("domain", "domain"),
           "Placement": ("placement", "placement"), "Results": ("placement", "placement"),
           "Fields": ("placement", "placement"), "Meshes": ("placement", "placement"),
           "Tessellation": ("placement", "placement"),
           "PlacementHandle": ("placement", "placement"), "Transfer": ("transfer", "transfer"),
           "Particles": ("particles", "particles"), "Shapes": ("geo", "shapes"),
           "GeoGrid": ("geo_grid", "grid")}
# C functions that users reach in other ways than by calling a function.
OTHERWISE = {"pnpbs_last_error": "PNPBSError", "pnpbs_geo_last_error": "PNPBSError",
             "pnpbs_last_error_data": "PNPBSError", "pnpbs_last_error_point": "PNPBSError",
             "pnpbs_status_string": "Status", "pnpbs_placement_write": "placement.write",
             "pnpbs_mesh_get_connectivity_int32": "DistributedMesh"}
# C functions that a function uses internally without corresponding to them.
IN_PASSING = {"placement.write_mesh": {"pnpbs_mesh_create", "pnpbs_mesh_destroy"}}
SETTERS = ("_set", "_set_int64", "_set_double")


class Function(NamedTuple):
    name: str  # as it is called: "placement.run", "Placement", "option_table"
    signature: str
    text: str


class Package:
    def __init__(self, folder, c_names):
        self.c_names = frozenset(c_names)
        self.functions, self.bodies = [], {}
        modules = [ast.parse(path.read_text()) for path in sorted(folder.glob("*.py"))]
        self.public = {name for module in modules for name in exported(module)}
        self.classes = {node.name: node for module in modules for node in module.body
                        if isinstance(node, ast.ClassDef)}
        self.described_below = {base.name for name in self.public & set(self.classes)
                                for base in self.public_bases(self.classes[name])}
        for module in modules:
            self.read(module)
        self.reach = {one: self.reached(one.name) - IN_PASSING.get(one.name, set())
                      for one in self.functions}
        self.documented = {one.name: one for one in self.functions}

    # ------------------------------------------------------------ public functions --------------
    def read(self, module):
        for node in module.body:
            if isinstance(node, ast.FunctionDef):
                self.add(node, None, node.name)
            elif isinstance(node, ast.ClassDef):
                self.read_class(node)

    def read_class(self, node):
        if node.name not in CLASSES:
            if ast.get_docstring(node) and node.name in self.public - self.described_below:
                self.bodies[node.name] = (node, None)
                self.functions.append(Function(node.name, node.name, "\n\n".join(
                    inspect.cleandoc(ast.get_docstring(one))
                    for one in (node, *self.public_bases(node)))))
            return
        prefix, called = CLASSES[node.name]
        for method in node.body:
            if not isinstance(method, ast.FunctionDef):
                continue
            if method.name == "__init__":
                self.add(method, prefix, node.name, ast.get_docstring(node))
            elif has_decorator(method, "classmethod"):
                self.add(method, prefix, f"{node.name}.{method.name}")
            else:
                self.add(method, prefix, f"{called}.{method.name}")

    def public_bases(self, node):
        """Yields the public base classes, direct or indirect."""
        for base in node.bases:
            one = self.classes.get(getattr(base, "id", None))
            if one is not None:
                yield from [one] if one.name in self.public else []
                yield from self.public_bases(one)

    def add(self, node, prefix, name, text=None):
        self.bodies[name] = (node, prefix)
        text = text or ast.get_docstring(node)
        if text and ("." in name or name in self.public) and not name.split(".")[-1].startswith("_"):
            self.functions.append(Function(name, signature(node, name), inspect.cleandoc(text)))

    # ------------------------------------------------------------ called C functions ------------
    def reached(self, name, seen=None):
        """Returns the C functions that a function calls, directly or through private ones."""
        seen = seen if seen is not None else {name}
        node, prefix = self.bodies.get(name, (None, None))
        found = set()
        for part in ast.walk(node) if node else ():
            if isinstance(part, ast.Attribute) and part.attr in self.c_names:
                found.add(part.attr)
            if isinstance(part, ast.Call):
                found |= self.named_by(part, prefix)
                found |= self.reached_through(part, name, seen)
        return found - (set(OTHERWISE) if name.split(".")[-1] != "write" else set())

    def named_by(self, call, prefix):
        """Returns the C function of self._call("run"): pnpbs_placement_run."""
        texts = [one.value for one in call.args
                 if isinstance(one, ast.Constant) and isinstance(one.value, str)]
        if isinstance(call.func, ast.Name) and call.func.id == "_set_option":
            return {f"pnpbs_{texts[0]}{setter}" for setter in SETTERS} & self.c_names
        if not (isinstance(call.func, ast.Attribute) and call.func.attr.startswith("_")):
            return set()
        return {f"pnpbs_{prefix}_{text}" for text in texts} & self.c_names

    def reached_through(self, call, name, seen):
        func = call.func
        if isinstance(func, ast.Attribute) and isinstance(func.value, ast.Name) \
                and func.value.id == "self":
            other = f"{name.split('.')[0].lower()}.{func.attr}"
        elif isinstance(func, ast.Name):
            other = func.id
        else:
            return set()
        if other in seen or other not in self.bodies or not other.split(".")[-1].startswith("_"):
            return set()
        seen.add(other)
        return self.reached(other, seen)

    def of_c_function(self, c_name):
        """Returns the functions that correspond to a C function."""
        if c_name in OTHERWISE:
            return [self.documented[OTHERWISE[c_name]]]
        return [one for one in self.functions if c_name in self.reach[one]]


def exported(module):
    """Returns the names in __all__."""
    return [name.value for node in module.body if isinstance(node, ast.Assign)
            and getattr(node.targets[0], "id", "") == "__all__" for name in node.value.elts]


def has_decorator(node, name):
    return any(isinstance(one, ast.Name) and one.id == name for one in node.decorator_list)


def signature(node, name):
    if has_decorator(node, "property"):
        return name
    for one in ast.walk(node.args):
        if isinstance(one, ast.arg):
            one.annotation = None
    arguments = re.sub(r"^(self|cls)(, )?", "", ast.unparse(node.args))
    return f"{name}({arguments})"
