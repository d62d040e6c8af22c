# SPDX-License-Identifier: BSD-3-Clause
# Data for pictures of domains and placements in the plane, for any plotting package.

# Converts segments (2, 2, n) to x and y of one path that is interrupted by NaN after each segment.
function broken_path(segments)
    coordinate(c) = vec([segments[c, :, :]; fill(NaN, 1, size(segments, 3))])
    return coordinate(1), coordinate(2)
end

# Returns the pairs in symmetric lists, each once, (2, n). Ghosts have the highest indices and no
# list.
function pairs_in(lists)
    pairs = [k for (i, list) in enumerate(lists) for j in list if i < j for k in (i, j)]
    return reshape(pairs, 2, :)
end

function lists_to_draw(placement, edges)
    edges === :triangles && return stars(placement).neighbours
    edges === :adjacency && return adjacency(placement)
    edges === :none && return no_rows()
    throw(ArgumentError("edges is $(repr(edges)); :triangles, :adjacency or :none was expected"))
end

# Returns the nodes of this rank, and the path of the edges between them. Collective.
function picture(placement::Placement, edges)
    ndims(placement) == 2 || throw(ArgumentError(
        "placement has $(ndims(placement)) dimensions; one in the plane was expected"))
    points = nodes(placement).points
    ends = [points ghosts(placement).points]
    return points, broken_path(ends[:, pairs_in(lists_to_draw(placement, edges))])
end
