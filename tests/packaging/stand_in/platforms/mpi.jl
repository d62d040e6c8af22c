# SPDX-License-Identifier: BSD-3-Clause
# Stand-in for Yggdrasil's file of this name.
module MPI
import BinaryBuilder
const augment = "augment_mpi!(platform) = platform"
augment_platforms(platforms) = platforms, [BinaryBuilder.Dependency("MPICH_jll", "")]
end
