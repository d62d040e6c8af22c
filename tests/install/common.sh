# SPDX-License-Identifier: BSD-3-Clause
# shellcheck shell=sh disable=SC2154  # variables of settings.sh
# Common parts of the scripts: a working folder, and functions that build and check programs.
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
unset DESTDIR CFLAGS CXXFLAGS FFLAGS LDFLAGS CPPFLAGS
export PKG_CONFIG_PATH="$prefix/$libdir/pkgconfig"
# These variables make MPI's compiler commands call the compilers under test.
export OMPI_CC="$cc" OMPI_FC="$fc" MPICH_CC="$cc" MPICH_FC="$fc"

say() { printf '== %s\n' "$*"; }

fail() {
  printf 'WRONG: %s\n' "$*"
  exit 1
}

nothing_to_test() {
  say "$*"
  exit 77
}

# Runs a command and prints its output only if it fails.
quietly() {
  "$@" > "$work/log" 2>&1 || {
    cat "$work/log"
    fail "$*"
  }
}

# Builds a project. Arguments: source folder, build folder, options of CMake.
build_with_cmake() {
  from=$1 to=$2
  shift 2
  quietly "$cmake" -S "$from" -B "$to" -DCMAKE_PREFIX_PATH="$prefix" "$@"
  quietly "$cmake" --build "$to"
}

# Runs a command on ranks. Arguments: number of ranks, command.
on_ranks() {
  ranks=$1
  shift
  "$mpirun" --oversubscribe --bind-to none --mca mpi_yield_when_idle 1 -np "$ranks" "$@"
}

# Runs a command, checks its output, and compares its check lines with those of the previous run.
run_and_compare() {
  "$@" > "$work/output" < /dev/null || fail "exit status $? of $*"
  sed 's/^/   /' "$work/output"
  awk -f "$scripts/check_lines.awk" "$work/output" || fail "$*"
  grep ', *expected' "$work/output" > "$work/check_lines"
  if [ -e "$work/check_lines_before" ]; then
    diff "$work/check_lines_before" "$work/check_lines" || fail "differs from the run before: $*"
  fi
  mv "$work/check_lines" "$work/check_lines_before"
}
