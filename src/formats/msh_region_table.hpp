// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "formats/msh_mesh.hpp"

namespace pnpbs {

// The regions of a mesh, made as elements ask for them from what a file tells of its entities.
class MshRegionTable {
 public:
  // group: the first physical group that it is in, 0 if it is in none.
  void add_entity(int dimension, std::int32_t entity, std::int32_t group) {
    group_of_[{dimension, entity}] = group;
    if (dimension > 0 && group != 0) any_group_[static_cast<std::size_t>(dimension)] = true;
  }
  // What bounds an entity of that dimension.
  void add_bound(int dimension, std::int32_t bound, bool bounds_one_in_group) {
    ++bounds_[{dimension - 1, bound}][bounds_one_in_group];
  }

  std::int32_t group_of(int dimension, std::int32_t entity) const {
    const auto found = group_of_.find({dimension, entity});
    return found == group_of_.end() ? 0 : found->second;
  }

  // Its place among all.
  std::int32_t region_of(int dimension, std::int32_t entity, std::int32_t group) {
    const std::array<std::int32_t, 3> key{dimension, entity, group};
    const auto [found, is_new] =
        region_at_.try_emplace(key, static_cast<std::int32_t>(regions_.size()));
    if (is_new) regions_.push_back({dimension, entity, group, bounds_of(dimension, entity)});
    return found->second;
  }
  std::vector<MshRegion> take() { return std::move(regions_); }

 private:
  // Where physical groups say what the domain is, entities in none are no part of it.
  int bounds_of(int dimension, std::int32_t entity) const {
    const auto found = bounds_.find({dimension, entity});
    if (found == bounds_.end()) return 0;
    const auto& [in_none, in_group] = found->second;
    return any_group_[static_cast<std::size_t>(dimension) + 1] ? in_group : in_none + in_group;
  }

  std::vector<MshRegion> regions_;
  std::map<std::array<std::int32_t, 3>, std::int32_t> region_at_;
  std::map<GroupTag, std::int32_t> group_of_;  // of entities
  // See MshRegion: by those in no physical group, and by those in one.
  std::map<GroupTag, std::array<int, 2>> bounds_;
  std::array<bool, 4> any_group_{};  // of entities of each dimension
};

}  // namespace pnpbs
