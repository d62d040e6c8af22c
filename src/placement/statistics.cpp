// SPDX-License-Identifier: BSD-3-Clause
#include "placement/statistics.hpp"

#include <cstdio>

#include "base/available_memory.hpp"
#include "base/build_config.hpp"
#include "base/kokkos_runtime.hpp"
#include "settings/named_rows.hpp"

namespace pnpbs {

namespace {

using P = Placement&;

StatisticRow integer(const char* name, std::int64_t (*get)(P), const char* help) {
  return {name, help, get, nullptr, nullptr, false};
}
StatisticRow real(const char* name, double (*get)(P), const char* help) {
  return {name, help, nullptr, get, nullptr, false};
}
StatisticRow text(const char* name, std::string (*get)(P), const char* help) {
  return {name, help, nullptr, nullptr, get, false};
}

StatisticRow computed(StatisticRow row) {
  row.computes = true;
  return row;
}

template <Phase phase>
double seconds(P p) {
  return p.timers().seconds(phase);
}

template <Phase phase>
double waiting(P p) {
  return p.timers().waiting(phase);
}

// Returns the number of nodes worked for over the number of owned ones, summed over all ranks.
// Collective.
template <Phase phase>
double redundancy(P p) {
  const NodesWorkedFor& nodes = p.timers().nodes(phase);
  std::vector<std::int64_t> sums{nodes.all, nodes.owned};
  p.communicator().allreduce_sum(sums);
  return sums[1] > 0 ? static_cast<double>(sums[0]) / static_cast<double>(sums[1]) : 1;
}

std::string stop_reason(P p) {
  switch (p.stop_reason()) {
    case StopReason::rest:
      return "rest";
    case StopReason::step_limit:
      return "step limit";
    case StopReason::monitor:
      return "monitor";
    case StopReason::none:
      break;
  }
  return "none";
}

std::string hash(P p) {
  char digits[17];
  std::snprintf(digits, sizeof digits, "%016llx",
                static_cast<unsigned long long>(p.results().hash()));
  return digits;
}

}  // namespace

const std::vector<StatisticRow>& statistic_table() {
  static const std::vector<StatisticRow> table = {
      integer(
          "nodes", [](P p) { return p.results().global_count(); }, "nodes of all kinds"),
      integer(
          "boundary_nodes", [](P p) { return p.results().boundary_nodes(); },
          "nodes on boundary and inner curves and surfaces, and fixed nodes"),
      integer(
          "steps", [](P p) { return p.steps_done(); },
          "time steps done, including those on coarser levels"),
      integer(
          "finished", [](P p) { return std::int64_t{p.finished()}; },
          "1 if a run has finished and no step was done since, otherwise 0"),
      integer(
          "status", [](P p) { return static_cast<std::int64_t>(p.outcome()); },
          "status (pnpbs_status) that the last run to its end returned, also where it was "
          "continued "
          "from a checkpoint; 0 before the first run"),
      integer(
          "levels", [](P p) { return std::int64_t{p.coarser_levels()}; },
          "coarser levels that provided the first nodes"),
      integer(
          "rebuilds", [](P p) { return p.rebuilds(); },
          "number of times the adjacency lists were built"),
      integer(
          "inserted", [](P p) { return p.inserted(); },
          "nodes inserted by population control, or where d became finer"),
      integer(
          "deleted", [](P p) { return p.deleted(); },
          "nodes deleted by population control, or where d became coarser"),
      integer(
          "dropped", [](P p) { return p.dropped(); },
          "nodes given by the user that lie outside or too close to the boundary"),
      integer(
          "missing_faces", [](P p) { return p.missing_faces(); },
          "faces of the boundary of the last run's tetrahedra with a point farther than d from the "
          "surfaces of the body"),
      integer(
          "left_out", [](P p) { return p.results().level_figures().left_out; },
          "nodes of corners and sharp edges that the last run left out because no tetrahedra "
          "connected to them"),
      integer(
          "unresolved_places", [](P p) { return p.unresolved_places(); },
          "places around which d is reduced because elements were missing there, or had angles "
          "below min_angle (option conforming_rounds)"),
      integer(
          "unresolved_nodes", [](P p) { return p.unresolved_nodes(); },
          "nodes that were expected when d was last reduced at such places; 0 without them, and "
          "after a restart"),
      real(
          "unresolved_spacing", [](P p) { return p.unresolved_spacing(); },
          "smallest d at the first of these places before it was reduced, also where a smaller d "
          "did "
          "not help: a resolution for pnpbs_domain_set_resurfaced that removes what d does not "
          "resolve; 0 without such places"),
      real(
          "repaired.resolution", [](P p) { return p.repair_distances().resolution; },
          "resolution of the surface of a repaired body (pnpbs_domain_set_repair); the other "
          "distances are evaluated at points no farther apart than this; all are 0 without a "
          "repair"),
      real(
          "repaired.distance", [](P p) { return p.repair_distances().to_given; },
          "largest distance of the repaired surface from the given triangles, except where it "
          "closes holes"),
      real(
          "repaired.hole_distance", [](P p) { return p.repair_distances().over_holes; },
          "largest distance of the repaired surface from the given triangles where it closes "
          "holes: where the direction to their nearest point is tangential rather than normal "
          "to it"),
      real(
          "repaired.mean_distance", [](P p) { return p.repair_distances().mean_to_given; },
          "mean distance of the repaired surface from the given triangles, including holes"),
      real(
          "repaired.given_distance", [](P p) { return p.repair_distances().to_new; },
          "largest distance of the given triangles from the repaired surface: large where some "
          "lie inside, enclose nothing or are closer to others than the resolution"),
      real(
          "repaired.lost_area", [](P p) { return p.repair_distances().lost; },
          "share of the area of the given triangles that is farther than the resolution from "
          "the repaired surface"),
      integer(
          "unknown_uses", [](P p) { return p.unknown_uses(); },
          "decisions, up to the end of the last run, based on stars that a rank does not hold "
          "exactly, and nodes whose adjacency lists could miss a node, or that lie in a leaf of "
          "the background tree held by no rank; in a library built with "
          "PNPBS_COUNT_UNKNOWN_USES also nodes moved or judged by others that are not exact; if "
          "not 0, the nodes may depend on the number of ranks"),
      integer(
          "nodes_held",
          [](P p) {
            const std::int64_t held = p.results().held();
            return static_cast<std::int64_t>(
                p.communicator().allreduce_max(static_cast<double>(held)));
          },
          "maximum number of nodes held by a rank, including its ghosts"),
      integer(
          "ghosts", [](P p) { return p.results().held() - p.results().count(); },
          "nodes of other ranks that this rank currently holds"),
      integer(
          "neighbours", [](P p) { return p.results().level_figures().neighbour_ranks; },
          "ranks that this rank exchanges ghosts with"),
      integer(
          "exchange.bytes", [](P p) { return p.results().level_figures().exchange_bytes; },
          "bytes that this rank sends every exchange_interval steps"),
      integer(
          "work.owned", [](P p) { return p.results().level_figures().owned_work; },
          "cost of a step to this rank: listed pairs of its own nodes, and 8 for each node"),
      real(
          "imbalance", [](P p) { return p.results().imbalance(); },
          "largest over mean of work.owned over the ranks"),
      real("redundancy.lists", redundancy<Phase::lists>,
           "nodes for which adjacency lists were built, ghosts included, over those that the "
           "building rank owned; summed over builds and ranks, as are the next three; 1 on one "
           "rank"),
      real("redundancy.motion", redundancy<Phase::motion>,
           "the same of forces and motion, over steps"),
      real("redundancy.stars", redundancy<Phase::stars>, "the same of Delaunay stars"),
      real("redundancy.sweeps", redundancy<Phase::sweeps>,
           "the same of finishing sweeps, with the stars in which their repairs look for slivers"),
      integer(
          "rebalances", [](P p) { return p.rebalances(); },
          "number of times the work was repartitioned"),
      real("seconds.boundary", seconds<Phase::boundary>, "laying the boundary nodes"),
      real("seconds.tree", seconds<Phase::tree>, "background tree and samples of d"),
      real("seconds.partition", seconds<Phase::partition>, "assigning leaves to ranks"),
      real("seconds.fill", seconds<Phase::fill>, "initial inner nodes"),
      real("seconds.spacing", seconds<Phase::spacing>, "evaluating d at the nodes; growth limit"),
      real("seconds.lists", seconds<Phase::lists>, "buckets and adjacency lists"),
      real("seconds.motion", seconds<Phase::motion>, "forces and time steps"),
      real("seconds.exchange", seconds<Phase::exchange>, "migration and ghosts between ranks"),
      real("seconds.population", seconds<Phase::population>, "population control"),
      real("seconds.stars", seconds<Phase::stars>, "Delaunay stars"),
      real("seconds.sweeps", seconds<Phase::sweeps>, "finishing sweeps"),
      real("seconds.conformity", seconds<Phase::conformity>,
           "making the elements conform to the boundary of the domain, and checking them"),
      real("seconds.other", seconds<Phase::other>, "everything else"),
      real(
          "seconds.total", [](P p) { return p.timers().total(); },
          "from domain and spacing given to nodes available, and what was derived from them on "
          "request since, without files: the sum of the phases above"),
      real(
          "waiting.boundary", waiting<Phase::boundary>,
          "seconds of this phase that this rank spent in communication, waiting for other ranks or "
          "transferring data; the next ones are those of the other phases"),
      real("waiting.tree", waiting<Phase::tree>, "the same of the tree"),
      real("waiting.partition", waiting<Phase::partition>, "the same of the partition"),
      real("waiting.fill", waiting<Phase::fill>, "the same of the initial inner nodes"),
      real("waiting.spacing", waiting<Phase::spacing>, "the same of the evaluation of d"),
      real("waiting.lists", waiting<Phase::lists>, "the same of the lists"),
      real("waiting.motion", waiting<Phase::motion>, "the same of the motion"),
      real("waiting.exchange", waiting<Phase::exchange>, "the same of the exchange"),
      real("waiting.population", waiting<Phase::population>, "the same of population control"),
      real("waiting.stars", waiting<Phase::stars>, "the same of the stars"),
      real("waiting.sweeps", waiting<Phase::sweeps>, "the same of the sweeps"),
      real("waiting.conformity", waiting<Phase::conformity>, "the same of conformity"),
      real("waiting.other", waiting<Phase::other>, "the same of everything else"),
      real(
          "waiting.total", [](P p) { return p.timers().total_waiting(); }, "the sum of these"),
      integer(
          "memory.peak_bytes", [](P) { return peak_memory(); },
          "peak memory of this process so far"),
      computed(integer(
          "memory.max_peak_bytes",
          [](P p) {
            const auto mine = static_cast<double>(peak_memory());
            return static_cast<std::int64_t>(p.communicator().allreduce_max(mine));
          },
          "largest memory.peak_bytes over the ranks")),
      computed(real(
          "volume.elements", [](P p) { return p.volume_of_elements(); },
          "volume of the tetrahedra; 0 for domains that are not bodies in space")),
      real(
          "volume.domain", [](P p) { return p.volume_of_domain(); },
          "volume of the body; 0 for domains that are not bodies in space"),
      computed(real(
          "boundary.distance", [](P p) { return p.boundary_distance().of_faces; },
          "largest distance over d of the boundary of the tetrahedra from the surfaces of the "
          "body, at the centroids of its faces and the middles of their sides")),
      computed(real(
          "boundary.given_distance", [](P p) { return p.boundary_distance().of_surfaces; },
          "largest distance over d of the surfaces of the body from the boundary of the "
          "tetrahedra, at points no farther apart than d")),
      computed(real(
          "d_error.mean", [](P p) { return p.results().spacing_error().mean; },
          "nearest-neighbour distance over d: mean")),
      computed(real(
          "d_error.deviation", [](P p) { return p.results().spacing_error().deviation; },
          "nearest-neighbour distance over d: standard deviation")),
      computed(real(
          "d_error.least", [](P p) { return p.results().spacing_error().min; },
          "nearest-neighbour distance over d: minimum")),
      computed(real(
          "quality.mean", [](P p) { return p.results().element_quality().simplex.mean; },
          "quality of the triangles, 2 r_in / R, or of the tetrahedra, 3 r_in / R: mean")),
      computed(real(
          "quality.one_percent",
          [](P p) { return p.results().element_quality().simplex.one_percent; },
          "quality of the elements: 99 % lie above this, a multiple of 2^-16")),
      computed(real(
          "quality.min", [](P p) { return p.results().element_quality().simplex.min; },
          "quality of the elements: minimum")),
      computed(real(
          "quality.min_angle", [](P p) { return p.results().element_quality().simplex.min_angle; },
          "smallest angle of the triangles, or between faces of the tetrahedra, degrees")),
      computed(real(
          "quality.min_angle_at_sharp_edges",
          [](P p) { return p.results().element_quality().simplex.min_angle_at_sharp_edges; },
          "the same of the tetrahedra with a node closer than d to an edge at which the body "
          "itself has an angle below 33 degrees, and of those that connect the two sides of a wall "
          "thinner than d/4; 180 without such edges and walls")),
      computed(real(
          "quality.min_angle_elsewhere",
          [](P p) { return p.results().element_quality().simplex.min_angle_elsewhere; },
          "the same of all other elements")),
      computed(integer(
          "quality.obtuse", [](P p) { return p.results().element_quality().simplex.obtuse; },
          "triangles with an angle of more than 90 degrees: their circumcentres, corners of "
          "Voronoi cells, lie outside of them")),
      computed(integer(
          "quality.on_boundary",
          [](P p) { return p.results().element_quality().simplex.on_boundary; },
          "in the plane and on spheres: triangles with all nodes on curves that bound the domain")),
      computed(real(
          "quality.irregular", [](P p) { return p.results().element_quality().irregular; },
          "share of the inner nodes that do not have six neighbours in their stars, in space 14")),
      computed(real(
          "edge.mean", [](P p) { return p.results().element_quality().edge.mean; },
          "length of the elements' edges over d, the mean of d at their ends: mean")),
      computed(real(
          "edge.deviation", [](P p) { return p.results().element_quality().edge.deviation; },
          "length of the elements' edges over d: standard deviation")),
      computed(integer(
          "edge.uncrossed", [](P p) { return p.results().element_quality().cell.uncrossed; },
          "in the plane and on spheres: edges between two triangles that the Voronoi edge between "
          "their circumcentres does not cross")),
      computed(real(
          "edge.mean_dual_offset",
          [](P p) { return p.results().element_quality().cell.shape.dual_offset.mean; },
          "in the plane and on spheres: distance between the middle of an edge between two inner "
          "nodes and that of the Voronoi edge across it, over the length of the former: mean")),
      computed(real(
          "edge.max_dual_offset",
          [](P p) { return p.results().element_quality().cell.shape.dual_offset.worst; },
          "the same: maximum")),
      computed(real(
          "cell.mean_offset", [](P p) { return p.results().element_quality().cell.mean_offset; },
          "in the plane and on spheres: distance over d of inner nodes from the centroids of their "
          "Voronoi cells for the density d^-4 (option centroidal_sweeps): mean")),
      computed(real(
          "cell.max_offset", [](P p) { return p.results().element_quality().cell.max_offset; },
          "the same: maximum")),
      computed(real(
          "cell.mean_edge_ratio",
          [](P p) { return p.results().element_quality().cell.shape.edge_ratio.mean; },
          "in the plane and on spheres: shortest edge of the Voronoi cell of an inner node, the "
          "polygon of its triangles' circumcentres, over the longest: mean")),
      computed(real(
          "cell.min_edge_ratio",
          [](P p) { return p.results().element_quality().cell.shape.edge_ratio.worst; },
          "the same: minimum")),
      computed(real(
          "cell.mean_area_ratio",
          [](P p) { return p.results().element_quality().cell.shape.area_ratio.mean; },
          "of two such cells beside each other: area of the smaller one over that of the larger: "
          "mean")),
      computed(real(
          "cell.min_area_ratio",
          [](P p) { return p.results().element_quality().cell.shape.area_ratio.worst; },
          "the same: minimum")),
      real(
          "speed.largest", [](P p) { return p.results().speeds().max; },
          "largest scaled speed, spacings per unit of time"),
      real(
          "speed.mean", [](P p) { return p.results().speeds().mean; },
          "mean scaled speed, spacings per unit of time"),
      text("stop_reason", stop_reason,
           "why the last run or step call ended: rest, step limit, monitor, or none"),
      text("hash", hash,
           "64-bit hash of ids, coordinate bits and tags; the same for any number of ranks and "
           "threads"),
      text(
          "version", [](P) { return std::string(PNPBS_PROJECT_VERSION); },
          "version of the library"),
      integer(
          "ranks", [](P p) { return std::int64_t{p.communicator().size()}; },
          "number of processes of the placement"),
      integer(
          "threads", [](P) { return thread_count(); }, "threads of this process"),
  };
  return table;
}

const StatisticRow& find_statistic(const std::string& key) {
  return row_named(key, statistic_table(), "statistic");
}

}  // namespace pnpbs
