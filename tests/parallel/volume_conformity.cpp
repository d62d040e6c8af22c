// SPDX-License-Identifier: BSD-3-Clause
// Tests that the tetrahedra returned on all ranks form one conforming triangulation of the body,
// equal to that of CGAL for all nodes. Each is returned once, by the rank that owns its corner with
// the smallest id. The test uses the public interface only. Usage:
//   volume_conformity [ROUND]... [CASE]...
#include <cstring>
#include <string>

#include "named_cases.hpp"
#include "volume_cases.h"
#include "volume_judge.hpp"

namespace {

using gathered::require;
using volume_judge::Body;
using volume_judge::Point;

constexpr const char* kData = PNPBS_SOURCE_DIR "/examples/data";

// ------------------------------------------------------------------ bodies ---------------------

// Returns 1 for points inside, -1 outside, and 0 on a surface.
int side_of(double within) { return within > 1e-9 ? 1 : within < -1e-9 ? -1 : 0; }

double within_box(const Point& x, const Point& high) {
  double least = HUGE_VAL;
  for (std::size_t k = 0; k < 3; ++k) least = std::min({least, x[k], high[k] - x[k]});
  return least;
}

// Returns the side of a globe whose triangles lie up to half a percent below the sphere.
int in_globe(const Point& x, const Point& centre, double radius) {
  const double away = std::hypot(x[0] - centre[0], x[1] - centre[1], x[2] - centre[2]) / radius;
  return away < 0.995 ? 1 : away > 1 ? -1 : 0;
}

Body box(double length) {
  return {length, 1e-12, [=](const Point& x) { return side_of(within_box(x, {length, 1, 1})); }};
}

Body l_block() {
  return {0.75, 1e-12, [](const Point& x) {
            return side_of(std::min(within_box(x, {1, 1, 1}), std::max(0.5 - x[0], 0.5 - x[1])));
          }};
}

// Returns a globe. Nodes lie on its triangles, so chords between them lie inside the sphere, at
// most d^2 / 8 below it.
Body globe(double volume) {
  return {volume, 0.01, [](const Point& x) { return in_globe(x, {0, 0, 0}, 1); }};
}

Body cavity(double volume) {
  return {
      volume, 0.005, [](const Point& x) {
        return std::min(side_of(within_box(x, {1, 1, 1})), -in_globe(x, {0.45, 0.5, 0.55}, 0.25));
      }};
}

// Returns a body that a file describes. The sides of points are not tested. The tolerance is
// larger, as d is a third of the body's width.
Body given(double volume) {
  return {volume, 0.05, [](const Point&) { return 0; }};
}

// ------------------------------------------------------------------ placements -----------------

class Job {
 public:
  Job(const char* what, volume_body add, const volume_spacing& d) : what_(what) {
    pnpbs_domain domain;
    require(pnpbs_domain_create(context, 3, &domain), "domain");
    require(add(domain, kData), what);
    require(pnpbs_domain_measure(domain, &volume_), "measure");
    require(pnpbs_placement_create(context, domain, &p_), "placement");
    pnpbs_domain_destroy(&domain);
    body_ = add == volume_l_block      ? l_block()
            : add == volume_two_halves ? box(2)
            : add == volume_unit_box   ? box(1)
            : add == volume_globe      ? globe(volume_)
            : add == volume_cavity     ? cavity(volume_)
                                       : given(volume_);
    set_spacing(d);
  }
  Job(const Job&) = delete;
  ~Job() { pnpbs_placement_destroy(&p_); }

  void set(const char* key, const char* value) {
    require(pnpbs_placement_set(p_, key, value), key);
  }
  void set_spacing(const volume_spacing& d) {
    d_ = d;
    require(pnpbs_placement_set_spacing_callback(p_, volume_spacing_at, &d_), "spacing");
  }

  // Passes the nodes to the placement. Every rank passes some of them, independent of their later
  // owners.
  void set_nodes(const std::vector<Point>& nodes) {
    std::vector<double> xyz;
    std::vector<std::int64_t> ids;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      if (static_cast<int>(i) % size != rank) continue;
      xyz.insert(xyz.end(), nodes[i].begin(), nodes[i].end());
      ids.push_back(static_cast<std::int64_t>((i * 7919) % nodes.size()) + 100);
    }
    require(pnpbs_placement_set_nodes(p_, static_cast<std::int64_t>(ids.size()), xyz.data(),
                                      ids.data()),
            "nodes");
  }

  void judge_filled() {
    require(pnpbs_placement_initialise(p_), "initialise");
    judge("filled");
  }
  void judge_after_run() {
    require(pnpbs_placement_run(p_), "run");
    judge("after the run");
  }

 private:
  void judge(const char* stage) {
    const gathered::Volume all = gathered::gather_volume(p_);
    if (rank != 0) return;
    const std::string name = std::to_string(size) + " ranks, " + what_ + ", " + stage;
    failures += volume_judge::Judge(all, body_, name).judge();
  }

  std::string what_;
  double volume_ = 0;
  Body body_;
  volume_spacing d_{};
  pnpbs_placement p_ = nullptr;
};

// ------------------------------------------------------------------ cases ----------------------

void fill_and_run(const char* what, volume_body add, const volume_spacing& d) {
  Job job(what, add, d);
  job.judge_filled();
  job.judge_after_run();
}

void run_bodies(const char* only) {
  for (const volume_case& body : volume_cases)
    if (std::strcmp(body.name, only) == 0) fill_and_run(body.name, body.body, body.spacing);
}

// Tests a cubic grid, in which every circumsphere passes through eight or more nodes. The order of
// the ids differs from that of the rows.
void exact_grid() {
  Job job("exact grid", volume_unit_box, VOLUME_CONSTANT(1.0 / 8));
  std::vector<Point> grid;
  for (int i = 1; i < 8; ++i)
    for (int j = 1; j < 8; ++j)
      for (int k = 1; k < 8; ++k) grid.push_back({i / 8.0, j / 8.0, k / 8.0});
  job.set_nodes(grid);
  job.judge_filled();
}

void adapting() {
  Job job("adapted", volume_unit_box, VOLUME_CONSTANT(0.12));
  job.judge_after_run();
  const volume_spacing steps[] = {
      VOLUME_GRADED(0.05, 0.12, 1, 1, 1), VOLUME_CONSTANT(0.2), {0.2, 0, {0, 0, 0}, 0.52, 0.07}};
  for (const volume_spacing& next : steps) {
    job.set_spacing(next);
    job.judge_after_run();
  }
}

// Tests more ranks than leaves, so that some ranks own nothing.
void empty_ranks() {
  fill_and_run("few leaves", volume_unit_box, VOLUME_CONSTANT(0.5));
  fill_and_run("some leaves", volume_l_block, VOLUME_CONSTANT(0.2));
}

const std::map<std::string, void (*)()> kCases{
    {"box-graded", [] { run_bodies("box-graded"); }},
    {"box-jump", [] { run_bodies("box-jump"); }},
    {"globe", [] { run_bodies("globe"); }},
    {"l-block", [] { run_bodies("l-block"); }},
    {"cavity", [] { run_bodies("cavity"); }},
    {"two-halves", [] { run_bodies("two-halves"); }},
    {"kleopatra", [] { run_bodies("kleopatra-graded"); }},
    {"exact-grid", exact_grid},
    {"adapting", adapting},
    {"empty-ranks", empty_ranks}};

void check_cases() { run_named_cases(kCases); }

}  // namespace

int main(int argc, char** argv) { return run_in_groups(argc, argv, check_cases); }
