# SPDX-License-Identifier: BSD-3-Clause
"""Stand-in for Spack: reads a recipe and stores the arguments of its directives."""

import contextlib
import re
import sys
import types


class Recipe:
    """The contents of a package.py: its class, and its directives in order."""

    def __init__(self, path):
        self.variants, self.versions, self.dependencies, self.conflicts = {}, {}, [], []
        self.conditions = []
        self.all_conditions = []
        package = types.ModuleType("spack.package")
        for directive in ("license", "version", "variant", "depends_on", "conflicts", "when"):
            setattr(package, directive, getattr(self, "on_" + directive))
        cmake = types.ModuleType("spack_repo.builtin.build_systems.cmake")
        cmake.CMakePackage = Package
        modules = {"spack": types.ModuleType("spack"), "spack.package": package, cmake.__name__: cmake}
        for name in ("spack_repo", "spack_repo.builtin", "spack_repo.builtin.build_systems"):
            modules[name] = types.ModuleType(name)
        before = dict(sys.modules)
        sys.modules.update(modules)
        try:
            names = {"__name__": "package"}
            exec(compile(path.read_text(), str(path), "exec"), names)  # our own recipe
        finally:
            sys.modules.clear()
            sys.modules.update(before)
        self.package = next(value for value in names.values() if isinstance(value, type)
                            and issubclass(value, Package) and value is not Package)

    def on_license(self, name):
        self.license = name

    def on_version(self, number, sha256=None, branch=None):
        assert (sha256 is None) != (branch is None), number
        self.versions[number] = sha256

    def on_variant(self, name, default, description):
        assert isinstance(default, bool) and description
        self.variants[name] = default

    def on_depends_on(self, spec, type=("build", "link"), when=""):
        self.dependencies.append((spec, " ".join(self.conditions + [when]).strip()))
        self.all_conditions.append(when)

    def on_conflicts(self, spec, msg=None, when=""):
        self.conflicts.append(spec)
        self.all_conditions.append(when)

    @contextlib.contextmanager
    def on_when(self, condition):
        self.all_conditions.append(condition)
        self.conditions.append(condition)
        yield
        self.conditions.pop()

    def cmake_args(self, variants):
        """Returns the options for CMake, {option: value}, with these variants."""
        package = self.package()
        package.variants = variants
        package.spec = {re.match(r"[\w-]+", spec)[0]: types.SimpleNamespace(prefix="/somewhere")
                        for spec, condition in self.dependencies if holds(condition, variants)}
        found = {}
        for argument in package.cmake_args():
            option, value = re.fullmatch(r"-D(\w+):\w+=(.*)", argument).groups()
            found[option] = value
        return found


class Package:
    """The base class of a recipe's class, with the methods that it calls."""

    def define(self, option, value):
        if isinstance(value, bool):
            return f"-D{option}:BOOL={'ON' if value else 'OFF'}"
        return f"-D{option}:STRING={value}"

    def define_from_variant(self, option, variant):
        return self.define(option, self.variants[variant])


def holds(condition, variants):
    return all(variants[name] == (sign == "+")
               for sign, name in re.findall(r"([+~])(\w+)", condition))
