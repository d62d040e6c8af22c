# SPDX-License-Identifier: BSD-3-Clause
# Judges what an example printed by the example's own words, and fails if one does not hold:
#
#   <what>: <number>, expected <number>             the same number
#   <what>: <number>, expected about <number>       within 4 %
#   <what>: <number>, expected at least <number>
#   <what>: <number>, expected at most <number>
#
# Other lines are free, but one that says ", expected" and is none of these (nan, a missing number)
# fails, and so does an output without any check.
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
