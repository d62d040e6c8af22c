// SPDX-License-Identifier: BSD-3-Clause
// Output of several files of particles. They are published together.
#pragma once

#include <memory>
#include <vector>

#include "io/write_files.hpp"
#include "particles/particles.hpp"

namespace pnpbs::io {

// Writes the files, with the fields if the format can store any. Collective; if one rank throws,
// all ranks throw.
void write_particles(const std::shared_ptr<const Communicator>& comm, const Particles& particles,
                     const GroupNames& names, const std::vector<OutputField>& fields,
                     const std::vector<FileRequest>& requests, const AsksToStop& requests_stop);

}  // namespace pnpbs::io
