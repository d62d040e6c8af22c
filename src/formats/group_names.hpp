// SPDX-License-Identifier: BSD-3-Clause
// What the user calls the tags. As in Gmsh's files a tag of points, of curves, of surfaces and of
// the inside may have a name each.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>

namespace pnpbs {

struct GroupTag {
  int dimension;  // 0 points, 1 curves, 2 surfaces (the inside of a domain in the plane), 3 bodies
  std::int32_t tag;

  auto operator<=>(const GroupTag&) const = default;
};

class GroupNames {
 public:
  void set(const GroupTag& group, std::string name) {
    names_.insert_or_assign(group, std::move(name));
  }
  // Unless it has one.
  void add(const GroupTag& group, const std::string& name) { names_.try_emplace(group, name); }

  // nullptr if it has none.
  const std::string* find(const GroupTag& group) const {
    const auto found = names_.find(group);
    return found == names_.end() ? nullptr : &found->second;
  }

  // By dimension, then by tag.
  const std::map<GroupTag, std::string>& all() const { return names_; }

 private:
  std::map<GroupTag, std::string> names_;
};

// What a group without a name is called: "tag_7".
inline std::string name_of_tag(std::int64_t tag) { return "tag_" + std::to_string(tag); }

}  // namespace pnpbs
