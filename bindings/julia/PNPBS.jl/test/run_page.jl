# SPDX-License-Identifier: BSD-3-Clause
# Runs the Julia of a page of the documentation, word for word, in a folder that is thrown away.
# usage: run_page.jl <page> [--mpi]     (--mpi: the blocks that use MPI.jl, on the stand-in)
with_mpi = "--mpi" in ARGS
with_mpi && push!(LOAD_PATH, joinpath(@__DIR__, "stand_in"))
const page = read(ARGS[1], String)
const blocks = [String(m[1]) for m in eachmatch(r"^```julia\n(.*?)^```$"ms, page)]
const wanted = filter(block -> occursin("using MPI", block) == with_mpi, blocks)
isempty(wanted) && error("$(ARGS[1]) has no such block")
mktempdir() do folder
    cd(folder) do
        foreach(block -> include_string(Main, block, ARGS[1]), wanted)
        # What the page promises to write is there.
        for m in eachmatch(r"write_file\(placement, \"([^\"]+)\"", join(wanted))
            isfile(m[1]) || error("$(m[1]) was not written")
        end
    end
end
