# SPDX-License-Identifier: BSD-3-Clause
"""Tests the recipes in packaging/ as far as possible without the package managers. They run with
stand-ins, use CMake options that exist, and have the version of the project, like all files that
contain a version.
usage: test_recipes.py <source folder> <version> <julia, or ''>"""

import itertools
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

import yaml

HERE = pathlib.Path(__file__).parent
SOURCE, VERSION, JULIA = pathlib.Path(sys.argv[1]), sys.argv[2], sys.argv[3]
sys.path.insert(0, str(HERE / "stand_in"))

import spack_recipe  # pylint: disable=wrong-import-position

ZEROS = "0" * 64


def options(files=None):
    """Returns the names of the CMake options, by default of the library."""
    text = "\n".join(path.read_text() for path in files or (SOURCE / "cmake").glob("*.cmake"))
    found = set(re.findall(r"^option\(\s*(PNPBS_\w+)", text, re.M))
    return found | set(re.findall(r"^set\(\s*(PNPBS_\w+)\s+\S+\s+CACHE\b", text, re.M))


class Versions(unittest.TestCase):
    def test_are_the_same_everywhere(self):
        numbers = VERSION.split(".")
        header = (SOURCE / "include/pnpbs/pnpbs.h").read_text()
        for name, number in zip(("MAJOR", "MINOR", "PATCH"), numbers):
            self.assertRegex(header, rf"(?m)^#define PNPBS_VERSION_{name} {number}$")
        for file, line in (
                ("include/pnpbs/pnpbs.h", f'#define PNPBS_VERSION_STRING "{VERSION}"'),
                ("bindings/julia/PNPBS.jl/Project.toml", f'version = "{VERSION}"'),
                ("bindings/python/pyproject.toml", f'version = "{VERSION}"'),
                ("CITATION.cff", f"version: {VERSION}"),
                ("packaging/yggdrasil/build_tarballs.jl", f'version = v"{VERSION}"')):
            self.assertIn(line, (SOURCE / file).read_text().splitlines(), file)
        self.assertRegex((SOURCE / "docs/pnpbs.1").read_text(), rf'(?m)^\.TH .*"PNPBS {VERSION}"')


class Options(unittest.TestCase):
    def test_are_read(self):
        self.assertLessEqual({"PNPBS_ENABLE_MPI", "PNPBS_BUILD_FORTRAN", "PNPBS_ARCH"}, options())
        self.assertNotIn("PNPBS_HAVE_MPI", options())

    def test_are_those_of_the_page(self):
        page = (SOURCE / "docs/building.md").read_text()
        self.assertEqual(set(re.findall(r"^\| `(PNPBS_\w+)`", page, re.M)), options())


class Spack(unittest.TestCase):
    recipe = spack_recipe.Recipe(SOURCE / "packaging/spack/package.py")

    def test_version(self):
        self.assertIn(VERSION, self.recipe.versions)
        self.assertIn(f"pnpbs-{VERSION}.", self.recipe.package.url)

    def test_says_honestly_that_there_is_no_release(self):
        # A real address requires a real checksum, and a placeholder requires a placeholder.
        released = ".invalid" not in self.recipe.package.url
        self.assertEqual(self.recipe.versions[VERSION] != ZEROS, released)

    def test_names_options_that_exist(self):
        for values in itertools.product((True, False), repeat=len(self.recipe.variants)):
            variants = dict(zip(self.recipe.variants, values))
            told = self.recipe.cmake_args(variants)
            ours = {option for option in told if option.startswith("PNPBS_")}
            self.assertLessEqual(ours, options())
            for option, variant in (("PNPBS_ENABLE_MPI", "mpi"), ("PNPBS_BUILD_CLI", "cli"),
                                    ("PNPBS_BUILD_FORTRAN", "fortran"),
                                    ("PNPBS_WITH_HDF5", "hdf5"),
                                    ("PNPBS_ENABLE_GEO", "geo"),
                                    ("PNPBS_INSTALL_STATIC", "static")):
                self.assertEqual(told[option], "ON" if variants[variant] else "OFF", option)

    def test_conditions_name_variants(self):
        self.assertGreater(len(list(self.recipe.all_conditions)), 5)
        for condition in self.recipe.all_conditions:
            for name in re.findall(r"[+~](\w+)", condition):
                self.assertIn(name, self.recipe.variants)

    def test_dependencies(self):
        def needed(**variants):
            all_variants = {**self.recipe.variants, **variants}
            return {re.match(r"[\w-]+", spec)[0] for spec, condition in self.recipe.dependencies
                    if spack_recipe.holds(condition, all_variants)}

        command = {"cli11", "nlohmann-json", "muparser", "cairo"}
        self.assertLessEqual(command | {"mpi", "metis", "kokkos", "fortran"}, needed())
        self.assertFalse(command & needed(cli=False))
        self.assertFalse({"mpi", "metis"} & needed(mpi=False))
        self.assertNotIn("gdal", needed(geo=False))
        self.assertIn("gdal", needed(geo=True))
        self.assertIn("zlib-api", needed(mpi=False, cli=False, hdf5=False))
        self.assertNotIn("hdf5", needed(hdf5=False))
        hdf5 = {mpi: [spec for spec, condition in self.recipe.dependencies if spec.startswith("hdf5")
                      and spack_recipe.holds(condition, {"hdf5": True, "mpi": mpi})]
                for mpi in (True, False)}
        self.assertEqual([len(specs) for specs in hdf5.values()], [1, 1])
        self.assertIn("~mpi", hdf5[False][0])
        self.assertNotIn("fortran", needed(fortran=False))
        self.assertIn("kokkos@4.5:5", " ".join(spec for spec, _ in self.recipe.dependencies))


class Yggdrasil(unittest.TestCase):
    path = SOURCE / "packaging/yggdrasil/build_tarballs.jl"
    text = path.read_text()
    script = re.search(r'^script = raw"""(.*?)^"""', text, re.S | re.M)[1]

    def test_names_options_that_exist(self):
        named = set(re.findall(r"-D(PNPBS_\w+)=", self.script))
        self.assertGreater(len(named), 3)
        self.assertLessEqual(named, options())

    def test_says_honestly_that_there_is_no_release(self):
        url, sha = re.search(r'ArchiveSource\("([^"]*/pnpbs-[^"]*)",\s*"(\w{64})"', self.text).groups()
        self.assertEqual(sha != ZEROS, ".invalid" not in url)

    def test_script_is_bash(self):
        subprocess.run(["bash", "-n"], input=self.script, text=True, check=True)

    @unittest.skipUnless(JULIA, "no Julia")
    def test_runs_against_a_stand_in(self):
        with tempfile.TemporaryDirectory() as folder:
            place = pathlib.Path(folder) / "P" / "PNPBS"
            place.mkdir(parents=True)
            shutil.copy(self.path, place)
            shutil.copytree(HERE / "stand_in" / "platforms", pathlib.Path(folder) / "platforms")
            environment = {**os.environ, "JULIA_DEPOT_PATH": f"{folder}/depot",
                           "JULIA_LOAD_PATH": f"@stdlib:{HERE / 'stand_in'}"}
            told = subprocess.run(
                [JULIA, "--startup-file=no", "--compiled-modules=no", "-O0", "build_tarballs.jl"],
                cwd=place, env=environment, check=True, capture_output=True, text=True).stdout
        lines = told.splitlines()
        for line in ("name: PNPBS", f"version: {VERSION}", "platform: linux 64 glibc",
                     "product: libpnpbs", "dependency: METIS_jll", "dependency: Zlib_jll",
                     "dependency: MPICH_jll"):
            self.assertIn(line, lines)
        self.assertEqual(sum(line.startswith("platform: ") for line in lines), 1)
        self.assertTrue(any(f"/pnpbs-{VERSION}.tar.gz " in line for line in lines), told)


class Conda(unittest.TestCase):
    """The recipe is read by PyYAML. Conditions on MPI are evaluated for each variant."""

    recipe = yaml.safe_load((SOURCE / "packaging/conda/recipe.yaml").read_text())
    variants = yaml.safe_load((SOURCE / "packaging/conda/variants.yaml").read_text())["mpi"]

    def needed(self, section, mpi):
        """Returns the names of the packages that a section requires in a variant of MPI."""
        names = set()
        for entry in self.recipe["requirements"][section]:
            if isinstance(entry, dict):
                self.assertEqual(set(entry), {"if", "then"})
                self.assertEqual(entry["if"], 'mpi != "nompi"')
            given = [entry] if isinstance(entry, str) else entry["then"] if mpi != "nompi" else []
            names.update(name.replace("${{ mpi }}", mpi).split()[0] for name in given)
        return names

    def test_version(self):
        self.assertEqual(self.recipe["context"]["version"], VERSION)
        self.assertIn("pnpbs-${{ version }}.", self.recipe["source"]["url"])

    def test_says_honestly_that_there_is_no_release(self):
        self.assertEqual(self.recipe["source"]["sha256"] != ZEROS, ".invalid" not in self.recipe["source"]["url"])

    def test_names_options_that_exist(self):
        named = set(re.findall(r"(?:-D|cmake\.define\.)(PNPBS_\w+)=", " ".join(self.recipe["build"]["script"])))
        self.assertGreater(len(named), 5)
        self.assertLessEqual(named, options() | {"PNPBS_LIBRARY"})

    def test_dependencies(self):
        self.assertIn("nompi", self.variants)
        for mpi in self.variants:
            host, run = self.needed("host", mpi), self.needed("run", mpi)
            self.assertLessEqual({"kokkos", "hdf5", "zlib", "libgdal-core", "cairo", "muparser", "cli11",
                                  "nlohmann_json", "scikit-build-core"}, host)
            self.assertLessEqual({"python", "numpy", "hdf5", "zlib"}, run)
            for package, section in (("metis", host), (mpi, host), ("metis", run), ("mpi4py", run)):
                self.assertEqual(package in section, mpi != "nompi", (package, mpi))


class Release(unittest.TestCase):
    workflow = yaml.safe_load((SOURCE / "packaging/github/release.yml").read_text())

    def test_names_what_exists(self):
        (build,) = [step for step in self.workflow["jobs"]["wheels"]["steps"] if "cibuildwheel" in step["uses"]]
        self.assertTrue((SOURCE / build["with"]["package-dir"] / "pyproject.toml").exists())
        settings = re.findall(r"cmake\.define\.(PNPBS_\w+)=", build["env"]["CIBW_CONFIG_SETTINGS"])
        self.assertGreater(len(settings), 1)
        of_wheel = options([SOURCE / "bindings/python/CMakeLists.txt"])
        self.assertLessEqual(set(settings), options() | of_wheel)
        program = re.search(r"\{project\}/(\S+)", build["env"]["CIBW_TEST_COMMAND"])[1]
        self.assertTrue((SOURCE / program).exists())

    def test_only_tags_are_published(self):
        publish = self.workflow["jobs"]["publish"]
        self.assertEqual(publish["if"], "startsWith(github.ref, 'refs/tags/v')")
        self.assertEqual(set(publish["needs"]), {"wheels", "archive"})
        self.assertEqual(publish["permissions"], {"id-token": "write"})
        for job in self.workflow["jobs"].values():
            for step in job["steps"]:
                self.assertFalse("password" in str(step) or "token" in str(step), step)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
