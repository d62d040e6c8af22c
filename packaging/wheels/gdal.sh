#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Builds PROJ and GDAL with the formats of coasts and grids only: GeoJSON, shapefiles, GeoPackage,
# FlatGeobuf, GML, KML, GeoTIFF, NetCDF. A distribution's GDAL reads two hundred formats, and
# some of the hundred libraries behind them are under the GPL. This one needs none of those: its
# libraries have permissive terms or the LGPL, so that a wheel with it can be given away.
set -euo pipefail

usage() {
  cat <<TEXT
usage: packaging/wheels/gdal.sh PREFIX [PROJ_ARCHIVE GDAL_ARCHIVE]

Installs into PREFIX. Without archives of the sources it downloads those of the versions below. It
needs CMake, a C++ compiler, curl, and the headers of SQLite, expat, and NetCDF with HDF5.
TEXT
}

proj_version=9.1.1 gdal_version=3.6.2

case ${1:-} in
  "" | -*)
    usage
    exit 2
    ;;
esac
if [ $# -ne 1 ] && [ $# -ne 3 ]; then
  usage >&2
  exit 2
fi
prefix=$(realpath -m "$1")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

sources() { # name, archive or '', address
  mkdir "$work/$1"
  local archive=$2
  if [ -z "$archive" ]; then
    archive=$work/$1.tar
    curl -sSfL -o "$archive" "$3"
  fi
  tar -xf "$archive" -C "$work/$1" --strip-components 1
}

build() { # name, options of CMake
  local name=$1
  shift
  cmake -S "$work/$name" -B "$work/$name-build" -DCMAKE_BUILD_TYPE=Release \
    -DCMAKE_INSTALL_PREFIX="$prefix" -DCMAKE_INSTALL_LIBDIR=lib -DCMAKE_PREFIX_PATH="$prefix" \
    -DCMAKE_INSTALL_RPATH="$prefix/lib" -DBUILD_SHARED_LIBS=ON -DBUILD_TESTING=OFF "$@"
  cmake --build "$work/$name-build" --target install --parallel "$(nproc)"
}

sources proj "${2:-}" "https://download.osgeo.org/proj/proj-$proj_version.tar.gz"
sources gdal "${3:-}" "https://download.osgeo.org/gdal/$gdal_version/gdal-$gdal_version.tar.xz"
build proj -DBUILD_APPS=OFF -DENABLE_TIFF=OFF -DENABLE_CURL=OFF
formats=()
for format in GDAL_ENABLE_DRIVER_NETCDF OGR_ENABLE_DRIVER_SQLITE OGR_ENABLE_DRIVER_GPKG \
  OGR_ENABLE_DRIVER_FLATGEOBUF OGR_ENABLE_DRIVER_GML OGR_ENABLE_DRIVER_KML; do
  formats+=("-D$format=ON")
done
build gdal -DBUILD_APPS=OFF -DBUILD_PYTHON_BINDINGS=OFF -DBUILD_JAVA_BINDINGS=OFF \
  -DBUILD_CSHARP_BINDINGS=OFF -DGDAL_USE_EXTERNAL_LIBS=OFF -DGDAL_USE_INTERNAL_LIBS=ON \
  -DGDAL_USE_SQLITE3=ON -DGDAL_USE_EXPAT=ON -DGDAL_USE_NETCDF=ON \
  -DGDAL_BUILD_OPTIONAL_DRIVERS=OFF -DOGR_BUILD_OPTIONAL_DRIVERS=OFF "${formats[@]}"

for part in proj/COPYING gdal/LICENSE.TXT; do
  install -D -m 644 "$work/$part" "$prefix/share/doc/${part%/*}/copyright"
done
