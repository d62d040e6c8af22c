#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Tests an installed example by building it in the documented ways: with its Makefile, which uses
# only pkg-config, and with its CMakeLists.txt, which uses only find_package. Examples in C++ have
# only the latter. Every number that an example checks must be right, and the same from both builds
# and, for an example with MPI, on any number of ranks.
# usage: example.sh <settings> <c, cpp or fortran> <name> [numbers of ranks]
# shellcheck disable=SC1090,SC1091,SC2154  # what settings.sh and common.sh define
set -eu
. "$1"
. "$scripts/common.sh"
language=$2 name=$3 rank_counts=${4:-1 3}
folder=$prefix/$datadir/pnpbs/examples/$language/$name

on_mpi=no
if grep -qiE 'pnpbs_mpi\.h|<mpi\.h>|mpif\.h|use +(, *intrinsic *:: *)?mpi' "$folder"/*.[cfF]*; then
  on_mpi=yes
  [ "$with_mpi" = 1 ] || nothing_to_test "$name is on MPI, and this build has none"
fi

if grep -q '<petsc' "$folder"/*.c 2> /dev/null && ! pkg-config --exists petsc; then
  nothing_to_test "$name needs PETSc, and pkg-config knows none"
fi

# Skips the test unless CMake finds a C++ package as the example needs it. Arguments: CMake lines
# that find it, its name.
require_package() {
  mkdir "$work/probe"
  printf '%s\n' "cmake_minimum_required(VERSION 3.22)" "project(probe LANGUAGES C CXX)" "$1" \
    > "$work/probe/CMakeLists.txt"
  "$cmake" -S "$work/probe" -B "$work/probe/build" -DCMAKE_C_COMPILER="$cc" \
    -DCMAKE_CXX_COMPILER="$cxx" > "$work/log" 2>&1 ||
    nothing_to_test "$name needs $2, and CMake finds none"
}

if grep -q 'find_package(deal\.II' "$folder/CMakeLists.txt"; then
  require_package 'find_package(deal.II 9.4 REQUIRED)
if(NOT DEAL_II_WITH_MPI OR NOT DEAL_II_WITH_TRILINOS)
  message(FATAL_ERROR "without MPI or Trilinos")
endif()' "deal.II 9.4 with MPI and Trilinos"
fi

if grep -q 'find_package(MFEM' "$folder/CMakeLists.txt"; then
  require_package 'find_package(MFEM 4.5 REQUIRED)
if(NOT MFEM_USE_MPI)
  message(FATAL_ERROR "without MPI")
endif()' "MFEM 4.5 with MPI"
fi

# Prints flags for Fortran. Invalid operations trap. Free-form source is checked strictly, whereas
# older code has its own flags.
fortran_flags() {
  [ "$fc_id" = GNU ] || return 0
  echo "-ffpe-trap=invalid,zero,overflow"
  for source_file in "$folder"/*.[fF] "$folder"/*.for; do
    [ ! -e "$source_file" ] || return 0
  done
  echo "-std=f2003 -fimplicit-none -Wall -Werror"
}
c_flags="-std=c99 -O2 -Wall -Wextra -pedantic -Werror"
# deal.II adds options of GCC, which other compilers may not have.
cxx_flags="-Wall -Wextra -Werror -Wno-unknown-warning-option"

make_it() {
  if [ "$language" = c ]; then
    # CC is set in the environment, since an example with MPI names its compiler itself.
    CC=$cc quietly make -C "$work/make" CFLAGS="$c_flags" PKG_CONFIG_PATH="$PKG_CONFIG_PATH"
  else
    compiler=$fc
    [ $on_mpi = no ] || compiler=mpifort
    quietly make -C "$work/make" FC="$compiler $(fortran_flags | tr '\n' ' ')" \
      PKG_CONFIG_PATH="$PKG_CONFIG_PATH"
  fi
}

cmake_it() {
  if [ "$language" = c ]; then
    build_with_cmake "$folder" "$work/cmake" -DCMAKE_C_COMPILER="$cc" -DCMAKE_C_FLAGS="$c_flags"
  elif [ "$language" = cpp ]; then
    build_with_cmake "$folder" "$work/cmake" -DCMAKE_CXX_COMPILER="$cxx" \
      -DCMAKE_CXX_FLAGS="$cxx_flags"
  else
    build_with_cmake "$folder" "$work/cmake" -DCMAKE_Fortran_COMPILER="$fc" \
      -DCMAKE_Fortran_FLAGS="$(fortran_flags | tr '\n' ' ')"
  fi
}

first=cmake
if [ -e "$folder/Makefile" ]; then
  first="make"
  say "$name with pkg-config"
  cp -r "$folder" "$work/make"
  (unset CMAKE_PREFIX_PATH && make_it)
fi
say "$name with CMake"
(unset PKG_CONFIG_PATH && cmake_it)

if [ $on_mpi = yes ]; then
  export OMP_NUM_THREADS=1
  # The last number of ranks runs CMake's build, and the others run make's.
  for ranks in $rank_counts; do
    build=$first
    [ "$ranks" != "${rank_counts##* }" ] || build=cmake
    say "$build's on $ranks ranks"
    run_and_compare on_ranks $ranks "$work/$build/$name"
  done
else
  OMP_NUM_THREADS=2 run_and_compare "$work/$first/$name"
  OMP_NUM_THREADS=1 run_and_compare "$work/cmake/$name"
fi
