# SPDX-License-Identifier: BSD-3-Clause
# Tests of Ctrl-C during a long call, and of the backtraces of exceptions in callbacks.

# Sends this process the signal of Ctrl-C after so many seconds.
interrupt_after(seconds) = run(`sh -c "sleep $seconds; kill -INT $(getpid())"`, wait = false)

# Interrupts f() after a second. Returns the exception that ends it, and the time from the interrupt
# to the end.
function interrupted(f)
    sender = interrupt_after(1)
    start = time()
    e = thrown(f)
    late = time() - start - 1
    wait(sender)
    return e, late
end

@testset "Ctrl-C" begin
    Base.exit_on_sigint(false)  # as at Julia's prompt; otherwise SIGINT ends the script
    Context() do context
        # Without an interrupt this run takes minutes.
        placement = Placement(square_domain(context); steps = 1_000_000, tolerance_mean = 1e-300,
                              tolerance_max = 1e-300)
        set_spacing!(placement, 0.01)
        for monitor in (nothing, (_...) -> false)
            monitor === nothing ? set_monitor!(placement, nothing) : set_monitor!(monitor, placement)
            e, late = interrupted(() -> run!(placement))
            @test e isa InterruptException
            @test 0 <= late < 2
        end
        # The state is that of a run that a monitor has stopped.
        @test node_count(placement) > 9000
        @test run!(set!(placement; steps = 20)) in (:ok, :not_converged)
        set_monitor!((_...) -> true, placement)
        @test run!(placement) === :stopped

        # Ctrl-C also ends a long function of the user.
        set_monitor!(placement, nothing)
        set_spacing!(x -> (sleep(10); fill(0.1, size(x, 2))), placement)
        e, late = interrupted(() -> run!(placement))
        @test e isa InterruptException
        @test 0 <= late < 2
        set_spacing!(placement, 0.1)
        @test run!(placement) in (:ok, :not_converged)
    end
end

@testset "exceptions tell the user's line" begin
    Context() do context
        placement = Placement(square_domain(context); steps = 20)
        line = @__LINE__() + 1
        set_spacing!(x -> error("no more"), placement)
        text = try
            run!(placement)
            ""
        catch
            sprint() do io
                for (e, backtrace) in (isdefined(Base, :current_exceptions) ?
                                       Base.current_exceptions() : Base.catch_stack())
                    showerror(io, e, backtrace)
                end
            end
        end
        @test occursin("no more", text)
        @test occursin("$(basename(@__FILE__)):$line", text)
    end
end
