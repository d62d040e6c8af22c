// SPDX-License-Identifier: BSD-3-Clause
#include "quality/plane/defects.hpp"

#include <algorithm>
#include <functional>
#include <map>
#include <numeric>
#include <set>

#include "method/constants.hpp"
#include "neighbors/rings.hpp"
#include "quality/triangle_quality.hpp"

namespace pnpbs {

namespace {

// The input of the search for defects.
struct DefectInput {
  const Nodes<2>& nodes;
  const DelaunayStars& stars;
  double bad_below;
  const std::function<bool(const Point<2>&, double)>& fits;
};

// A defect, identified by one of its nodes, and its best repair.
struct Defect {
  std::int32_t node;
  std::int64_t id;         // of that node
  double severity;         // sum of (1 - quality)^2 of the triangles around the node
  double gain = 0;         // reduction of that sum in the patch; 0: no repair pays
  std::int32_t goes = -1;  // node to delete; -1: insert one
  Point<2> place{};        // position of the node to insert

  bool is_worse_than(const Defect& other) const {
    return severity > other.severity || (severity == other.severity && id > other.id);
  }
  bool gains_more_than(const Defect& other) const {
    return gain > other.gain || (gain == other.gain && id > other.id);
  }
};

// ------------------------------------------------------------------ finding them ---------------

bool is_inner(const DefectInput& in, std::int64_t i) {
  return in.nodes.moves(i) && in.stars.closed(i) && in.stars.needs(i) == 0;
}

// Calls visit(j) for the inner neighbours of node i that have as many neighbours as i, if that is
// five or seven. Each pair is visited only from its node with the smaller id.
template <class Visit>
void for_alike(const DefectInput& in, std::int64_t i, const Visit& visit) {
  const std::int32_t n = in.stars.size(i);
  if (n != 5 && n != 7) return;
  in.stars.for_neighbours(i, [&](std::int64_t j) {
    if (in.nodes.id(j) > in.nodes.id(i) && is_inner(in, j) && in.stars.size(j) == n) visit(j);
  });
}

// Calls visit(j, k) for the bad triangles (i, j, k) around inner node i. Each triangle is visited
// only from its inner node with the smallest id.
template <class Visit>
void for_bad_triangles(const DefectInput& in, std::int64_t i, const Visit& visit) {
  const Point<2> x = in.nodes.position(i);
  const auto after_i = [&](std::int64_t j) {
    return in.nodes.id(j) > in.nodes.id(i) || !is_inner(in, j);
  };
  in.stars.for_simplices(i, [&](const DelaunayStars::Corners& others) {
    const std::int64_t j = others[0], k = others[1];
    if (after_i(j) && after_i(k) &&
        triangle_quality(x, in.nodes.position(j), in.nodes.position(k)) < in.bad_below)
      visit(j, k);
  });
}

bool is_defect(const DefectInput& in, std::int64_t i) {
  if (!is_inner(in, i)) return false;
  const std::int32_t n = in.stars.size(i);
  bool defect = n <= 4 || n >= 8;
  for_alike(in, i, [&](std::int64_t) { defect = true; });
  if (in.bad_below > 0)
    for_bad_triangles(in, i, [&](std::int64_t, std::int64_t) { defect = true; });
  return defect;
}

// Returns the sum of (1 - quality)^2 of the triangles around node i. The terms are sorted so that
// the sum has the same bits on all ranks.
double severity_of(const DefectInput& in, std::int64_t i) {
  const Point<2> x = in.nodes.position(i);
  std::vector<double> terms;
  in.stars.for_simplices(i, [&](const DelaunayStars::Corners& others) {
    const double lack =
        1 - triangle_quality(x, in.nodes.position(others[0]), in.nodes.position(others[1]));
    terms.push_back(lack * lack);
  });
  std::sort(terms.begin(), terms.end());
  return std::accumulate(terms.begin(), terms.end(), 0.0);
}

// Returns all defects in memory order.
std::vector<Defect> find_defects(const DefectInput& in) {
  const View<char> defect = make_view<char>("pnpbs::defects::found", in.nodes.count);
  for_each("pnpbs::defects::find", in.nodes.count,
           [&](std::int64_t i) { defect(i) = is_defect(in, i); });
  std::vector<Defect> defects;
  for (std::int32_t i = 0; i < in.nodes.count; ++i)
    if (defect(i)) defects.push_back({i, in.nodes.id(i), severity_of(in, i)});
  return defects;
}

// Returns the defect at node i, or nullptr.
const Defect* defect_at(const std::vector<Defect>& defects, std::int64_t i) {
  const auto found =
      std::lower_bound(defects.begin(), defects.end(), i,
                       [](const Defect& defect, std::int64_t node) { return defect.node < node; });
  return found != defects.end() && found->node == i ? &*found : nullptr;
}

// Returns whether ahead(other, defect) is false for all other defects within `rings` rings.
template <class Ahead>
bool leads(const DefectInput& in, const std::vector<Defect>& defects, const Defect& defect,
           int rings, const Ahead& ahead) {
  return for_rings(in.stars, defect.node, rings, [&](std::int64_t i, int) {
    const Defect* other = defect_at(defects, i);
    return !other || !std::invoke(ahead, *other, defect);
  });
}

// ------------------------------------------------------------------ trying repairs -------------

// The search for the best repair of one defect. Repairs are tried in an order that is the same on
// all ranks, and the first of equal ones wins.
class Trial {
 public:
  Trial(const DefectInput& in, Defect& defect) : in_(in), defect_(defect) {}

  void find_best_repair() {
    if (!patch_.cut_out(in_.nodes, in_.stars, defect_.node)) return;
    collect_ideas();
    LocalMesh relaxed = patch_.mesh();
    relaxed.relax();
    unrepaired_ = relaxed.quality();
    for (const auto& [id, i] : surplus_) try_without(i);
    for (const std::int32_t triangle : room_) try_with_one_more(triangle);
  }

 private:
  std::int32_t place_of(std::int64_t i) const { return patch_.place_of(in_.nodes.id(i)); }

  void collect_ideas() {
    const std::int64_t i = defect_.node;
    const std::int32_t n = in_.stars.size(i);
    if (n <= 4) may_be_surplus(i);
    if (n >= 8) {
      may_have_room(patch_.mesh().largest_triangle_at(place_of(i)));
      neighbours_may_be_surplus(i);
    }
    for_alike(in_, i, [&](std::int64_t j) { collect_ideas_for_pair(i, j); });
    for_bad_triangles(in_, i, [&](std::int64_t j, std::int64_t k) {
      for (const std::int64_t corner : {i, j, k}) may_be_surplus(corner);
      may_have_room(patch_.mesh().largest_triangle_at(place_of(i)));
    });
  }

  void collect_ideas_for_pair(std::int64_t i, std::int64_t j) {
    if (in_.stars.size(i) == 7)
      may_have_room(patch_.mesh().largest_triangle_at(place_of(i), place_of(j)));
    for (const std::int64_t node : {i, j}) {
      if (in_.stars.size(node) == 5)
        may_be_surplus(node);
      else
        neighbours_may_be_surplus(node);
    }
  }

  void may_be_surplus(std::int64_t i) {
    if (is_inner(in_, i)) surplus_.emplace(in_.nodes.id(i), i);
  }

  // Adds the neighbours of node i that have five neighbours.
  void neighbours_may_be_surplus(std::int64_t i) {
    in_.stars.for_neighbours(i, [&](std::int64_t j) {
      if (in_.stars.size(j) == 5) may_be_surplus(j);
    });
  }

  void may_have_room(std::int32_t triangle) {
    if (triangle >= 0) room_.insert(triangle);
  }

  void try_without(std::int64_t i) {
    LocalMesh mesh = patch_.mesh();
    if (!mesh.remove(place_of(i))) return;
    const double gain = gain_of(mesh);
    if (gain <= defect_.gain) return;
    defect_.gain = gain;
    defect_.goes = static_cast<std::int32_t>(i);
  }

  // Tests the position against the unrelaxed nodes of the patch, which are the nodes of the level.
  bool has_room(const Point<2>& place) const {
    const double d = in_.nodes.d(defect_.node);
    return patch_.mesh().gap_at(place) >= method::kDefectMinGap * d && in_.fits(place, d);
  }

  void try_with_one_more(std::int32_t triangle) {
    LocalMesh mesh = patch_.mesh();
    const std::int32_t place = mesh.insert(triangle);
    const double gain = gain_of(mesh);
    if (gain <= defect_.gain || !has_room(mesh.position(place))) return;
    defect_.gain = gain;
    defect_.goes = -1;
    defect_.place = mesh.position(place);
  }

  // Relaxes the mesh and returns its gain. Returns 0 if the gain is too small, or if a triangle is
  // worse than the worst one without the repair.
  double gain_of(LocalMesh& mesh) const {
    mesh.relax();
    const MeshQuality repaired = mesh.quality();
    const double gain = unrepaired_.loss - repaired.loss;
    return gain > method::kDefectPays && repaired.min >= unrepaired_.min ? gain : 0;
  }

  const DefectInput& in_;
  Defect& defect_;
  StarPatch patch_;
  MeshQuality unrepaired_{};
  std::map<std::int64_t, std::int64_t> surplus_;  // nodes whose deletion is tried, by id
  std::set<std::int32_t> room_;                   // triangles in which an insertion is tried
};

}  // namespace

PopulationChange<2> choose_defect_repairs(
    const Nodes<2>& nodes, const DelaunayStars& stars, double bad_below,
    const std::function<bool(const Point<2>&, double)>& fits) {
  const DefectInput in{nodes, stars, bad_below, fits};
  std::vector<Defect> defects = find_defects(in);
  // Only the worst defect of a cluster is tried, because a repair of one helps the others. This
  // also limits the cost far from rest, where nearly every node is a defect.
  for_each("pnpbs::defects::try", static_cast<std::int64_t>(defects.size()), [&](std::int64_t k) {
    Defect& defect = defects[static_cast<std::size_t>(k)];
    if (leads(in, defects, defect, method::kClusterRings, &Defect::is_worse_than))
      Trial(in, defect).find_best_repair();
  });
  PopulationChange<2> change;
  for (const Defect& defect : defects) {
    if (defect.gain == 0 ||
        !leads(in, defects, defect, method::kDefectContestRings, &Defect::gains_more_than))
      continue;
    if (defect.goes >= 0) {
      change.deleted.push_back(defect.goes);
    } else {
      change.born.push_back({defect.place, nodes.id(defect.node), nodes.d(defect.node)});
      change.parents.push_back(defect.node);
    }
  }
  std::sort(change.deleted.begin(), change.deleted.end());
  change.deleted.erase(std::unique(change.deleted.begin(), change.deleted.end()),
                       change.deleted.end());
  return change;
}

}  // namespace pnpbs
