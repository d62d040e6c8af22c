// SPDX-License-Identifier: BSD-3-Clause
// All results that the queries of a placement return on a rank, for comparison before and after a
// call.
#pragma once

#include <pnpbs/pnpbs.h>

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

struct PlacementView {
  std::vector<std::string> statistics, warnings;
  std::vector<double> coordinates, spacing;
  std::vector<std::int64_t> ids, offsets, neighbours, elements;
  std::vector<std::int32_t> tags;
  std::int64_t nodes = 0, ghosts = 0;

  bool operator==(const PlacementView&) const = default;

  // Returns a text with the differences.
  std::string difference(const PlacementView& other) const {
    std::string text;
    for (std::size_t k = 0; k < statistics.size() && k < other.statistics.size(); ++k)
      if (statistics[k] != other.statistics[k])
        text += "'" + statistics[k] + "' became '" + other.statistics[k] + "'; ";
    const auto tell = [&](bool same, const char* what) { text += same ? "" : what; };
    tell(warnings == other.warnings, "warnings; ");
    tell(nodes == other.nodes && ghosts == other.ghosts, "number of nodes or ghosts; ");
    tell(coordinates == other.coordinates, "coordinates; ");
    tell(spacing == other.spacing, "d; ");
    tell(ids == other.ids && tags == other.tags, "ids or tags; ");
    tell(offsets == other.offsets && neighbours == other.neighbours, "lists; ");
    tell(elements == other.elements, "elements; ");
    return text;
  }
};

namespace placement_view {

inline void add_statistics(pnpbs_placement placement, PlacementView& view) {
  std::int32_t count = 0;
  pnpbs_statistic_count(&count);
  for (std::int32_t k = 0; k < count; ++k) {
    const char *name = "", *type = "", *text = "";
    pnpbs_statistic_info(k, &name, &type, nullptr);
    const std::string_view key = name;
    if (key.starts_with("seconds.") || key.starts_with("waiting.") || key.starts_with("memory.") ||
        key.starts_with("redundancy."))
      continue;
    std::int64_t integer = 0;
    double real = 0;
    std::string value = "an error";
    if (std::string_view(type) == "integer" &&
        pnpbs_placement_get_int64(placement, name, &integer) == PNPBS_OK)
      value = std::to_string(integer);
    else if (std::string_view(type) == "real" &&
             pnpbs_placement_get_double(placement, name, &real) == PNPBS_OK)
      value = std::to_string(real);
    else if (pnpbs_placement_get_string(placement, name, &text) == PNPBS_OK)
      value = text;
    view.statistics.push_back(std::string(key) + " = " + value);
  }
}

inline void add_nodes_and_lists(pnpbs_placement placement, PlacementView& view) {
  if (pnpbs_placement_count(placement, &view.nodes) != PNPBS_OK) view.nodes = -1;
  const std::size_t n = view.nodes > 0 ? static_cast<std::size_t>(view.nodes) : 0;
  view.coordinates.assign(3 * n, 0);
  view.spacing.assign(n, 0);
  view.ids.assign(n, 0);
  view.tags.assign(n, 0);
  pnpbs_placement_get_nodes(placement, view.nodes, view.coordinates.data(), view.ids.data(),
                            view.tags.data(), view.spacing.data());
  std::int64_t entries = 0, elements = 0;
  if (pnpbs_placement_adjacency_size(placement, &entries) < 0) return;  // there are no nodes
  view.offsets.assign(n + 1, 0);
  view.neighbours.assign(static_cast<std::size_t>(entries), 0);
  pnpbs_placement_get_adjacency(placement, entries, view.offsets.data(), view.neighbours.data());
  pnpbs_placement_ghost_count(placement, &view.ghosts);
  const bool flat = pnpbs_placement_get_triangles(placement, 0, &elements, nullptr) == PNPBS_OK;
  if (!flat) pnpbs_placement_get_tetrahedra(placement, 0, &elements, nullptr);
  view.elements.assign(static_cast<std::size_t>((flat ? 3 : 4) * elements), 0);
  (flat ? pnpbs_placement_get_triangles : pnpbs_placement_get_tetrahedra)(
      placement, elements, &elements, view.elements.data());
}

inline void add_warnings(pnpbs_placement placement, PlacementView& view) {
  std::int32_t count = 0;
  pnpbs_placement_warning_count(placement, &count);
  for (std::int32_t k = 0; k < count; ++k) {
    const char* text = "";
    pnpbs_placement_get_warning(placement, k, &text);
    view.warnings.emplace_back(text);
  }
}

}  // namespace placement_view

// Returns the results before a call. Lists are built on request, which changes statistics. So
// before a call the lists are requested first, and after a call the statistics are read first.
// Collective.
inline PlacementView view_before_call(pnpbs_placement placement) {
  PlacementView view;
  placement_view::add_nodes_and_lists(placement, view);
  placement_view::add_warnings(placement, view);
  placement_view::add_statistics(placement, view);
  return view;
}
inline PlacementView view_after_call(pnpbs_placement placement) {
  PlacementView view;
  placement_view::add_warnings(placement, view);
  placement_view::add_statistics(placement, view);
  placement_view::add_nodes_and_lists(placement, view);
  return view;
}
