// SPDX-License-Identifier: BSD-3-Clause
#include "cgrid/sphere_grid.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

#include "base/execution.hpp"
#include "comm/communicator.hpp"
#include "comm/id_blocks.hpp"
#include "comm/records.hpp"
#include "mesh/distributed_mesh.hpp"
#include "mesh/mesh_records.hpp"
#include "sphere/sphere_geometry.hpp"

namespace pnpbs {
namespace {

// Global numbers of the cells, edges and vertices. Each of them has a leader, one of its nodes
// (SphereGrid::leads and leader_of). They are numbered in the order of the ids of their leaders, so
// the numbers do not depend on the ranks.

// For a node, how many cells, edges and vertices it leads, or the global number of the first of
// each that it leads.
struct LedEntities {
  std::int64_t cells = 0, edges = 0, vertices = 0;

  LedEntities& operator+=(const LedEntities& other) {
    cells += other.cells;
    edges += other.edges;
    vertices += other.vertices;
    return *this;
  }
};

// The entities of a node on their way to the block of its id and back.
struct Entry {
  std::int64_t id;
  std::int32_t rank;  // rank that owns the node
  LedEntities led;
};

// Replaces the counts by their exclusive prefix sums, beginning with `next`.
void count_up(std::vector<Entry>& entries, LedEntities next) {
  for (Entry& entry : entries) {
    const LedEntities count = entry.led;
    entry.led = next;
    next += count;
  }
}

LedEntities sum_of(const std::vector<Entry>& entries) {
  LedEntities sum;
  for (const Entry& entry : entries) sum += entry.led;
  return sum;
}

// Returns for each owned node the global numbers of the first entities that it leads, from
// `counts`, how many it leads. Sets `total` to the numbers of entities on all ranks. `ids` must be
// increasing, and no id may be on two ranks. Collective.
std::vector<LedEntities> first_numbers(const Communicator& comm,
                                       const std::vector<std::int64_t>& ids,
                                       const std::vector<LedEntities>& counts, LedEntities& total) {
  std::vector<Entry> entries;
  entries.reserve(ids.size());
  for (std::size_t k = 0; k < ids.size(); ++k) entries.push_back({ids[k], comm.rank(), counts[k]});
  if (comm.size() > 1) {
    const IdBlocks blocks(comm, std::ssize(ids),
                          [&](std::int64_t k) { return ids[static_cast<std::size_t>(k)]; });
    entries = redistribute<Entry>(comm, entries,
                                  [&](const Entry& entry) { return blocks.rank_of(entry.id); });
    std::ranges::sort(entries, {}, &Entry::id);
  }
  const LedEntities here = sum_of(entries);
  count_up(entries, {comm.exclusive_scan(here.cells), comm.exclusive_scan(here.edges),
                     comm.exclusive_scan(here.vertices)});
  std::vector<std::int64_t> sums{here.cells, here.edges, here.vertices};
  comm.allreduce_sum(sums);
  total = {sums[0], sums[1], sums[2]};
  if (comm.size() > 1) {
    entries = redistribute<Entry>(comm, entries, [](const Entry& entry) { return entry.rank; });
    std::ranges::sort(entries, {}, &Entry::id);
  }
  std::vector<LedEntities> first;
  first.reserve(entries.size());
  for (const Entry& entry : entries) first.push_back(entry.led);
  return first;
}

constexpr std::int64_t kNone = SphereGrid::kNone;

std::size_t index(std::int64_t i) { return static_cast<std::size_t>(i); }

// Number of ghost layers of the mesh. The weights need the stars of owned nodes and of their
// neighbours, and the neighbours of these may lead an edge.
constexpr int kLayers = 3;

// Builds the grid. The functions are called in the order of their declaration.
class Builder {
 public:
  Builder(Results<2>& results, SphereGrid& grid)
      : results_(results), comm_(results.communicator()), grid_(grid) {}

  void build() {
    take_mesh();
    find_cells();
    const std::vector<LedEntities> first = first_of_nodes();
    number_entities(first);
    find_kites();
  }

 private:
  void take_mesh();
  void find_centres();
  void find_cells();
  LedEntities led_by(std::int32_t node) const;
  std::vector<LedEntities> first_of_nodes();
  void number_entities(const std::vector<LedEntities>& first);
  void find_kites();
  std::int64_t vertex_number(std::int32_t triangle, const std::vector<LedEntities>& first) const;
  std::int64_t edge_number(std::int32_t node, std::int32_t other,
                           const std::vector<LedEntities>& first) const;
  // Appends the values at ghosts, requested from their owners, to those of owned nodes. Collective.
  template <class Value>
  void append_ghost_values(std::vector<Value>& values) const;

  Results<2>& results_;
  const Communicator& comm_;
  SphereGrid& grid_;
  std::vector<std::int64_t> numbers_;  // global numbers of the nodes, contiguous by rank
};

void Builder::take_mesh() {
  const std::unique_ptr<DistributedMesh> mesh =
      make_distributed_mesh(results_, comm_.size() > 1 ? kLayers : 0);
  const std::size_t nodes = mesh->ids.size(), triangles = mesh->element_numbers.size();
  grid_.owned = mesh->owned_nodes;
  grid_.ids = std::move(mesh->ids);
  numbers_ = std::move(mesh->numbers);
  grid_.x.resize(nodes);
  for (std::size_t i = 0; i < nodes; ++i)
    grid_.x[i] = unit_vector({mesh->x[3 * i], mesh->x[3 * i + 1], mesh->x[3 * i + 2]});
  grid_.triangles.resize(triangles);
  for (std::size_t t = 0; t < triangles; ++t)
    std::copy_n(&mesh->element_corners[3 * t], 3, grid_.triangles[t].begin());
  grid_.rings = StarRings(grid_.triangles, grid_.ids);
  find_centres();
}

// The corners of a triangle begin with the smallest id on all ranks, so that all ranks compute the
// same bits.
void Builder::find_centres() {
  grid_.centres.resize(grid_.triangles.size());
  for_each("pnpbs::SphereGrid::centres", std::ssize(grid_.triangles), [&](std::int64_t t) {
    const StarRings::Triangle& corners = grid_.triangles[index(t)];
    grid_.centres[index(t)] =
        circumcentre(grid_.at(corners[0]), grid_.at(corners[1]), grid_.at(corners[2]));
  });
}

template <class Value>
void Builder::append_ghost_values(std::vector<Value>& values) const {
  struct Answer {
    std::int64_t number;
    Value value;
  };
  const RankRanges ranges(comm_, grid_.owned);
  const std::vector<std::int64_t> ghosts(numbers_.begin() + grid_.owned, numbers_.end());
  const auto give = [&](std::int64_t number, int, std::vector<Answer>& answers) {
    answers.push_back({number, values[index(number - ranges.first())]});
  };
  std::vector<Answer> answers =
      query_owners<Answer>(comm_, ranges, ghosts, give, [](const Answer& a) { return a.number; });
  std::ranges::sort(answers, {}, &Answer::number);  // ghosts are sorted by number, too
  for (const Answer& answer : answers) values.push_back(answer.value);
}

// Determines which nodes have a cell. Their numbers are set later.
void Builder::find_cells() {
  grid_.cell.resize(index(grid_.owned));
  std::int32_t longest = 0;
  double min_spacing = std::numeric_limits<double>::infinity();
  for (std::int32_t i = 0; i < grid_.owned; ++i) {
    const double d = results_.spacing_at(results_.node_at(i)) / grid_.radius;
    grid_.spacing.push_back(d);
    grid_.cell[index(i)] = grid_.rings.closed(i) ? 0 : kNone;
    if (!grid_.rings.closed(i)) continue;
    longest = std::max(longest, grid_.rings.size(i));
    min_spacing = std::min(min_spacing, d);
  }
  grid_.min_spacing = -comm_.allreduce_max(-min_spacing);
  grid_.max_edges = static_cast<int>(comm_.allreduce_max(double(longest)));
  append_ghost_values(grid_.cell);
}

// Counts the entities that a node leads.
LedEntities Builder::led_by(std::int32_t node) const {
  LedEntities led;
  if (!grid_.has_cell(node)) return led;
  led.cells = 1;
  for (std::int64_t k = grid_.rings.begin(node); k < grid_.rings.end(node); ++k) {
    led.edges += grid_.leads(node, grid_.rings.neighbour(k));
    led.vertices += grid_.leader_of(grid_.rings.triangle(k)) == node;
  }
  return led;
}

// Returns the first numbers at all nodes and sets the total numbers of the grid. Collective.
std::vector<LedEntities> Builder::first_of_nodes() {
  std::vector<LedEntities> counts(index(grid_.owned));
  for_each("pnpbs::SphereGrid::count", grid_.owned,
           [&](std::int64_t i) { counts[index(i)] = led_by(static_cast<std::int32_t>(i)); });
  LedEntities total;
  const std::vector<std::int64_t> owned_ids(grid_.ids.begin(), grid_.ids.begin() + grid_.owned);
  std::vector<LedEntities> first = first_numbers(comm_, owned_ids, counts, total);
  grid_.cells = total.cells;
  grid_.edges = total.edges;
  grid_.vertices = total.vertices;
  append_ghost_values(first);
  return first;
}

// Returns the number of an edge. The edges that a node leads are numbered in the order of the ids
// of its neighbours.
std::int64_t Builder::edge_number(std::int32_t node, std::int32_t other,
                                  const std::vector<LedEntities>& first) const {
  if (!grid_.leads(node, other)) std::swap(node, other);
  if (!grid_.leads(node, other)) return kNone;
  std::int64_t number = first[index(node)].edges;
  for (std::int64_t k = grid_.rings.begin(node); k < grid_.rings.end(node); ++k) {
    const std::int32_t neighbour = grid_.rings.neighbour(k);
    number += grid_.leads(node, neighbour) && grid_.id(neighbour) < grid_.id(other);
  }
  return number;
}

std::int64_t Builder::vertex_number(std::int32_t triangle,
                                    const std::vector<LedEntities>& first) const {
  const std::int32_t leader = grid_.leader_of(triangle);
  if (leader < 0) return kNone;
  const StarRings& rings = grid_.rings;
  const std::int64_t at = rings.place_of_triangle(leader, triangle);
  std::int64_t number = first[index(leader)].vertices;
  for (std::int64_t k = rings.begin(leader); k < rings.end(leader); ++k)
    number += grid_.leader_of(rings.triangle(k)) == leader &&
              grid_.id(rings.neighbour(k)) < grid_.id(rings.neighbour(at));
  return number;
}

void Builder::number_entities(const std::vector<LedEntities>& first) {
  const StarRings& rings = grid_.rings;
  const auto nodes = static_cast<std::int64_t>(grid_.ids.size());
  for (std::int64_t i = 0; i < nodes; ++i)
    if (grid_.cell[index(i)] != kNone) grid_.cell[index(i)] = first[index(i)].cells;
  std::vector<char> near(index(nodes), 0);  // owned nodes and their neighbours
  grid_.vertex.assign(grid_.triangles.size(), kNone);
  std::vector<char> own_vertex(grid_.triangles.size(), 0);
  for (std::int32_t i = 0; i < grid_.owned; ++i) {
    near[index(i)] = 1;
    for (std::int64_t k = rings.begin(i); k < rings.end(i); ++k) {
      near[index(rings.neighbour(k))] = 1;
      own_vertex[index(rings.triangle(k))] = 1;
    }
  }
  for_each("pnpbs::SphereGrid::vertices", std::ssize(grid_.triangles), [&](std::int64_t t) {
    if (own_vertex[index(t)])
      grid_.vertex[index(t)] = vertex_number(static_cast<std::int32_t>(t), first);
  });
  grid_.edge.assign(index(rings.places()), kNone);
  for_each("pnpbs::SphereGrid::edges", nodes, [&](std::int64_t i) {
    const auto node = static_cast<std::int32_t>(i);
    if (!near[index(i)] || !grid_.has_cell(node)) return;
    for (std::int64_t k = rings.begin(node); k < rings.end(node); ++k)
      grid_.edge[index(k)] = edge_number(node, rings.neighbour(k), first);
  });
}

// Computes the kites from signed areas of two triangles. The area of one is negative if the vertex
// lies beyond an edge, as for an obtuse triangle. The kites still sum up to the areas of cells and
// of triangles.
void Builder::find_kites() {
  const StarRings& rings = grid_.rings;
  grid_.kite.assign(index(rings.places()), 0);
  for_each("pnpbs::SphereGrid::kites", std::ssize(grid_.ids), [&](std::int64_t i) {
    const auto node = static_cast<std::int32_t>(i);
    if (!grid_.has_cell(node) || !rings.closed(node)) return;
    const Point<3>& x = grid_.at(node);
    for (std::int64_t k = rings.begin(node); k < rings.end(node); ++k) {
      const Point<3>& vertex = grid_.centre(rings.triangle(k));
      const Point<3> from = arc_middle(x, grid_.at(rings.neighbour(k)));
      const Point<3> to = arc_middle(x, grid_.at(rings.neighbour(rings.next(node, k))));
      grid_.kite[index(k)] = signed_area(x, from, vertex) + signed_area(x, vertex, to);
    }
  });
}

}  // namespace

std::int32_t SphereGrid::leader_of(std::int32_t triangle) const {
  std::int32_t leader = -1;
  for (const std::int32_t node : triangles[index(triangle)])
    if (has_cell(node) && (leader < 0 || id(node) < id(leader))) leader = node;
  return leader;
}

std::int64_t SphereGrid::edge_between(std::int32_t a, std::int32_t b) const {
  if (!has_cell(a)) std::swap(a, b);
  return has_cell(a) ? edge[index(rings.place_of(a, b))] : kNone;
}

double SphereGrid::area(std::int32_t node) const {
  double sum = 0;
  for (std::int64_t k = rings.begin(node); k < rings.end(node); ++k) sum += kite[index(k)];
  return sum;
}

std::unique_ptr<SphereGrid> make_sphere_grid(Results<2>& results) {
  auto grid = std::make_unique<SphereGrid>();
  grid->radius = results.sphere_radius();
  Builder(results, *grid).build();
  return grid;
}

}  // namespace pnpbs
