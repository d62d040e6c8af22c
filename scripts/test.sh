#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Sets up a fresh machine up to the last test: installs what is missing, builds, and runs the tests
# of one or more configurations.
#
#   quick     the default: the release build and the tests that find most faults in the shortest
#             time, for every module and every language available, on one and several ranks. The
#             list is tests/selections.cmake
#   full      the release build with all tests except those of nightly. After quick in one call,
#             only the tests that quick leaves out
#   nightly   searches for differences between ranks with the date as seed, soak tests, studies, and
#             long tests of what shorter ones cover too; the build of full
#   sanitize  with Clang and address and undefined-behaviour sanitizers, including mutated input, on
#             the oldest supported Kokkos; without Fortran, whose compiler cannot link with Clang's
#             sanitizers. The shorter tests of the interface, of ranks and of the command; the list is
#             in tests/selections.cmake
#   sanitize-all  the same build with all of these tests that make sense there
#   no-mpi    without MPI, with the static library, on a shared Kokkos of a host program. Tests of
#             what can differ: linkage, installed copies, some tests of each language
#   inner     as sanitize, for the internal tests (tests/geometry, tests/core)
#   files     compiles every file separately with Clang, as users' builds without a preset do; no
#             tests
#
# usage: scripts/test.sh [configuration]...
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
root=$PWD

wanted=("$@")
if [ ${#wanted[@]} -eq 0 ]; then wanted=(quick); fi
is_wanted() { case " ${wanted[*]} " in *" $1 "*) ;; *) return 1 ;; esac; }

setup=(--tests)
for configuration in "${wanted[@]}"; do
  case $configuration in
    quick) ;;
    full | nightly) setup+=(--all) ;;
    sanitize | sanitize-all | inner | files) setup+=(--all --kokkos 4.5.1-clang) ;;
    no-mpi) setup+=(--kokkos 4.7.0-shared) ;;
    *)
      echo "test.sh: unknown configuration '$configuration'; there are quick, full, nightly, sanitize," \
        "sanitize-all, no-mpi, inner and files" >&2
      exit 2
      ;;
  esac
done

started=$SECONDS
failed=()
summary=()
say() { printf '\n== %s (after %d s)\n' "$*" $((SECONDS - started)); }

say "setting up"
scripts/setup.sh "${setup[@]}"

if command -v ninja > /dev/null; then export CMAKE_GENERATOR=${CMAKE_GENERATOR:-Ninja}; fi
export CMAKE_BUILD_PARALLEL_LEVEL=${CMAKE_BUILD_PARALLEL_LEVEL:-$(nproc)}
export CTEST_PARALLEL_LEVEL=${CTEST_PARALLEL_LEVEL:-$(nproc)}
# ccache avoids compiling again what was compiled before, in this clone or another.
if command -v ccache > /dev/null; then
  export CMAKE_C_COMPILER_LAUNCHER=ccache CMAKE_CXX_COMPILER_LAUNCHER=ccache
  export CCACHE_BASEDIR=$root CCACHE_NOHASHDIR=1 CCACHE_SLOPPINESS=pch_defines,time_macros
fi

say "checking the format"
# Versions of clang-format differ in their output; the files are formatted with version 14.
if clang-format --version | grep -q 'version 14\.'; then
  find include src tests examples \( -name '*.h' -o -name '*.hpp' -o -name '*.c' -o -name '*.cpp' \) \
    -print0 | xargs -0 clang-format --dry-run --Werror || failed+=(format)
else
  echo "left out: not clang-format 14"
fi

# scripts/run.sh builds in the same folder, without Fortran.
fortran=()
if command -v "${FC:-gfortran}" > /dev/null; then fortran=(-DPNPBS_BUILD_FORTRAN=ON); fi

configure() { # folder under build, options of CMake
  local name=$1 log
  shift
  log=$(mktemp)
  if ! cmake -B "build/$name" -DPNPBS_WARNINGS_AS_ERRORS=ON "$@" > "$log" 2>&1; then
    cat "$log"
    exit 1
  fi
  rm -f "$log"
}

run_tests() { # configuration, folder under build, options of ctest
  local name=$1 folder=$2 log=build/$2/ctest_$1.log
  shift 2
  say "testing $name"
  if ! ctest --test-dir "build/$folder" --output-on-failure --no-tests=error "$@" | tee "$log"; then
    failed+=("$name")
  fi
  summary+=("$(printf '%-10s %s, after %d s' "$name" "$(grep -E 'tests (passed|failed)' "$log" || true)" \
    $((SECONDS - started)))")
}

for configuration in "${wanted[@]}"; do
  say "building $configuration"
  case $configuration in
    quick)
      configure release --preset release ${fortran[@]+"${fortran[@]}"}
      cmake --build build/release --target pnpbs-quick-tests
      run_tests quick release -L '^quick$'
      ;;
    full)
      configure release --preset release ${fortran[@]+"${fortran[@]}"}
      cmake --build build/release
      if is_wanted quick; then
        run_tests full release -LE '^(quick|nightly)$'
      else
        run_tests full release -LE '^nightly$'
      fi
      ;;
    nightly)
      configure release --preset release ${fortran[@]+"${fortran[@]}"}
      cmake --build build/release
      run_tests nightly release -L '^nightly$' --verbose
      ;;
    sanitize)
      configure sanitize --preset sanitize -DPNPBS_TEST_FOLDERS="api;parallel;linkage;tool"
      cmake --build build/sanitize --target pnpbs-sanitize-tests
      run_tests sanitize sanitize -L '^sanitize$'
      ;;
    sanitize-all)
      configure sanitize --preset sanitize -DPNPBS_TEST_FOLDERS="api;parallel;linkage;tool"
      cmake --build build/sanitize
      run_tests sanitize-all sanitize -LE '^(many-runs|figures|nightly)$'
      ;;
    inner)
      configure inner --preset sanitize -DPNPBS_TEST_FOLDERS="geometry;core"
      cmake --build build/inner
      run_tests inner inner -LE '^(many-runs|figures|nightly)$'
      ;;
    files)
      configure files --preset debug -DCMAKE_C_COMPILER=clang -DCMAKE_CXX_COMPILER=clang++ \
        -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON -DPNPBS_BUILD_FORTRAN=OFF \
        -DKokkos_ROOT="$root/.deps/kokkos-4.5.1-clang"
      cmake --build build/files
      ;;
    no-mpi)
      configure no-mpi -DPNPBS_BUILD_TESTS=ON -DPNPBS_ENABLE_MPI=OFF \
        -DPNPBS_INSTALL_STATIC=ON -DCMAKE_UNITY_BUILD=ON -DCMAKE_CXX_FLAGS_RELEASE="-O1 -DNDEBUG" \
        -DPNPBS_TEST_FOLDERS="api;geo;fortran;linkage;julia;python;install" \
        -DKokkos_ROOT="$root/.deps/kokkos-4.7.0-shared"
      cmake --build build/no-mpi --target pnpbs-no-mpi-tests
      run_tests no-mpi no-mpi -L '^no-mpi$'
      ;;
  esac
done

say "done"
printf '%s\n' "${summary[@]}"
if [ ${#failed[@]} -gt 0 ]; then
  echo "Failed: ${failed[*]}"
  exit 1
fi
