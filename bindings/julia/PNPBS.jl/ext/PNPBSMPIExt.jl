# SPDX-License-Identifier: BSD-3-Clause
# Contexts on communicators of MPI.jl. Julia 1.9 and later load this extension with both packages.
module PNPBSMPIExt

import MPI
import PNPBS

PNPBS.Context(comm::MPI.Comm; options...) = PNPBS.context_on(MPI, comm; options...)

end
