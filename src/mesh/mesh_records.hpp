// SPDX-License-Identifier: BSD-3-Clause
// What ranks tell each other of a mesh: its nodes, elements and facets, all by their numbers.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <vector>

namespace pnpbs {

constexpr std::int64_t kNoElement = -1;

struct MeshNode {
  std::int64_t number, id;
  std::array<double, 3> x;
  std::int32_t tag;
};

// A triangle or a tetrahedron. The corners have positive orientation, and that of the least id
// comes first.
template <std::size_t Corners>
struct MeshElement {
  std::int64_t number;
  std::array<std::int64_t, Corners> corners;
  std::int32_t tag;  // of its region, 0 for none; on surfaces alone, of its surface
};

// A side of an element with a tag: a part of the boundary, of which there is one element, or of an
// inner curve or surface, with two.
template <std::size_t Corners>
struct MeshFacet {
  std::array<std::int64_t, Corners - 1> corners;
  std::array<std::int64_t, 2> elements;  // the lesser number first; kNoElement
  std::array<std::int8_t, 2> opposite;   // the corner of each that the facet has not, 0 ..
  std::int32_t tag;
};

// Sorts by key(record) and keeps one of each.
template <class Record, class Key = std::identity>
void sort_and_keep_one(std::vector<Record>& records, const Key& key = {}) {
  std::ranges::sort(records, {}, key);
  const auto same = [&](const Record& a, const Record& b) { return key(a) == key(b); };
  records.erase(std::unique(records.begin(), records.end(), same), records.end());
}

}  // namespace pnpbs
