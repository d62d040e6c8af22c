// SPDX-License-Identifier: BSD-3-Clause
// What models of seas and rivers read of a node: x and y in the plane, longitude and latitude in
// degrees on a sphere; and its depth, if the caller has given one.
#pragma once

#include <string_view>
#include <vector>

#include "io/numbered_rows.hpp"
#include "io/particle_fields.hpp"
#include "sphere/degrees.hpp"

namespace pnpbs::io {

// Name of a field with one component: how far down the bottom is.
inline constexpr std::string_view kDepthField = "depth";

// Calls write(number, x and y, depth, sink) for each node, numbered from 1. Without the field the
// depth is 0. Collective.
template <class Write>
void append_map_places(const NodeSource& nodes, SharedFile& file, const Write& write) {
  const Contents& all = nodes.contents();
  const auto coordinates = static_cast<std::size_t>(all.coordinates);
  std::vector<double> depths;
  if (all.fields && has_particle_field(*all.fields, kDepthField))
    depths = particle_values(nodes, kDepthField);
  std::size_t before = 0;  // nodes of windows that have been
  nodes.for_nodes([&](const NodeRows& rows) {
    file.append([&](Sink& sink) {
      std::int64_t number = rows.first;
      for (std::size_t i = 0; i < rows.ids.size(); ++i) {
        const double* x = &rows.x[coordinates * i];
        const Point<2> place =
            coordinates == 3 ? degrees_of({x[0], x[1], x[2]}) : Point<2>{x[0], x[1]};
        write(++number, place, depths.empty() ? 0 : depths[before + i], sink);
      }
    });
    before += rows.ids.size();
  });
}

}  // namespace pnpbs::io
