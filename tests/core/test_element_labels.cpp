// SPDX-License-Identifier: BSD-3-Clause
// Labels of tetrahedra between surface nodes. The domain is a plate one cell thick. Its cells and
// those around it are cut into six tetrahedra each (Kuhn's subdivision), so all nodes of the plate
// lie on its surface. Wrong labels make its boundary non-manifold; settling them repairs it.
#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <vector>

#include "delaunay/volume/element_labels.hpp"
#include "geometry/run_suite.hpp"
#include "level/volume/open_faces.hpp"
#include "quick_assert.hpp"
#include "random.hpp"

using pnpbs::ElementLabels;
using pnpbs::LabelledNode;
using pnpbs::LabelledTetrahedron;

namespace {

using Cell = std::array<std::int64_t, 3>;

constexpr Cell kSize{4, 3, 1};  // cells of the plate, without the layer around it

std::int64_t id_of(const Cell& corner) {
  return (corner[2] * (kSize[1] + 3) + corner[1]) * (kSize[0] + 3) + corner[0];
}

bool in_plate(const Cell& cell) {
  bool inside = true;
  for (std::size_t k = 0; k < 3; ++k) inside = inside && cell[k] >= 1 && cell[k] <= kSize[k];
  return inside;
}

struct Plate {
  std::vector<LabelledTetrahedron> tetrahedra;
  std::vector<LabelledNode> nodes;
};

// Cuts a cell along its diagonal, one tetrahedron per order of the axes.
void cut(const Cell& cell, std::vector<LabelledTetrahedron>& tetrahedra) {
  std::array<std::size_t, 3> axes{0, 1, 2};
  do {
    LabelledTetrahedron t{{}, in_plate(cell), true, 0.1, {}};
    Cell corner = cell;
    t.ids[0] = id_of(corner);
    for (std::size_t k = 0; k < 3; ++k) {
      ++corner[axes[k]];
      t.ids[k + 1] = id_of(corner);
    }
    std::ranges::sort(t.ids);
    t.along.fill(true);
    tetrahedra.push_back(t);
  } while (std::ranges::next_permutation(axes).found);
}

Plate plate() {
  Plate made;
  Cell cell;
  for (cell[2] = 0; cell[2] <= kSize[2] + 1; ++cell[2])
    for (cell[1] = 0; cell[1] <= kSize[1] + 1; ++cell[1])
      for (cell[0] = 0; cell[0] <= kSize[0] + 1; ++cell[0]) cut(cell, made.tetrahedra);
  for (cell[2] = 1; cell[2] <= kSize[2] + 1; ++cell[2])
    for (cell[1] = 1; cell[1] <= kSize[1] + 1; ++cell[1])
      for (cell[0] = 1; cell[0] <= kSize[0] + 1; ++cell[0])
        made.nodes.push_back({id_of(cell), 1, {}});
  return made;
}

int defects(const ElementLabels& labels, const std::vector<LabelledNode>& nodes) {
  int sum = 0;
  for (const LabelledNode& node : nodes) sum += labels.defects_at(node.id);
  return sum;
}

// Returns whether all corners are nodes of the plate.
bool is_known(const Plate& plate, const LabelledTetrahedron& t) {
  return std::ranges::all_of(t.ids, [&](std::int64_t id) {
    return std::ranges::find(plate.nodes, id, &LabelledNode::id) != plate.nodes.end();
  });
}

std::vector<LabelledTetrahedron> settled(const Plate& plate) {
  ElementLabels labels(plate.tetrahedra, plate.nodes);
  labels.settle();
  return labels.changed();
}

}  // namespace

START_TEST(what_is_whole_stays) {
  const Plate whole = plate();
  ElementLabels labels(whole.tetrahedra, whole.nodes);
  ck_assert_int_eq(defects(labels, whole.nodes), 0);
  labels.settle();
  ck_assert(labels.changed().empty());
}
END_TEST

// A wrong label either leaves a valid dent, or makes the boundary non-manifold and is corrected.
START_TEST(one_wrong_label_is_mended) {
  const Plate whole = plate();
  int torn = 0;
  for (std::size_t t = 0; t < whole.tetrahedra.size(); ++t) {
    std::vector<LabelledTetrahedron> wrong = whole.tetrahedra;
    wrong[t].is_element = !wrong[t].is_element;
    ElementLabels labels(wrong, whole.nodes);
    if (!is_known(whole, wrong[t]) || defects(labels, whole.nodes) == 0) continue;
    ++torn;
    labels.settle();
    ck_assert_int_eq(defects(labels, whole.nodes), 0);
  }
  ck_assert(torn >= 10);
}
END_TEST

START_TEST(thin_elements_go_where_the_boundary_stays_whole) {
  const Plate whole = plate();
  int gone = 0, kept = 0;
  for (std::size_t t = 0; t < whole.tetrahedra.size(); ++t) {
    if (!whole.tetrahedra[t].is_element) continue;
    std::vector<LabelledTetrahedron> without = whole.tetrahedra, marked = whole.tetrahedra;
    without[t].is_element = false;
    marked[t].thin = true;
    const bool may_go = defects(ElementLabels(without, whole.nodes), whole.nodes) == 0;
    ElementLabels labels(marked, whole.nodes);
    labels.drop_thin_elements();
    ck_assert_uint_eq(labels.changed().size(), may_go ? 1 : 0);
    ck_assert_int_eq(defects(labels, whole.nodes), 0);
    ++(may_go ? gone : kept);
  }
  ck_assert(gone >= 10 && kept >= 10);
}
END_TEST

START_TEST(settled_labels_are_those_of_any_order) {
  const Plate whole = plate();
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Random random(seed);
    Plate wrong = whole;
    for (LabelledTetrahedron& t : wrong.tetrahedra)
      if (t.is_element && random.between(0, 1) < 0.15) t.is_element = false;
    ElementLabels labels(wrong.tetrahedra, wrong.nodes);
    const int before = defects(labels, wrong.nodes);
    labels.settle();
    const std::vector<LabelledTetrahedron> changed = labels.changed();
    ck_assert(before > 0 && defects(labels, wrong.nodes) < before / 4);
    Plate shuffled = wrong;
    random.shuffle(shuffled.tetrahedra);
    random.shuffle(shuffled.nodes);
    shuffled.tetrahedra.push_back(shuffled.tetrahedra.front());  // the same one from two nodes
    ElementLabels again(shuffled.tetrahedra, shuffled.nodes);
    again.settle();
    ck_assert(again.changed() == changed);
  }
}
END_TEST

// A feature edge of the plate is cut off by a dent that leaves the boundary a manifold.
START_TEST(feature_edges_stay_on_the_boundary) {
  Plate dented = plate();
  const std::int64_t a = id_of({2, 1, 2}), b = id_of({3, 1, 2});
  for (LabelledNode& node : dented.nodes) {
    if (node.id == a) node.joined.push_back(b);
    if (node.id == b) node.joined.push_back(a);
  }
  ck_assert_int_eq(defects(ElementLabels(dented.tetrahedra, dented.nodes), dented.nodes), 0);
  int cut_off = 0;
  for (LabelledTetrahedron& t : dented.tetrahedra)
    if (t.is_element && std::ranges::binary_search(t.ids, a) &&
        std::ranges::binary_search(t.ids, b)) {
      t.is_element = false;
      ++cut_off;
    }
  ck_assert(cut_off > 0);
  ElementLabels labels(dented.tetrahedra, dented.nodes);
  ck_assert(labels.defects_at(a) > 0);
  labels.settle();
  ck_assert_int_eq(defects(labels, dented.nodes), 0);
}
END_TEST

using Face = std::array<std::int64_t, 3>;

// Returns the faces that belong to exactly one element.
std::vector<Face> open_faces_of(std::vector<LabelledTetrahedron> tetrahedra,
                                const std::vector<LabelledTetrahedron>& changed) {
  for (LabelledTetrahedron& t : tetrahedra)
    for (const LabelledTetrahedron& other : changed)
      if (t.ids == other.ids) t.is_element = other.is_element;
  std::map<Face, int> faces;
  for (const LabelledTetrahedron& t : tetrahedra)
    for (std::size_t k = 0; t.is_element && k < 4; ++k) {
      Face face;
      std::ranges::copy_if(t.ids, face.begin(), [&](std::int64_t id) { return id != t.ids[k]; });
      ++faces[face];
    }
  std::vector<Face> open;
  for (const auto& [face, count] : faces)
    if (count == 1) open.push_back(face);
  return open;
}

// Returns vertices minus edges plus triangles of the boundary of the elements.
std::int64_t euler_of(const std::vector<LabelledTetrahedron>& tetrahedra,
                      const std::vector<LabelledTetrahedron>& changed) {
  std::set<std::int64_t> vertices;
  std::set<std::array<std::int64_t, 2>> edges;
  const std::vector<Face> faces = open_faces_of(tetrahedra, changed);
  for (const Face& face : faces) {
    vertices.insert(face.begin(), face.end());
    edges.insert({{face[0], face[1]}, {face[1], face[2]}, {face[0], face[2]}});
  }
  return std::ssize(vertices) - std::ssize(edges) + std::ssize(faces);
}

std::int64_t pieces_of(const std::vector<LabelledTetrahedron>& tetrahedra,
                       const std::vector<LabelledTetrahedron>& changed) {
  constexpr std::size_t kIds = 1000;
  pnpbs::UnionFind<std::size_t> joined(kIds);
  std::set<std::size_t> nodes, pieces;
  for (const Face& face : open_faces_of(tetrahedra, changed))
    for (const std::int64_t id : face) {
      joined.join(static_cast<std::size_t>(face[0]), static_cast<std::size_t>(id));
      nodes.insert(static_cast<std::size_t>(id));
    }
  for (const std::size_t node : nodes) pieces.insert(joined.root(node));
  return std::ssize(pieces);
}

// The number of wrong labels is so large that changing one or two at once ends in nodes without a
// disk, or in handles. The search finds a sphere.
START_TEST(the_search_finds_a_sphere) {
  const Plate whole = plate();
  ck_assert_int_eq(euler_of(whole.tetrahedra, {}), 2);
  int searched = 0, handles = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    Random random(seed);
    Plate wrong = whole;
    for (LabelledTetrahedron& t : wrong.tetrahedra)
      if (is_known(whole, t) && random.between(0, 1) < 0.4) t.is_element = !t.is_element;
    const std::int64_t before = euler_of(wrong.tetrahedra, {});
    ElementLabels labels(wrong.tetrahedra, wrong.nodes);
    labels.settle();
    ck_assert_int_eq(labels.euler_change(), euler_of(wrong.tetrahedra, labels.changed()) - before);
    searched += defects(labels, wrong.nodes) > 0;
    handles += defects(labels, wrong.nodes) == 0 && before + labels.euler_change() != 2;
    labels.search(2 - before, 1 - pieces_of(wrong.tetrahedra, {}), 20000);
    ck_assert_int_eq(defects(labels, wrong.nodes), 0);
    ck_assert_int_eq(euler_of(wrong.tetrahedra, labels.changed()), 2);
    ck_assert_int_eq(pieces_of(wrong.tetrahedra, labels.changed()), 1);
    ck_assert_int_eq(labels.euler_change(), 2 - before);
  }
  ck_assert(searched + handles >= 20);
}
END_TEST

START_TEST(disks_around_a_node) {
  using pnpbs::disks_of;
  using pnpbs::FaceFan;
  const auto disks = [](FaceFan fan) {
    std::ranges::sort(fan);
    return disks_of(fan);
  };
  ck_assert_int_eq(disks({}), 0);
  ck_assert_int_eq(disks({{1, 2}, {2, 3}, {3, 1}}), 1);
  ck_assert_int_eq(disks({{1, 2}, {2, 3}, {3, 1}, {6, 4}, {4, 5}, {5, 6}}), 2);
  ck_assert_int_eq(disks({{1, 2}, {2, 3}, {3, 4}}), 0);  // open
  // Two disks at an edge.
  ck_assert_int_eq(disks({{1, 2}, {2, 3}, {3, 1}, {1, 4}, {4, 5}, {5, 1}}), 0);
  ck_assert_int_eq(disks({{1, 2}, {2, 3}, {3, 1}, {4, 3}}), 0);
}
END_TEST

// Labels do not change for deep tetrahedra, nor between nodes whose surroundings are not completely
// known.
START_TEST(what_is_sure_stays) {
  Plate deep = plate();
  const auto middle = std::ranges::find_if(
      deep.tetrahedra, [](const LabelledTetrahedron& t) { return t.is_element; });
  middle->is_element = false;
  for (LabelledTetrahedron& t : deep.tetrahedra) t.depth = 0.3;
  ck_assert(settled(deep).empty());
  for (LabelledTetrahedron& t : deep.tetrahedra) t.depth = 0.1;
  deep.nodes.clear();
  ck_assert(settled(deep).empty());
}
END_TEST

TEST_SUITE(test_element_labels) {
  return run_suite("element_labels", {what_is_whole_stays, one_wrong_label_is_mended,
                                      thin_elements_go_where_the_boundary_stays_whole,
                                      settled_labels_are_those_of_any_order, disks_around_a_node,
                                      feature_edges_stay_on_the_boundary, what_is_sure_stays,
                                      the_search_finds_a_sphere});
}
