#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# A library exports the functions that its headers declare, at their version, and nothing else.
# usage: exports.sh <library> <compiler> <include folder> [<prefix>]
# With a prefix it is the library of the functions that begin with it; pnpbs_geo_ are never
# libpnpbs's own.
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

# After the preprocessor, PNPBS_API is the attribute below, right before each function's type.
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
# "<" lines are declared but not exported, ">" lines the other way round.
diff "$work/declared" "$work/exported"
