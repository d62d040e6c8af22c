# SPDX-License-Identifier: BSD-3-Clause
"""
A stand-in for Ferrite, for tests on machines without it. It defines the parts of grids that PNPBS
uses, with the same names.
"""
module Ferrite

struct Node{dim,T}
    x::NTuple{dim,T}
end

struct Triangle
    nodes::NTuple{3,Int}
end

struct Tetrahedron
    nodes::NTuple{4,Int}
end

struct FacetIndex
    idx::Tuple{Int,Int}
end

FacetIndex(cell::Int, facet::Int) = FacetIndex((cell, facet))
Base.iterate(index::FacetIndex, state...) = iterate(index.idx, state...)

sides(::Triangle) = ((1, 2), (2, 3), (3, 1))
sides(::Tetrahedron) = ((1, 3, 2), (1, 2, 4), (2, 3, 4), (1, 4, 3))
facets(cell) = map(side -> map(k -> cell.nodes[k], side), sides(cell))

struct Grid{Cell,Point}
    cells::Vector{Cell}
    nodes::Vector{Point}
    cellsets::Dict{String,Set{Int}}
    facetsets::Dict{String,Set{FacetIndex}}
end

Grid(cells, nodes; cellsets::Dict{String,Vector{Int}}, facetsets::Dict{String,Vector{FacetIndex}}) =
    Grid(cells, nodes, as_sets(cellsets), as_sets(facetsets))

as_sets(lists) = Dict(name => Set(list) for (name, list) in lists)

end
