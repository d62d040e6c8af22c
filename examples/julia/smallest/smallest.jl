# SPDX-License-Identifier: BSD-3-Clause
#
# The smallest program: places nodes in the unit square with the constant spacing 0.05.
# examples/c/smallest is the same program in C and explains the expected results.
using PNPBS

Context() do context
    square = add_polyline!(Domain(context), [0 1 1 0
                                             0 0 1 1])
    placement = Placement(square)
    set_spacing!(placement, 0.05)
    run!(placement)

    n = node_count(placement)
    boundary = count(!=(0), nodes(placement).tags)
    println("nodes: $n, expected about 503")
    println("on the boundary: $boundary, expected 80")
    println("triangles: $(size(triangles(placement), 2)), expected $(2n - boundary - 2)")
end
