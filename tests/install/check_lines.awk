# SPDX-License-Identifier: BSD-3-Clause
# Checks the output of an example by the lines in which the example states what it expects:
#
#   <what>: <number>, expected <number>             the same number
#   <what>: <number>, expected about <number>       within 4 %
#   <what>: <number>, expected at least <number>
#   <what>: <number>, expected at most <number>
#
# Fails if an expectation does not hold, if a line contains ", expected" but has none of these forms
# (nan, a missing number), or if there is no such line. Other lines are ignored.
# usage: awk -f check_lines.awk OUTPUT

BEGIN {
  number = "[-+]?([0-9]+[.]?[0-9]*|[.][0-9]+)([eE][-+]?[0-9]+)?"
  check = ": +" number ", expected +(about +|at least +|at most +)?" number " *$"
}

/, *expected/ {
  if (!match($0, check)) {
    wrong("not understood")
    next
  }
  checked++
  words = substr($0, RSTART + 1)
  split(words, part, /, expected +/)
  found = part[1] + 0
  wanted = part[2]
  kind = "equal"
  if (sub(/^about +/, "", wanted)) kind = "about"
  else if (sub(/^at least +/, "", wanted)) kind = "least"
  else if (sub(/^at most +/, "", wanted)) kind = "most"
  if (!holds(kind, found, wanted + 0)) wrong("does not hold")
}

END {
  if (!checked && !bad) {
    print "   WRONG: no line that can be checked"
    bad = 1
  }
  exit bad
}

function holds(kind, found, wanted) {
  if (kind == "least") return found >= wanted
  if (kind == "most") return found <= wanted
  if (kind == "about") return size(found - wanted) <= 0.04 * size(wanted)
  return found == wanted
}

function size(x) { return x < 0 ? -x : x }

function wrong(why) {
  print "   WRONG, " why ": " $0
  bad = 1
}
