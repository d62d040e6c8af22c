#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Installs into an empty prefix and moves the prefix. The other tests use this copy.
# usage: tree.sh <settings>
# shellcheck disable=SC1090,SC1091,SC2154  # what settings.sh and common.sh define
set -eu
. "$1"
unset DESTDIR
first=$(dirname "$prefix")/first
rm -rf "$first" "$prefix"
"$cmake" --install "$build" --prefix "$first"
mv "$first" "$prefix"
