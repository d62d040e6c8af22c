// SPDX-License-Identifier: BSD-3-Clause
// The nodes and triangles around each node of a triangulation, counter-clockwise, in compressed
// rows.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

namespace pnpbs {

class StarRings {
 public:
  using Triangle = std::array<std::int32_t, 3>;  // nodes, counter-clockwise

  StarRings() = default;
  // A closed ring begins with the neighbour of the least id, so that it is the same on all ranks
  // that have it.
  StarRings(const std::vector<Triangle>& triangles, const std::vector<std::int64_t>& ids);

  std::int64_t begin(std::int32_t node) const { return offsets_[static_cast<std::size_t>(node)]; }
  std::int64_t end(std::int32_t node) const { return offsets_[static_cast<std::size_t>(node) + 1]; }
  std::int32_t size(std::int32_t node) const {
    return static_cast<std::int32_t>(end(node) - begin(node));
  }
  std::int64_t places() const { return offsets_.back(); }
  // At a place of the ring: the neighbour, and the triangle between it and the next one.
  std::int32_t neighbour(std::int64_t place) const {
    return neighbours_[static_cast<std::size_t>(place)];
  }
  std::int32_t triangle(std::int64_t place) const {
    return triangles_[static_cast<std::size_t>(place)];
  }
  std::int64_t next(std::int32_t node, std::int64_t place) const {
    return place + 1 < end(node) ? place + 1 : begin(node);
  }
  std::int64_t before(std::int32_t node, std::int64_t place) const {
    return (place > begin(node) ? place : end(node)) - 1;
  }
  // Of this neighbour; it must be one.
  std::int64_t place_of(std::int32_t node, std::int32_t neighbour) const {
    std::int64_t place = begin(node);
    while (this->neighbour(place) != neighbour) ++place;
    return place;
  }
  // Of this triangle; it must be one of them.
  std::int64_t place_of_triangle(std::int32_t node, std::int32_t triangle) const {
    std::int64_t place = begin(node);
    while (this->triangle(place) != triangle) ++place;
    return place;
  }
  // Do the triangles go all the way around the node?
  bool closed(std::int32_t node) const { return closed_[static_cast<std::size_t>(node)] != 0; }

 private:
  void put_in_order(std::int32_t node, const std::vector<Triangle>& triangles,
                    const std::vector<std::int64_t>& ids);

  std::vector<std::int64_t> offsets_{0};
  std::vector<std::int32_t> neighbours_, triangles_;
  std::vector<char> closed_;
};

}  // namespace pnpbs
