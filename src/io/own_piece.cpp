// SPDX-License-Identifier: BSD-3-Clause
#include "io/own_piece.hpp"

#include <algorithm>

#include "io/rows.hpp"

namespace pnpbs::io {

OwnPiece::OwnPiece(const PlacementOf<2>& placement, bool elements)
    : placement_(placement),
      owned_(placement.count()),
      number_(static_cast<std::size_t>(placement.level().nodes.count - owned_), -1) {
  contents_.is_piece = true;
  contents_.elements = elements;
  if (elements) {
    placement.for_elements([&](const std::array<std::int64_t, 3>& places) {
      ++contents_.triangles;
      for (const std::int64_t place : places) {
        if (place < owned_) continue;
        std::int64_t& number = number_[static_cast<std::size_t>(place - owned_)];
        if (number >= 0) continue;
        number = owned_ + static_cast<std::int64_t>(ghosts_.size());
        ghosts_.push_back(place);
      }
    });
  }
  contents_.nodes = owned_ + static_cast<std::int64_t>(ghosts_.size());
}

void OwnPiece::for_nodes(const std::function<void(const NodeRows&)>& visit) const {
  const Nodes<2>& nodes = placement_.level().nodes;
  for (std::int64_t begin = 0; begin < contents_.nodes; begin += kWindow) {
    NodeRows rows;
    rows.first = begin;
    for (std::int64_t k = begin; k < std::min(begin + kWindow, contents_.nodes); ++k) {
      const bool ghost = k >= owned_;
      const std::int64_t place = ghost ? ghosts_[static_cast<std::size_t>(k - owned_)] : k;
      const std::int64_t i = placement_.node_at(place);
      rows.xy.insert(rows.xy.end(), {nodes.x[0](i), nodes.x[1](i)});
      rows.ids.push_back(nodes.id(i));
      rows.tags.push_back(nodes.tag(i));
      rows.spacing.push_back(nodes.d(i));
      rows.ghosts.push_back(ghost);
    }
    visit(rows);
  }
}

void OwnPiece::for_triangles(const std::function<void(const TriangleRows&)>& visit) const {
  const Nodes<2>& nodes = placement_.level().nodes;
  const auto position = [&](std::int64_t place) {
    return nodes.position(placement_.node_at(place));
  };
  std::int64_t before = 0;
  for (std::int64_t begin = 0; begin < owned_; begin += kWindow) {
    TriangleRows rows;
    rows.first = before;
    placement_.for_elements(
        begin, std::min(begin + kWindow, owned_), [&](const std::array<std::int64_t, 3>& places) {
          const auto [a, b, c] = places;
          for (const std::int64_t place : places)
            rows.corners.push_back(
                place < owned_ ? place : number_[static_cast<std::size_t>(place - owned_)]);
          rows.quality.push_back(quality_of(position(a), position(b), position(c)));
        });
    before += static_cast<std::int64_t>(rows.quality.size());
    visit(rows);
  }
}

}  // namespace pnpbs::io
