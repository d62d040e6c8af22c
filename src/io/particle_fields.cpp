// SPDX-License-Identifier: BSD-3-Clause
#include "io/particle_fields.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"

namespace pnpbs::io {

FieldColumns field_columns(const NodeSource& nodes, std::size_t field) {
  FieldColumns columns{static_cast<std::size_t>((*nodes.contents().fields)[field].components), {}};
  nodes.for_field(field, [&](const FieldRows& rows) {
    columns.values.insert(columns.values.end(), rows.values.begin(), rows.values.end());
  });
  return columns;
}

std::size_t particle_field(const std::vector<OutputField>& fields, std::string_view name) {
  const auto found = std::ranges::find_if(fields, [&](const OutputField& field) {
    return field.name == name && field.components == 1;
  });
  return static_cast<std::size_t>(found - fields.begin());
}

bool has_particle_field(const std::vector<OutputField>& fields, std::string_view name) {
  return particle_field(fields, name) < fields.size();
}

std::vector<double> particle_values(const NodeSource& nodes, std::string_view name) {
  return field_columns(nodes, particle_field(*nodes.contents().fields, name)).values;
}

namespace {

// Returns the side of a square or cube of this volume, or 1 if it is 0, since no program accepts an
// empty box.
double size_of_particle(double volume, int dimension) {
  if (!(volume > 0)) return 1;
  return dimension == 2 ? std::sqrt(volume) : std::cbrt(volume);
}

}  // namespace

// Uses minima and maxima only, so that the result does not depend on the order of ranks.
ParticleExtent extent_of_particles(const NodeSource& nodes, const std::vector<double>& volumes,
                                   const Communicator& comm) {
  double largest = 0;
  for (const double volume : volumes) largest = std::max(largest, volume);
  ParticleExtent extent{{},
                        size_of_particle(comm.allreduce_max(largest), nodes.contents().dimension)};
  const std::vector<TagGroup> groups = nodes.node_groups();
  if (!groups.empty()) extent.box = {groups[0].low, groups[0].high};
  for (const TagGroup& group : groups)
    for (std::size_t k = 0; k < 3; ++k) {
      extent.box.low[k] = std::min(extent.box.low[k], group.low[k]);
      extent.box.high[k] = std::max(extent.box.high[k], group.high[k]);
    }
  return extent;
}

void write_point(const NodeRows& rows, std::size_t i, Sink& sink) {
  for (std::size_t k = 0; k < 3; ++k) {
    sink.number(rows.x[3 * i + k]);
    sink.text(" ");
  }
}

std::int32_t largest_block(const NodeSource& nodes, const std::string& format,
                           const std::string& called) {
  std::int32_t largest = 1;
  for (const TagGroup& region : nodes.region_groups()) {
    if (region.tag < 0)
      throw Error(ErrorKind::argument, "a ." + format + " file numbers " + called +
                                           " from 1 on, and the tag of a region is " +
                                           std::to_string(region.tag));
    largest = std::max(largest, region.tag);
  }
  return largest;
}

}  // namespace pnpbs::io
