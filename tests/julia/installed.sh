#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Tests the installed package in a prefix that was moved: it must find the library beside it.
# usage: installed.sh <build folder> <cmake> <julia>
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
unset DESTDIR PNPBS_LIBRARY
"$2" --install "$1" --prefix "$work/first" > "$work/install.log"
mv "$work/first" "$work/moved"
export JULIA_LOAD_PATH="@stdlib:$work/moved/share/pnpbs/julia" JULIA_DEPOT_PATH="$work/depot"
# shellcheck disable=SC2016  # Julia's own
"$3" --startup-file=no --compiled-modules=no -e '
  using PNPBS
  path = PNPBS.LibPNPBS.library_path()
  startswith(path, ARGS[1]) || error("the library found is $path")' "$work/moved"
# The package is precompiled, as usual. The image must not contain any state of the library.
for turn in first second; do
  "$3" --startup-file=no -e '
    using PNPBS
    n = Context() do context
      domain = add_polyline!(Domain(context), [0 1 1 0; 0 0 1 1])
      node_count(initialise!(set_spacing!(x -> fill(0.1, size(x, 2)), Placement(domain))))
    end
    println(ARGS[1], ": ", n, " nodes"); n > 90 || exit(1)' "$turn"
done

# Pkg adds the package to an environment and runs its tests there. It requires a registry, which may
# be empty since the package has no dependencies.
registry=$work/depot/registries/Empty
mkdir -p "$registry"
cat > "$registry/Registry.toml" << 'REGISTRY'
name = "Empty"
uuid = "23338594-aafe-5451-b93e-139f81909106"
repo = "none"

[packages]
REGISTRY
unset JULIA_LOAD_PATH
"$3" --startup-file=no -e '
  using Pkg
  Pkg.activate(ARGS[1])
  Pkg.develop(PackageSpec(path = ARGS[2]))
  Pkg.test("PNPBS"; test_args = ["package"])' \
  "$work/environment" "$work/moved/share/pnpbs/julia/PNPBS.jl"
