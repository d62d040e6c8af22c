#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Installs what this machine lacks to build and run PNPBS, and builds Kokkos if there is none. It
# can be run repeatedly; existing installations are left unchanged.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

default_kokkos=4.7.0

usage() {
  cat <<TEXT
usage: scripts/setup.sh [--tests | --all] [--kokkos VERSION]...

  --tests           also install what the quick tests need
  --all             also install what all tests need: GDAL, CGAL, Julia, mypy
  --kokkos VERSION  also build this Kokkos, static, into .deps/kokkos-VERSION; with "-shared"
                    behind the version a shared one, with "-clang" one that Clang compiles.
                    Known versions: 4.7.0, 4.5.1

Packages are installed with apt-get, as root or through sudo; otherwise the script lists what is
missing. If CMake finds no Kokkos from 4.5 on, $default_kokkos is built into .deps/kokkos, from source
that comes from PyPI (pip's own settings say which index is asked). CC, CXX, CMAKE_PREFIX_PATH
and HDF5_ROOT are respected.
TEXT
}

with_tests=no
with_all=no
more_kokkos=()
while [ $# -gt 0 ]; do
  case $1 in
    --tests) with_tests=yes ;;
    --all) with_tests=yes with_all=yes ;;
    --kokkos)
      [ $# -gt 1 ] || { usage >&2; exit 2; }
      more_kokkos+=("$2")
      shift
      ;;
    -h | --help)
      usage
      exit 0
      ;;
    *)
      echo "setup.sh: unknown option '$1'" >&2
      usage >&2
      exit 2
      ;;
  esac
  shift
done

say() { printf '== %s\n' "$*"; }

# ---------------------------------------------------------------- packages ------------------
# Each requirement is a test on the machine and the Debian package that satisfies it, so a compiler,
# MPI or CMake from another source is accepted as well.
have() { command -v "$1" > /dev/null 2>&1; }
cxx() { have "${CXX:-c++}" && have "${CC:-cc}"; }
header() { echo "#include <$1>" | "${CXX:-c++}" -std=c++20 -E -x c++ - > /dev/null 2>&1; }
# Optional. Without HDF5 there are no checkpoints, no .vtkhdf and no .xdmf files.
hdf5() {
  header hdf5.h || header hdf5/serial/hdf5.h || header hdf5/openmpi/hdf5.h ||
    [ -e "${HDF5_ROOT:-/nowhere}/include/hdf5.h" ]
}
module() { have pkg-config && pkg-config --exists "$1"; }
new_cmake() {
  have cmake || return 1
  local v
  v=$(cmake --version | sed -n '1s/[^0-9]*\([0-9]*\)\.\([0-9]*\).*/\1 \2/p')
  # shellcheck disable=SC2086  # two words on purpose
  set -- $v
  [ "$1" -gt 3 ] || { [ "$1" -eq 3 ] && [ "$2" -ge 22 ]; }
}
new_venv() { have python3 && python3 -c 'import venv, ensurepip' 2> /dev/null; }
certificates() { [ -e /etc/ssl/certs/ca-certificates.crt ] || [ ! -e /etc/debian_version ]; }
clang_links() { echo 'int main() {}' | clang++ "$1" -x c++ - -o /dev/null > /dev/null 2>&1; }
wants_clang() { case " ${more_kokkos[*]-} " in *-clang\ *) ;; *) return 1 ;; esac; }
no_kokkos() { ! find_kokkos; }

# Tests whether CMake finds a Kokkos that is new enough, the user's or the one built here.
find_kokkos() {
  if [ -e .deps/kokkos/lib/cmake/Kokkos/KokkosConfig.cmake ]; then return 0; fi
  cxx && new_cmake || return 1
  local dir
  dir=$(mktemp -d)
  printf '%s\n' 'cmake_minimum_required(VERSION 3.22)' 'project(probe CXX)' \
    'find_package(Kokkos 4.5 REQUIRED CONFIG)' > "$dir/CMakeLists.txt"
  local found=0
  cmake -S "$dir" -B "$dir/build" > /dev/null 2>&1 || found=1
  rm -rf "$dir"
  return $found
}

missing() {
  # The compiler comes first, because the tests for headers need it.
  cxx || echo g++
  have make || have ninja || echo ninja-build
  new_cmake || echo cmake
  have pkg-config || echo pkg-config
  have mpicc || echo libopenmpi-dev
  have mpirun || echo openmpi-bin
  header metis.h || echo libmetis-dev
  hdf5 || echo libhdf5-dev
  header CLI/CLI.hpp || echo libcli11-dev
  header nlohmann/json.hpp || echo nlohmann-json3-dev
  module muparser || echo libmuparser-dev
  module cairo || echo libcairo2-dev
  if [ $with_tests = yes ]; then
    have ninja || echo ninja-build
    have make || echo make
    have clang-format || echo clang-format
    have ccache || echo ccache
    module check || echo check
    have "${FC:-gfortran}" || echo gfortran
    # Its Fortran module files, which some distributions package separately from mpicc.
    have mpifort || echo libopenmpi-dev
  fi
  if [ $with_all = yes ]; then
    # Optional to build; the tests read GeoJSON and shapefiles.
    have gdal-config || echo libgdal-dev
    header CGAL/Constrained_Delaunay_triangulation_2.h || echo libcgal-dev
  fi
  if wants_clang; then
    have clang && have clang++ || echo clang
    clang_links -fopenmp || echo libomp-dev
    clang_links -fsanitize=address,undefined || echo libclang-rt-dev
  fi
  if [ $with_tests = yes ] || [ ${#more_kokkos[@]} -gt 0 ] || no_kokkos; then
    new_venv || echo python3-venv
    certificates || echo ca-certificates
  fi
}

packages=$(missing | sort -u | tr '\n' ' ')
packages=${packages% }
if [ -n "$packages" ]; then
  as_root=()
  if [ "$(id -u)" != 0 ]; then as_root=(sudo); fi
  if ! have apt-get || { [ ${#as_root[@]} -gt 0 ] && ! have sudo; }; then
    {
      echo "setup.sh: missing on this machine (Debian's names): $packages"
      echo "setup.sh: install them, or run this script as root or with sudo on Debian or Ubuntu."
    } >&2
    exit 1
  fi
  say "installing $packages"
  # shellcheck disable=SC2086  # a list of words
  if ! { "${as_root[@]}" apt-get update -qq &&
    "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
      apt-get install -y -qq --no-install-recommends $packages > /dev/null; }; then
    echo "setup.sh: apt-get could not install these; missing: $packages" >&2
    exit 1
  fi
  packages=$(missing | sort -u | tr '\n' ' ')
  if [ -n "${packages% }" ]; then
    echo "setup.sh: still missing or too old after installing: $packages" >&2
    exit 1
  fi
fi

# ---------------------------------------------------------------- Python --------------------
# A separate environment: pip for the source packages, and the readers that the tests use.
python_environment() {
  if [ ! -x .deps/venv/bin/pip ]; then
    say "making a Python environment in .deps/venv"
    python3 -m venv .deps/venv
  fi
}

install_python() { # file of requirements
  local installed=.deps/venv/installed_$(basename "$1")
  if cmp -s "$1" "$installed"; then return; fi
  python_environment
  say "installing the Python packages of $1 into .deps/venv"
  .deps/venv/bin/pip install -q -r "$1"
  cp "$1" "$installed"
}
if [ $with_tests = yes ]; then install_python tests/requirements.txt; fi
if [ $with_all = yes ]; then install_python tests/requirements_all.txt; fi

# ---------------------------------------------------------------- Julia ---------------------
# For the tests of the Julia package, which are skipped without it.
if [ $with_all = yes ] && ! have julia && [ ! -x .deps/julia/bin/julia ]; then
  say "getting a Julia into .deps/julia"
  scripts/setup_julia.sh .deps/julia || say "no Julia: its tests will be left out"
fi

# ---------------------------------------------------------------- Kokkos --------------------
# Two source packages on PyPI contain the Kokkos releases, so a machine that reaches only package
# registries can build it.
build_kokkos() { # version, static, shared or clang, prefix
  local version=$1 kind=$2 prefix=$3 package package_version sum folder
  case $version in
    4.7.0)
      package=pygenten package_version=0.1.5 folder=tpls/kokkos
      sum=e620f05c742905e2db705d875f1cac92ef0ed453f9e6734e9beda26cc0f9cce7
      ;;
    4.5.1)
      package=pycompadre package_version=1.7.6 folder=kokkos
      sum=c766ec4d445ce076069be4b8c51a23ffac4ee79ea949ca86446bfd8c299b154c
      ;;
    *)
      echo "setup.sh: no source known for Kokkos '$version' (4.7.0 and 4.5.1 are)" >&2
      exit 2
      ;;
  esac
  local downloads=$PWD/.deps/downloads
  local archive=$downloads/$package-$package_version.tar.gz
  mkdir -p "$downloads"
  if ! echo "$sum  $archive" | sha256sum --check --status 2> /dev/null; then
    python_environment
    say "downloading Kokkos $version (in $package $package_version from PyPI)"
    # With the hash in a file, pip verifies the package before it runs any of it.
    echo "$package==$package_version --hash=sha256:$sum" > "$downloads/$package.txt"
    .deps/venv/bin/pip download -q --no-deps --no-binary "$package" --require-hashes \
      -r "$downloads/$package.txt" -d "$downloads"
    echo "$sum  $archive" | sha256sum --check --status
  fi

  say "building Kokkos $version, $kind, into ${prefix#"$PWD"/}"
  local work
  work=$(mktemp -d)
  rm -rf .deps/new
  tar -xzf "$archive" -C "$work" "$package-$package_version/$folder"
  local shared=OFF generator=() compilers=()
  if [ "$kind" = shared ]; then shared=ON; fi
  if [ "$kind" = clang ]; then
    compilers=(-DCMAKE_C_COMPILER=clang -DCMAKE_CXX_COMPILER=clang++)
  fi
  if have ninja; then generator=(-G Ninja); fi
  # No Kokkos_ARCH_*: Kokkos would pass its -march on to everything that links it. Its
  # performance-critical parts are in headers and compiled with the project's flags.
  if ! {
    cmake -S "$work/$package-$package_version/$folder" -B "$work/build" "${generator[@]}" "${compilers[@]}" \
      -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_STANDARD=20 -DCMAKE_CXX_EXTENSIONS=OFF \
      -DBUILD_SHARED_LIBS=$shared -DCMAKE_POSITION_INDEPENDENT_CODE=ON \
      -DKokkos_ENABLE_OPENMP=ON -DKokkos_ENABLE_SERIAL=ON \
      -DKokkos_ENABLE_TESTS=OFF -DKokkos_ENABLE_EXAMPLES=OFF -DKokkos_ENABLE_BENCHMARKS=OFF \
      -DCMAKE_INSTALL_LIBDIR=lib -DCMAKE_INSTALL_PREFIX="$prefix" &&
      cmake --build "$work/build" --parallel "$(nproc)" &&
      DESTDIR="$PWD/.deps/new" cmake --install "$work/build"
  } > "$work/log" 2>&1; then
    tail -n 40 "$work/log" >&2
    echo "setup.sh: building Kokkos failed; the whole log: $work/log" >&2
    exit 1
  fi
  # Installed in a temporary folder and moved, so that a prefix exists only when it is complete.
  rm -rf "$prefix"
  mv "$PWD/.deps/new$prefix" "$prefix"
  rm -rf "$work" "$PWD/.deps/new"
}

if no_kokkos; then
  build_kokkos $default_kokkos static "$PWD/.deps/kokkos"
fi
for wanted in ${more_kokkos[@]+"${more_kokkos[@]}"}; do
  prefix=$PWD/.deps/kokkos-$wanted
  if [ ! -e "$prefix/lib/cmake/Kokkos/KokkosConfig.cmake" ]; then
    case $wanted in
      *-clang) build_kokkos "${wanted%-clang}" clang "$prefix" ;;
      *-shared) build_kokkos "${wanted%-shared}" shared "$prefix" ;;
      *) build_kokkos "$wanted" static "$prefix" ;;
    esac
  fi
done

say "PNPBS has what it needs"
