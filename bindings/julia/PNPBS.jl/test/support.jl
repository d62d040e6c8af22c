# SPDX-License-Identifier: BSD-3-Clause
# Helpers of several tests.

# Returns the exception that f throws, or nothing.
function thrown(f)
    try
        f()
        return nothing
    catch e
        return e
    end
end

# Returns whether f throws a PNPBSError of this status with these words in its message.
function fails(f, status::Symbol, words...)
    e = thrown(f)
    good = e isa PNPBSError && e.status === status && all(word -> occursin(word, e.message), words)
    good || @info "not the error that was expected" status words e
    return good
end

function square_domain(context)
    domain = Domain(context)
    return add_polyline!(domain, [0 1 1 0; 0 0 1 1])
end

graded(x) = 0.04 .+ 0.05 .* x[1, :]

# Returns a placement after a run of few steps, because these tests check the interface and not the
# quality.
function placed_square(context; spacing = graded)
    placement = Placement(square_domain(context); steps = 40)
    set_spacing!(spacing, placement)
    run!(placement)
    return placement
end
