# SPDX-License-Identifier: BSD-3-Clause
# Adapters that make Julia functions callbacks of the library. A static function receives the Julia
# function through the `user` pointer, because not all processors support closures in @cfunction.
# Exceptions must not pass through the library. The adapter stores them in the context and returns
# nonzero, and `check` throws them after the call has returned.

# A Julia function with its context. It is mutable because the library holds its address. The caller
# that passes it must keep it alive.
mutable struct Callback
    f::Any
    context::Any
end

user_pointer(callback::Callback) = pointer_from_objref(callback)

# Returns `f(callback)`, or 1 if an exception is pending or thrown. Ctrl-C takes effect here, in
# Julia code, and not in the code of the library.
function guarded(f, user::Ptr{Cvoid})
    callback = unsafe_pointer_to_objref(user)::Callback
    context = callback.context
    context.thrown === nothing || return Int32(1)
    try
        return Int32(context.sigint_disabled ? reenable_sigint(() -> f(callback)) : f(callback))
    catch e
        context.thrown = CapturedException(e, catch_backtrace())
        return Int32(1)
    end
end

# Runs the call `f()` of the library, which may take long. Ctrl-C must not end it in the middle,
# because the library would be left in an invalid state. It takes effect in the next callback. Every
# placement has a monitor, which is called about once per second.
function interruptible(f, context)
    context.thrown = nothing
    context.sigint_disabled = true
    try
        return disable_sigint(f)
    finally
        context.sigint_disabled = false
    end
end

# Returns a copy of the array of the library. A function that keeps or changes its argument thus has
# no effect on the library.
copied(values::Ptr{Float64}, size...) = copy(unsafe_wrap(Array, values, size))

function store!(out::Ptr{Float64}, values::AbstractArray{<:Real}, wanted, what)
    size(values) == wanted || throw(DimensionMismatch(
        "the $what function returned an array of size $(size(values)); $wanted was expected"))
    copyto!(unsafe_wrap(Array, out, wanted), values)
    return nothing
end

function store!(out::Ptr{Float64}, value, wanted, what)
    throw(ArgumentError("the $what function returned $(repr(value)); an array of numbers of size " *
                        "$wanted was expected"))
end

function call_spacing(n::Int64, dim::Int32, coordinates::Ptr{Float64}, d::Ptr{Float64}, user::Ptr{Cvoid})
    n == 0 && return Int32(0)
    return guarded(user) do callback
        values = callback.f(copied(coordinates, Int(dim), Int(n)))
        store!(d, values, (Int(n),), "spacing")
        return 0
    end
end

function call_curve(n::Int64, dim::Int32, t::Ptr{Float64}, coordinates::Ptr{Float64},
                    user::Ptr{Cvoid})
    n == 0 && return Int32(0)
    return guarded(user) do callback
        points = callback.f(copied(t, Int(n)))
        store!(coordinates, points, (Int(dim), Int(n)), "curve")
        return 0
    end
end

function call_level_set(n::Int64, dim::Int32, coordinates::Ptr{Float64}, values::Ptr{Float64},
                        user::Ptr{Cvoid})
    n == 0 && return Int32(0)
    return guarded(user) do callback
        f = callback.f(copied(coordinates, Int(dim), Int(n)))
        store!(values, f, (Int(n),), "level set")
        return 0
    end
end

# Only `true` stops the run, because a monitor that ends with a print statement returns `nothing`.
function call_monitor(fraction::Float64, step::Int64, nodes::Int64, max_speed::Float64,
                      user::Ptr{Cvoid})
    return guarded(callback -> callback.f(fraction, step, nodes, max_speed) === true, user)
end

# Pointers are valid in one process only, so they are created when the package is loaded.
const spacing_pointer = Ref{Ptr{Cvoid}}(C_NULL)
const curve_pointer = Ref{Ptr{Cvoid}}(C_NULL)
const level_set_pointer = Ref{Ptr{Cvoid}}(C_NULL)
const monitor_pointer = Ref{Ptr{Cvoid}}(C_NULL)

function make_callback_pointers()
    spacing_pointer[] = @cfunction(call_spacing, Int32,
                                   (Int64, Int32, Ptr{Float64}, Ptr{Float64}, Ptr{Cvoid}))
    curve_pointer[] = @cfunction(call_curve, Int32,
                                 (Int64, Int32, Ptr{Float64}, Ptr{Float64}, Ptr{Cvoid}))
    level_set_pointer[] = @cfunction(call_level_set, Int32,
                                     (Int64, Int32, Ptr{Float64}, Ptr{Float64}, Ptr{Cvoid}))
    monitor_pointer[] = @cfunction(call_monitor, Int32,
                                   (Float64, Int64, Int64, Float64, Ptr{Cvoid}))
    return nothing
end
