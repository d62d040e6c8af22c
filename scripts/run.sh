#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Sets up a fresh machine up to a first result: installs what is missing, builds, places 104 000
# nodes in Lake Victoria, fine in its middle, and some ten thousand in a bracket. Writes lake.png
# and bracket.png (pictures; the bracket is cut open), lake.vtu and bracket.vtu (for ParaView) and a
# report of each to the folder out.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

scripts/setup.sh
if command -v ninja > /dev/null; then export CMAKE_GENERATOR=${CMAKE_GENERATOR:-Ninja}; fi
export CMAKE_BUILD_PARALLEL_LEVEL=${CMAKE_BUILD_PARALLEL_LEVEL:-$(nproc)}
cmake --preset release -DPNPBS_BUILD_TESTS=OFF -DPNPBS_BUILD_FORTRAN=OFF
cmake --build --preset release

mkdir -p out
build/release/bin/pnpbs --domain examples/data/lake_victoria.poly \
  --spacing '0.35 + 0.006*hypot(x,y)' \
  --output out/lake.png --output out/lake.vtu --report out/report.json
build/release/bin/pnpbs --domain examples/data/bracket.stl \
  --spacing '0.8 + 0.05*hypot(x-62, y-14)' \
  --output out/bracket.png --output out/bracket.vtu --report out/bracket.json
echo "See out/lake.png, out/bracket.png, the .vtu files and the reports there."
