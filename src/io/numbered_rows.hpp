// SPDX-License-Identifier: BSD-3-Clause
// The rows that mesh formats have for nodes, "number x y ...", and the corners that follow the
// number of an element: all numbered from 1.
#pragma once

#include <string_view>
#include <vector>

#include "io/formats.hpp"
#include "io/particle_fields.hpp"
#include "sphere/degrees.hpp"

namespace pnpbs::io {

// rest(rows, i, sink) writes what follows the coordinates of a node, and ends the line.
template <class Rest>
void append_numbered_points(const NodeSource& nodes, SharedFile& file, const Rest& rest) {
  const auto coordinates = static_cast<std::size_t>(nodes.contents().coordinates);
  nodes.for_nodes([&](const NodeRows& rows) {
    file.append([&](Sink& sink) {
      std::int64_t number = rows.first;
      for (std::size_t i = 0; i < rows.ids.size(); ++i) {
        sink.number(++number);
        for (std::size_t k = 0; k < coordinates; ++k) {
          sink.text(" ");
          sink.number(rows.x[coordinates * i + k]);
        }
        rest(rows, i, sink);
      }
    });
  });
}

// Those of row i, each after a space.
inline void write_corners(const std::vector<std::int64_t>& corners, std::size_t i, int each,
                          Sink& sink) {
  const auto n = static_cast<std::size_t>(each);
  for (std::size_t k = n * i; k < n * (i + 1); ++k) {
    sink.text(" ");
    sink.number(corners[k] + 1);
  }
}

// Name of a field with one component: how far down the bottom is.
inline constexpr std::string_view kDepthField = "depth";

// Calls write(number, place, depth, sink) for each node, numbered from 1, with what models of seas
// and rivers read: x and y in the plane, longitude and latitude in degrees on a sphere. Without the
// field the depth is 0. Collective.
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
