#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Tests which packages scripts/setup.sh requests from apt-get if something is missing. Nothing is
# installed.
# usage: setup_needs.sh <source folder> <C++ compiler>
set -euo pipefail
source=$1 cxx=$(command -v "$2")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# This compiler fails if the code includes the header $HIDDEN.
cat > "$work/compiler" << COMPILER
#!/bin/sh
case "\$*" in *" -") ;; *) exec "$cxx" "\$@" ;; esac
code=\$(cat)
case \$code in *"\$HIDDEN"*) exit 1 ;; esac
printf '%s\n' "\$code" | "$cxx" "\$@"
COMPILER
printf '#!/bin/sh\nexit 100\n' > "$work/apt-get"
printf '#!/bin/sh\nexec "$@"\n' > "$work/sudo"
chmod +x "$work"/*

asks_for() { # arguments: hidden header, package, options of setup.sh
  local hidden=$1 package=$2 status=0
  shift 2
  HIDDEN=$hidden CXX=$work/compiler PATH=$work:$PATH HDF5_ROOT='' "$source/scripts/setup.sh" "$@" \
    > "$work/told" 2>&1 || status=$?
  if [ $status != 1 ] || ! grep -q "could not install these; missing:.* $package\( \|$\)" "$work/told"; then
    echo "without $hidden, setup.sh $* ends with $status and asks not for $package:"
    cat "$work/told"
    exit 1
  fi
}

asks_for metis.h libmetis-dev
asks_for hdf5 libhdf5-dev
asks_for hdf5 libhdf5-dev --tests
asks_for CGAL libcgal-dev --all
echo "setup.sh asks for what is missing"
