// SPDX-License-Identifier: BSD-3-Clause
// pnpbs-cgal-mesh: CGAL's Delaunay mesher and Lloyd optimiser as a command that compare.py can run
// like any other tool. Usage:
//   pnpbs-cgal-mesh IN.poly OUT.node CONSTANT SLOPE X0 Y0 X_COUNTS EDGE_BOUND LLOYD_STEPS
//   pnpbs-cgal-mesh IN.poly OUT.node TABLE EDGE_BOUND LLOYD_STEPS
// Edges may be EDGE_BOUND d long. d is CONSTANT + SLOPE * distance from (X0, Y0), or from the line
// y = Y0 if X_COUNTS is 0, or it is given by the file TABLE (spacing_table.py). Angles of triangles
// are at least 20.6 degrees, CGAL's default bound. Prints the seconds without files.
#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Delaunay_mesh_criteria_2.h>
#include <CGAL/Delaunay_mesh_face_base_2.h>
#include <CGAL/Delaunay_mesh_vertex_base_2.h>
#include <CGAL/Delaunay_mesher_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Mesh_2/Face_badness.h>
#include <CGAL/lloyd_optimize_mesh_2.h>
#include <CGAL/version.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <list>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Delaunay_mesh_vertex_base_2<Kernel>;
using FaceBase = CGAL::Delaunay_mesh_face_base_2<Kernel>;
using Structure = CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>;
using Triangulation = CGAL::Constrained_Delaunay_triangulation_2<Kernel, Structure>;
using Point = Kernel::Point_2;

// Values at the crossings of grid lines, with bilinear interpolation; one column for each x.
struct Table {
  std::vector<double> x, y, values;

  double at(const Point& p) const {
    const std::size_t i = gap(x, p.x()), j = gap(y, p.y());
    const double u = (p.x() - x[i]) / (x[i + 1] - x[i]), v = (p.y() - y[j]) / (y[j + 1] - y[j]);
    const double *left = &values[i * y.size() + j], *right = left + y.size();
    return (1 - u) * ((1 - v) * left[0] + v * left[1]) + u * ((1 - v) * right[0] + v * right[1]);
  }

  // Returns the index of the grid line before t.
  static std::size_t gap(const std::vector<double>& lines, double t) {
    const auto after = std::upper_bound(lines.begin() + 1, lines.end() - 1, t);
    return static_cast<std::size_t>(after - lines.begin() - 1);
  }
};

struct Spacing {
  double constant, slope;
  Point middle;
  double x_counts;  // 1, or 0 for the distance from a horizontal line
  Table table;      // used instead, if not empty

  double at(const Point& p) const {
    if (!table.values.empty()) return table.at(p);
    return constant + slope * std::hypot(x_counts * (p.x() - middle.x()), p.y() - middle.y());
  }
};

// Criteria with a size given by a function at the triangle's centroid. CGAL's own criteria have one
// size for the whole domain.
class GradedCriteria : public CGAL::Delaunay_mesh_criteria_2<Triangulation> {
 public:
  GradedCriteria(const Spacing& spacing, double edge_bound)
      : spacing_(&spacing), edge_bound_(edge_bound) {}

  // Badness of a triangle: its longest edge over the permitted length, then its smallest angle.
  struct Quality {
    double excess = 0, squared_sine = 0;
    bool operator<(const Quality& other) const {  // the worse one comes first
      if (excess > 1 || other.excess > 1) return excess > other.excess;
      return squared_sine < other.squared_sine;
    }
  };

  class Is_bad {
   public:
    Is_bad(const Spacing* spacing, double edge_bound, double sine_bound)
        : spacing_(spacing), edge_bound_(edge_bound), sine_bound_(sine_bound) {}

    CGAL::Mesh_2::Face_badness operator()(const Quality& q) const {
      if (q.excess > 1) return CGAL::Mesh_2::IMPERATIVELY_BAD;
      return q.squared_sine < sine_bound_ ? CGAL::Mesh_2::BAD : CGAL::Mesh_2::NOT_BAD;
    }

    CGAL::Mesh_2::Face_badness operator()(const Triangulation::Face_handle& f, Quality& q) const {
      const Point &a = f->vertex(0)->point(), &b = f->vertex(1)->point(),
                  &c = f->vertex(2)->point();
      double squared[3] = {CGAL::squared_distance(a, b), CGAL::squared_distance(b, c),
                           CGAL::squared_distance(c, a)};
      std::sort(squared, squared + 3);
      const double area = CGAL::area(a, b, c);
      q.excess = std::sqrt(squared[2]) / (edge_bound_ * spacing_->at(CGAL::centroid(a, b, c)));
      // The smallest angle lies between the two longest edges.
      q.squared_sine = 4 * area * area / (squared[1] * squared[2]);
      return (*this)(q);
    }

   private:
    const Spacing* spacing_;
    double edge_bound_, sine_bound_;
  };

  Is_bad is_bad_object() const { return Is_bad(spacing_, edge_bound_, this->bound()); }

 private:
  const Spacing* spacing_;
  double edge_bound_;
};

struct Input {
  std::vector<Point> vertices;
  std::vector<std::pair<std::size_t, std::size_t>> segments;
  std::list<Point> holes;
};

// Reads Triangle's .poly format as compare.py writes it: numbered from 1, without comments after
// the first line that is not one.
Input read_poly(const char* name) {
  std::ifstream file(name);
  if (!file) throw std::runtime_error(std::string("cannot read ") + name);
  std::string line;
  const auto next = [&]() -> std::istringstream {
    while (std::getline(file, line))
      if (line.find_first_not_of(" \t\r") != std::string::npos && line[0] != '#') break;
    return std::istringstream(line);
  };
  Input input;
  std::size_t count = 0, id = 0, a = 0, b = 0;
  double x = 0, y = 0;
  next() >> count;
  for (std::size_t i = 0; i < count; ++i) {
    next() >> id >> x >> y;
    input.vertices.emplace_back(x, y);
  }
  next() >> count;
  for (std::size_t i = 0; i < count; ++i) {
    next() >> id >> a >> b;
    input.segments.emplace_back(a - 1, b - 1);
  }
  next() >> count;
  for (std::size_t i = 0; i < count; ++i) {
    next() >> id >> x >> y;
    input.holes.emplace_back(x, y);
  }
  if (!file) throw std::runtime_error(std::string("incomplete: ") + name);
  return input;
}

Table read_table(const char* name) {
  std::ifstream file(name);
  std::size_t columns = 0, rows = 0;
  file >> columns >> rows;
  Table table{std::vector<double>(columns), std::vector<double>(rows),
              std::vector<double>(columns * rows)};
  for (std::vector<double>* numbers : {&table.x, &table.y, &table.values})
    for (double& number : *numbers) file >> number;
  if (!file || columns < 2 || rows < 2) throw std::runtime_error(std::string("no table: ") + name);
  return table;
}

// Parses the arguments between the file names and the last two.
Spacing spacing_of(int count, char** words) {
  if (count == 1) return {0, 0, Point(0, 0), 0, read_table(words[0])};
  const Spacing spacing{std::atof(words[0]),
                        std::atof(words[1]),
                        Point(std::atof(words[2]), std::atof(words[3])),
                        std::atof(words[4]),
                        {}};
  if (!(spacing.constant > 0) || !(spacing.slope >= 0))
    throw std::runtime_error("CONSTANT must be positive, SLOPE not negative");
  return spacing;
}

double place(const Input& input, const Spacing& spacing, double edge_bound, std::size_t steps,
             Triangulation& t) {
  const auto begin = std::chrono::steady_clock::now();
  std::vector<Triangulation::Vertex_handle> vertex;
  for (const Point& p : input.vertices) vertex.push_back(t.insert(p));
  for (const auto& [a, b] : input.segments) t.insert_constraint(vertex[a], vertex[b]);
  CGAL::Delaunay_mesher_2<Triangulation, GradedCriteria> mesher(
      t, GradedCriteria(spacing, edge_bound));
  mesher.set_seeds(input.holes.begin(), input.holes.end());
  mesher.refine_mesh();
  if (steps > 0)
    CGAL::lloyd_optimize_mesh_2(
        t, CGAL::parameters::max_iteration_number = steps, CGAL::parameters::convergence = 0,
        CGAL::parameters::freeze_bound = 0, CGAL::parameters::seeds_begin = input.holes.begin(),
        CGAL::parameters::seeds_end = input.holes.end());
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

void write_nodes(const Triangulation& t, const char* name) {
  std::FILE* file = std::fopen(name, "w");
  if (!file) throw std::runtime_error(std::string("cannot write ") + name);
  std::fprintf(file, "%lu 2 0 0\n", static_cast<unsigned long>(t.number_of_vertices()));
  unsigned long id = 0;
  for (auto v = t.finite_vertices_begin(); v != t.finite_vertices_end(); ++v)
    std::fprintf(file, "%lu %.17g %.17g\n", ++id, v->point().x(), v->point().y());
  if (std::fclose(file) != 0) throw std::runtime_error(std::string("cannot write ") + name);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc == 2 && std::string(argv[1]) == "--version") {
    std::puts(CGAL_VERSION_STR);
    return 0;
  }
  if (argc != 10 && argc != 6) {
    std::fputs(
        "usage: pnpbs-cgal-mesh IN.poly OUT.node CONSTANT SLOPE X0 Y0 X_COUNTS EDGE_BOUND LLOYD\n"
        "       pnpbs-cgal-mesh IN.poly OUT.node TABLE EDGE_BOUND LLOYD\n",
        stderr);
    return 2;
  }
  try {
    const Spacing spacing = spacing_of(argc - 5, argv + 3);
    const double edge_bound = std::atof(argv[argc - 2]);
    if (!(edge_bound > 0)) throw std::runtime_error("EDGE_BOUND must be positive");
    Triangulation t;
    const double seconds = place(read_poly(argv[1]), spacing, edge_bound,
                                 static_cast<std::size_t>(std::atoi(argv[argc - 1])), t);
    write_nodes(t, argv[2]);
    std::printf("seconds %.6f\n", seconds);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "pnpbs-cgal-mesh: %s\n", error.what());
    return 1;
  }
  return 0;
}
