// SPDX-License-Identifier: BSD-3-Clause
// C interface: creation of placements, their options, computations, statistics and warnings.
#include <algorithm>
#include <cmath>

#include "api/placement_calls.hpp"
#include "api/sphere_points.hpp"
#include "base/kokkos_runtime.hpp"
#include "base/mixed_hash.hpp"
#include "base/point_text.hpp"
#include "placement/statistics.hpp"

using namespace pnpbs;
using namespace pnpbs::api;

namespace {

// The statistic "status" is the number of an outcome, which must equal the status.
static_assert(static_cast<int>(Outcome::converged) == PNPBS_OK &&
              static_cast<int>(Outcome::not_converged) == PNPBS_NOT_CONVERGED &&
              static_cast<int>(Outcome::stopped) == PNPBS_STOPPED &&
              static_cast<int>(Outcome::spacing_missed) == PNPBS_SPACING_MISSED &&
              static_cast<int>(Outcome::not_conforming) == PNPBS_NOT_CONFORMING);

pnpbs_status status_of(Outcome outcome) { return static_cast<pnpbs_status>(outcome); }

std::unique_ptr<Placement> placement_in(const DomainObject& domain,
                                        std::shared_ptr<const Communicator> comm,
                                        const Options& options) {
  if (domain.plane)
    return std::make_unique<PlacementImpl<2>>(std::move(comm), domain.plane, options);
  return std::make_unique<PlacementImpl<3>>(std::move(comm), domain.volume, options);
}

void release_all_nodes() {
  placements().for_each([](PlacementObject& object) { object.placement->release_nodes(); });
}

void set_placement_option(Placement& placement, const char* key, const auto& assign) {
  require_pointer(key, "key");
  if (std::string(key) == "threads")
    throw Error(ErrorKind::state,
                "option threads belongs to the process: set it on the context, before the first "
                "placement is created");
  assign(placement.options());
}

}  // namespace

pnpbs_status pnpbs_placement_create(pnpbs_context context, pnpbs_domain domain,
                                    pnpbs_placement* placement) {
  return guarded(context, [&](Context& object) {
    require_pointer(placement, "placement");
    *placement = nullptr;
    require_not_in_callback(object);
    std::shared_ptr<PlacementObject> made;
    collective_try(*object.communicator, [&] {
      const auto of = require(domain);
      if (of->context.get() != &object)
        throw Error(ErrorKind::argument,
                    "argument domain belongs to another context: create it on this one");
      start_kokkos(object.options.integer("threads"), object.communicator->ranks_on_node(),
                   release_all_nodes);
      made = std::make_shared<PlacementObject>(PlacementObject{
          require(context), placement_in(*of, object.communicator, object.options)});
    });
    *placement = placements().add(std::move(made));
    return PNPBS_OK;
  });
}

pnpbs_status pnpbs_placement_destroy(pnpbs_placement* placement) {
  return destroy(placement, placements);
}

pnpbs_status pnpbs_placement_set(pnpbs_placement placement, const char* key, const char* value) {
  return local_change(placement, [&](Placement& p) {
    require_pointer(value, "value");
    set_placement_option(p, key, [&](Options& o) { o.set(key, value); });
    return PNPBS_OK;
  });
}

pnpbs_status pnpbs_placement_set_int64(pnpbs_placement placement, const char* key, int64_t value) {
  return local_change(placement, [&](Placement& p) {
    set_placement_option(p, key, [&](Options& o) { o.set_integer(key, value); });
    return PNPBS_OK;
  });
}

pnpbs_status pnpbs_placement_set_double(pnpbs_placement placement, const char* key, double value) {
  return local_change(placement, [&](Placement& p) {
    set_placement_option(p, key, [&](Options& o) { o.set_real(key, value); });
    return PNPBS_OK;
  });
}

pnpbs_status pnpbs_placement_set_monitor(pnpbs_placement placement, pnpbs_monitor_fn monitor,
                                         void* user) {
  return local_change(placement, [&](Placement& p) {
    if (!monitor)
      p.monitoring().set({});
    else
      p.monitoring().set([monitor, user](double fraction, std::int64_t step, std::int64_t nodes,
                                         double max_speed) {
        const HostArithmetic arithmetic;
        return monitor(fraction, step, nodes, max_speed, user) != 0;
      });
    return PNPBS_OK;
  });
}

namespace {

template <int Dim>
IncomingNodes<Dim> checked_nodes(std::int64_t n, const double* coordinates,
                                 const std::int64_t* ids) {
  require_count(n, "n");
  if (n > 0) require_pointer(coordinates, "coordinates");
  constexpr std::int64_t kMaxId = std::int64_t{1} << 62;  // leaves ids for new nodes
  IncomingNodes<Dim> nodes;
  for (std::int64_t i = 0; i < n; ++i) {
    Point<Dim> x;
    std::copy_n(coordinates + Dim * i, Dim, x.begin());
    // Points outside the domain are dropped later, however far away they are.
    if (!std::all_of(x.begin(), x.end(), [](double c) { return std::isfinite(c); }))
      throw Error(ErrorKind::argument, "argument coordinates[" + std::to_string(i) +
                                           "] = " + point_text(x) + " must be finite");
    if (ids && (ids[i] < 0 || ids[i] > kMaxId))
      throw Error(ErrorKind::argument, "argument ids[" + std::to_string(i) + "] = " +
                                           std::to_string(ids[i]) + " must be in 0 .. 2^62");
    IncomingNode<Dim> node{x, ids ? ids[i] : -1};
    nodes.push_back(node);
  }
  if (ids) {
    std::vector<std::int64_t> sorted(ids, ids + n);
    std::sort(sorted.begin(), sorted.end());
    const auto twice = std::adjacent_find(sorted.begin(), sorted.end());
    if (twice != sorted.end())
      throw Error(ErrorKind::argument,
                  "argument ids: id " + std::to_string(*twice) + " comes twice");
  }
  return nodes;
}

}  // namespace

pnpbs_status pnpbs_placement_set_nodes(pnpbs_placement placement, int64_t n,
                                       const double* coordinates, const int64_t* ids) {
  return local_change(placement, [&](Placement& p) {
    return visit_dimension(p, [&]<int Dim>(PlacementImpl<Dim>& placement_impl) {
      IncomingNodes<Dim> nodes;
      collective_try(p.communicator(), [&] {
        std::vector<double> charted;
        nodes = checked_nodes<Dim>(
            n, placed_coordinates(placement_impl.domain().embedding(), n, coordinates, charted),
            ids);
      });
      placement_impl.set_nodes(std::move(nodes));  // reached by all ranks or by none
      return PNPBS_OK;
    });
  });
}

pnpbs_status pnpbs_placement_initialise(pnpbs_placement placement) {
  return collective(placement, [](Placement& p) { return status_of(p.initialise()); });
}

pnpbs_status pnpbs_placement_step(pnpbs_placement placement, int64_t n) {
  return collective(placement, [&](Placement& p) {
    require_count(n, "n");
    return status_of(p.step(n));
  });
}

pnpbs_status pnpbs_placement_adjust_population(pnpbs_placement placement, int64_t* inserted,
                                               int64_t* deleted) {
  return collective(placement, [&](Placement& p) {
    PopulationCounts change;
    const Outcome outcome = p.adjust_population(change);
    if (inserted) *inserted = change.inserted;
    if (deleted) *deleted = change.deleted;
    return status_of(outcome);
  });
}

pnpbs_status pnpbs_placement_rebalance(pnpbs_placement placement) {
  return collective(placement, [](Placement& p) { return status_of(p.rebalance()); });
}

pnpbs_status pnpbs_placement_run(pnpbs_placement placement) {
  return collective(placement, [](Placement& p) { return status_of(p.run()); });
}

namespace {

// Throws unless all ranks pass the same key, since they would wait for each other forever.
// Collective.
void require_same_key(const Communicator& comm, const std::string& key) {
  std::uint64_t fingerprint = 0;
  for (const char c : key) fingerprint = mixed(fingerprint ^ static_cast<unsigned char>(c));
  if (!comm.same_on_all(fingerprint))
    throw Error(ErrorKind::argument,
                "argument key = \"" + key +
                    "\" differs between ranks: request the same statistic on all of them");
}

// Gets a statistic in a collective call. From inside a callback the call is local because the other
// ranks are busy; it then returns only statistics that need no computation.
template <class Value, class Getter>
pnpbs_status get_statistic(pnpbs_placement placement, const char* key, Value* value,
                           const char* type, Getter StatisticRow::*getter) {
  return guarded(placement, [&](PlacementObject& object) {
    const StatisticRow* row = nullptr;
    const auto find = [&] {
      require_pointer(key, "key");
      require_pointer(value, "value");
      row = &find_statistic(key);
      if (row->computes) require_not_in_callback(*object.context);
      if (!(row->*getter))
        throw Error(ErrorKind::key, std::string("statistic \"") + key + "\" is of type " +
                                        row->type() + ", not " + type +
                                        ": use the get function of that type");
    };
    const auto get = [&] { *value = (row->*getter)(*object.placement); };
    if (object.context->computing) {
      find();
      get();
      return PNPBS_OK;
    }
    const Communicator& comm = object.placement->communicator();
    collective_try(comm, find);
    require_same_key(comm, key);
    collective_on(*object.placement, get);
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
    *count = static_cast<int32_t>(object.placement->warnings().size());
    return PNPBS_OK;
  });
}

namespace {

constexpr std::pair<WarningCode, int> kCodes[] = {
    {WarningCode::unknown, PNPBS_WARNING_UNKNOWN},
    {WarningCode::left_out_outside, PNPBS_WARNING_LEFT_OUT_OUTSIDE},
    {WarningCode::unused_vertices, PNPBS_WARNING_UNUSED_VERTICES},
    {WarningCode::region_points, PNPBS_WARNING_REGION_POINTS},
    {WarningCode::simplified, PNPBS_WARNING_SIMPLIFIED},
    {WarningCode::repaired, PNPBS_WARNING_REPAIRED},
    {WarningCode::triangles_left_out, PNPBS_WARNING_TRIANGLES_LEFT_OUT},
    {WarningCode::triangles_turned, PNPBS_WARNING_TRIANGLES_TURNED},
    {WarningCode::vertices_merged, PNPBS_WARNING_VERTICES_MERGED},
    {WarningCode::surfaces_touch, PNPBS_WARNING_SURFACES_TOUCH},
    {WarningCode::pieces_left_out, PNPBS_WARNING_PIECES_LEFT_OUT},
    {WarningCode::edges_rounded, PNPBS_WARNING_EDGES_ROUNDED},
    {WarningCode::creases_ignored, PNPBS_WARNING_CREASES_IGNORED},
    {WarningCode::feature_angle, PNPBS_WARNING_FEATURE_ANGLE},
    {WarningCode::curved_elements, PNPBS_WARNING_CURVED_ELEMENTS},
    {WarningCode::groups, PNPBS_WARNING_GROUPS},
    {WarningCode::feature_unresolved, PNPBS_WARNING_FEATURE_UNRESOLVED},
    {WarningCode::fixed_nodes_close, PNPBS_WARNING_FIXED_NODES_CLOSE},
    {WarningCode::growth, PNPBS_WARNING_GROWTH},
    {WarningCode::partial_extent, PNPBS_WARNING_PARTIAL_EXTENT},
    {WarningCode::spacing_coarse, PNPBS_WARNING_SPACING_COARSE},
    {WarningCode::spacing_missed, PNPBS_WARNING_SPACING_MISSED},
    {WarningCode::spacing_held, PNPBS_WARNING_SPACING_HELD},
    {WarningCode::boundary_not_followed, PNPBS_WARNING_BOUNDARY_NOT_FOLLOWED},
    {WarningCode::not_conforming, PNPBS_WARNING_NOT_CONFORMING},
    {WarningCode::small_angles, PNPBS_WARNING_SMALL_ANGLES},
    {WarningCode::features_left_out, PNPBS_WARNING_FEATURES_LEFT_OUT},
    {WarningCode::option_without_effect, PNPBS_WARNING_OPTION_WITHOUT_EFFECT},
    {WarningCode::options_changed, PNPBS_WARNING_OPTIONS_CHANGED},
    {WarningCode::depends_on_ranks, PNPBS_WARNING_DEPENDS_ON_RANKS}};
static_assert(std::ranges::all_of(kCodes, [](const auto& code) {
  return static_cast<int>(code.first) == code.second;
}));

const Warning& warning_at(const PlacementObject& object, std::int32_t at) {
  const std::vector<Warning>& warnings = object.placement->warnings();
  if (at < 0 || at >= std::ssize(warnings))
    throw Error(ErrorKind::argument, "argument index = " + std::to_string(at) + "; there are " +
                                         std::to_string(warnings.size()) + " warnings");
  return warnings[static_cast<std::size_t>(at)];
}

}  // namespace

pnpbs_status pnpbs_placement_get_warning(pnpbs_placement placement, int32_t index,
                                         const char** text) {
  return guarded(placement, [&](PlacementObject& object) {
    require_pointer(text, "text");
    object.context->returned_text =
        in_degrees(sphere_of(object), warning_at(object, index).message).text();
    *text = object.context->returned_text.c_str();
    return PNPBS_OK;
  });
}

pnpbs_status pnpbs_placement_get_warning_data(pnpbs_placement placement, int32_t index,
                                              int32_t* code, int64_t* count, double* value,
                                              double* point) {
  return guarded(placement, [&](PlacementObject& object) {
    const Warning& warning = warning_at(object, index);
    const MessageText message = in_degrees(sphere_of(object), warning.message);
    if (code) *code = static_cast<int32_t>(warning.code);
    if (count) *count = warning.count;
    if (value) *value = warning.value;
    copy_point(message.points().empty() ? NamedPoint{} : message.points().front(), point);
    return PNPBS_OK;
  });
}
