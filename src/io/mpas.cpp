// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <functional>
#include <limits>
#include <numbers>
#include <span>
#include <string>
#include <vector>

#include "base/build_config.hpp"
#include "base/error.hpp"
#include "base/execution.hpp"
#include "base/leading_count.hpp"
#include "cgrid/sphere_grid.hpp"
#include "comm/records.hpp"
#include "io/formats.hpp"
#include "io/netcdf.hpp"
#include "io/rows.hpp"
#include "quality/plane/voronoi_ring.hpp"

namespace pnpbs::io {
namespace {

// MPAS writer. Values of cells, edges and vertices are written in the order of their global
// numbers, one window at a time, so that writing needs little memory.
enum class Entity { cell, edge, vertex };

// A cell, edge or vertex, given by its leading node and a place in the ring of neighbours of that
// node. The edge leads to the neighbour at this place. The vertex lies between that neighbour and
// the next one. A cell has an arbitrary place.
struct EntityPlace {
  std::int32_t node;
  std::int64_t place;
};

// Sets the values of an entity in `row`, which are 0 initially.
template <class Value>
using RowFill = std::function<void(const EntityPlace&, std::span<Value> row)>;

// An iteration over the cells, edges or vertices in the order of their numbers.
class EntityRows {
 public:
  explicit EntityRows(const SphereGrid& grid);

  // Calls visit(rows) for each window, with the rows of this rank's part in the order of their
  // numbers. The parts of a window are in the order of the ranks. Collective.
  template <class Value, class Visit>
  void for_windows(Entity of, int columns, const RowFill<Value>& fill, const Communicator& comm,
                   const Visit& visit) const;

 private:
  std::int64_t number(Entity of, const EntityPlace& at) const;
  // Returns the entities whose leading node is owned and has a cell with a number from `begin` up
  // to, but without, `end`. They are in the order of the entities' numbers.
  std::vector<EntityPlace> led(Entity of, std::int64_t begin, std::int64_t end) const;
  // Sends each row to the rank whose part of the window contains the leading cell. Returns the rows
  // received, in the order of their numbers. Collective.
  template <class Value>
  std::vector<Value> brought(Entity of, int columns, const std::vector<EntityPlace>& places,
                             const std::vector<Value>& rows, const Communicator& comm) const;

  const SphereGrid& grid_;
  std::vector<std::int32_t> leaders_;  // owned nodes with a cell, in the order of cells
};

template <class Value, class Visit>
void EntityRows::for_windows(Entity of, int columns, const RowFill<Value>& fill,
                             const Communicator& comm, const Visit& visit) const {
  const std::int64_t window = kWindow * comm.size();
  const auto n = static_cast<std::size_t>(columns);
  for (std::int64_t begin = 0; begin < grid_.cells; begin += window) {
    const std::vector<EntityPlace> places = led(of, begin, begin + window);
    std::vector<Value> rows(n * places.size(), 0);
    for_each("pnpbs::EntityRows", std::ssize(places), [&](std::int64_t i) {
      const auto row = static_cast<std::size_t>(i);
      fill(places[row], std::span(rows).subspan(n * row, n));
    });
    if (comm.size() > 1) rows = brought(of, columns, places, rows, comm);
    visit(std::move(rows));
  }
}

template <class Value>
std::vector<Value> EntityRows::brought(Entity of, int columns,
                                       const std::vector<EntityPlace>& places,
                                       const std::vector<Value>& rows,
                                       const Communicator& comm) const {
  const auto n = static_cast<std::size_t>(columns);
  Outbox outgoing;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const std::int64_t leader = grid_.cell[static_cast<std::size_t>(places[i].node)];
    Bytes& bytes = outgoing.to(static_cast<int>(leader / kWindow % comm.size()));
    pack(bytes, number(of, places[i]));
    for (std::size_t k = 0; k < n; ++k) pack(bytes, rows[n * i + k]);
  }
  struct Arrived {
    std::int64_t number;
    const char* row;
  };
  const std::vector<Message> messages = comm.sparse_all_to_all(outgoing.messages());
  const std::size_t size = n * sizeof(Value), step = sizeof(std::int64_t) + size;
  std::vector<Arrived> arrived;
  for (const Message& message : messages)
    for (std::size_t at = 0; at < message.bytes.size(); at += step) {
      const char* const bytes = reinterpret_cast<const char*>(message.bytes.data()) + at;
      arrived.push_back({0, bytes + sizeof(std::int64_t)});
      std::memcpy(&arrived.back().number, bytes, sizeof(std::int64_t));
    }
  std::ranges::sort(arrived, {}, &Arrived::number);
  std::vector<Value> sorted(n * arrived.size());
  for (std::size_t i = 0; i < arrived.size(); ++i)
    std::memcpy(&sorted[n * i], arrived[i].row, size);
  return sorted;
}

EntityRows::EntityRows(const SphereGrid& grid) : grid_(grid) {
  for (std::int32_t i = 0; i < grid.owned; ++i)
    if (grid.has_cell(i)) leaders_.push_back(i);
}

std::int64_t EntityRows::number(Entity of, const EntityPlace& at) const {
  if (of == Entity::cell) return grid_.cell[static_cast<std::size_t>(at.node)];
  if (of == Entity::edge) return grid_.edge[static_cast<std::size_t>(at.place)];
  return grid_.vertex[static_cast<std::size_t>(grid_.rings.triangle(at.place))];
}

std::vector<EntityPlace> EntityRows::led(Entity of, std::int64_t begin, std::int64_t end) const {
  const auto first_from = [&](std::int64_t bound) {
    return leading_count(std::ssize(leaders_), [&](std::int64_t k) {
      return grid_.cell[static_cast<std::size_t>(leaders_[static_cast<std::size_t>(k)])] < bound;
    });
  };
  std::vector<EntityPlace> places;
  const std::int64_t last = first_from(end);
  for (std::int64_t l = first_from(begin); l < last; ++l) {
    const std::int32_t node = leaders_[static_cast<std::size_t>(l)];
    const std::int64_t ring = grid_.rings.begin(node);
    if (of == Entity::cell) {
      places.push_back({node, ring});
      continue;
    }
    const std::ptrdiff_t first = std::ssize(places);
    for (std::int64_t k = ring; k < grid_.rings.end(node); ++k) {
      const bool leads = of == Entity::edge ? grid_.leads(node, grid_.rings.neighbour(k))
                                            : grid_.leader_of(grid_.rings.triangle(k)) == node;
      if (leads) places.push_back({node, k});
    }
    std::ranges::sort(places.begin() + first, places.end(), {},
                      [&](const EntityPlace& at) { return number(of, at); });
  }
  return places;
}

using Place = EntityPlace;
using Integers = std::span<std::int32_t>;
using Reals = std::span<double>;

// Indices in the list of dimensions.
enum Dimension : std::size_t { nCells, nEdges, nVertices, maxEdges, maxEdges2, two, vertexDegree };

// A variable of the file.
struct Variable {
  std::string name;
  Entity of;
  int columns;
  std::size_t second;              // dimension of the columns if there are several
  RowFill<std::int32_t> integers;  // set for an integer variable, else `reals`
  RowFill<double> reals;

  NumberType type() const { return integers ? NumberType::int32 : NumberType::real; }
};

std::size_t index(std::int64_t i) { return static_cast<std::size_t>(i); }
// Converts a number to the file's convention: numbers start at 1, and 0 means none.
std::int32_t in_file(std::int64_t number) { return static_cast<std::int32_t>(number + 1); }

// Returns the nodes of the triangle, counter-clockwise from the leading node.
std::array<std::int32_t, 3> corners_at(const SphereGrid& grid, const Place& at) {
  return {at.node, grid.rings.neighbour(at.place),
          grid.rings.neighbour(grid.rings.next(at.node, at.place))};
}

// Returns the sides of the triangle. Side k ends at corner k, so each corner lies between its side
// and the next.
std::array<std::array<std::int32_t, 2>, 3> sides_of(const std::array<std::int32_t, 3>& corners) {
  return {{{corners[2], corners[0]}, {corners[0], corners[1]}, {corners[1], corners[2]}}};
}

double side_length(const SphereGrid& grid, const std::array<std::int32_t, 2>& side) {
  return arc(grid.at(side[0]), grid.at(side[1]));
}

std::array<double, 3> side_lengths(const SphereGrid& grid, const Place& at) {
  std::array<double, 3> lengths;
  const auto sides = sides_of(corners_at(grid, at));
  for (std::size_t k = 0; k < 3; ++k) lengths[k] = side_length(grid, sides[k]);
  return lengths;
}

// Returns the angles of a plane triangle with these sides.
std::array<double, 3> angles_of(const std::array<double, 3>& lengths) {
  std::array<double, 3> angles;
  for (std::size_t k = 0; k < 3; ++k) {
    const double a = lengths[k], b = lengths[(k + 1) % 3], c = lengths[(k + 2) % 3];
    angles[k] = std::acos(std::clamp((b * b + c * c - a * a) / (2 * b * c), -1.0, 1.0));
  }
  return angles;
}

// Returns the area of the corner's cell in the triangle, on the unit sphere, or 0 if the corner has
// no cell.
double kite_at(const SphereGrid& grid, std::int32_t corner, std::int32_t triangle) {
  if (!grid.has_cell(corner)) return 0;
  return grid.kite[index(grid.rings.place_of_triangle(corner, triangle))];
}

// The variables in the order of the file.
class Table {
 public:
  explicit Table(const SphereGrid& grid) : grid_(grid), r_(grid.radius) {
    add_places("Cell", Entity::cell, [&g = grid_](const Place& at) { return g.at(at.node); });
    add_places("Edge", Entity::edge, [&g = grid_](const Place& at) {
      return arc_middle(g.at(at.node), g.at(g.rings.neighbour(at.place)));
    });
    add_places("Vertex", Entity::vertex,
               [&g = grid_](const Place& at) { return g.centre(g.rings.triangle(at.place)); });
    add_numbers();
    add_cells();
    add_edges();
    add_weights();
    add_vertices();
    add_qualities();
  }

  const std::vector<Variable>& variables() const { return variables_; }

 private:
  template <class Point_of>
  void add_places(const std::string& what, Entity of, const Point_of& point) {
    reals("lat" + what, of, [point](const Place& at) {
      const Point<3> x = point(at);
      return std::atan2(x[2], std::hypot(x[0], x[1]));
    });
    reals("lon" + what, of, [point](const Place& at) {
      const Point<3> x = point(at);
      const double east = std::atan2(x[1], x[0]);
      return east < 0 ? east + 2 * std::numbers::pi : east;
    });
    for (std::size_t k = 0; k < 3; ++k)
      reals(std::string(1, "xyz"[k]) + what, of,
            [point, k, r = r_](const Place& at) { return r * point(at)[k]; });
  }

  void add_numbers();
  void add_cells();
  void add_edges();
  void add_weights();
  void add_vertices();
  void add_qualities();

  template <class Value>
  void reals(const std::string& name, Entity of, const Value& value) {
    variables_.push_back(
        {name, of, 1, 0, {}, [value](const Place& at, Reals row) { row[0] = value(at); }});
  }
  template <class Value>
  void integers(const std::string& name, Entity of, const Value& value) {
    variables_.push_back(
        {name, of, 1, 0, [value](const Place& at, Integers row) { row[0] = value(at); }, {}});
  }
  template <class Fill>
  void real_rows(const std::string& name, Entity of, Dimension second, const Fill& fill) {
    variables_.push_back({name, of, columns(second), second, {}, fill});
  }
  template <class Fill>
  void integer_rows(const std::string& name, Entity of, Dimension second, const Fill& fill) {
    variables_.push_back({name, of, columns(second), second, fill, {}});
  }
  // Adds a variable with value(place) for each place in the ring of a cell.
  template <class Value>
  void integers_around(const std::string& name, const Value& value) {
    integer_rows(name, Entity::cell, maxEdges, [&g = grid_, value](const Place& at, Integers row) {
      std::size_t k = 0;
      for (std::int64_t p = g.rings.begin(at.node); p < g.rings.end(at.node); ++p)
        row[k++] = in_file(value(p));
    });
  }
  int columns(Dimension second) const {
    if (second == two) return 2;
    if (second == vertexDegree) return 3;
    return second == maxEdges ? grid_.max_edges : 2 * grid_.max_edges;
  }

  const SphereGrid& grid_;
  double r_;
  std::vector<Variable> variables_;
};

void Table::add_numbers() {
  integers("indexToCellID", Entity::cell,
           [&g = grid_](const Place& at) { return in_file(g.cell[index(at.node)]); });
  integers("indexToEdgeID", Entity::edge,
           [&g = grid_](const Place& at) { return in_file(g.edge[index(at.place)]); });
  integers("indexToVertexID", Entity::vertex, [&g = grid_](const Place& at) {
    return in_file(g.vertex[index(g.rings.triangle(at.place))]);
  });
}

void Table::add_cells() {
  integers("nEdgesOnCell", Entity::cell,
           [&g = grid_](const Place& at) { return g.rings.size(at.node); });
  integers_around("edgesOnCell", [&g = grid_](std::int64_t p) { return g.edge[index(p)]; });
  integers_around("cellsOnCell",
                  [&g = grid_](std::int64_t p) { return g.cell[index(g.rings.neighbour(p))]; });
  integers_around("verticesOnCell",
                  [&g = grid_](std::int64_t p) { return g.vertex[index(g.rings.triangle(p))]; });
  reals("areaCell", Entity::cell,
        [&g = grid_, r = r_](const Place& at) { return r * r * g.area(at.node); });
  reals("meshDensity", Entity::cell, [&g = grid_](const Place& at) {
    const double ratio = g.min_spacing / g.spacing[index(at.node)];
    return ratio * ratio * ratio * ratio;
  });
}

void Table::add_edges() {
  integer_rows("cellsOnEdge", Entity::edge, two, [&g = grid_](const Place& at, Integers row) {
    row[0] = in_file(g.cell[index(at.node)]);
    row[1] = in_file(g.cell[index(g.rings.neighbour(at.place))]);
  });
  integer_rows("verticesOnEdge", Entity::edge, two, [&g = grid_](const Place& at, Integers row) {
    row[0] = in_file(g.vertex[index(g.rings.triangle(g.rings.before(at.node, at.place)))]);
    row[1] = in_file(g.vertex[index(g.rings.triangle(at.place))]);
  });
  reals("dvEdge", Entity::edge, [&g = grid_, r = r_](const Place& at) {
    return r * voronoi_edge_length(g, at.node, at.place);
  });
  reals("dcEdge", Entity::edge, [&g = grid_, r = r_](const Place& at) {
    return r * arc(g.at(at.node), g.at(g.rings.neighbour(at.place)));
  });
  reals("angleEdge", Entity::edge, [&g = grid_](const Place& at) {
    const Point<3>&a = g.at(at.node), &b = g.at(g.rings.neighbour(at.place));
    return angle_to_east(arc_middle(a, b), a, b);
  });
}

// Calls visit(node, place of the edge in its ring, sign) for the one or two cells at an edge. The
// sign is 1 for the leading cell, else -1.
template <class Visit>
void for_cells_beside(const SphereGrid& grid, const Place& at, const Visit& visit) {
  visit(at.node, at.place, 1);
  const std::int32_t other = grid.rings.neighbour(at.place);
  if (grid.has_cell(other)) visit(other, grid.rings.place_of(other, at.node), -1);
}

void Table::add_weights() {
  integers("nEdgesOnEdge", Entity::edge, [&g = grid_](const Place& at) {
    const std::int32_t other = g.rings.neighbour(at.place);
    return g.rings.size(at.node) - 1 + (g.has_cell(other) ? g.rings.size(other) - 1 : 0);
  });
  integer_rows("edgesOnEdge", Entity::edge, maxEdges2, [&g = grid_](const Place& at, Integers row) {
    std::size_t k = 0;
    for_cells_beside(g, at, [&](std::int32_t node, std::int64_t place, double) {
      for (std::int64_t p = g.rings.next(node, place); p != place; p = g.rings.next(node, p))
        row[k++] = in_file(g.edge[index(p)]);
    });
  });
  real_rows("weightsOnEdge", Entity::edge, maxEdges2, [&g = grid_](const Place& at, Reals row) {
    std::size_t k = 0;
    for_cells_beside(g, at, [&](std::int32_t node, std::int64_t place, double sign) {
      for_tangential_weights(g, node, place, sign, [&](double weight) { row[k++] = weight; });
    });
  });
}

void Table::add_vertices() {
  integer_rows("cellsOnVertex", Entity::vertex, vertexDegree,
               [&g = grid_](const Place& at, Integers row) {
                 const auto corners = corners_at(g, at);
                 for (std::size_t k = 0; k < 3; ++k) row[k] = in_file(g.cell[index(corners[k])]);
               });
  integer_rows("edgesOnVertex", Entity::vertex, vertexDegree,
               [&g = grid_](const Place& at, Integers row) {
                 const auto sides = sides_of(corners_at(g, at));
                 for (std::size_t k = 0; k < 3; ++k)
                   row[k] = in_file(g.edge_between(sides[k][0], sides[k][1]));
               });
  const auto kites = [&g = grid_](const Place& at) {
    std::array<double, 3> areas;
    const auto corners = corners_at(g, at);
    for (std::size_t k = 0; k < 3; ++k)
      areas[k] = kite_at(g, corners[k], g.rings.triangle(at.place));
    return areas;
  };
  real_rows("kiteAreasOnVertex", Entity::vertex, vertexDegree,
            [kites, r = r_](const Place& at, Reals row) {
              const std::array<double, 3> areas = kites(at);
              for (std::size_t k = 0; k < 3; ++k) row[k] = r * r * areas[k];
            });
  reals("areaTriangle", Entity::vertex, [kites, r = r_](const Place& at) {
    const std::array<double, 3> areas = kites(at);
    return r * r * (areas[0] + areas[1] + areas[2]);
  });
  integers("boundaryVertex", Entity::vertex, [&g = grid_](const Place& at) {
    const auto has_none = [&](std::int32_t node) { return !g.has_cell(node); };
    return static_cast<std::int32_t>(std::ranges::any_of(corners_at(g, at), has_none));
  });
}

void Table::add_qualities() {
  reals("cellQuality", Entity::cell, [&g = grid_](const Place& at) {
    ShortestOverLongest<3> ratio;
    for (std::int64_t p = g.rings.begin(at.node); p < g.rings.end(at.node); ++p)
      ratio.add(g.centre(g.rings.triangle(g.rings.before(at.node, p))),
                g.centre(g.rings.triangle(p)));
    return ratio.value();
  });
  reals("gridSpacing", Entity::cell, [&g = grid_, r = r_](const Place& at) {
    double sum = 0;
    for (std::int64_t p = g.rings.begin(at.node); p < g.rings.end(at.node); ++p)
      sum += r * arc(g.at(at.node), g.at(g.rings.neighbour(p)));
    return sum / g.rings.size(at.node);
  });
  reals("triangleQuality", Entity::vertex, [&g = grid_](const Place& at) {
    const auto [least, longest] = std::ranges::minmax(side_lengths(g, at));
    return least / longest;
  });
  reals("triangleAngleQuality", Entity::vertex, [&g = grid_](const Place& at) {
    const auto [least, largest] = std::ranges::minmax(angles_of(side_lengths(g, at)));
    return least / largest;
  });
  integers("obtuseTriangle", Entity::vertex, [&g = grid_](const Place& at) {
    const auto angles = angles_of(side_lengths(g, at));
    return static_cast<std::int32_t>(std::ranges::max(angles) > std::numbers::pi / 2);
  });
}

NetcdfContents contents_of(const SphereGrid& grid, const Table& table) {
  NetcdfContents contents;
  contents.dimensions = {{"nCells", grid.cells},
                         {"nEdges", grid.edges},
                         {"nVertices", grid.vertices},
                         {"maxEdges", grid.max_edges},
                         {"maxEdges2", 2 * grid.max_edges},
                         {"TWO", 2},
                         {"vertexDegree", 3}};
  contents.attributes = {{"on_a_sphere", "YES"},  {"sphere_radius", grid.radius},
                         {"is_periodic", "NO"},   {"mesh_spec", "1.0"},
                         {"Conventions", "MPAS"}, {"source", "pnpbs " PNPBS_PROJECT_VERSION}};
  for (const Variable& variable : table.variables()) {
    const std::size_t rows = variable.of == Entity::cell   ? nCells
                             : variable.of == Entity::edge ? nEdges
                                                           : nVertices;
    std::vector<std::size_t> dimensions{rows};
    if (variable.columns > 1) dimensions.push_back(variable.second);
    contents.variables.push_back({variable.name, variable.type(), std::move(dimensions), {}});
  }
  return contents;
}

// Appends a line for each row with its numbers up to the first 0.
void append_lines(const std::vector<std::int32_t>& rows, int columns, SharedFile& file) {
  const auto n = static_cast<std::size_t>(columns);
  file.append([&](Sink& sink) {
    for (std::size_t begin = 0; begin < rows.size(); begin += n) {
      for (std::size_t k = 0; k < n && rows[begin + k] > 0; ++k) {
        if (k > 0) sink.text(" ");
        sink.number(rows[begin + k]);
      }
      sink.text("\n");
    }
  });
}

// Throws unless there is a cell and all numbers fit into 32 bits. NetCDF would read 0 cells as an
// unlimited dimension.
void require_numbers(const SphereGrid& grid) {
  if (grid.cells == 0)
    throw Error(ErrorKind::argument,
                "the MPAS grid would have no cells, because all nodes are on the boundary: use a "
                "smaller d");
  constexpr std::int64_t kMost = std::numeric_limits<std::int32_t>::max();
  if (grid.edges > kMost)
    throw Error(ErrorKind::argument, "an MPAS grid can have " + std::to_string(kMost) +
                                         " edges, and this one would have " +
                                         std::to_string(grid.edges));
}

}  // namespace

void write_mpas(const SphereGrid& grid, SharedFile& file) {
  require_numbers(grid);
  const Table table(grid);
  const EntityRows rows(grid);
  file.append_text(netcdf_head(contents_of(grid, table)));
  const auto append = [&]<class Value>(const Variable& variable, const RowFill<Value>& fill) {
    rows.for_windows<Value>(
        variable.of, variable.columns, fill, file.ranks(), [&](std::vector<Value> values) {
          make_big_endian(values);
          file.append([&](Sink& sink) { sink.array(std::span<const Value>(values)); });
        });
  };
  for (const Variable& variable : table.variables()) {
    if (variable.integers)
      append(variable, variable.integers);
    else
      append(variable, variable.reals);
  }
}

// Each line lists the neighbours of a cell.
void write_cell_graph(const SphereGrid& grid, SharedFile& file) {
  require_numbers(grid);
  const EntityRows rows(grid);
  std::int64_t inner = 0;  // number of edges between two cells
  for (std::int32_t i = 0; i < grid.owned; ++i)
    for (std::int64_t p = grid.rings.begin(i); p < grid.rings.end(i); ++p)
      inner += grid.has_cell(grid.rings.neighbour(p)) && grid.leads(i, grid.rings.neighbour(p));
  std::vector<std::int64_t> sum{inner};
  file.ranks().allreduce_sum(sum);
  file.append_text(std::to_string(grid.cells) + " " + std::to_string(sum[0]) + "\n");
  const auto cells_beside = [&grid](const Place& at, Integers row) {
    std::size_t k = 0;
    for (std::int64_t p = grid.rings.begin(at.node); p < grid.rings.end(at.node); ++p)
      if (grid.has_cell(grid.rings.neighbour(p)))
        row[k++] = in_file(grid.cell[index(grid.rings.neighbour(p))]);
  };
  rows.for_windows<std::int32_t>(Entity::cell, grid.max_edges, cells_beside, file.ranks(),
                                 [&](const std::vector<std::int32_t>& windows) {
                                   append_lines(windows, grid.max_edges, file);
                                 });
}

}  // namespace pnpbs::io
