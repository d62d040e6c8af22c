// SPDX-License-Identifier: BSD-3-Clause
// Tests that the triangles returned on all ranks form one conforming triangulation of the domain,
// equal to that of CGAL for all nodes. Each triangle is returned once, by the rank that owns its
// corner with the smallest id. The test uses the public interface only. Usage:
//   conformity [ROUND]... [CASE]...
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <cmath>
#include <cstring>
#include <functional>
#include <iterator>
#include <map>
#include <set>
#include <string>

#include "evaluate.hpp"
#include "gathered_triangulation.hpp"
#include "named_cases.hpp"

namespace {

using gathered::Ids3;
using gathered::Node;
using gathered::require;
using gathered::Triangulation;
using Plane = std::function<double(double, double)>;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Triangle = std::array<std::int64_t, 3>;  // indices of nodes, in increasing order

constexpr std::int32_t kInnerTag = 7777;

// ------------------------------------------------------------------ checks ---------------------

void expect(bool condition, const std::string& what, const std::string& wrong) {
  if (condition) return;
  std::fprintf(stderr, "%d ranks, %s: %s\n", size, what.c_str(), wrong.c_str());
  ++failures;
}

class Judge {
 public:
  Judge(const Triangulation& all, std::string what) : all_(all), what_(std::move(what)) {
    for (std::size_t i = 0; i < all.nodes.size(); ++i)
      place_[all.nodes[i].id] = static_cast<std::int64_t>(i);
  }

  void judge() {
    fail_unless(place_.size() == all_.nodes.size(), "a node has two owners");
    if (!ghosts_are_copies() || !edges_fit() || !stars_agree()) return;
    compare_with_reference();
  }

 private:
  bool fail_unless(bool condition, const std::string& wrong) {
    expect(condition, what_, wrong);
    return condition;
  }

  const Node& node(std::int64_t place) const { return all_.nodes[static_cast<std::size_t>(place)]; }
  Kernel::Point_2 point(std::int64_t place) const { return {node(place).x, node(place).y}; }
  Triangle places(const Ids3& ids) const {
    Triangle t{place_.at(ids[0]), place_.at(ids[1]), place_.at(ids[2])};
    std::sort(t.begin(), t.end());
    return t;
  }
  std::string text(const Triangle& t) const {
    char buffer[256];
    std::snprintf(buffer, sizeof buffer,
                  "triangle (%.17g, %.17g) of rank %d, (%.17g, %.17g) of %d, (%.17g, %.17g) of %d",
                  node(t[0]).x, node(t[0]).y, node(t[0]).owner, node(t[1]).x, node(t[1]).y,
                  node(t[1]).owner, node(t[2]).x, node(t[2]).y, node(t[2]).owner);
    return buffer;
  }

  bool ghosts_are_copies() {
    for (const Node& ghost : all_.ghosts) {
      const auto found = place_.find(ghost.id);
      if (!fail_unless(found != place_.end(), "a ghost is nobody's node")) return false;
      const Node& owned = node(found->second);
      if (!fail_unless(
              owned.x == ghost.x && owned.y == ghost.y && owned.owner == ghost.owner,
              "ghost " + std::to_string(ghost.id) + " differs from what its owner hands out"))
        return false;
    }
    return true;
  }

  // Checks that triangles are counter-clockwise, that no edge occurs twice in one direction, and
  // that an edge with a single triangle is a boundary edge.
  bool edges_fit() {
    std::set<std::array<std::int64_t, 2>> directed, boundary;
    for (const gathered::Edge& e : all_.boundary_edges) {
      boundary.insert({e.begin, e.end});
      boundary.insert({e.end, e.begin});
    }
    for (const Ids3& t : all_.triangles)
      for (std::size_t k = 0; k < 3; ++k)
        if (!fail_unless(directed.insert({t[k], t[(k + 1) % 3]}).second,
                         "two triangles overlap: " + text(places(t))))
          return false;
    for (const auto& [a, b] : directed)
      if (!directed.count({b, a}) &&
          !fail_unless(boundary.count({a, b}) > 0, "a triangle is missing between nodes " +
                                                       std::to_string(a) + " and " +
                                                       std::to_string(b)))
        return false;
    return true;
  }

  // Checks that every triangle is in the stars of all its corners, and is returned once.
  bool stars_agree() {
    std::map<Triangle, int> in_stars;
    for (const Ids3& t : all_.star_triangles) ++in_stars[places(t)];
    for (const auto& [t, times] : in_stars)
      if (!fail_unless(times == 3, text(t) + " is in " + std::to_string(times) + " stars"))
        return false;
    for (const Ids3& t : all_.triangles) ours_.push_back(places(t));
    std::sort(ours_.begin(), ours_.end());
    fail_unless(std::adjacent_find(ours_.begin(), ours_.end()) == ours_.end(),
                "a triangle is handed out twice");
    return fail_unless(ours_.size() == in_stars.size(),
                       std::to_string(ours_.size()) + " triangles handed out, " +
                           std::to_string(in_stars.size()) + " in the stars");
  }

  std::vector<Triangle> reference() const {
    pnpbs_bench::NodeSet set;
    for (const Node& n : all_.nodes) set.x.push_back({n.x, n.y});
    for (const gathered::Edge& e : all_.boundary_edges)
      (e.tag == kInnerTag ? set.inner_edges : set.edges)
          .push_back({place_.at(e.begin), place_.at(e.end)});
    return pnpbs_bench::reference_triangles(set);
  }

  // Returns whether a corner of an adjacent triangle in `others` lies exactly on the circle of t
  // and none lies inside.
  bool tied(const Triangle& t, const std::vector<Triangle>& others) const {
    const auto in_t = [&](std::int64_t d) { return std::count(t.begin(), t.end(), d) > 0; };
    bool on_circle = false;
    for (const Triangle& other : others) {
      if (std::none_of(other.begin(), other.end(), in_t)) continue;
      for (const std::int64_t d : other) {
        if (in_t(d)) continue;
        const auto side =
            CGAL::side_of_bounded_circle(point(t[0]), point(t[1]), point(t[2]), point(d));
        if (side == CGAL::ON_BOUNDED_SIDE) return false;
        on_circle = on_circle || side == CGAL::ON_BOUNDARY;
      }
    }
    return on_circle;
  }

  // Expects the same triangles. Where four or more nodes lie exactly on a circle, expects the same
  // number on that circle.
  void compare_with_reference() {
    const std::vector<Triangle> theirs = reference();
    fail_unless(!theirs.empty(), "no triangles");
    fail_unless(
        ours_.size() == theirs.size(),
        std::to_string(ours_.size()) + " triangles instead of " + std::to_string(theirs.size()));
    std::vector<Triangle> ours_only, theirs_only;
    std::set_difference(ours_.begin(), ours_.end(), theirs.begin(), theirs.end(),
                        std::back_inserter(ours_only));
    std::set_difference(theirs.begin(), theirs.end(), ours_.begin(), ours_.end(),
                        std::back_inserter(theirs_only));
    for (const Triangle& t : ours_only)
      if (!fail_unless(tied(t, theirs_only), text(t) + " is not Delaunay")) return;
    if (ours_only.empty() && !theirs_only.empty())
      fail_unless(false, text(theirs_only[0]) + " is missing");
  }

  const Triangulation& all_;
  std::string what_;
  std::map<std::int64_t, std::int64_t> place_;  // index of the node with each id
  std::vector<Triangle> ours_;
};

// ------------------------------------------------------------------ placements -----------------

std::int32_t call_plane(std::int64_t n, std::int32_t, const double* x, double* d, void* user) {
  const Plane& plane = *static_cast<const Plane*>(user);
  for (std::int64_t i = 0; i < n; ++i) d[i] = plane(x[2 * i], x[2 * i + 1]);
  return 0;
}

using Build = std::function<void(pnpbs_domain)>;

void add_square(pnpbs_domain domain) {
  const double corners[] = {0, 0, 1, 0, 1, 1, 0, 1};
  require(pnpbs_domain_add_polyline(domain, PNPBS_BOUNDARY, 1, 4, corners, nullptr, 0), "square");
}

// Adds a slit that ends inside and two holes, smaller than d or of about its size.
void add_square_with_slit_and_holes(pnpbs_domain domain) {
  add_square(domain);
  const double slit[] = {0.2, 0.51, 0.7, 0.55, 0.72, 0.8};
  const std::int32_t tags[] = {kInnerTag, kInnerTag};
  const double hole[] = {0.503, 0.498}, pinhole[] = {0.2, 0.25};
  require(pnpbs_domain_add_polyline(domain, PNPBS_INNER, 0, 3, slit, tags, 0), "slit");
  require(pnpbs_domain_add_arc(domain, PNPBS_BOUNDARY, hole, 0.01, 0, 2 * M_PI, 2), "hole");
  require(pnpbs_domain_add_arc(domain, PNPBS_BOUNDARY, pinhole, 0.0001, 0, 2 * M_PI, 3), "pinhole");
}

Build lake(const char* name) {
  return [name](pnpbs_domain domain) {
    const std::string path = std::string(PNPBS_SOURCE_DIR "/examples/data/") + name + ".poly";
    require(pnpbs_domain_read_poly(domain, path.c_str()), name);
  };
}

class Job {
 public:
  Job(std::string what, const Build& build, Plane d) : what_(std::move(what)) {
    pnpbs_domain domain;
    require(pnpbs_domain_create(context, 2, &domain), "domain");
    build(domain);
    require(pnpbs_placement_create(context, domain, &p_), "placement");
    pnpbs_domain_destroy(&domain);
    set_spacing(std::move(d));
    set("growth_limit", "0");  // jumps are the difficult cases
  }
  Job(const Job&) = delete;
  ~Job() { pnpbs_placement_destroy(&p_); }

  void set_spacing(Plane d) {
    d_ = std::move(d);
    require(pnpbs_placement_set_spacing_callback(p_, call_plane, &d_), "spacing");
  }
  void set(const char* key, const char* value) {
    require(pnpbs_placement_set(p_, key, value), key);
  }

  // Passes the nodes to the placement. Every rank passes some of them, independent of their later
  // owners.
  void set_nodes(const std::vector<std::array<double, 2>>& nodes) {
    std::vector<double> xy;
    std::vector<std::int64_t> ids;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      if (static_cast<int>(i) % size != rank) continue;
      xy.insert(xy.end(), nodes[i].begin(), nodes[i].end());
      ids.push_back(static_cast<std::int64_t>((i * 7919) % nodes.size()) + 100);
    }
    require(
        pnpbs_placement_set_nodes(p_, static_cast<std::int64_t>(ids.size()), xy.data(), ids.data()),
        "nodes");
  }

  void judge(const char* stage) {
    const Triangulation all = gathered::gather(p_);
    if (rank == 0) Judge(all, what_ + ", " + stage).judge();
  }

  void judge_filled() {
    require(pnpbs_placement_initialise(p_), "initialise");
    judge("filled");
  }
  void judge_taken_over() {
    require(pnpbs_placement_step(p_, 0), "step");
    judge("taken over");
  }
  void judge_after_run() {
    require(pnpbs_placement_run(p_), "run");
    judge("after the run");
  }

 private:
  std::string what_;
  Plane d_;
  pnpbs_placement p_ = nullptr;
};

Plane constant(double d) {
  return [d](double, double) { return d; };
}

// A spacing that is ten times finer at a point of the unit square than far from it.
Plane graded(double d) {
  return [d](double x, double y) { return d * (1 + 13 * std::hypot(x - 0.5, y - 0.45)); };
}

// A spacing that is coarse on the left and finer by a factor on the right.
Plane jump(double d, double factor) {
  return [d, factor](double x, double) { return x < 0.52 ? factor * d : d; };
}

void fill_and_run(const std::string& what, const Build& build, const Plane& d) {
  Job job(what, build, d);
  job.set("steps", "60");
  job.judge_filled();
  job.judge_after_run();
}

std::vector<std::array<double, 2>> scattered(std::size_t n, std::uint64_t seed) {
  std::vector<std::array<double, 2>> nodes(n);
  for (auto& node : nodes)
    for (double& coordinate : node) {
      seed = seed * 6364136223846793005u + 1442695040888963407u;
      coordinate = static_cast<double>(seed >> 11) * 0x1p-53;
    }
  return nodes;
}

// ------------------------------------------------------------------ cases ----------------------

void graded_square() { fill_and_run("graded square", add_square, graded(0.009)); }
void uniform_square() { fill_and_run("uniform square", add_square, constant(0.025)); }
void victoria() {
  fill_and_run("lake_victoria", lake("lake_victoria"),
               [](double x, double y) { return 3 + 0.03 * std::hypot(x, y); });
}
void lakes() {
  fill_and_run("great_lakes_islands", lake("great_lakes_islands"),
               [](double x, double y) { return 6 + 0.02 * std::hypot(x, y); });
}
void slit_and_holes() {
  fill_and_run("slit and holes", add_square_with_slit_and_holes, constant(0.03));
  fill_and_run("slit and holes, graded", add_square_with_slit_and_holes, graded(0.01));
}

// Tests a square grid, in which every circumcircle passes through four or more nodes. The order of
// the ids differs from that of the rows.
void exact_grid() {
  Job job("exact grid", add_square, constant(1.0 / 32));
  std::vector<std::array<double, 2>> grid;
  for (int i = 1; i < 32; ++i)
    for (int j = 1; j < 32; ++j) grid.push_back({i / 32.0, j / 32.0});
  job.set_nodes(grid);
  job.judge_filled();
}

void adapting() {
  Job job("adapted", add_square, constant(0.04));
  job.set("steps", "40");
  job.judge_after_run();
  const Plane spot = [](double x, double y) { return 0.004 + 0.25 * std::hypot(x - 0.3, y - 0.3); };
  for (const Plane& next : {spot, constant(0.12), jump(0.012, 25), constant(0.02)}) {
    job.set_spacing(next);
    job.judge_taken_over();
    job.judge_after_run();
  }
}

// Tests more ranks than leaves, so that some ranks own nothing.
void empty_ranks() {
  fill_and_run("few leaves", add_square, constant(0.5));
  fill_and_run("some leaves", add_square, constant(0.2));
}

// Tests jumps of the spacing. Triangles of the coarse nodes next to a jump reach far into the fine
// part, which another rank owns.
void jumps() {
  for (const double factor : {6.0, 12.0})
    fill_and_run("jump by " + std::to_string(factor), add_square, jump(0.012, factor));
  Job job("jump by 40", add_square, jump(0.01, 40));
  job.judge_filled();
}

// Tests nodes at random points, far too few or too many for d.
void scattered_nodes() {
  for (const std::size_t n : {0, 1, 3, 20, 200}) {
    Job job(std::to_string(n) + " scattered nodes", add_square, constant(0.02));
    job.set_nodes(scattered(n, 5 + n));
    job.judge_filled();
  }
  Job job("scattered nodes in a jump", add_square, jump(0.01, 20));
  job.set_nodes(scattered(300, 77));
  job.judge_filled();
}

const std::map<std::string, void (*)()> kCases{{"graded-square", graded_square},
                                               {"uniform-square", uniform_square},
                                               {"exact-grid", exact_grid},
                                               {"victoria", victoria},
                                               {"lakes", lakes},
                                               {"slit-and-holes", slit_and_holes},
                                               {"adapting", adapting},
                                               {"empty-ranks", empty_ranks},
                                               {"jumps", jumps},
                                               {"scattered", scattered_nodes}};

void check_cases() { run_named_cases(kCases); }

}  // namespace

int main(int argc, char** argv) { return run_in_groups(argc, argv, check_cases); }
