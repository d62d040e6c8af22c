// SPDX-License-Identifier: BSD-3-Clause
#include "quality/element_quality.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "quality/triangle_quality.hpp"
#include "spacing/spacing_bands.hpp"
#include "spacing/spacing_range.hpp"

namespace pnpbs {

namespace {

constexpr double kDegrees = 180 / 3.14159265358979323846;

// ------------------------------------------------------------------ edges ----------------------

// Calls visit(j) for the edges (i, j) of triangles of the domain around an owned node, each once
// over all nodes: at its end with the lesser id.
template <class Visit>
void for_edges(const Nodes<2>& nodes, const DelaunayStars& stars, std::int64_t i,
               const Visit& visit) {
  bool before = stars.closed(i);  // is the triangle before the edge one of the domain?
  if (!before)
    stars.for_neighbours_in_order(i, [&](std::int64_t, bool triangle) { before = triangle; });
  stars.for_neighbours_in_order(i, [&](std::int64_t j, bool triangle) {
    if ((before || triangle) && nodes.id(i) < nodes.id(j)) visit(j);
    before = triangle;
  });
}

struct RatioSums {
  std::int64_t edges = 0, excess = 0, squares = 0;  // of ratio - 1, in fixed point

  void add(double ratio) {
    constexpr double kMax = 1024;  // lest fixed-point numbers overflow
    const double excess_of_one = std::min(ratio, kMax) - 1;
    ++edges;
    excess += fixed_point(excess_of_one);
    squares += fixed_point(excess_of_one * excess_of_one);
  }
  void add(const RatioSums& other) {
    edges += other.edges;
    excess += other.excess;
    squares += other.squares;
  }
};

// Of the edges of each band; the last are those between two boundary nodes, whatever their d.
struct EdgeSums {
  std::array<RatioSums, SpacingBands::kMaxBands + 1> of;

  RatioSums all() const {
    RatioSums sum;
    for (const RatioSums& part : of) sum.add(part);
    return sum;
  }
  void add(const EdgeSums& other) {
    for (std::size_t k = 0; k < of.size(); ++k) of[k].add(other.of[k]);
  }
};

EdgeRatio ratio_of(const RatioSums& sums) {
  if (sums.edges == 0) return {};
  const double n = static_cast<double>(sums.edges);
  const double excess = from_fixed_point(static_cast<std::uint64_t>(sums.excess)) / n;
  const double squares = from_fixed_point(static_cast<std::uint64_t>(sums.squares)) / n;
  return {sums.edges, 1 + excess, std::sqrt(std::max(0.0, squares - excess * excess))};
}

SpacingBands bands_of_nodes(const Communicator& comm, const Nodes<2>& nodes) {
  const SpacingRange d = spacing_range(comm, nodes);
  return {d.min, d.max};
}

EdgeSums local_edge_sums(const Nodes<2>& nodes, const DelaunayStars& stars,
                         const SpacingBands& bands) {
  return sums_over(
      "pnpbs::edge_sums", nodes.count, EdgeSums(), [&](std::int64_t i, EdgeSums& sums) {
        if (!nodes.owned(i)) return;
        for_edges(nodes, stars, i, [&](std::int64_t j) {
          const double d = 0.5 * (nodes.d(i) + nodes.d(j));
          const double ratio = distance<2>(nodes.position(i), nodes.position(j)) / d;
          const bool free = nodes.moves(i) || nodes.moves(j);
          sums.of[static_cast<std::size_t>(free ? bands.band_of(d) : SpacingBands::kMaxBands)].add(
              ratio);
        });
      });
}

// Over all ranks.
EdgeSums edge_sums(const Communicator& comm, const Nodes<2>& nodes, const DelaunayStars& stars,
                   const SpacingBands& bands) {
  EdgeSums sums = local_edge_sums(nodes, stars, bands);
  std::vector<std::int64_t> values;
  for (const RatioSums& part : sums.of)
    values.insert(values.end(), {part.edges, part.excess, part.squares});
  comm.allreduce_sum(values);
  auto value = values.begin();
  for (RatioSums& part : sums.of)
    for (std::int64_t* sum : {&part.edges, &part.excess, &part.squares}) *sum = *value++;
  return sums;
}

std::vector<EdgeBand> bands_with_edges(const SpacingBands& bands, const EdgeSums& sums) {
  std::vector<EdgeBand> found;
  for (int band = 0; band < bands.count(); ++band) {
    const EdgeRatio ratio = ratio_of(sums.of[static_cast<std::size_t>(band)]);
    if (ratio.edges > 0) found.push_back({bands.from(band), bands.to(band), ratio});
  }
  return found;
}

// ------------------------------------------------------------------ triangles ------------------

// The quality of a triangle in steps of 2^-16.
constexpr std::int64_t kQualitySteps = 1 << 16;

// Calls visit(j, k) for the triangles (i, j, k) whose node with the least id is i.
template <class Visit>
void for_triangles_of(const Nodes<2>& nodes, const DelaunayStars& stars, std::int64_t i,
                      const Visit& visit) {
  if (!nodes.owned(i)) return;
  stars.for_simplices(i, [&](const DelaunayStars::Corners& others) {
    const std::int64_t j = others[0], k = others[1];
    if (nodes.id(i) < nodes.id(j) && nodes.id(i) < nodes.id(k)) visit(j, k);
  });
}

struct QualitySums {
  std::int64_t triangles = 0, quality = 0;  // in fixed point

  void add(const QualitySums& other) {
    triangles += other.triangles;
    quality += other.quality;
  }
};

// Of the angle at a.
double cosine(const Point<2>& a, const Point<2>& b, const Point<2>& c) {
  const double product = (b[0] - a[0]) * (c[0] - a[0]) + (b[1] - a[1]) * (c[1] - a[1]);
  return product / (distance<2>(a, b) * distance<2>(a, c));
}

// Of the least angle of a triangle.
double max_cosine(const Point<2>& a, const Point<2>& b, const Point<2>& c) {
  return std::max({cosine(a, b, c), cosine(b, c, a), cosine(c, a, b)});
}

// The largest of value(a, b, c) of the triangles, over all ranks; at least `floor`.
template <class Value>
double max_of_triangles(const Communicator& comm, const Nodes<2>& nodes, const DelaunayStars& stars,
                        double floor, const Value& value) {
  return comm.allreduce_max(
      max_of("pnpbs::largest_of_triangles", nodes.count, floor, [&](std::int64_t i) {
        double max = floor;
        for_triangles_of(nodes, stars, i, [&](std::int64_t j, std::int64_t k) {
          max = std::max(max, value(nodes.position(i), nodes.position(j), nodes.position(k)));
        });
        return max;
      }));
}

// The step below which less than 1 % of the triangles are.
double one_percent_of(const std::vector<std::int64_t>& histogram, std::int64_t triangles) {
  std::int64_t below = 0;
  std::size_t step = 0;
  while (step + 1 < histogram.size() && below + histogram[step] <= triangles / 100)
    below += histogram[step++];
  return static_cast<double>(step) / static_cast<double>(kQualitySteps);
}

// How many triangles there are of each step of quality, on this rank.
std::vector<std::int64_t> histogram_of(const Nodes<2>& nodes, const DelaunayStars& stars) {
  const View<std::int64_t> steps = make_view<std::int64_t>("pnpbs::quality", kQualitySteps);
  Kokkos::deep_copy(steps, 0);
  for_each("pnpbs::quality_histogram", nodes.count, [&](std::int64_t i) {
    for_triangles_of(nodes, stars, i, [&](std::int64_t j, std::int64_t k) {
      const auto step = static_cast<std::int64_t>(
          kQualitySteps *
          triangle_quality(nodes.position(i), nodes.position(j), nodes.position(k)));
      Kokkos::atomic_inc(&steps(std::clamp<std::int64_t>(step, 0, kQualitySteps - 1)));
    });
  });
  return {steps.data(), steps.data() + kQualitySteps};
}

TriangleQuality measure_triangles(const Communicator& comm, const Nodes<2>& nodes,
                                  const DelaunayStars& stars) {
  const QualitySums sums = sums_over(
      "pnpbs::quality_sums", nodes.count, QualitySums(), [&](std::int64_t i, QualitySums& sum) {
        for_triangles_of(nodes, stars, i, [&](std::int64_t j, std::int64_t k) {
          ++sum.triangles;
          sum.quality += fixed_point(
              triangle_quality(nodes.position(i), nodes.position(j), nodes.position(k)));
        });
      });
  std::vector<std::int64_t> histogram = histogram_of(nodes, stars);
  TriangleQuality found;
  found.triangles =
      static_cast<std::int64_t>(comm.allreduce_sum(static_cast<std::uint64_t>(sums.triangles)));
  const double quality =
      from_fixed_point(comm.allreduce_sum(static_cast<std::uint64_t>(sums.quality)));
  comm.allreduce_sum(histogram);
  if (found.triangles == 0) return found;
  found.mean = quality / static_cast<double>(found.triangles);
  found.one_percent = one_percent_of(histogram, found.triangles);
  found.min = -max_of_triangles(comm, nodes, stars, -1,
                                [](const auto&... corner) { return -triangle_quality(corner...); });
  const double cosine_of_min = max_of_triangles(
      comm, nodes, stars, 0.5, [](const auto&... corner) { return max_cosine(corner...); });
  found.min_angle = kDegrees * std::acos(std::min(1.0, cosine_of_min));
  return found;
}

// ------------------------------------------------------------------ nodes ----------------------

double irregular_share(const Communicator& comm, const Nodes<2>& nodes,
                       const DelaunayStars& stars) {
  const auto count = [&](const char* label, const auto& counts) {
    return static_cast<double>(comm.allreduce_sum(sum_of(label, nodes.count, [&](std::int64_t i) {
      return nodes.owned(i) && nodes.moves(i) && counts(i) ? 1 : 0;
    })));
  };
  const double inner = count("pnpbs::inner_nodes", [](std::int64_t) { return true; });
  const double irregular =
      count("pnpbs::irregular_nodes", [&](std::int64_t i) { return stars.size(i) != 6; });
  return inner > 0 ? irregular / inner : 0;
}

}  // namespace

std::vector<EdgeBand> measure_edge_bands(const Communicator& comm, const Nodes<2>& nodes,
                                         const DelaunayStars& stars) {
  const SpacingBands bands = bands_of_nodes(comm, nodes);
  return bands_with_edges(bands, edge_sums(comm, nodes, stars, bands));
}

ElementQuality measure_elements(const Communicator& comm, const Nodes<2>& nodes,
                                const DelaunayStars& stars) {
  const SpacingBands bands = bands_of_nodes(comm, nodes);
  const EdgeSums edges = edge_sums(comm, nodes, stars, bands);
  ElementQuality found;
  found.triangle = measure_triangles(comm, nodes, stars);
  found.edge = ratio_of(edges.all());
  found.bands = bands_with_edges(bands, edges);
  found.irregular = irregular_share(comm, nodes, stars);
  return found;
}

const EdgeBand* worst_missed_band(const std::vector<EdgeBand>& bands) {
  constexpr double kMissed = 0.1;
  constexpr std::int64_t kEnoughEdges = 50;
  const EdgeBand* worst = nullptr;
  const auto off = [](const EdgeBand& band) { return std::fabs(band.ratio.mean - 1); };
  for (const EdgeBand& band : bands)
    if (band.ratio.edges >= kEnoughEdges && off(band) > (worst ? off(*worst) : kMissed))
      worst = &band;
  return worst;
}

}  // namespace pnpbs
