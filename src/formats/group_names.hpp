// SPDX-License-Identifier: BSD-3-Clause
// Names of tags. As in Gmsh's files, tags of points, curves, surfaces and volumes are independent,
// and each may have a name.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>

namespace pnpbs {

// A tag and the dimension of what it marks.
struct GroupTag {
  int dimension;  // 0 points, 1 curves, 2 surfaces (the regions of a plane domain), 3 volumes
  std::int32_t tag;

  auto operator<=>(const GroupTag&) const = default;
};

// A map from tags to names.
class GroupNames {
 public:
  void set(const GroupTag& group, std::string name) {
    names_.insert_or_assign(group, std::move(name));
  }
  // Sets the name unless the tag has one. Returns whether it is set.
  bool add(const GroupTag& group, const std::string& name) {
    return names_.try_emplace(group, name).second;
  }

  void remove(const GroupTag& group) { names_.erase(group); }

  // Returns the name, or nullptr if the tag has none.
  const std::string* find(const GroupTag& group) const {
    const auto found = names_.find(group);
    return found == names_.end() ? nullptr : &found->second;
  }

  // Returns all names, sorted by dimension and tag.
  const std::map<GroupTag, std::string>& all() const { return names_; }

 private:
  std::map<GroupTag, std::string> names_;
};

// Returns the name of a group that has none: "tag_7".
inline std::string name_of_tag(std::int64_t tag) { return "tag_" + std::to_string(tag); }

}  // namespace pnpbs
