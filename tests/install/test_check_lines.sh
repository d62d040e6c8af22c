#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Tests that check_lines.awk accepts expectations that hold, and nothing else.
# usage: test_check_lines.sh
set -u
rules=$(dirname "$0")/check_lines.awk
failures=0

judge() { printf '%s\n' "$1" | awk -f "$rules" > /dev/null; }

passes() {
  if ! judge "$1"; then
    echo "should pass: $1"
    failures=$((failures + 1))
  fi
}

fails() {
  if judge "$1"; then
    echo "should fail: $1"
    failures=$((failures + 1))
  fi
}

passes 'nodes: 80, expected 80'
passes 'nodes: -3, expected -3'
passes 'area: 1.50, expected 1.5'
passes 'nodes: 518, expected about 503'
passes 'nodes: 490, expected about 503'
passes 'slope: -1.03, expected about -1'
passes 'exactly: 0, expected about 0'
passes 'rate: 1.91, expected at least 1.8'
passes 'rate: 1.8, expected at least 1.8'
passes 'error: 3.2e-05, expected at most 1e-4'
passes 'error:   0.32E-04, expected at most  1.E-4'
passes 'error: .5, expected at most 0.5'
passes 'a: b: 2, expected 2'
passes "$(printf 'anything else\n\nnodes: 80, expected 80\nfinished after 3 frames')"

fails ''
fails 'nodes: 80'
fails 'all is as expected'
fails 'nodes: 81, expected 80'
fails 'nodes: -3, expected 3'
fails 'area: 1.5000001, expected 1.5'
fails 'nodes: 524, expected about 503'
fails 'nodes: 482, expected about 503'
fails 'slope: 1, expected about -1'
fails 'exactly: 0.001, expected about 0'
fails 'rate: 1.79, expected at least 1.8'
fails 'rate: -2, expected at least 1.8'
fails 'error: 3.2e-03, expected at most 1e-4'
fails 'error: nan, expected at most 1e-4'
fails 'error: -nan, expected 0'
fails 'error: inf, expected at least 1'
fails 'error: ****, expected at most 1e-4'
fails 'error: , expected at most 1e-4'
fails 'nodes: 80, expected'
fails 'nodes: 80, expected some'
fails 'nodes: 80, expected nearly 80'
fails 'nodes: 80, expected 80 or 81'
fails 'nodes: 8x, expected 8'
fails "$(printf 'nodes: 80, expected 80\nedges: 4, expected 5')"
fails "$(printf 'edges: 4, expected 5\nnodes: 80, expected 80')"
fails "$(printf 'nodes: 80, expected 80\nerror: nan, expected at most 1')"

[ "$failures" = 0 ] && echo "check lines are judged as they should be"
