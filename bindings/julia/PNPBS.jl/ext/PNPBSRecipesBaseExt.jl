# SPDX-License-Identifier: BSD-3-Clause
# Recipes of Plots.jl for placements and domains. Julia 1.9 and later load this extension with PNPBS
# and RecipesBase, on which Plots.jl depends.
module PNPBSRecipesBaseExt

import PNPBS
using RecipesBase

@recipe function f(placement::PNPBS.Placement; edges = :triangles)
    points, path = PNPBS.picture(placement, edges)
    aspect_ratio --> :equal
    legend --> false
    @series begin
        seriestype := :path
        linecolor --> :gray
        linewidth --> 0.5
        path
    end
    seriestype := :scatter
    markersize --> 2
    markerstrokewidth --> 0
    points[1, :], points[2, :]
end

@recipe function f(domain::PNPBS.Domain)
    aspect_ratio --> :equal
    legend --> false
    PNPBS.broken_path(PNPBS.outline(domain).segments)
end

end
