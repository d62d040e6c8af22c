// SPDX-License-Identifier: BSD-3-Clause
// Several files of particles, which appear together.
#pragma once

#include <memory>
#include <vector>

#include "io/write_files.hpp"
#include "particles/particles.hpp"

namespace pnpbs::io {

// With these fields, in the formats that have room for any. Collective, and agreed.
void write_particles(const std::shared_ptr<const Communicator>& comm, const Particles& particles,
                     const GroupNames& names, const std::vector<OutputField>& fields,
                     const std::vector<FileRequest>& requests, const AsksToStop& asks_to_stop);

}  // namespace pnpbs::io
