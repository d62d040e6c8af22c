// SPDX-License-Identifier: BSD-3-Clause
// Rings: the neighbours and triangles around each node of a triangulation in counter-clockwise
// order, in compressed rows.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

namespace pnpbs {

// The rings of all nodes. `place` is an index into their concatenation.
class StarRings {
 public:
  using Triangle = std::array<std::int32_t, 3>;  // node indices, counter-clockwise

  StarRings() = default;
  // Builds the rings. A closed ring begins with the neighbour that has the smallest id, so that it
  // is the same on all ranks.
  StarRings(const std::vector<Triangle>& triangles, const std::vector<std::int64_t>& ids);

  std::int64_t begin(std::int32_t node) const { return offsets_[static_cast<std::size_t>(node)]; }
  std::int64_t end(std::int32_t node) const { return offsets_[static_cast<std::size_t>(node) + 1]; }
  std::int32_t size(std::int32_t node) const {
    return static_cast<std::int32_t>(end(node) - begin(node));
  }
  std::int64_t places() const { return offsets_.back(); }
  // Return the neighbour at this index, and the triangle between it and the next neighbour.
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
  // Returns the index of a neighbour in the ring of the node.
  std::int64_t place_of(std::int32_t node, std::int32_t neighbour) const {
    std::int64_t place = begin(node);
    while (this->neighbour(place) != neighbour) ++place;
    return place;
  }
  // Returns the index of a triangle in the ring of the node.
  std::int64_t place_of_triangle(std::int32_t node, std::int32_t triangle) const {
    std::int64_t place = begin(node);
    while (this->triangle(place) != triangle) ++place;
    return place;
  }
  // Returns true if the triangles surround the node completely.
  bool closed(std::int32_t node) const { return closed_[static_cast<std::size_t>(node)] != 0; }

 private:
  void put_in_order(std::int32_t node, const std::vector<Triangle>& triangles,
                    const std::vector<std::int64_t>& ids);

  std::vector<std::int64_t> offsets_{0};
  std::vector<std::int32_t> neighbours_, triangles_;
  std::vector<char> closed_;
};

}  // namespace pnpbs
