// SPDX-License-Identifier: BSD-3-Clause
// Output fields that particle formats require, and properties of all particles.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/types.hpp"
#include "io/node_source.hpp"
#include "io/shared_file.hpp"

namespace pnpbs::io {

// The values of a field at this rank's nodes over all windows. They are read before the nodes are
// written, so that windows of nodes and of fields need not be interleaved.
struct FieldColumns {
  std::size_t components;
  std::vector<double> values;  // [nodes][components]
};

// Reads a field. Collective.
FieldColumns field_columns(const NodeSource& nodes, std::size_t field);

// Names of fields with one component: volume (area in the plane) and density of a particle.
inline constexpr std::string_view kVolumeField = "volume", kDensityField = "density";

bool has_particle_field(const std::vector<OutputField>& fields, std::string_view name);
// Returns the index of the field with this name and one component, or the number of fields if there
// is none.
std::size_t particle_field(const std::vector<OutputField>& fields, std::string_view name);

// Returns the values of an existing field at this rank's nodes over all windows. Collective.
std::vector<double> particle_values(const NodeSource& nodes, std::string_view name);

// The extent of all particles.
struct ParticleExtent {
  Box<3> box;   // bounding box of the positions; z is 0 in the plane
  double size;  // side of a square or cube with the largest volume of a particle
};

// Returns the extent, the same on all ranks. Collective.
ParticleExtent extent_of_particles(const NodeSource& nodes, const std::vector<double>& volumes,
                                   const Communicator& comm);

// Returns the block, type or material of a region. Particles without tag are in block 1.
inline std::int32_t block_of_tag(std::int32_t tag) { return tag != 0 ? tag : 1; }

inline std::int32_t block_of(const NodeRows& rows, std::size_t i) {
  return block_of_tag(rows.regions.empty() ? 0 : rows.regions[i]);
}

// Returns the largest block of all nodes. Throws Error(ErrorKind::argument) for a negative tag,
// which the format cannot store. `called` names the blocks in messages. Collective.
std::int32_t largest_block(const NodeSource& nodes, const std::string& format,
                           const std::string& called = "blocks and types");

// Writes x, y and z of node i of a body, each followed by a space.
void write_point(const NodeRows& rows, std::size_t i, Sink& sink);

}  // namespace pnpbs::io
