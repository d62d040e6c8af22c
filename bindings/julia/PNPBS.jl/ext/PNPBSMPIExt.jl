# SPDX-License-Identifier: BSD-3-Clause
# Loaded by Julia 1.9 and later when both packages are.
module PNPBSMPIExt

import MPI
import PNPBS

PNPBS.Context(comm::MPI.Comm; options...) = PNPBS.context_on(MPI, comm; options...)

end
