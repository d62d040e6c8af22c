#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# On a fresh machine, everything up to the last test: installs what is missing, builds the
# library in every configuration that is promised, and tests each.
#
# The main configuration runs all tests. The others build and run those that can differ in them,
# chosen by folder under tests, or by label (a test's folder, or a word of its own):
#   sanitize  by Clang with address and undefined-behaviour sanitizers, mutated inputs included, on
#             the oldest Kokkos we promise; no Fortran, whose compiler cannot link with Clang's
#             sanitizers. Tests of the interface, of ranks and of the command
#   no-mpi    without MPI, and the static library, on a shared Kokkos as a user would bring it,
#             adopted from a host program; little optimised, which compiles in half of the time
#   inner     as sanitize, the tests of the inside (tests/geometry, tests/core). Not run by default:
#             they take as long as those of sanitize
#   files     every file compiled by itself, by Clang, as users' builds without a preset do; no
#             tests. Not run by default: it takes as long as all of sanitize
# usage: scripts/test.sh [configuration]...     (main, sanitize and no-mpi by default)
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
root=$PWD

wanted=("$@")
if [ ${#wanted[@]} -eq 0 ]; then
  wanted=(main sanitize no-mpi)
fi
started=$SECONDS
failed=()
summary=()
say() { printf '\n== %s (after %d s)\n' "$*" $((SECONDS - started)); }

say "setting up"
scripts/setup.sh --tests --kokkos 4.5.1-clang --kokkos 4.7.0-shared

if command -v ninja > /dev/null; then export CMAKE_GENERATOR=${CMAKE_GENERATOR:-Ninja}; fi
export CMAKE_BUILD_PARALLEL_LEVEL=${CMAKE_BUILD_PARALLEL_LEVEL:-$(nproc)}
export CTEST_PARALLEL_LEVEL=${CTEST_PARALLEL_LEVEL:-$(nproc)}
# What has been compiled before, in this clone or another, need not be compiled again.
if command -v ccache > /dev/null; then
  export CMAKE_C_COMPILER_LAUNCHER=ccache CMAKE_CXX_COMPILER_LAUNCHER=ccache
  export CCACHE_BASEDIR=$root CCACHE_NOHASHDIR=1 CCACHE_SLOPPINESS=pch_defines,time_macros
fi

say "checking the format"
# Versions of clang-format differ in taste; 14 is the one the files are written with.
if clang-format --version | grep -q 'version 14\.'; then
  find include src tests examples \( -name '*.h' -o -name '*.hpp' -o -name '*.c' -o -name '*.cpp' \) \
    -print0 | xargs -0 clang-format --dry-run --Werror || failed+=(format)
else
  echo "left out: not clang-format 14"
fi

configure_and_build() { # name, options of CMake
  local name=$1 log
  shift
  log=$(mktemp)
  say "building $name"
  if ! cmake -B "build/$name" -DPNPBS_WARNINGS_AS_ERRORS=ON "$@" > "$log" 2>&1; then
    cat "$log"
    exit 1
  fi
  rm -f "$log"
  cmake --build "build/$name"
}

run_tests() { # name, options of ctest
  local name=$1 log=build/$1/ctest.log
  shift
  say "testing $name"
  if ! ctest --test-dir "build/$name" --output-on-failure --no-tests=error "$@" | tee "$log"; then
    failed+=("$name")
  fi
  summary+=("$(printf '%-14s %s' "$name" "$(grep -E 'tests (passed|failed)' "$log" || true)")")
}

for configuration in "${wanted[@]}"; do
  case $configuration in
    main)
      configure_and_build release --preset release
      run_tests release
      ;;
    sanitize)
      configure_and_build sanitize --preset sanitize \
        -DPNPBS_TEST_FOLDERS="api;parallel;linkage;tool"
      run_tests sanitize -LE '^(many-runs|figures)$'
      ;;
    inner)
      configure_and_build inner --preset sanitize -DPNPBS_TEST_FOLDERS="geometry;core"
      run_tests inner -LE '^(many-runs|figures)$'
      ;;
    files)
      configure_and_build files --preset debug -DCMAKE_C_COMPILER=clang -DCMAKE_CXX_COMPILER=clang++ \
        -DPNPBS_BUILD_FORTRAN=OFF -DKokkos_ROOT="$root/.deps/kokkos-4.5.1-clang"
      ;;
    no-mpi)
      configure_and_build no-mpi -DPNPBS_BUILD_TESTS=ON -DPNPBS_ENABLE_MPI=OFF \
        -DPNPBS_INSTALL_STATIC=ON -DCMAKE_UNITY_BUILD=ON -DCMAKE_CXX_FLAGS_RELEASE="-O1 -DNDEBUG" \
        -DPNPBS_TEST_FOLDERS="api;geo;fortran;linkage;julia;python;install" \
        -DKokkos_ROOT="$root/.deps/kokkos-4.7.0-shared"
      run_tests no-mpi -LE '^(many-runs|figures|once)$'
      ;;
    *)
      echo "test.sh: unknown configuration '$configuration'" >&2
      exit 2
      ;;
  esac
done

say "done"
printf '%s\n' "${summary[@]}"
if [ ${#failed[@]} -gt 0 ]; then
  echo "Failed: ${failed[*]}"
  exit 1
fi
