# SPDX-License-Identifier: BSD-3-Clause

"""
    Domain(context::Context; dim = 2)

Creates an empty domain in the plane, or with `dim = 3` in space. Curves, surfaces, holes and fixed
nodes are added to it. A point is inside the domain if it lies behind an odd number of boundary
curves, or of boundary surfaces in space. Holes and islands nest to any depth. All functions on
domains are local. Those that add or set something return the domain. Points are the columns of
`(dim, n)` matrices, which are copied. Functions for domains "in the plane" or "in space" throw a
[`PNPBSError`](@ref) with the status `:error_argument`, or a `DimensionMismatch`, for others.

Common arguments:

- `role`: `:boundary` for a curve or surface that separates inside from outside; `:inner` for one
  inside the domain that nodes follow. Curves in space are always `:inner`.
- `tag`: a nonzero integer that marks the nodes on a curve or surface. `tags` is one number for all
  segments or triangles, or one for each; `nothing` stands for 1.
"""
mutable struct Domain
    handle::LibPNPBS.pnpbs_domain
    context::Context
    callbacks::Vector{Callback}
end

function Domain(context::Context; dim::Integer = 2)
    handle = Ref{LibPNPBS.pnpbs_domain}(C_NULL)
    check(context, LibPNPBS.pnpbs_domain_create(live(context), dim, handle))
    domain = Domain(handle[], context, Callback[])
    push!(context.children, domain)
    return domain
end

"""
    sphere_domain(context, radius, outside) -> Domain

Creates an empty domain on a sphere about the origin. Its nodes lie on the sphere, spacings are
lengths along it, and points are the columns of `(3, n)` matrices. Boundary curves
([`add_polyline!`](@ref)) follow great circles from vertex to vertex. The domain lies behind an odd
number of them, as seen from a point outside in the direction `outside`, three numbers that are not
all 0. Nodes are placed in the stereographic projection from that point, which should be at least
ten spacings away from the domain. Placements have [`triangles`](@ref) and [`boundary_edges`](@ref),
as in the plane.

Without a boundary curve the domain is the whole sphere. Nodes around the point are laid first and
stay fixed then.

The following are not available on a sphere: particles and offsets, arcs, parametric curves, graphs,
holes of a whole sphere, and files of curves other than those of [`Shapes`](@ref).

    ring = sphere_points(1, [permutedims(0:2:358); fill(-70, 1, 180)])
    sea = add_polyline!(sphere_domain(context, 1, (0, 0, -1)), ring; corner_angle = 30)
"""
function sphere_domain(context::Context, radius::Real, outside)
    handle = Ref{LibPNPBS.pnpbs_domain}(C_NULL)
    check(context,
          LibPNPBS.pnpbs_domain_create_sphere(live(context), radius,
                                              as_point(outside, 3, "outside"), handle))
    domain = Domain(handle[], context, Callback[])
    push!(context.children, domain)
    return domain
end

"""
    sphere_points(radius, degrees)

Computes points on a sphere about the origin, `(3, n)`, from longitude and latitude. `degrees` is
`(2, n)`, with longitudes that may exceed a full turn and latitudes from -90 to 90. Local.
"""
function sphere_points(radius::Real, degrees::AbstractMatrix{<:Real})
    places = as_points(degrees, 2, "degrees")
    points = zeros(3, size(places, 2))
    check_without_context(LibPNPBS.pnpbs_sphere_points(radius, size(places, 2), places, points))
    return points
end

"""
    sphere_degrees(coordinates)

Computes longitudes, from -180 to 180, and latitudes, from -90 to 90, of the directions of points.
`coordinates` is `(3, n)`, without points at 0. Returns a `(2, n)` matrix. Local.
"""
function sphere_degrees(coordinates::AbstractMatrix{<:Real})
    points = as_points(coordinates, 3, "coordinates")
    degrees = zeros(2, size(points, 2))
    check_without_context(LibPNPBS.pnpbs_sphere_degrees(size(points, 2), points, degrees))
    return degrees
end

Base.isopen(domain::Domain) = domain.handle != C_NULL

function Base.close(domain::Domain)
    isopen(domain) || return nothing
    check(domain.context, LibPNPBS.pnpbs_domain_destroy(Ref(domain.handle)))
    domain.handle = C_NULL
    forget!(domain.context, domain)
    return nothing
end

"""
    ndims(domain), ndims(placement), ndims(transfer)

Returns the dimension of points: 2 in the plane, 3 in space and on a sphere. Local.
"""
function Base.ndims(domain::Domain)
    dim = Ref{Int32}(0)
    check(domain.context, LibPNPBS.pnpbs_domain_dimension(live(domain), dim))
    return Int(dim[])
end

Base.show(io::IO, domain::Domain) =
    print(io, "PNPBS.Domain(", isopen(domain) ? "$(ndims(domain))D" : "closed", ")")

function role_number(role::Symbol)
    role === :boundary && return LibPNPBS.PNPBS_BOUNDARY
    role === :inner && return LibPNPBS.PNPBS_INNER
    throw(ArgumentError("role is :$role; :boundary or :inner was expected"))
end

"""
    add_polyline!(domain, coordinates; closed = true, role = :boundary, tags = nothing,
                  corner_angle = 0)

Adds straight segments through vertices. On a sphere the segments are parts of great circles.

- `coordinates`: the vertices, `(dim, n)`.
- `closed`: whether a segment joins the last vertex to the first one.
- `corner_angle`: in degrees. With 0 every vertex becomes a node. Otherwise only vertices where the
  direction turns by more than this angle become nodes, and ends of open polylines and vertices
  where curves meet. Between them the polyline represents a smooth curve. In space the `role` is
  `:inner`, and the `feature_angle` of the surfaces is used instead.
"""
function add_polyline!(domain::Domain, coordinates::AbstractMatrix{<:Real}; closed::Bool = true,
                       role::Symbol = :boundary, tags = nothing, corner_angle::Real = 0)
    points = as_points(coordinates, ndims(domain), "coordinates")
    n = size(points, 2)
    segment_tags = as_tags(tags, closed ? n : max(n - 1, 0), "tags")
    check(domain.context,
          LibPNPBS.pnpbs_domain_add_polyline(live(domain), role_number(role), closed, n, points,
                                             segment_tags, corner_angle))
    return domain
end

"""
    add_surface!(domain, coordinates, corners; role = :boundary, tags = nothing,
                 feature_angle = 40)

Adds a triangulated surface to a domain in space. Closed surfaces with the role `:boundary` bound
the domain. Nodes follow `:inner` surfaces, which may be open. Coincident vertices are merged. The
triangles may have any orientation, because the enclosed volume determines it.

- `coordinates`: the vertices, `(3, n)`.
- `corners`: indices of vertices from 1, `(3, m)`.
- `feature_angle`: in degrees. Nodes lie on an edge between two triangles if their normals differ by
  more than this angle, or if their tags differ. Between such edges the triangles only define the
  shape, whatever their size is.
"""
function add_surface!(domain::Domain, coordinates::AbstractMatrix{<:Real},
                      corners::AbstractMatrix{<:Integer}; role::Symbol = :boundary, tags = nothing,
                      feature_angle::Real = 40)
    points = as_points(coordinates, 3, "coordinates")
    require_columns(corners, 3, "corners")
    m = size(corners, 2)
    check(domain.context,
          LibPNPBS.pnpbs_domain_add_surface(live(domain), role_number(role), size(points, 2),
                                            points, m, Matrix{Int64}(corners) .- 1,
                                            as_tags(tags, m, "tags"), feature_angle))
    return domain
end

"""
    read_surface!(domain, path; role = :boundary, feature_angle = 40)

Adds a surface from a file to a domain in space, as [`add_surface!`](@ref) does. The formats are
.stl (text or binary), .off, .obj, .ply, and TetGen's .poly and .smesh. Solids, groups, materials
and facet markers become tags with their names ([`tag_names`](@ref)). Hole points become holes of
the domain. Throws `:error_file` with file, line and what was expected.
"""
function read_surface!(domain::Domain, path::AbstractString; role::Symbol = :boundary,
                       feature_angle::Real = 40)
    check(domain.context,
          LibPNPBS.pnpbs_domain_read_surface(live(domain), role_number(role), path, feature_angle))
    return domain
end

"""
    set_role!(domain, tag, role)

Sets the role, `:boundary` or `:inner`, of all triangles with a tag in a domain in space. It
overrides the role with which they are added, before or after this call, so that single groups of a
file can be inner surfaces. Checking the domain fails if no triangle has the tag.
"""
function set_role!(domain::Domain, tag::Integer, role::Symbol)
    check(domain.context, LibPNPBS.pnpbs_domain_set_role(live(domain), tag, role_number(role)))
    return domain
end

"""
    read_msh!(domain, path; feature_angle = 40)

Reads a mesh in Gmsh's MSH format, 4.1 or 2.2, text or binary, and adds its boundary and the curves,
surfaces and points inside to the domain. In space, triangles and quadrangles become boundary, or
inner surfaces if the domain lies on both sides. Lines and points in physical groups become inner
curves and fixed nodes. In the plane, lines and the edges that bound triangles become boundary or
inner curves likewise. The tag of a physical group becomes the tag, and its name is kept
([`tag_names`](@ref)). `feature_angle` is that of [`add_surface!`](@ref), in the plane the
`corner_angle` of [`add_polyline!`](@ref). Throws `:error_file` with file, line or byte, and what
was expected.
"""
function read_msh!(domain::Domain, path::AbstractString; feature_angle::Real = 40)
    check(domain.context, LibPNPBS.pnpbs_domain_read_msh(live(domain), path, feature_angle))
    return domain
end

"""
    file_dimension(path)

Returns the dimension of the domain that a file describes, 2 or 3. The extension determines it. For
.poly it is the second number in the file; for .msh it is 2 if the mesh lies in a plane of constant
z. Throws `:error_file` if a .msh file cannot be read; other files are not checked. Local.
"""
function file_dimension(path::AbstractString)
    dim = Ref{Int32}(0)
    check_without_context(LibPNPBS.pnpbs_file_dimension(path, dim))
    return Int(dim[])
end

"""
    set_tag_name!(domain, dim, tag, name)

Sets the name of a tag, for files with physical groups (.msh). `dim` is the dimension of the entity
with the tag: 0 for points, 1 for curves, 2 for surfaces, 3 for bodies. The inside of the domain has
the dimension of the domain.
"""
function set_tag_name!(domain::Domain, dim::Integer, tag::Integer, name::AbstractString)
    check(domain.context, LibPNPBS.pnpbs_domain_set_tag_name(live(domain), dim, tag, name))
    return domain
end

"""
    tag_names(domain)

Returns the names of tags, set or from files, as a vector of named tuples `(dim, tag, name)`.
"""
function tag_names(domain::Domain)
    count = Ref{Int32}(0)
    check(domain.context, LibPNPBS.pnpbs_domain_tag_name_count(live(domain), count))
    return [tag_name(domain, i) for i in 0:(count[] - 1)]
end

function tag_name(domain, i)
    dim, tag, name = Ref{Int32}(0), Ref{Int32}(0), Ref{Cstring}()
    check(domain.context, LibPNPBS.pnpbs_domain_get_tag_name(live(domain), i, dim, tag, name))
    return (dim = Int(dim[]), tag = Int(tag[]), name = unsafe_string(name[]))
end

"""
    add_box!(domain, low, high; tag = 1, role = :boundary)

Adds a box to a domain in space. Its sides bound the domain, or with the role `:inner` lie in it and
nodes follow them. `low` and `high` are opposite corners.
"""
function add_box!(domain::Domain, low, high; tag::Integer = 1, role::Symbol = :boundary)
    check(domain.context,
          LibPNPBS.pnpbs_domain_add_box_surface(live(domain), role_number(role),
                                                as_point(low, 3, "low"), as_point(high, 3, "high"),
                                                tag))
    return domain
end

"""
    add_ball!(domain, centre, radius; tag = 1, role = :boundary)

Adds a ball to a domain in space, as triangles within 1e-4 of the radius. Its surface bounds the
domain, or with the role `:inner` lies in it and nodes follow it.
"""
function add_ball!(domain::Domain, centre, radius::Real; tag::Integer = 1,
                   role::Symbol = :boundary)
    check(domain.context,
          LibPNPBS.pnpbs_domain_add_ball_surface(live(domain), role_number(role),
                                                 as_point(centre, 3, "centre"), radius, tag))
    return domain
end

"""
    add_cylinder!(domain, from, to, radius; tag = 1, role = :boundary)

Adds a circular cylinder to a domain in space, as triangles within 1e-4 of the radius. Its surface
bounds the domain, or with the role `:inner` lies in it and nodes follow it. `from` and `to` are the
centres of its two circles.
"""
function add_cylinder!(domain::Domain, from, to, radius::Real; tag::Integer = 1,
                       role::Symbol = :boundary)
    check(domain.context,
          LibPNPBS.pnpbs_domain_add_cylinder_surface(live(domain), role_number(role),
                                                     as_point(from, 3, "from"),
                                                     as_point(to, 3, "to"), radius, tag))
    return domain
end

"""
    add_level_set!(f, domain, low, high, resolution; tag = 1, per_point = false)

Adds the body where a function is negative to a domain in space. Its surface is found on an octree
that is refined near `f = 0` down to cells of side `resolution`. Thinner features can be lost, and
so can a body that is small relative to the box and towards which `f` does not decrease. Nodes on
the surface lie where `f = 0`, and on its edges, where the gradient of `f` jumps by more than 40
degrees. Where triangles would cross, edges stay rounded, with a warning.

- `f`: a function `f(x)` that receives points as a `(3, n)` matrix and returns a vector of `n`
  values. It must be pure, continuous and finite in the whole box; it need not be a distance. It is
  called now and while placements compute, so the domain keeps it. With `per_point` it is called as
  `f(x, y, z)` for each point and returns a number.
- `low`, `high`: opposite corners of a box that contains the body.
- `resolution`: no more than the spacing at the surface, and half of the minimum radius of
  curvature.

Throws `:error_domain` if `f` is not finite, or negative on the border of the box, with the point,
or if it is negative nowhere.

    add_level_set!(body, (-2, -2, -1), (2, 2, 1), 0.1) do x
        hypot.(hypot.(x[1, :], x[2, :]) .- 1, x[3, :]) .- 0.4
    end
"""
function add_level_set!(f, domain::Domain, low, high, resolution::Real; tag::Integer = 1,
                        per_point::Bool = false)
    callback = Callback(for_batches(f, "level set", per_point), domain.context)
    GC.@preserve callback begin
        code = LibPNPBS.pnpbs_domain_add_level_set(live(domain), level_set_pointer[],
                                                   user_pointer(callback),
                                                   as_point(low, 3, "low"),
                                                   as_point(high, 3, "high"), resolution, tag)
    end
    check(domain.context, code)
    push!(domain.callbacks, callback)
    return domain
end

"""
    add_arc!(domain, centre, radius; from = 0, to = 2pi, role = :boundary, tag = 1)

Adds a circular arc between two angles in radians, by default a full circle, to a domain in the
plane. Its ends join curves that end at the same point, to within 1e-9 of the size of the domain.
"""
function add_arc!(domain::Domain, centre, radius::Real; from::Real = 0, to::Real = 2pi,
                  role::Symbol = :boundary, tag::Integer = 1)
    check(domain.context,
          LibPNPBS.pnpbs_domain_add_arc(live(domain), role_number(role),
                                        as_point(centre, 2, "centre"), radius, from, to, tag))
    return domain
end

"""
    add_curve!(f, domain, from, to; role = :boundary, tag = 1, per_point = false)

Adds a curve that a function defines to a domain in the plane. `f(t)` receives a vector of
parameters between `from` and `to` and returns points as a `(2, length(t))` matrix. It must be pure
and continuous, and the curve must not cross itself. Corners exist only where curves meet. A curve
whose ends coincide is closed. The function is called now and whenever a placement is initialised,
so the domain keeps it. With `per_point` it receives one parameter and returns the two coordinates
of the point.

    add_curve!(domain, 0, 2pi) do t
        [cos.(t) 0.5 .* sin.(t)]'
    end
    add_curve!(t -> (cos(t), 0.5 * sin(t)), domain, 0, 2pi; per_point = true)
"""
function add_curve!(f, domain::Domain, from::Real, to::Real; role::Symbol = :boundary,
                    tag::Integer = 1, per_point::Bool = false)
    callback = Callback(for_batches(f, "curve", per_point), domain.context)
    GC.@preserve callback begin
        code = LibPNPBS.pnpbs_domain_add_curve(live(domain), role_number(role), curve_pointer[],
                                               user_pointer(callback), from, to, tag)
    end
    check(domain.context, code)
    push!(domain.callbacks, callback)
    return domain
end

"""
    add_pslg!(domain, coordinates, segments; vertex_tags = nothing, segment_tags = nothing,
              holes = nothing)

Adds a planar straight-line graph, as Triangle defines it, to a domain in the plane. The segments
enclose the domain, except for regions that contain a hole point. Every vertex becomes a node,
unless [`set_corner_angle!`](@ref) is called. This rule then holds for all curves of the domain.

- `coordinates`: the vertices, `(2, n)`.
- `segments`: indices of vertices from 1, `(2, m)`.
- `vertex_tags`: tags of vertices; 0 stands for the tag of the segment.
- `segment_tags`: tags of segments.
- `holes`: a point in each hole, `(2, h)`.
"""
function add_pslg!(domain::Domain, coordinates::AbstractMatrix{<:Real},
                   segments::AbstractMatrix{<:Integer};
                   vertex_tags = nothing, segment_tags = nothing,
                   holes::Union{Nothing,AbstractMatrix{<:Real}} = nothing)
    points = as_points(coordinates, 2, "coordinates")
    require_columns(segments, 2, "segments")
    hole_points = holes === nothing ? zeros(2, 0) : as_points(holes, 2, "holes")
    n, m = size(points, 2), size(segments, 2)
    ends = Matrix{Int64}(segments) .- 1
    check(domain.context,
          LibPNPBS.pnpbs_domain_add_pslg(live(domain), n, points,
                                         as_tags(vertex_tags, n, "vertex_tags"), m, ends,
                                         as_tags(segment_tags, m, "segment_tags"),
                                         size(hole_points, 2), hole_points))
    return domain
end

"""
    set_filled!(domain, filled)

Sets whether a domain in space is the volume enclosed by its surfaces, which is the default. With
`false` it is the surfaces alone: nodes lie on them, triangles join these nodes
([`boundary_triangles`](@ref)), and there is no interior. Both roles are equivalent then, and
surfaces may be closed or open. Polylines must follow edges of the triangles, fixed nodes must be
vertices of them, and there are no holes.
"""
function set_filled!(domain::Domain, filled::Bool)
    check(domain.context, LibPNPBS.pnpbs_domain_set_filled(live(domain), filled))
    return domain
end

"""
    set_repair!(domain, resolution = 0)

Repairs the triangulated boundary surfaces of a domain in space that enclose one body imperfectly:
open, crossing, folded or inconsistently oriented. Sound surfaces do not change, and a warning
reports that nothing is repaired. The body is the set of points around which the surfaces wind more
than half a time, in either orientation. Holes are closed, overlapping bodies are joined, and
surfaces that enclose nothing are removed. The surface of the body is extracted as that of a level
set, with its sharp edges. All of it has the tag of the first triangle. A warning reports its
distance from the given triangles. Features thinner than the resolution can be lost. `resolution` is
at least 0, and no more than the spacing at the surface. 0 stands for 1/64 of the longest side of
the bounding box of the triangles.
"""
function set_repair!(domain::Domain, resolution::Real = 0)
    check(domain.context, LibPNPBS.pnpbs_domain_set_repair(live(domain), resolution))
    return domain
end

"""
    set_resurfaced!(domain, resolution = 0)

Replaces the triangulated boundary surfaces of a domain in space as [`set_repair!`](@ref) does, even
if they need no repair. This removes features of the body that are smaller than the resolution. The
last call of `set_repair!` or `set_resurfaced!` is effective.
"""
function set_resurfaced!(domain::Domain, resolution::Real = 0)
    check(domain.context, LibPNPBS.pnpbs_domain_set_resurfaced(live(domain), resolution))
    return domain
end

"""
    set_fragment!(domain, overlap = :last)

Splits the curves or surfaces of a domain where they cross, touch or lie on each other, so that
several solids, sheets and curves become regions of one domain with common nodes and facets. The
domain is what any solid contains. Curves and surfaces that enclose nothing lie inside of it, and
their parts outside are left out. The first of several curves or triangles that lie on each other
gives the tag. The k-th solid, counted from 1 in the order in which they are added (groups by tag),
gives its elements the region tag k. [`add_region!`](@ref) sets other tags, and [`add_hole!`](@ref)
removes regions.

In space each box, ball, cylinder and level set is a solid, and so is each closed group of an added
surface, which are its triangles with one tag: a solid contains the points around which it winds, so
triangles of a cavity are oriented into it. The other triangles of a surface enclose a further
solid. Surfaces with the role `:inner` are no solids. Without this call, surfaces that touch are
accepted if no solids overlap and each surface ends on others, as for stacked boxes and for a sheet
from side to side of a box. Gaps up to the length of [`set_snap!`](@ref) are closed.

In the plane each closed boundary curve is a solid, and so are boundary curves that are joined at
their ends to a closed one. It is a cavity if the solid before it encloses it and runs around in the
other direction. Each closed group of a graph, which are its segments with one tag, is a solid, and
the rest of what the graph encloses is a further one. Without this call, curves that touch, also
along common edges, are accepted if no solids overlap. Excludes [`set_repair!`](@ref). Not on a
sphere.

`overlap` is the region tag where solids overlap: `:last` or `:first`, that of the solid added last
or first, or `:own`, one for each combination of solids, following those of the solids.
"""
function set_fragment!(domain::Domain, overlap::Symbol = :last)
    rules = (last = LibPNPBS.PNPBS_OVERLAP_LAST, first = LibPNPBS.PNPBS_OVERLAP_FIRST,
             own = LibPNPBS.PNPBS_OVERLAP_OWN)
    haskey(rules, overlap) ||
        throw(ArgumentError("overlap is :$overlap, expected :last, :first or :own"))
    check(domain.context, LibPNPBS.pnpbs_domain_set_fragment(live(domain), rules[overlap]))
    return domain
end

"""
    set_periodic!(domain, low, high, periodic = true; tags = nothing, flat = false)

Makes the domain a box that repeats itself along some axes. It has no boundary across these axes:
bubbles on both sides of a seam act on each other. The other sides of the box are boundaries. Closed
curves and surfaces are holes and cavities or, with the role `:inner` or as fragments, inclusions.
They are given once, stand for all their copies, and may extend beyond a periodic side. The spacing
is evaluated at points of the box only, and continued with its periods.

Nodes lie in the box, `low <= x < high` along a periodic axis. Results have the images of nodes near
the box as ghosts, on a single rank as well: an image has the id of its node, and its coordinates
differ from those of the node by whole periods. Adjacency lists and elements refer to images, so an
element at a seam has its true shape, and no element occurs twice.

Coordinates along a periodic axis, and the period, are rounded to multiples of 2^-50 times the
largest coordinate of an image. Not on a sphere, nor for surfaces alone, level sets and inner curves
in space. Not yet for a periodic domain, but `:error_unsupported`: files with elements of second order,
distributed meshes, Voronoi cells, particles and cracks. [`run!`](@ref) and [`initialise!`](@ref) throw
`:error_spacing` if a period is shorter than four spacings.

`periodic` is true for all axes, or has a value for each axis. `tags` are those of the sides that
are not periodic or are flat: low x, high x, low y and so on; all are 1 without them. `flat` is true,
or has a value for each axis: no element crosses the sides across a periodic axis, nodes lie on them,
and opposite sides have the same facets, as solvers need that work on a box. In the plane curves may
cross such sides. In space surfaces must not, and all periodic axes or none are flat.
"""
function set_periodic!(domain::Domain, low, high, periodic = true; tags = nothing,
                       flat = false)
    dim = ndims(domain)
    axes = periodic isa Bool ? fill(periodic, dim) : collect(Bool, periodic)
    length(axes) == dim ||
        throw(DimensionMismatch("periodic has $(length(axes)) values, expected $dim"))
    sides = flat isa Bool ? fill(flat, dim) : collect(Bool, flat)
    length(sides) == dim ||
        throw(DimensionMismatch("flat has $(length(sides)) values, expected $dim"))
    values = ifelse.(sides, LibPNPBS.PNPBS_FLAT, LibPNPBS.PNPBS_PERIODIC)
    check(domain.context,
          LibPNPBS.pnpbs_domain_set_periodic(live(domain), as_point(low, dim, "low"),
                                             as_point(high, dim, "high"), Int32.(axes .* values),
                                             as_tags(tags, 2 * dim, "tags")))
    return domain
end

"""
    set_corner_angle!(domain, corner_angle)

Sets the corner angle of the graphs of a domain in the plane ([`add_pslg!`](@ref),
[`read_poly!`](@ref), [`parse_poly!`](@ref)), both of those added already and of later ones. Corners
are vertices where the direction turns by more than this angle in degrees, where segments of
different tags or other than two segments end, and vertices with a tag of their own. Nodes lie on
corners. Between corners a graph represents a smooth curve, with nodes spaced by d. With 0, the
default, every vertex becomes a node.
"""
function set_corner_angle!(domain::Domain, corner_angle::Real)
    check(domain.context, LibPNPBS.pnpbs_domain_set_corner_angle(live(domain), corner_angle))
    return domain
end

"""
    set_snap!(domain, length)

In the plane, sets the largest distance over which loose points are moved onto a curve or vertex
that they miss: ends of open curves, ends of segments that join no other one, and fixed nodes. By
default it is 1e-7 of the size of the domain, the longest side of its bounding box. The check of the
domain moves them, with a warning; set it before. With 0, none are moved. On a sphere none are
moved. In space, with [`set_fragment!`](@ref), surfaces become one where they are no farther from
each other, with the same warning: gaps between solids and thin overlaps are closed. Vertices within
16 times the length are then merged, and what is thinner is lost. By default no gaps are closed.
"""
function set_snap!(domain::Domain, length::Real)
    check(domain.context, LibPNPBS.pnpbs_domain_set_snap(live(domain), length))
    return domain
end

"""
    tag_outline!(selects, domain, tag; per_point = false) -> Int

Gives a tag to those parts of the boundary around a domain in the plane or on a sphere that a
function selects, such as the open boundary of a sea where it is deep. Boundaries around holes, such
as islands, keep their tags. Segments are selected by their middles, arcs and general curves as
wholes. Nodes are placed where the tag changes. `selects(x)` receives points as a `(2, n)` matrix,
on a sphere `(3, n)`, and returns `n` truth values; with `per_point` it is called for each point.
All ranks must make the same call. Returns the number of segments and curves that it selects.
Throws `:error_domain` if [`check`](@ref) does.

    tag_outline!(domain, 2) do x
        x[2, :] .> 54.9
    end
"""
function tag_outline!(selects, domain::Domain, tag::Integer; per_point::Bool = false)
    select = for_batches(selects, "selecting", per_point)
    callback = Callback(x -> ifelse.(select(x) .> 0, -1.0, 1.0), domain.context)
    count = Ref{Int64}(0)
    GC.@preserve callback begin
        code = LibPNPBS.pnpbs_domain_tag_outline(live(domain), level_set_pointer[],
                                                 user_pointer(callback), tag, count)
    end
    check(domain.context, code)
    return count[]
end

"""
    simplify!(d, domain; tolerance = 0.25, smallest = 0, per_point = false) -> (vertices, curves)

Removes features smaller than d, such as those of coastlines, from the graphs and polylines of a
domain in the plane. It removes vertices next to segments shorter than d, as long as the curve then
passes them within `tolerance` times d. It also removes closed curves, such as islands and lakes,
whose extent is less than `smallest` times d, where the extent is the longer side of the bounding
box. No other vertex, fixed node or hole point changes to another side of a curve. Vertices are kept
where curves meet or end, where tags change, where a vertex has a tag of its own, and at fixed
nodes. `d` is a number, or a function as in [`set_spacing!`](@ref). All ranks must make the same
call. If the call throws, the domain does not change. Returns the numbers of removed vertices,
including those of removed curves, and of removed curves.

    simplify!(domain; smallest = 2) do x
        0.2 .+ 0.05 .* hypot.(x[1, :], x[2, :])
    end
"""
function simplify!(d, domain::Domain; tolerance::Real = 0.25, smallest::Real = 0,
                   per_point::Bool = false)
    callback = Callback(for_batches(d, "spacing", per_point), domain.context)
    vertices, curves = Ref{Int64}(0), Ref{Int64}(0)
    GC.@preserve callback begin
        code = LibPNPBS.pnpbs_domain_simplify(live(domain), spacing_pointer[],
                                              user_pointer(callback), tolerance, smallest,
                                              vertices, curves)
    end
    check(domain.context, code)
    return (vertices = vertices[], curves = curves[])
end
simplify!(d::Real, domain::Domain; options...) = simplify!(evenly(d), domain; options...)

# Returns the spacing function with a constant value.
evenly(d::Real) = x -> fill(Float64(d), size(x, 2))

"""
    simplify_by_file!(domain, path; field = "", tolerance = 0.25, smallest = 0) -> (vertices, curves)

Removes features as [`simplify!`](@ref) does, with a spacing from a file with values at points, as
in [`set_spacing_file!`](@ref). Throws `:error_file` if the file cannot be read, and
`:error_spacing` for values that are zero, negative or not finite.
"""
function simplify_by_file!(domain::Domain, path::AbstractString; field::AbstractString = "",
                           tolerance::Real = 0.25, smallest::Real = 0)
    vertices, curves = Ref{Int64}(0), Ref{Int64}(0)
    check(domain.context,
          LibPNPBS.pnpbs_domain_simplify_by_file(live(domain), path, field, tolerance, smallest,
                                                 vertices, curves))
    return (vertices = vertices[], curves = curves[])
end

"""
    add_offset!(d, domain, body, low, high; resolution = 0, tag = 1, per_point = false)
    add_offset!(domain, body, low, high; resolution = 0, tag = 1)

Adds the body between two distances from the boundary of another domain. A point belongs to it if
its signed distance from that boundary, negative inside, lies between `low` and `high` times d.
Without `d` they are lengths. All ranks must make the same call.

Particles that each represent d^dim of matter lie half a spacing inside the wall. To place them, use
`low = -Inf` and `high = -0.42` in the plane or `-0.46` in space, with nodes of the spacing 1.076 d
or 1.147 d. Their number is then nearly the integral of 1 / d^dim over the body. n layers of wall
particles lie outside, between 0.42 and n - 0.58, or in space between 0.46 and n - 0.54.

`d` is a number, or a function as in [`set_spacing!`](@ref). It is evaluated in the bounding box of
the body and around it, a little farther than the new body reaches. The boundary has the `tag` and
is found as that of a level set ([`add_level_set!`](@ref)) with this resolution; thinner parts are
lost. A resolution of 0 stands for an eighth, in space half, of the least d at the boundary of the
body, or without `d` of the lesser of `abs(low)` and `abs(high)`.

Throws `:error_domain` if the body is invalid or nothing lies between these distances.

    add_offset!(x -> 0.1 .+ 0.05 .* x[1, :], inset, body, -Inf, -0.42)
    add_offset!(0.1, walls, body, 0.42, 2.42)  # three layers
"""
function add_offset!(d, domain::Domain, body::Domain, low::Real, high::Real; resolution::Real = 0,
                     tag::Integer = 1, per_point::Bool = false)
    callback = Callback(for_batches(d, "spacing", per_point), domain.context)
    GC.@preserve callback begin
        code = LibPNPBS.pnpbs_domain_add_offset(live(domain), live(body), low, high,
                                                spacing_pointer[], user_pointer(callback),
                                                resolution, tag)
    end
    check(domain.context, code)
    push!(domain.callbacks, callback)
    return domain
end
add_offset!(d::Real, domain::Domain, body::Domain, low::Real, high::Real; options...) =
    add_offset!(evenly(d), domain, body, low, high; options...)

function add_offset!(domain::Domain, body::Domain, low::Real, high::Real; resolution::Real = 0,
                     tag::Integer = 1)
    check(domain.context,
          LibPNPBS.pnpbs_domain_add_offset(live(domain), live(body), low, high, C_NULL, C_NULL,
                                           resolution, tag))
    return domain
end

"""
    add_hole!(domain, point)

Removes the region around a point from the domain, up to the next curves or surfaces of either role.
"""
function add_hole!(domain::Domain, point)
    check(domain.context,
          LibPNPBS.pnpbs_domain_add_hole(live(domain), as_point(point, ndims(domain), "point")))
    return domain
end

"""
    add_region!(domain, point, tag)

Gives a tag, which is not 0, to the region around a point, up to the next curves or surfaces of
either role. Elements in the region have this tag ([`element_tags`](@ref),
[`DistributedMesh`](@ref)), also in files. Inner curves and surfaces thus divide a domain into
materials. Elements of regions without a point have the tag 0. [`check_domain`](@ref) throws
`:error_domain` if the point lies outside the domain, on a curve or surface, or in a region with
another tag.
"""
function add_region!(domain::Domain, point, tag::Integer)
    check(domain.context,
          LibPNPBS.pnpbs_domain_add_region(live(domain), as_point(point, ndims(domain), "point"),
                                           tag))
    return domain
end

"""
    add_fixed_nodes!(domain, coordinates; tags = nothing)

Adds fixed nodes, which keep their exact coordinates. They must lie inside the domain or on a vertex
of its curves or surfaces. `coordinates` is `(dim, n)`.
"""
function add_fixed_nodes!(domain::Domain, coordinates::AbstractMatrix{<:Real}; tags = nothing)
    points = as_points(coordinates, ndims(domain), "coordinates")
    n = size(points, 2)
    check(domain.context,
          LibPNPBS.pnpbs_domain_add_fixed_nodes(live(domain), n, points, as_tags(tags, n, "tags")))
    return domain
end

"""
    read_poly!(domain, path)

Adds the content of a file in Triangle's .poly format to a domain in the plane, as
[`add_pslg!`](@ref) does. Throws `:error_file` with file, line and what was expected.
"""
function read_poly!(domain::Domain, path::AbstractString)
    check(domain.context, LibPNPBS.pnpbs_domain_read_poly(live(domain), path))
    return domain
end

"""
    parse_poly!(domain, text; name = "text")

Adds the content of a text in Triangle's .poly format to a domain in the plane, as
[`read_poly!`](@ref) does. `name` is the name of the text in messages.
"""
function parse_poly!(domain::Domain, text::AbstractString; name::AbstractString = "text")
    bytes = String(text)
    check(domain.context,
          LibPNPBS.pnpbs_domain_parse_poly(live(domain), bytes, sizeof(bytes), name))
    return domain
end

"""
    check_domain(domain)

Checks the whole geometry: duplicate vertices, crossings, boundaries that do not close, hole points
outside, fixed nodes outside or too close. Placements check it, too; an early check adds no cost.
Throws `:error_domain` with the vertex, segment or triangle.
"""
function check_domain(domain::Domain)
    check(domain.context, LibPNPBS.pnpbs_domain_check(live(domain)))
    return nothing
end

"""
    bounds(domain) -> (low, high)

Returns the corners of the bounding box of the curves or surfaces.
"""
function bounds(domain::Domain)
    dim = ndims(domain)
    low, high = zeros(dim), zeros(dim)
    check(domain.context, LibPNPBS.pnpbs_domain_bounds(live(domain), low, high))
    return low, high
end

"""
    measure(domain) -> Float64

Returns the area of the inside, in space its volume, or the area of surfaces alone. Checks the
domain first.
"""
function measure(domain::Domain)
    inside = Ref(0.0)
    check(domain.context, LibPNPBS.pnpbs_domain_measure(live(domain), inside))
    return inside[]
end

"""
    distances(domain, x; tag = 0) -> Vector{Float64}

Evaluates the distances of points, the columns of `x`, from the boundary of the domain, or from the
curves, surfaces or nodes with a tag. They are exact for segments and triangles, and within 1e-7 of
the size of the domain for arcs and parametric curves. The first query after a change of the domain
builds a search tree. If a callback queries distances, query one before the run. Throws
`:error_argument` if nothing has the tag.
"""
function distances(domain::Domain, x::AbstractMatrix{<:Real}; tag::Integer = 0)
    d = zeros(size(x, 2))
    check(domain.context,
          LibPNPBS.pnpbs_domain_distance(live(domain), tag, length(d), places(domain, x), d))
    return d
end

"""
    regions_at(domain, x; rows = 1) -> Matrix{Int32}

Returns the region tags at points, the columns of `x` ([`add_region!`](@ref),
[`set_fragment!`](@ref)), for use in a spacing function: 0 where a region has no tag, and outside of
the domain the tag of the region behind the nearest point of the boundary. A point within 1e-6 of
the size of the domain from interfaces lies in the regions on both sides: use the least d of these,
because nodes on interfaces lie on one side or the other by rounding. A column has first the tag of
the region that contains the point, then others at interfaces, and the first one again where there
are fewer. If a callback queries regions, query them once before the run. Throws `:error_argument`
if no region of the domain has a tag.
"""
function regions_at(domain::Domain, x::AbstractMatrix{<:Real}; rows::Integer = 1)
    tags = zeros(Int32, max(rows, 1), size(x, 2))
    check(domain.context,
          LibPNPBS.pnpbs_domain_regions_at(live(domain), size(x, 2), places(domain, x), rows, tags))
    return tags
end

"""
    shape_spacing(domain, x; nodes_per_turn = 0, nodes_across = 0, nodes_per_edge = 0,
                  growth = 0) -> Vector{Float64}

Evaluates the spacing that [`set_spacing_from_shape!`](@ref) sets, without its bounds, at points,
the columns of `x`, for use in a spacing function. The first query computes what the shape requires.
If a callback queries this spacing, query it once before the run.
"""
function shape_spacing(domain::Domain, x::AbstractMatrix{<:Real}; nodes_per_turn::Real = 0,
                       nodes_across::Real = 0, nodes_per_edge::Real = 0, growth::Real = 0)
    d = zeros(size(x, 2))
    check(domain.context,
          LibPNPBS.pnpbs_domain_shape_spacing(live(domain), nodes_per_turn, nodes_across,
                                              nodes_per_edge, growth, length(d),
                                              places(domain, x), d))
    return d
end

function places(domain, x)
    size(x, 1) == ndims(domain) || throw(DimensionMismatch(
        "x has $(size(x, 1)) rows; $(ndims(domain)) were expected"))
    return convert(Matrix{Float64}, x)
end

"""
    outline(domain) -> (segments, tags)

Returns straight segments that approximate the curves of a domain in the plane or on a sphere, for
pictures. `segments[:, 1, k]` and `segments[:, 2, k]` are the ends of segment k, and `tags[k]` is
the tag of its curve. With Plots.jl and Julia 1.9 or later, `plot(domain)` draws them.
"""
function outline(domain::Domain)
    count = Ref{Int64}(0)
    ask(capacity, segments, tags) =
        check(domain.context, LibPNPBS.pnpbs_domain_get_segments(live(domain), capacity, count,
                                                                 segments, tags))
    ask(0, C_NULL, C_NULL)
    segments, tags = zeros(ndims(domain), 2, count[]), zeros(Int32, count[])
    ask(count[], segments, tags)
    return (segments = segments, tags = tags)
end
