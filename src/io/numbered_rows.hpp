// SPDX-License-Identifier: BSD-3-Clause
// Rows of mesh formats that are numbered from 1: nodes "number x y ...", and the corners of
// elements.
#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "io/formats.hpp"
#include "io/particle_fields.hpp"
#include "sphere/degrees.hpp"

namespace pnpbs::io {

// Appends all nodes. rest(rows, i, sink) writes what follows the coordinates and ends the line.
// Collective.
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

// Writes the corners of row i, each after a space.
inline void write_corners(const std::vector<std::int64_t>& corners, std::size_t i, int each,
                          Sink& sink) {
  const auto n = static_cast<std::size_t>(each);
  for (std::size_t k = n * i; k < n * (i + 1); ++k) {
    sink.text(" ");
    sink.number(corners[k] + 1);
  }
}

// Writes the nodes of row i as write_corners() does, in the order of Gmsh: the last two mid nodes
// of a tetrahedron of second order change places.
inline void write_msh_nodes(const std::vector<std::int64_t>& nodes, std::size_t i, int each,
                            Sink& sink) {
  constexpr std::array<std::size_t, 10> kOfGmsh{0, 1, 2, 3, 4, 5, 6, 7, 9, 8};
  const auto n = static_cast<std::size_t>(each);
  for (std::size_t k = 0; k < n; ++k) {
    sink.text(" ");
    sink.number(nodes[n * i + (n == 10 ? kOfGmsh[k] : k)] + 1);
  }
}

// Name of the output field with the depth of the bottom, which has one component.
inline constexpr std::string_view kDepthField = "depth";

// Calls write(number, position, depth, sink) for each node, with numbers from 1. The position is x
// and y in the plane, and longitude and latitude in degrees on a sphere, as models of seas and
// rivers read it. Without the field the depth is 0. Collective.
template <class Write>
void append_map_places(const NodeSource& nodes, SharedFile& file, const Write& write) {
  const Contents& all = nodes.contents();
  const auto coordinates = static_cast<std::size_t>(all.coordinates);
  std::vector<double> depths;
  if (all.fields && has_particle_field(*all.fields, kDepthField))
    depths = particle_values(nodes, kDepthField);
  std::size_t before = 0;  // nodes of earlier windows
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
