// SPDX-License-Identifier: BSD-3-Clause
// Nodes, ghosts, lists, stars and boundary edges, handed out through the C interface.
#include "api/placement_calls.hpp"
#include "placement/result_check.hpp"

using namespace pnpbs;
using namespace pnpbs::api;

namespace {

std::int64_t adjacency_entries(const Placement& placement) {
  const Level& level = placement.level();
  return static_cast<std::int64_t>(
      sum_of("pnpbs::adjacency_entries", level.nodes.count, [&](std::int64_t i) {
        std::int64_t n = 0;
        if (!level.nodes.owned(i)) return n;
        level.lists().for_neighbours(i, [&](std::int64_t) { ++n; });
        return n;
      }));
}

std::int64_t star_entries(const Placement& placement) {
  const Level& level = placement.level();
  return static_cast<std::int64_t>(
      sum_of("pnpbs::star_entries", level.nodes.count,
             [&](std::int64_t i) { return level.nodes.owned(i) ? level.stars.size(i) : 0; }));
}

// Copies nodes with places first .. first + n - 1 out; arrays may be NULL.
void copy_nodes(const Placement& p, std::int64_t first, std::int64_t n, double* coordinates,
                std::int64_t* ids, std::int32_t* tags, double* spacing) {
  const Nodes<2>& nodes = p.level().nodes;
  for_each("pnpbs::copy_nodes", n, [&](std::int64_t k) {
    const std::int64_t i = p.node_at(first + k);
    if (coordinates)
      for (int c = 0; c < 2; ++c) coordinates[2 * k + c] = nodes.x[c](i);
    if (ids) ids[k] = nodes.id(i);
    if (tags) tags[k] = nodes.tag(i);
    if (spacing) spacing[k] = nodes.d(i);
  });
}

}  // namespace

pnpbs_status pnpbs_placement_count(pnpbs_placement placement, int64_t* nodes) {
  return guarded(placement, [&](PlacementObject& object) {
    require_pointer(nodes, "nodes");
    *nodes = object.placement.count();
    return PNPBS_OK;
  });
}

pnpbs_status pnpbs_placement_get_nodes(pnpbs_placement placement, int64_t capacity,
                                       double* coordinates, int64_t* ids, int32_t* tags,
                                       double* spacing) {
  return guarded(placement, [&](PlacementObject& object) {
    Placement& p = object.placement;
    require_capacity(capacity, p.count());
    if (p.count() == 0) return PNPBS_OK;
    p.prepare_order();
    copy_nodes(p, 0, p.count(), coordinates, ids, tags, spacing);
    return PNPBS_OK;
  });
}

pnpbs_status pnpbs_placement_ghost_count(pnpbs_placement placement, int64_t* ghosts) {
  return collective(placement, [&](Placement& p) {
    require_pointer(ghosts, "ghosts");
    p.prepare_lists();
    *ghosts = p.level().nodes.count - p.count();
    return PNPBS_OK;
  });
}

pnpbs_status pnpbs_placement_get_ghosts(pnpbs_placement placement, int64_t capacity,
                                        double* coordinates, int64_t* ids, int32_t* tags,
                                        double* spacing, int32_t* owners) {
  return collective(placement, [&](Placement& p) {
    p.prepare_lists();
    const Nodes<2>& nodes = p.level().nodes;
    const std::int64_t owned = p.count(), ghosts = nodes.count - owned;
    require_capacity(capacity, ghosts);
    copy_nodes(p, owned, ghosts, coordinates, ids, tags, spacing);
    for (std::int64_t g = 0; owners && g < ghosts; ++g)
      owners[g] = p.level().tree->owner_at(nodes.position(p.node_at(owned + g)));
    return PNPBS_OK;
  });
}

pnpbs_status pnpbs_placement_adjacency_size(pnpbs_placement placement, int64_t* entries) {
  return collective(placement, [&](Placement& p) {
    require_pointer(entries, "entries");
    p.prepare_lists();
    *entries = adjacency_entries(p);
    return PNPBS_OK;
  });
}

pnpbs_status pnpbs_placement_get_adjacency(pnpbs_placement placement, int64_t capacity,
                                           int64_t* offsets, int64_t* neighbours) {
  return collective(placement, [&](Placement& p) {
    require_pointer(offsets, "offsets");
    p.prepare_lists();
    require_capacity(capacity, adjacency_entries(p));
    if (capacity > 0) require_pointer(neighbours, "neighbours");
    std::int64_t at = 0;
    const std::int64_t owned = p.count();
    for (std::int64_t place = 0; place < owned; ++place) {
      offsets[place] = at;
      p.level().lists().for_neighbours(p.node_at(place),
                                       [&](std::int64_t j) { neighbours[at++] = p.place_of(j); });
    }
    offsets[owned] = at;
    return PNPBS_OK;
  });
}

pnpbs_status pnpbs_placement_star_size(pnpbs_placement placement, int64_t* entries) {
  return collective(placement, [&](Placement& p) {
    require_pointer(entries, "entries");
    p.prepare_stars();
    *entries = star_entries(p);
    return PNPBS_OK;
  });
}

pnpbs_status pnpbs_placement_get_stars(pnpbs_placement placement, int64_t capacity,
                                       int64_t* offsets, int64_t* neighbours, int8_t* triangle) {
  return collective(placement, [&](Placement& p) {
    require_pointer(offsets, "offsets");
    p.prepare_stars();
    require_capacity(capacity, star_entries(p));
    if (capacity > 0) require_pointer(neighbours, "neighbours");
    std::int64_t at = 0;
    const std::int64_t owned = p.count();
    for (std::int64_t place = 0; place < owned; ++place) {
      offsets[place] = at;
      p.level().stars.for_neighbours_in_order(p.node_at(place),
                                              [&](std::int64_t j, bool is_triangle) {
                                                if (triangle) triangle[at] = is_triangle;
                                                neighbours[at++] = p.place_of(j);
                                              });
    }
    offsets[owned] = at;
    return PNPBS_OK;
  });
}

pnpbs_status pnpbs_placement_get_triangles(pnpbs_placement placement, int64_t capacity,
                                           int64_t* count, int64_t* triangles) {
  return collective(placement, [&](Placement& p) {
    require_pointer(count, "count");
    p.prepare_stars();
    *count = 0;
    p.for_triangles([&](std::int64_t, std::int64_t, std::int64_t) { ++*count; });
    if (capacity == 0 && !triangles) return PNPBS_OK;
    require_capacity(capacity, *count);
    std::int64_t at = 0;
    p.for_triangles([&](std::int64_t a, std::int64_t b, std::int64_t c) {
      if (!triangles) return;
      triangles[at++] = a;
      triangles[at++] = b;
      triangles[at++] = c;
    });
    return PNPBS_OK;
  });
}

pnpbs_status pnpbs_placement_get_boundary_edges(pnpbs_placement placement, int64_t capacity,
                                                int64_t* count, int64_t* edges, int32_t* tags) {
  return guarded(placement, [&](PlacementObject& object) {
    Placement& p = object.placement;
    require_pointer(count, "count");
    *count = 0;
    if (!p.has_nodes()) return PNPBS_OK;
    p.prepare_order();
    p.for_boundary_edges([&](std::int64_t, std::int64_t, std::int32_t) { ++*count; });
    if (capacity == 0 && !edges && !tags) return PNPBS_OK;
    require_capacity(capacity, *count);
    std::int64_t at = 0;
    p.for_boundary_edges([&](std::int64_t begin, std::int64_t end, std::int32_t tag) {
      if (edges) edges[2 * at] = begin, edges[2 * at + 1] = end;
      if (tags) tags[at] = tag;
      ++at;
    });
    return PNPBS_OK;
  });
}

pnpbs_status pnpbs_placement_check(pnpbs_placement placement) {
  return collective(placement, [](Placement& p) {
    check_results(p);
    return PNPBS_OK;
  });
}
