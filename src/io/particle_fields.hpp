// SPDX-License-Identifier: BSD-3-Clause
// What files of particles need of the caller's fields, and what they say of them all.
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

// One of the caller's fields at the nodes in this rank's parts of all windows. So no window of
// nodes waits for one of a field.
struct FieldColumns {
  std::size_t components;
  std::vector<double> values;  // [nodes][components]
};

// Collective.
FieldColumns field_columns(const NodeSource& nodes, std::size_t field);

// Names of fields with one component: the volume of a particle, an area in the plane, and the
// density of its matter.
inline constexpr std::string_view kVolumeField = "volume", kDensityField = "density";

bool has_particle_field(const std::vector<OutputField>& fields, std::string_view name);
// One that there is.
std::size_t particle_field(const std::vector<OutputField>& fields, std::string_view name);

// Of the nodes in this rank's parts of all windows. Collective.
std::vector<double> particle_values(const NodeSource& nodes, std::string_view name);

// The same on all ranks.
struct ParticleExtent {
  Box<3> box;   // around the places of all; z is 0 in the plane
  double size;  // of the largest: the side of a square or cube of its volume
};

// Collective.
ParticleExtent extent_of_particles(const NodeSource& nodes, const std::vector<double>& volumes,
                                   const Communicator& comm);

// The block, type or material with this tag of a region, or with none.
inline std::int32_t block_of_tag(std::int32_t tag) { return tag != 0 ? tag : 1; }

inline std::int32_t block_of(const NodeRows& rows, std::size_t i) {
  return block_of_tag(rows.regions.empty() ? 0 : rows.regions[i]);
}

// Of all nodes. Throws Error(ErrorKind::argument) for a tag below 1, which such a file cannot have.
// Collective.
std::int32_t largest_block(const NodeSource& nodes, const std::string& format,
                           const std::string& called = "blocks and types");

// x, y and z of node i of a body, each before a space.
void write_point(const NodeRows& rows, std::size_t i, Sink& sink);

}  // namespace pnpbs::io
