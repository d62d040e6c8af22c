// SPDX-License-Identifier: BSD-3-Clause
// Placements of the C interface.
#include <cmath>

#include "api/guard.hpp"
#include "core/kokkos_runtime.hpp"
#include "core/statistics.hpp"

using namespace pnpbs;
using namespace pnpbs::api;

namespace {

pnpbs_status status_of(Outcome outcome) {
  switch (outcome) {
    case Outcome::converged:
      return PNPBS_OK;
    case Outcome::stopped:
      return PNPBS_STOPPED;
    case Outcome::not_converged:
      break;
  }
  return PNPBS_NOT_CONVERGED;
}

void forget_all_nodes() {
  placements().for_each([](PlacementObject& object) { object.placement.forget_nodes(); });
}

// A call that changes the placement or may ask callbacks.
template <class Body>
pnpbs_status compute(pnpbs_placement placement, const Body& body) {
  return guarded(placement, [&](PlacementObject& object) {
    const Computing computing(*object.context);
    return body(object.placement);
  });
}

// A question that makes lists or stars fresh first.
template <class Body>
pnpbs_status extract(pnpbs_placement placement, const Body& body) {
  return compute(placement, body);
}

void require_capacity(std::int64_t capacity, std::int64_t needed) {
  require_count(capacity, "capacity");
  if (capacity < needed)
    throw Error(PNPBS_ERROR_CAPACITY, "argument capacity = " + std::to_string(capacity) + "; " +
                                          std::to_string(needed) + " are needed");
}

void set_placement_option(Placement& placement, const char* key, const auto& assign) {
  require_pointer(key, "key");
  if (std::string(key) == "threads")
    throw Error(PNPBS_ERROR_STATE,
                "option threads belongs to the process: set it on the context, before the first "
                "placement is created");
  assign(placement.options());
}

std::int64_t adjacency_entries(const Placement& placement) {
  const Level& level = placement.level();
  return static_cast<std::int64_t>(
      sum_of("pnpbs::adjacency_entries", level.nodes().count, [&](std::int64_t i) {
        std::int64_t n = 0;
        if (!level.nodes().owned(i)) return n;
        level.lists().for_neighbours(i, [&](std::int64_t) { ++n; });
        return n;
      }));
}

std::int64_t star_entries(const Placement& placement) {
  const Level& level = placement.level();
  return static_cast<std::int64_t>(
      sum_of("pnpbs::star_entries", level.nodes().count,
             [&](std::int64_t i) { return level.nodes().owned(i) ? level.stars().size(i) : 0; }));
}

}  // namespace

pnpbs_status pnpbs_placement_create(pnpbs_context context, pnpbs_domain domain,
                                    pnpbs_placement* placement) {
  return guarded(context, [&](Context& object) {
    require_pointer(placement, "placement");
    *placement = nullptr;
    require_not_in_callback(object);
    const auto of = require(domain);
    if (of->context.get() != &object)
      throw Error(PNPBS_ERROR_ARGUMENT,
                  "argument domain belongs to another context: create it on this one");
    start_kokkos(object.options.integer("threads"), object.communicator->ranks_on_node(),
                 forget_all_nodes);
    auto made = std::make_shared<PlacementObject>(PlacementObject{
        require(context), Placement(object.communicator, of->plane, object.options)});
    *placement = placements().add(std::move(made));
    return PNPBS_OK;
  });
}

pnpbs_status pnpbs_placement_destroy(pnpbs_placement* placement) {
  if (!placement || !*placement) return PNPBS_OK;
  return guarded(*placement, [&](PlacementObject& object) {
    require_not_in_callback(*object.context);
    placements().remove(*placement);
    *placement = nullptr;
    return PNPBS_OK;
  });
}

pnpbs_status pnpbs_placement_set(pnpbs_placement placement, const char* key, const char* value) {
  return compute(placement, [&](Placement& p) {
    require_pointer(value, "value");
    set_placement_option(p, key, [&](Options& o) { o.set(key, value); });
    return PNPBS_OK;
  });
}

pnpbs_status pnpbs_placement_set_int64(pnpbs_placement placement, const char* key, int64_t value) {
  return compute(placement, [&](Placement& p) {
    set_placement_option(p, key, [&](Options& o) { o.set_integer(key, value); });
    return PNPBS_OK;
  });
}

pnpbs_status pnpbs_placement_set_double(pnpbs_placement placement, const char* key, double value) {
  return compute(placement, [&](Placement& p) {
    set_placement_option(p, key, [&](Options& o) { o.set_real(key, value); });
    return PNPBS_OK;
  });
}

pnpbs_status pnpbs_placement_set_spacing_constant(pnpbs_placement placement, double d) {
  return compute(placement, [&](Placement& p) {
    if (!std::isfinite(d) || d <= 0)
      throw Error(PNPBS_ERROR_SPACING, "argument d = " + number_text(d) +
                                           ": the spacing must be finite and greater than 0");
    p.set_spacing(std::make_shared<ConstantSpacing<2>>(d));
    return PNPBS_OK;
  });
}

pnpbs_status pnpbs_placement_set_spacing_callback(pnpbs_placement placement,
                                                  pnpbs_spacing_fn spacing, void* user) {
  return compute(placement, [&](Placement& p) {
    if (!spacing) throw Error(PNPBS_ERROR_ARGUMENT, "argument spacing is NULL");
    p.set_spacing(std::make_shared<CallbackSpacing<2>>(
        [spacing, user](std::int64_t n, const double* x, double* d) {
          return spacing(n, 2, x, d, user);
        }));
    return PNPBS_OK;
  });
}

pnpbs_status pnpbs_placement_set_spacing_grid(pnpbs_placement placement, const int64_t* size,
                                              const double* origin, const double* step,
                                              const double* values) {
  return compute(placement, [&](Placement& p) {
    require_pointer(size, "size");
    require_pointer(origin, "origin");
    require_pointer(step, "step");
    require_pointer(values, "values");
    constexpr std::int64_t kMost = std::int64_t{1} << 31;
    for (int k = 0; k < 2; ++k) {
      const std::string at = "[" + std::to_string(k) + "] = ";
      if (size[k] < 1 || size[k] > kMost)
        throw Error(PNPBS_ERROR_ARGUMENT,
                    "argument size" + at + std::to_string(size[k]) + " must be in 1 .. 2^31");
      if (!std::isfinite(origin[k]))
        throw Error(PNPBS_ERROR_ARGUMENT,
                    "argument origin" + at + number_text(origin[k]) + " must be finite");
      if (!std::isfinite(step[k]) || step[k] <= 0)
        throw Error(PNPBS_ERROR_ARGUMENT,
                    "argument step" + at + number_text(step[k]) + " must be greater than 0");
    }
    const std::int64_t n = size[0] * size[1];
    for (std::int64_t i = 0; i < n; ++i)
      if (!std::isfinite(values[i]) || values[i] <= 0)
        throw Error(PNPBS_ERROR_SPACING, "argument values[" + std::to_string(i / size[0]) + "][" +
                                             std::to_string(i % size[0]) +
                                             "] = " + number_text(values[i]) +
                                             ": the spacing must be finite and greater than 0");
    p.set_spacing(std::make_shared<GridSpacing<2>>(
        std::array<std::int64_t, 2>{size[0], size[1]}, Point<2>{origin[0], origin[1]},
        Point<2>{step[0], step[1]}, std::vector<double>(values, values + n)));
    return PNPBS_OK;
  });
}

pnpbs_status pnpbs_placement_set_monitor(pnpbs_placement placement, pnpbs_monitor_fn monitor,
                                         void* user) {
  return compute(placement, [&](Placement& p) {
    if (!monitor)
      p.set_monitor({});
    else
      p.set_monitor([monitor, user](double fraction, std::int64_t step, std::int64_t nodes,
                                    double max_speed) {
        return monitor(fraction, step, nodes, max_speed, user) != 0;
      });
    return PNPBS_OK;
  });
}

pnpbs_status pnpbs_placement_set_nodes(pnpbs_placement placement, int64_t n, const double* xy,
                                       const int64_t* ids) {
  return compute(placement, [&](Placement& p) {
    require_count(n, "n");
    if (n > 0) require_pointer(xy, "xy");
    constexpr std::int64_t kLargestId = std::int64_t{1} << 62;  // leaves numbers for new nodes
    std::vector<GivenNode> nodes;
    for (std::int64_t i = 0; i < n; ++i) {
      if (!std::isfinite(xy[2 * i]) || !std::isfinite(xy[2 * i + 1]))
        throw Error(PNPBS_ERROR_ARGUMENT, "argument xy[" + std::to_string(i) + "] = (" +
                                              number_text(xy[2 * i]) + ", " +
                                              number_text(xy[2 * i + 1]) + ") must be finite");
      if (ids && (ids[i] < 0 || ids[i] > kLargestId))
        throw Error(PNPBS_ERROR_ARGUMENT, "argument ids[" + std::to_string(i) + "] = " +
                                              std::to_string(ids[i]) + " must be in 0 .. 2^62");
      nodes.push_back({{xy[2 * i], xy[2 * i + 1]}, ids ? ids[i] : -1});
    }
    if (ids) {
      std::vector<std::int64_t> sorted(ids, ids + n);
      std::sort(sorted.begin(), sorted.end());
      const auto twice = std::adjacent_find(sorted.begin(), sorted.end());
      if (twice != sorted.end())
        throw Error(PNPBS_ERROR_ARGUMENT,
                    "argument ids: id " + std::to_string(*twice) + " comes twice");
    }
    p.set_nodes(std::move(nodes));
    return PNPBS_OK;
  });
}

pnpbs_status pnpbs_placement_initialise(pnpbs_placement placement) {
  return compute(placement, [](Placement& p) {
    p.initialise();
    return PNPBS_OK;
  });
}

pnpbs_status pnpbs_placement_step(pnpbs_placement placement, int64_t n) {
  return compute(placement, [&](Placement& p) {
    require_count(n, "n");
    return status_of(p.step(n));
  });
}

pnpbs_status pnpbs_placement_adjust_population(pnpbs_placement placement, int64_t* inserted,
                                               int64_t* deleted) {
  return compute(placement, [&](Placement& p) {
    const PopulationCounts change = p.adjust_population();
    if (inserted) *inserted = change.inserted;
    if (deleted) *deleted = change.deleted;
    return PNPBS_OK;
  });
}

pnpbs_status pnpbs_placement_rebalance(pnpbs_placement placement) {
  return compute(placement, [](Placement& p) {
    p.rebalance();
    return PNPBS_OK;
  });
}

pnpbs_status pnpbs_placement_run(pnpbs_placement placement) {
  return compute(placement, [](Placement& p) { return status_of(p.run()); });
}

pnpbs_status pnpbs_placement_count(pnpbs_placement placement, int64_t* nodes) {
  return guarded(placement, [&](PlacementObject& object) {
    require_pointer(nodes, "nodes");
    *nodes = object.placement.count();
    return PNPBS_OK;
  });
}

namespace {

// Copies nodes with places first .. first + n - 1 out; arrays may be NULL.
void copy_nodes(const Placement& p, std::int64_t first, std::int64_t n, double* xy,
                std::int64_t* ids, std::int32_t* tags, double* spacing) {
  const Nodes<2>& nodes = p.level().nodes();
  for_each("pnpbs::copy_nodes", n, [&](std::int64_t k) {
    const std::int64_t i = p.node_at(first + k);
    if (xy)
      for (int c = 0; c < 2; ++c) xy[2 * k + c] = nodes.x[c](i);
    if (ids) ids[k] = nodes.id(i);
    if (tags) tags[k] = nodes.tag(i);
    if (spacing) spacing[k] = nodes.d(i);
  });
}

}  // namespace

pnpbs_status pnpbs_placement_get_nodes(pnpbs_placement placement, int64_t capacity, double* xy,
                                       int64_t* ids, int32_t* tags, double* spacing) {
  return guarded(placement, [&](PlacementObject& object) {
    Placement& p = object.placement;
    require_capacity(capacity, p.count());
    if (p.count() == 0) return PNPBS_OK;
    p.prepare_order();
    copy_nodes(p, 0, p.count(), xy, ids, tags, spacing);
    return PNPBS_OK;
  });
}

pnpbs_status pnpbs_placement_ghost_count(pnpbs_placement placement, int64_t* ghosts) {
  return extract(placement, [&](Placement& p) {
    require_pointer(ghosts, "ghosts");
    p.prepare_lists();
    *ghosts = p.level().nodes().count - p.count();
    return PNPBS_OK;
  });
}

pnpbs_status pnpbs_placement_get_ghosts(pnpbs_placement placement, int64_t capacity, double* xy,
                                        int64_t* ids, int32_t* tags, double* spacing,
                                        int32_t* owners) {
  return extract(placement, [&](Placement& p) {
    p.prepare_lists();
    const Nodes<2>& nodes = p.level().nodes();
    const std::int64_t owned = p.count(), ghosts = nodes.count - owned;
    require_capacity(capacity, ghosts);
    copy_nodes(p, owned, ghosts, xy, ids, tags, spacing);
    for (std::int64_t g = 0; owners && g < ghosts; ++g)
      owners[g] = p.level().owner_of(p.node_at(owned + g));
    return PNPBS_OK;
  });
}

pnpbs_status pnpbs_placement_adjacency_size(pnpbs_placement placement, int64_t* entries) {
  return extract(placement, [&](Placement& p) {
    require_pointer(entries, "entries");
    p.prepare_lists();
    *entries = adjacency_entries(p);
    return PNPBS_OK;
  });
}

pnpbs_status pnpbs_placement_get_adjacency(pnpbs_placement placement, int64_t capacity,
                                           int64_t* offsets, int64_t* neighbours) {
  return extract(placement, [&](Placement& p) {
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
  return extract(placement, [&](Placement& p) {
    require_pointer(entries, "entries");
    p.prepare_stars();
    *entries = star_entries(p);
    return PNPBS_OK;
  });
}

pnpbs_status pnpbs_placement_get_stars(pnpbs_placement placement, int64_t capacity,
                                       int64_t* offsets, int64_t* neighbours, int8_t* triangle) {
  return extract(placement, [&](Placement& p) {
    require_pointer(offsets, "offsets");
    p.prepare_stars();
    require_capacity(capacity, star_entries(p));
    if (capacity > 0) require_pointer(neighbours, "neighbours");
    std::int64_t at = 0;
    const std::int64_t owned = p.count();
    for (std::int64_t place = 0; place < owned; ++place) {
      offsets[place] = at;
      p.level().stars().for_neighbours(p.node_at(place), [&](std::int64_t j, bool is_triangle) {
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
  return extract(placement, [&](Placement& p) {
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

namespace {

template <class Value, class Getter>
pnpbs_status get_statistic(pnpbs_placement placement, const char* key, Value* value,
                           const char* type, Getter StatisticRow::*getter) {
  return guarded(placement, [&](PlacementObject& object) {
    require_pointer(key, "key");
    require_pointer(value, "value");
    const StatisticRow& row = find_statistic(key);
    if (row.computes) require_not_in_callback(*object.context);
    if (!(row.*getter))
      throw Error(PNPBS_ERROR_KEY, std::string("statistic \"") + key + "\" is of type " +
                                       row.type() + ", not " + type +
                                       ": use the get function of that type");
    *value = (row.*getter)(object.placement);
    return PNPBS_OK;
  });
}

}  // namespace

pnpbs_status pnpbs_placement_get_int64(pnpbs_placement placement, const char* key, int64_t* value) {
  return get_statistic(placement, key, value, "integer", &StatisticRow::integer);
}

pnpbs_status pnpbs_placement_get_double(pnpbs_placement placement, const char* key, double* value) {
  return get_statistic(placement, key, value, "real", &StatisticRow::real);
}

pnpbs_status pnpbs_placement_get_string(pnpbs_placement placement, const char* key,
                                        const char** value) {
  std::string text;
  const pnpbs_status status = get_statistic(placement, key, &text, "string", &StatisticRow::text);
  if (status != PNPBS_OK) return status;
  return guarded(placement, [&](PlacementObject& object) {
    require_pointer(value, "value");
    object.context->returned_text = text;
    *value = object.context->returned_text.c_str();
    return PNPBS_OK;
  });
}

pnpbs_status pnpbs_placement_warning_count(pnpbs_placement placement, int32_t* count) {
  return guarded(placement, [&](PlacementObject& object) {
    require_pointer(count, "count");
    *count = static_cast<int32_t>(object.placement.warnings().size());
    return PNPBS_OK;
  });
}

pnpbs_status pnpbs_placement_get_warning(pnpbs_placement placement, int32_t index,
                                         const char** text) {
  return guarded(placement, [&](PlacementObject& object) {
    require_pointer(text, "text");
    const std::vector<std::string>& warnings = object.placement.warnings();
    if (index < 0 || static_cast<std::size_t>(index) >= warnings.size())
      throw Error(PNPBS_ERROR_ARGUMENT, "argument index = " + std::to_string(index) +
                                            "; there are " + std::to_string(warnings.size()) +
                                            " warnings");
    object.context->returned_text = warnings[static_cast<std::size_t>(index)];
    *text = object.context->returned_text.c_str();
    return PNPBS_OK;
  });
}
