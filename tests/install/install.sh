#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Installs into an empty prefix, moves the prefix, and there does what users do: builds the
# examples with pkg-config and with CMake, in C alone or in Fortran alone, and runs them and the
# command.
# usage: install.sh <build folder> <C compiler> <C++ compiler> <cmake> <Fortran compiler, or ''>
set -eu
build=$1 cc=$2 cxx=$3 cmake=$4 fc=$5
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
unset DESTDIR

say() { printf '== %s\n' "$*"; }

"$cmake" --install "$build" --prefix "$work/first" > "$work/install.log"
mv "$work/first" "$work/moved"
prefix=$work/moved
pc_folder=$(dirname "$(find "$prefix" -name pnpbs.pc)")
export OMP_NUM_THREADS=2

# Programs on MPI come with a library that has it.
with_mpi=$(grep -q '^PNPBS_ENABLE_MPI:BOOL=ON' "$build/CMakeCache.txt" && echo yes || echo no)
uses_mpi() { grep -q pnpbs_mpi.h "$1"/*.c; }

# Runs a program and judges it by the lines that it prints.
rules=$(dirname "$0")/check_lines.awk
run_and_compare() {
  "$@" > "$work/output" < /dev/null
  sed 's/^/   /' "$work/output"
  awk -f "$rules" "$work/output"
}

say "headers, each by itself"
for header in "$prefix"/include/pnpbs/*.h; do
  case $header in *pnpbs_mpi.h) continue ;; esac
  echo "#include <pnpbs/$(basename "$header")>" > "$work/header.c"
  "$cc" -std=c99 -Wall -Wextra -pedantic-errors -Werror -I "$prefix/include" \
    -fsyntax-only "$work/header.c"
  "$cxx" -std=c++11 -Wall -Wextra -pedantic-errors -Werror -I "$prefix/include" \
    -fsyntax-only -x c++ "$work/header.c"
done

for source in "$prefix"/share/pnpbs/examples/c/*/; do
  name=$(basename "$source")
  compiler=$cc on_ranks=''
  if uses_mpi "$source"; then
    [ "$with_mpi" = yes ] || continue
    compiler=mpicc on_ranks='mpirun --oversubscribe --bind-to none --mca mpi_yield_when_idle 1 -np 3'
  fi

  say "$name with pkg-config"
  cp -r "$source" "$work/$name"
  make -s -C "$work/$name" CC="$compiler" CFLAGS="-std=c99 -O2 -Wall -Wextra -pedantic -Werror" \
    PKG_CONFIG_PATH="$pc_folder"
  # shellcheck disable=SC2086  # words on purpose
  run_and_compare $on_ranks "$work/$name/$name"

  say "$name with CMake"
  "$cmake" -S "$source" -B "$work/$name/cmake" -DCMAKE_C_COMPILER="$cc" \
    -DCMAKE_PREFIX_PATH="$prefix" > "$work/cmake.log" || { cat "$work/cmake.log"; exit 1; }
  "$cmake" --build "$work/$name/cmake" > "$work/cmake.log" || { cat "$work/cmake.log"; exit 1; }
  # shellcheck disable=SC2086  # words on purpose
  run_and_compare $on_ranks "$work/$name/cmake/$name"
done

# An example in Fortran with CMake: source folder, build folder.
fortran_with_cmake() {
  "$cmake" -S "$1" -B "$2" -DCMAKE_Fortran_COMPILER="$fc" -DCMAKE_PREFIX_PATH="$prefix" \
    > "$work/cmake.log" || { cat "$work/cmake.log"; exit 1; }
  "$cmake" --build "$2" > "$work/cmake.log" || { cat "$work/cmake.log"; exit 1; }
}

if [ -n "$fc" ]; then
  for source in "$prefix"/share/pnpbs/examples/fortran/*/; do
    name=$(basename "$source")
    say "$name in Fortran with pkg-config"
    cp -r "$source" "$work/fortran_$name"
    make -s -C "$work/fortran_$name" FC="$fc" PKG_CONFIG_PATH="$pc_folder" \
      FFLAGS="-std=f2003 -fimplicit-none -Wall -Werror -ffpe-trap=invalid,zero,overflow"
    run_and_compare "$work/fortran_$name/$name"
    say "$name in Fortran with CMake"
    fortran_with_cmake "$source" "$work/fortran_$name/cmake"
    run_and_compare "$work/fortran_$name/cmake/$name"
  done

  say "smallest in Fortran as by another compiler, from the installed source"
  config=$(find "$prefix" -name pnpbsConfig.cmake)
  cp "$config" "$work/config"
  sed 's/set(pnpbs_fortran_built_by .*/set(pnpbs_fortran_built_by "Another 1")/' "$work/config" \
    > "$config"
  fortran_with_cmake "$prefix/share/pnpbs/examples/fortran/smallest" "$work/from_source"
  [ -e "$work/from_source/pnpbs_fortran/pnpbs.mod" ]
  run_and_compare "$work/from_source/smallest"
  cp "$work/config" "$config"
fi

archive=$(find "$prefix" -name libpnpbs.a)
if [ -n "$archive" ]; then
  say "smallest with the static library"
  # The compiler prefers a shared library that lies beside.
  mkdir "$work/static"
  cp "$archive" "$work/static"
  # shellcheck disable=SC2046  # words on purpose
  "$cc" -std=c99 "$prefix/share/pnpbs/examples/c/smallest/smallest.c" \
    $(PKG_CONFIG_PATH=$pc_folder pkg-config --cflags pnpbs) -o "$work/smallest_static" \
    -L "$work/static" $(PKG_CONFIG_PATH=$pc_folder pkg-config --static --libs-only-l pnpbs) \
    $(PKG_CONFIG_PATH=$pc_folder pkg-config --static --libs-only-other pnpbs)
  run_and_compare "$work/smallest_static"
fi

if [ -x "$prefix/bin/pnpbs" ]; then
  say "the command"
  "$prefix/bin/pnpbs" --version
  "$prefix/bin/pnpbs" --quiet --domain "$prefix/share/pnpbs/examples/data/lake_victoria.poly" \
    --spacing 5 --output "$work/lake.node" || [ $? = 3 ]
  [ -s "$work/lake.node" ]
fi
