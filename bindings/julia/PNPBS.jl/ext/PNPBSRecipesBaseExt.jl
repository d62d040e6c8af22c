# SPDX-License-Identifier: BSD-3-Clause
# Recipes for Plots.jl. Julia 1.9 and later load this when PNPBS and RecipesBase, which Plots.jl
# loads, are loaded.
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
