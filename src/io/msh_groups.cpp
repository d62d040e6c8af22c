// SPDX-License-Identifier: BSD-3-Clause
#include "io/msh_groups.hpp"

#include <algorithm>
#include <cmath>

namespace pnpbs::io {

namespace {

constexpr std::size_t kLongestName = 127;  // Gmsh's

// In quotation marks, as Gmsh can read it.
std::string quoted_name(const std::string& name) {
  std::string text = name.substr(0, kLongestName);
  for (char& c : text) {
    if (c == '"') c = '\'';
    if (static_cast<unsigned char>(c) < ' ') c = ' ';
  }
  return '"' + text + '"';
}

// That of facets with this tag or, for nodes alone, of whatever else has it.
std::string name_of(const Contents& all, std::int32_t tag) {
  if (tag == 0) return "inner";
  std::vector<int> dimensions{all.dimension - 1};
  if (!all.with_elements) dimensions.insert(dimensions.end(), {0, 1, 2, 3});
  for (const int dimension : dimensions)
    if (const std::string* name = all.names ? all.names->find({dimension, tag}) : nullptr)
      return *name;
  return name_of_tag(tag);
}

void write_numbers(const std::array<double, 3>& numbers, Sink& sink) {
  for (const double number : numbers) {
    sink.text(" ");
    sink.number(number);
  }
}

}  // namespace

MshGroup inside_group(const Contents& all) {
  MshGroup inside{all.dimension, 1, "domain", {}};
  std::int64_t named = 0;
  if (all.names)
    for (const auto& [group, name] : all.names->all()) {
      if (group.dimension != all.dimension || group.tag < 1) continue;
      if (named++ == 0) {
        inside.number = group.tag;
        inside.name = name;
      }
    }
  return named > 1 ? MshGroup{all.dimension, 1, "domain", {}} : inside;
}

std::vector<MshGroup> tagged_groups(const Contents& all, const std::vector<TagGroup>& tags) {
  const int dimension = all.with_elements ? all.dimension - 1 : 0;
  std::vector<MshGroup> groups;
  std::int64_t free = 1;
  for (const TagGroup& tag : tags) free = std::max<std::int64_t>(free, tag.tag + std::int64_t{1});
  for (const TagGroup& tag : tags)
    groups.push_back({dimension, tag.tag > 0 ? tag.tag : free++, name_of(all, tag.tag), tag});
  return groups;
}

const MshGroup* group_of(const std::vector<MshGroup>& groups, std::int32_t tag) {
  const auto found = std::ranges::lower_bound(groups, tag, {},
                                              [](const MshGroup& group) { return group.rows.tag; });
  return found == groups.end() || found->rows.tag != tag ? nullptr : &*found;
}

MshGroups msh_groups(const NodeSource& nodes) {
  const Contents& all = nodes.contents();
  return {tagged_groups(all, all.with_elements ? nodes.facet_groups() : nodes.node_groups()),
          inside_group(all)};
}

std::string physical_names(const std::vector<const MshGroup*>& groups) {
  std::string text = "$PhysicalNames\n" + std::to_string(groups.size()) + "\n";
  for (const MshGroup* group : groups)
    text += std::to_string(group->dimension) + " " + std::to_string(group->number) + " " +
            quoted_name(group->name) + "\n";
  return text + "$EndPhysicalNames\n";
}

void write_entity(const std::string& head, const MshGroup& group, bool is_physical, Sink& sink) {
  sink.text(head);
  write_numbers(group.rows.low, sink);
  if (group.dimension > 0) write_numbers(group.rows.high, sink);
  sink.text(is_physical ? " 1 " : " 0");
  if (is_physical) sink.number(group.number);
  sink.text(group.dimension > 0 ? " 0\n" : "\n");
}

}  // namespace pnpbs::io
