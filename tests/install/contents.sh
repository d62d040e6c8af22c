#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Tests the installed tree file by file: it has all files that belong to it, no others, and no text
# that contains folders of the machine on which it was built.
# usage: contents.sh <settings>
# shellcheck disable=SC1090,SC1091,SC2154  # what settings.sh and common.sh define
set -eu
. "$1"
. "$scripts/common.sh"
cd "$prefix"
configuration=$(echo "${build_type:-noconfig}" | tr '[:upper:]' '[:lower:]')

# ------------------------------------------------------------------ expected files --------------
# Prints the files of a folder of the source tree as installed files. Arguments: the folder, its
# path in the prefix.
same_files() {
  (cd "$source/$1" && find . -type f ! -name .clang-format ! -path '*/__pycache__/*') |
    sed "s,^\.,$2,"
}

expected_files() {
  echo "$includedir/pnpbs/pnpbs.h"
  echo "$includedir/pnpbs/pnpbs_mpi.h"
  echo "$libdir/libpnpbs.so"
  echo "$libdir/libpnpbs.so.$soversion"
  echo "$libdir/libpnpbs.so.$version"
  for level in $levels; do
    echo "$libdir/glibc-hwcaps/$level/libpnpbs.so.$soversion"
    echo "$libdir/glibc-hwcaps/$level/libpnpbs.so.$version"
  done
  for file in Config ConfigVersion Targets "Targets-$configuration"; do
    echo "$libdir/cmake/pnpbs/pnpbs$file.cmake"
  done
  echo "$libdir/pkgconfig/pnpbs.pc"
  if [ "$with_mpi" = 1 ]; then
    echo "$libdir/pkgconfig/pnpbs-mpi.pc"
  fi
  if [ "$with_geo" = 1 ]; then
    echo "$includedir/pnpbs/pnpbs_geo.h"
    for ending in "" ".$soversion" ".$version"; do
      echo "$libdir/libpnpbs_geo.so$ending"
    done
    for file in GeoTargets "GeoTargets-$configuration"; do
      echo "$libdir/cmake/pnpbs/pnpbs$file.cmake"
    done
    echo "$libdir/pkgconfig/pnpbs-geo.pc"
  fi
  if [ "$with_static" = ON ]; then
    echo "$libdir/libpnpbs.a"
    echo "$libdir/cmake/pnpbs/pnpbsStatic.cmake"
  fi
  if [ "$with_command" = ON ]; then
    echo "$bindir/pnpbs"
    echo "$mandir/man1/pnpbs.1"
  fi
  for module in pnpbs_c pnpbs_calls pnpbs; do
    echo "$datadir/pnpbs/fortran/$module.f90"
    if [ -n "$fc" ]; then
      echo "$includedir/pnpbs/fortran/$module.mod"
    fi
  done
  if [ -n "$fc" ]; then
    echo "$libdir/libpnpbs_fortran.a"
    echo "$libdir/pkgconfig/pnpbs-fortran.pc"
    echo "$libdir/cmake/pnpbs/pnpbsFortranTargets.cmake"
    echo "$libdir/cmake/pnpbs/pnpbsFortranTargets-$configuration.cmake"
  fi
  if [ "$with_geo" = 1 ]; then
    for module in pnpbs_geo_c pnpbs_geo; do
      echo "$datadir/pnpbs/fortran/$module.f90"
      [ -z "$fc" ] || echo "$includedir/pnpbs/fortran/$module.mod"
    done
    if [ -n "$fc" ]; then
      echo "$libdir/libpnpbs_geo_fortran.a"
      echo "$libdir/pkgconfig/pnpbs-geo-fortran.pc"
      echo "$libdir/cmake/pnpbs/pnpbsGeoFortranTargets.cmake"
      echo "$libdir/cmake/pnpbs/pnpbsGeoFortranTargets-$configuration.cmake"
    fi
  fi
  for file in LICENSE README.md CHANGELOG.md CITATION.cff CONTRIBUTING.md; do
    echo "$datadir/doc/pnpbs/$file"
  done
  same_files docs "$datadir/doc/pnpbs/docs" | grep -v '/pnpbs\.1$'
  same_files abi "$datadir/doc/pnpbs/abi"
  same_files packaging "$datadir/doc/pnpbs/packaging"
  for link in examples include/pnpbs bindings/fortran; do
    echo "$datadir/doc/pnpbs/$link"
  done
  echo "$datadir/pnpbs/docs"
  same_files examples "$datadir/pnpbs/examples"
  same_files bindings/julia "$datadir/pnpbs/julia"
  same_files bindings/python/pnpbs "$datadir/pnpbs/python/pnpbs"
}

say "files ('<' is missing, '>' does not belong there)"
expected_files | sort > "$work/expected"
find . -not -type d | sed 's,^\./,,' | sort > "$work/found"
diff "$work/expected" "$work/found" || fail "not the files that should be there"

say "contents of what is copied"
for pair in include/pnpbs:$includedir/pnpbs bindings/julia:$datadir/pnpbs/julia \
  bindings/python/pnpbs:$datadir/pnpbs/python/pnpbs examples:$datadir/pnpbs/examples docs:$datadir/doc/pnpbs/docs; do
  same_files "${pair%%:*}" "${pair#*:}" | grep -v '/pnpbs\.1$' |
    { [ "$with_geo" = 1 ] && cat || grep -v '/pnpbs_geo\.h$'; } > "$work/copied"
  [ -s "$work/copied" ] || fail "$pair: no files"
  while read -r file; do
    cmp "$source/${pair%%:*}/${file#"${pair#*:}"/}" "$file"
  done < "$work/copied"
done

cmp "$datadir/doc/pnpbs/LICENSE" "$datadir/pnpbs/julia/PNPBS.jl/LICENSE" || fail "two licences"

# ------------------------------------------------------------------ the library -----------------
say "the library's names"
[ "$(readlink "$libdir/libpnpbs.so")" = "libpnpbs.so.$soversion" ] || fail "libpnpbs.so"
[ "$(readlink "$libdir/libpnpbs.so.$soversion")" = "libpnpbs.so.$version" ] ||
  fail "libpnpbs.so.$soversion"
readelf -d "$libdir/libpnpbs.so" > "$work/dynamic"
grep -q "SONAME.*\[libpnpbs\.so\.$soversion\]" "$work/dynamic" || fail "SONAME"
if [ "$kokkos_is_shared" = FALSE ]; then
  if grep -E 'NEEDED.*(libkokkos|libstdc)' "$work/dynamic"; then
    fail "Kokkos and the C++ library should be inside"
  fi
fi

# ------------------------------------------------------------------ folders of this machine -----
# Prints the texts in a file, also in a compressed one, that contain the source or the build folder.
named_folders() {
  case $1 in
    *.mod) gzip -dc "$1" ;;
    *) cat "$1" ;;
  esac | strings -a | grep -F -e "$source/" -e "$build/"
}

# Filters texts that are allowed. A Kokkos in .deps of the source tree is linked at its location:
# this is the rpath to a shared one, and appears in the output of pkg-config --static and in
# pnpbs::static. gfortran stores the names of source files for its messages and has no option
# against it.
allowed() {
  case $1 in
    *.so.* | *.pc | */pnpbsStatic.cmake) grep -vF "$kokkos_folder" ;;
    *libpnpbs_fortran.a | *libpnpbs_geo_fortran.a) grep -vF "$source/bindings/fortran/" ;;
    *) cat ;;
  esac
}

if [ "$build_type" = Release ]; then
  say "no folder of the machine that built it"
  find . -type f > "$work/files"
  while read -r file; do
    named_folders "$file" | allowed "$file" | sed "s,^,$file: ," || true
  done < "$work/files" > "$work/leaks"
  if [ -s "$work/leaks" ]; then
    fail "$(cat "$work/leaks")"
  fi
  # The search must find the folders in a file of the build tree.
  named_folders "$build/CMakeCache.txt" > "$work/leaks"
  [ -s "$work/leaks" ] || fail "the search finds nothing where there is something"
fi

# ------------------------------------------------------------------ links in the documents ------
# Links that lead out of the folder of the documents must lead to installed files.
say "links between installed documents"
for link in "$datadir/doc/pnpbs/examples" "$datadir/pnpbs/docs"; do
  case $(readlink "$link") in
    ../*) ;;
    *) fail "$link is no relative link" ;;
  esac
done
for folder in "$datadir/doc/pnpbs" "$datadir/pnpbs"; do
  python3 -B "$scripts/../docs/check_links.py" "$folder" || fail "links that lead nowhere"
done
