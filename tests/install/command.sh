#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Tests that the installed command finds its library after the tree was moved, and that it has a
# manual page.
# usage: command.sh <settings>
# shellcheck disable=SC1090,SC1091,SC2154  # what settings.sh and common.sh define
set -eu
. "$1"
. "$scripts/common.sh"
[ "$with_command" = ON ] || nothing_to_test "this build has no command"
export OMP_NUM_THREADS=2

command=$prefix/$bindir/pnpbs
"$command" --version | grep -F "$version" || fail "not version $version"
# The exit status 3 means that the step limit was reached and nodes were written.
"$command" --quiet --domain "$prefix/$datadir/pnpbs/examples/data/lake_victoria.poly" --spacing 5 \
  --output "$work/lake.node" || [ $? = 3 ]
[ -s "$work/lake.node" ] || fail "no nodes were written"

page=$prefix/$mandir/man1/pnpbs.1
grep -q "^\.TH PNPBS 1 .*\"PNPBS $version\"" "$page" || fail "the manual page is not of $version"
if command -v mandoc > /dev/null; then
  mandoc -Tlint "$page" || fail "mandoc -Tlint $page"
fi
if command -v groff > /dev/null; then
  groff -man -ww -Tutf8 -z "$page" 2> "$work/warnings"
  [ ! -s "$work/warnings" ] || fail "$(cat "$work/warnings")"
elif ! command -v mandoc > /dev/null; then
  nothing_to_test "the manual page was not formatted, as there is neither mandoc nor groff"
fi
