# SPDX-License-Identifier: BSD-3-Clause
# Adapters for functions of one point, because the library evaluates functions at batches of points.
# The type of the function is known inside the adapter, so the loop over the points is compiled for
# it and only the call for the whole batch is dynamic.

struct PerPoint{F}
    f::F
    what::String  # kind of the function, for messages
end

function (one::PerPoint)(x::Matrix{Float64})
    size(x, 1) == 2 && return [as_number(one.f(x[1, k], x[2, k]), one.what) for k in axes(x, 2)]
    return [as_number(one.f(x[1, k], x[2, k], x[3, k]), one.what) for k in axes(x, 2)]
end

# Evaluates a curve: converts parameters to points in the plane.
function (one::PerPoint)(t::Vector{Float64})
    points = zeros(2, length(t))
    for k in eachindex(t)
        points[:, k] = as_point(one.f(t[k]), 2, "what the $(one.what) function returned")
    end
    return points
end

as_number(value::Real, what) = Float64(value)
as_number(value, what) =
    throw(ArgumentError("the $what function returned $(repr(value)); a number was expected"))

for_batches(f, what, per_point) = per_point ? PerPoint(f, what) : f
