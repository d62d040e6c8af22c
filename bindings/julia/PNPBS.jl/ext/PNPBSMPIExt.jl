# SPDX-License-Identifier: BSD-3-Clause
# Passes MPI.jl to PNPBS. Julia 1.9 and later load this when both packages are loaded.
module PNPBSMPIExt

import MPI
import PNPBS

PNPBS.Context(comm::MPI.Comm; options...) = PNPBS.context_on(MPI, comm; options...)

end
