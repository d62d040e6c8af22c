#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Tests the wheel, built from an existing library and used in a fresh environment. The examples
# check themselves by the lines that they print, and print the same on any number of ranks. Without
# MPI, a wheel that contains all libraries is built as well, as by scripts/wheel.sh.
# usage: wheel.sh <python> <bindings/python> <libpnpbs.so> <source folder> <mpiexec, or ''>
set -eu
python=$1 bindings=$2 library=$3 source=$4 mpiexec=$5
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
unset PNPBS_LIBRARY PYTHONPATH

# The library of shapes is put into the wheel where there is one.
geo=OFF tables=
if [ -e "$(dirname "$library")/libpnpbs_geo.so.0" ]; then
  geo=ON tables=$(pkg-config --variable=datadir proj)/..
fi

# The build tools, NumPy and mpi4py are those of the environment of the tests.
cp -r "$bindings" "$work/bindings"
# build <folder> <ON: with the library of shapes, or OFF>
build() {
  "$python" -m pip wheel --quiet --no-deps --no-build-isolation --disable-pip-version-check \
    -C cmake.define.PNPBS_LIBRARY="$library" -C cmake.define.PNPBS_ENABLE_GEO="$2" \
    -C cmake.define.PNPBS_PYTHON_GEO_TABLES="$tables" -w "$1" "$work/bindings"
}
build "$work" $geo
# The build must not leave files in the source folder.
diff -r -x __pycache__ "$bindings" "$work/bindings"
# install <environment> <wheel>
# Creates an environment with the wheel, and sets `site` to its folder of packages.
install() {
  "$python" -m venv --without-pip "$1"
  site=$("$1/bin/python" -c 'import sysconfig; print(sysconfig.get_path("purelib"))')
  "$python" -m pip install --quiet --no-deps --no-index --disable-pip-version-check \
    --target "$site" "$2"
  "$python" -c 'import sysconfig; print(sysconfig.get_path("purelib"))' > "$site/others.pth"
}
install "$work/fresh" "$work"/pnpbs-*.whl

# The wheel must also contain the library for each level of processors.
for level in "$(dirname "$library")"/glibc-hwcaps/*/; do
  [ ! -d "$level" ] ||
    cmp "$level/libpnpbs.so.0" "$site/pnpbs/lib/glibc-hwcaps/$(basename "$level")/libpnpbs.so.0"
done

cd "$work"
fresh=$work/fresh/bin/python
"$fresh" -c "
import pathlib, pnpbs
assert pathlib.Path(pnpbs.library_path()).is_relative_to('$site/pnpbs/lib'), pnpbs.library_path()
assert pnpbs.Context.__doc__ and pathlib.Path(pnpbs.__file__).with_name('py.typed').exists()
print(pnpbs.library_version())"

if [ $geo = ON ]; then
  echo '{"type": "Polygon", "coordinates": [[[0, 0], [1, 0], [1, 1], [0, 0]]]}' > triangle.geojson
  "$fresh" -c "
import pnpbs
with pnpbs.Context() as context, pnpbs.Shapes('triangle.geojson', projection='none') as shapes:
    area = shapes.add_to(pnpbs.Domain(context)).measure()
assert area == 0.5, area"
  # PROJ must find its tables in the wheel, not in the system.
  PROJ_DATA=/nowhere PROJ_LIB=/nowhere "$fresh" -c "
import pnpbs
with pnpbs.Context() as context, pnpbs.Shapes('triangle.geojson', projection='EPSG:3857') as shapes:
    area = shapes.add_to(pnpbs.Domain(context)).measure()
assert abs(area / 111319.49 ** 2 - 0.5) < 1e-3, area"
fi

for example in smallest laplace_ring adaptive_fem adaptive_rbf_fd; do
  for ranks in 0 1 2 4; do
    script=$source/examples/python/$example/$example.py
    if [ "$ranks" = 0 ]; then
      "$fresh" "$script" > output
    elif [ -n "$mpiexec" ] && [ $example = laplace_ring ]; then
      "$mpiexec" --oversubscribe --bind-to none --mca mpi_yield_when_idle 1 -np "$ranks" \
        "$fresh" "$script" --mpi < /dev/null > output
    else
      continue
    fi
    echo "== $example, ranks: $ranks"
    cat output
    awk -f "$source/tests/install/check_lines.awk" output
    [ -e "first_$example" ] || cp output "first_$example"
    cmp "first_$example" output
  done
done

PATH=$(dirname "$python"):$PATH
if [ -n "$mpiexec" ]; then
  echo "== with MPI, no wheel can hold everything"
  exit 0
fi
if ! "$python" -c 'import auditwheel' 2> /dev/null || ! command -v patchelf > /dev/null; then
  echo "== skipped: a wheel that holds everything, which needs auditwheel and patchelf"
  exit 77
fi
build "$work/plain" OFF
"$python" -m auditwheel repair -w "$work/repaired" "$work"/plain/pnpbs-*.whl > log 2>&1 || { cat log; exit 1; }
install "$work/alone" "$work"/repaired/pnpbs-*manylinux*.whl
# All libraries except those of the C library and of the compiler must be in the wheel.
find "$site" -name 'lib*.so*' | while read -r library; do
  env -i ldd "$library" | awk -v site="$site" '
    /not found/ { print; bad = 1 }
    /=> / && index($3, site) != 1 && $1 !~ /^lib(c|m|dl|pthread|rt|gcc_s|stdc\+\+)\.so/ { print; bad = 1 }
    END { exit bad }'
done
env -i "$work/alone/bin/python" "$source/examples/python/smallest/smallest.py" > output
cmp first_smallest output
echo "== the same from $(basename "$work"/repaired/*.whl)"
