#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Tests that a library exports the functions that its headers declare, with their version, and
# nothing else.
# usage: exports.sh <library> <compiler> <include folder> [<prefix>]
# With a prefix, the library is the one of the functions that begin with it. Without one it is
# libpnpbs, which does not have the functions pnpbs_geo_*.
set -eu
prefix=${4:-}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

of_this_library() {
  if [ -n "$prefix" ]; then
    grep "^T $prefix"
  else
    grep -v '^T pnpbs_geo_'
  fi
}

# The preprocessor replaces PNPBS_API by the attribute below, which precedes the type of each
# function.
for header in "$3"/pnpbs/pnpbs*.h; do
  echo "#include <pnpbs/$(basename "$header")>"
done > "$work/headers.c"
"$2" -E -P -I "$3" "$work/headers.c" | tr '\n' ' ' |
  grep -oE 'visibility\("default"\)\)\) [^(]*\(' |
  sed -E 's/.*[ *](pnpbs_[a-z0-9_]+) *\($/T \1@@PNPBS_1/' | of_this_library | sort > "$work/declared"
nm -D --defined-only --with-symbol-versions "$1" | sed -E 's/^[0-9a-f]+ //' |
  grep -v '^A PNPBS_1$' | sort > "$work/exported"

if ! [ -s "$work/declared" ]; then
  echo "no declarations found in $3" >&2
  exit 1
fi
# Lines with "<" are declared but not exported, and lines with ">" are exported but not declared.
diff "$work/declared" "$work/exported"
