// SPDX-License-Identifier: BSD-3-Clause
#include "quality/element_quality.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <tuple>

#include "base/lattice.hpp"
#include "quality/triangle_quality.hpp"
#include "quality/volume/tetrahedron_quality.hpp"
#include "spacing/spacing_range.hpp"

namespace pnpbs {

namespace {

constexpr double kDegrees = 180 / 3.14159265358979323846;
constexpr std::int64_t kEnoughEdges = 50;  // fewest edges for a meaningful mean

// ------------------------------------------------------------------ edges ----------------------

// Calls visit(j) for the edges (i, j) of elements around node i. Each edge is visited only from its
// end with the smaller id. Edges of the star that belong to no element of the domain are skipped.
template <class Visit>
void for_edges(const Nodes<2>& nodes, const DelaunayStars& stars, std::int64_t i,
               const Visit& visit) {
  bool before = stars.closed(i);  // whether the triangle before the edge is an element
  if (!before)
    stars.for_neighbours_in_order(i, [&](std::int64_t, bool triangle) { before = triangle; });
  stars.for_neighbours_in_order(i, [&](std::int64_t j, bool triangle) {
    if ((before || triangle) && nodes.id(i) < nodes.id(j)) visit(j);
    before = triangle;
  });
}

// All neighbours in space are connected by elements.
template <class Visit>
void for_edges(const Nodes<3>& nodes, const VolumeStars& stars, std::int64_t i,
               const Visit& visit) {
  stars.for_neighbours(i, [&](std::int64_t j) {
    if (nodes.id(i) < nodes.id(j)) visit(j);
  });
}

// Sums over edge ratios from which mean and deviation follow.
struct RatioSums {
  std::int64_t edges = 0;
  FixedPointSum excess, squares;  // sums of ratio - 1 and of its square

  void add(double ratio) {
    // longer edges count as 33 so that one outlier cannot dominate the mean
    constexpr double kMax = 33;
    const double excess_of_one = std::min(ratio, kMax) - 1;
    ++edges;
    excess.add(excess_of_one);
    squares.add(excess_of_one * excess_of_one);
  }
  void add(const RatioSums& other) {
    edges += other.edges;
    excess.add(other.excess);
    squares.add(other.squares);
  }
};

// Sums for each band. The last entry holds the edges between two boundary nodes, whatever their d.
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
  const double excess = sums.excess.value() / n, squares = sums.squares.value() / n;
  return {sums.edges, 1 + excess, std::sqrt(std::max(0.0, squares - excess * excess))};
}

// Returns the deviation of the mean edge ratio from 1.
double off(const EdgeRatio& ratio) { return std::fabs(ratio.mean - 1); }
double off(const RatioSums& sums) { return off(ratio_of(sums)); }

template <int Dim>
SpacingBands bands_of_nodes(const Communicator& comm, const MeasuredNodes<Dim>& measured) {
  const SpacingRange d =
      spacing_range<Dim>(comm, measured.nodes, [&](std::int64_t i) { return measured.d(i); });
  return {d.min, d.max};
}

// Returns whether the node is on a feature edge or a corner of a body, or fixed inside it.
bool is_on_feature(const Nodes<3>& nodes, std::int64_t i) {
  return nodes.moving == Carrier::free &&
         (nodes.carrier(i) == Carrier::curve || nodes.carrier(i) == Carrier::fixed);
}

// Returns the sums over this rank's edges (i, j) for which counts(i, j) is true.
template <int Dim, class Counts>
EdgeSums local_edge_sums(const MeasuredNodes<Dim>& measured, const Stars<Dim>& stars,
                         const SpacingBands& bands, const Counts& counts) {
  const Nodes<Dim>& nodes = measured.nodes;
  return sums_over(
      "pnpbs::edge_sums", nodes.count, EdgeSums(), [&](std::int64_t i, EdgeSums& sums) {
        if (!nodes.owned(i)) return;
        for_edges(nodes, stars, i, [&](std::int64_t j) {
          if (!counts(i, j)) return;
          const double d = 0.5 * (measured.d(i) + measured.d(j));
          const double ratio = measured.distance_between(i, j) / d;
          const bool moves = nodes.moves(i) || nodes.moves(j);
          sums.of[static_cast<std::size_t>(moves ? bands.band_of(d) : SpacingBands::kMaxBands)].add(
              ratio);
        });
      });
}

// Returns the sums over the edges of all ranks for which counts(i, j) is true. Collective.
template <int Dim, class Counts>
EdgeSums edge_sums(const Communicator& comm, const MeasuredNodes<Dim>& measured,
                   const Stars<Dim>& stars, const SpacingBands& bands, const Counts& counts) {
  EdgeSums sums = local_edge_sums<Dim>(measured, stars, bands, counts);
  std::vector<std::int64_t> edges;
  std::vector<FixedPointSum> ratios;
  for (const RatioSums& part : sums.of) {
    edges.push_back(part.edges);
    ratios.insert(ratios.end(), {part.excess, part.squares});
  }
  comm.allreduce_sum(edges, ratios);
  for (std::size_t k = 0; k < edges.size(); ++k)
    sums.of[k] = {edges[k], ratios[2 * k], ratios[2 * k + 1]};
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

// ------------------------------------------------------------------ elements -------------------

// Number of bins of the quality histogram: a bin is 2^-16 wide.
constexpr std::int64_t kQualitySteps = 1 << 16;

// Corners of an element: a triangle in the plane, and a triangle of a surface or a sphere.
// Tetrahedra are TetrahedronCorners. The unused pointer arguments below select the kind of element.
using PlaneTriangle = std::array<Point<2>, 3>;
using SpaceTriangle = std::array<Point<3>, 3>;

template <class Visit>
void for_simplices_around(const DelaunayStars& stars, std::int64_t i, const PlaneTriangle*,
                          const Visit& visit) {
  stars.for_simplices(i, visit);
}
template <class Visit>
void for_simplices_around(const DelaunayStars& stars, std::int64_t i, const SpaceTriangle*,
                          const Visit& visit) {
  stars.for_simplices(i, visit);
}
template <class Visit>
void for_simplices_around(const VolumeStars& stars, std::int64_t i, const TetrahedronCorners*,
                          const Visit& visit) {
  stars.for_simplices(i, visit);
}
template <class Visit>
void for_simplices_around(const VolumeStars& stars, std::int64_t i, const SpaceTriangle*,
                          const Visit& visit) {
  stars.for_triangles(i, visit);
}

// Calls visit(corners) for the elements of type Element in which owned node i has the smallest id.
template <class Element, int Dim, class Visit>
void for_elements_of(const MeasuredNodes<Dim>& measured, const Stars<Dim>& stars, std::int64_t i,
                     const Visit& visit) {
  const Nodes<Dim>& nodes = measured.nodes;
  if (!nodes.owned(i)) return;
  constexpr const Element* kKind = nullptr;
  for_simplices_around(stars, i, kKind, [&](const auto& others) {
    Element corners;
    measured.put(i, corners[0]);
    for (std::size_t k = 0; k < others.size(); ++k) {
      if (nodes.id(others[k]) < nodes.id(i)) return;
      measured.put(others[k], corners[k + 1]);
    }
    visit(corners);
  });
}

double quality_of(const PlaneTriangle& x) { return triangle_quality(x[0], x[1], x[2]); }
double quality_of(const TetrahedronCorners& x) { return tetrahedron_quality(x); }
double quality_of(const SpaceTriangle& x) { return triangle_quality(x[0], x[1], x[2]); }

// The cosine of the smallest angle of a triangle, or of the smallest dihedral angle of a
// tetrahedron, and whether a triangle is obtuse.
struct Angles {
  double max_cosine;
  bool obtuse;
};

template <std::size_t Dim>
Angles angles_of(const std::array<std::array<double, Dim>, 3>& x) {
  const auto [min, max] =
      std::minmax({angle_cosine(x[0], x[1], x[2]), angle_cosine(x[1], x[2], x[0]),
                   angle_cosine(x[2], x[0], x[1])});
  return {max, is_obtuse(min)};
}
Angles angles_of(const TetrahedronCorners& x) {
  return {std::cos(min_dihedral_angle(x) / kDegrees), false};
}

// Quality sums over the elements of this rank.
struct QualitySums {
  explicit QualitySums(double cosine) : max_cosine(cosine) {}

  std::int64_t elements = 0, obtuse = 0;
  FixedPointSum quality;
  double min = 1;
  double max_cosine;  // cosine of the smallest angle

  void add(const QualitySums& other) {
    elements += other.elements;
    obtuse += other.obtuse;
    quality.add(other.quality);
    min = std::min(min, other.min);
    max_cosine = std::max(max_cosine, other.max_cosine);
  }
};

// Returns the lower end of the histogram bin that contains the 1 % quantile of the quality.
double one_percent_of(const std::vector<std::int64_t>& histogram, std::int64_t elements) {
  std::int64_t below = 0;
  std::size_t step = 0;
  while (step + 1 < histogram.size() && below + histogram[step] <= elements / 100)
    below += histogram[step++];
  return static_cast<double>(step) / static_cast<double>(kQualitySteps);
}

// Returns the quality sums of this rank's elements, and fills `histogram` with their numbers by
// quality.
template <class Element, int Dim>
QualitySums local_quality_sums(const MeasuredNodes<Dim>& measured, const Stars<Dim>& stars,
                               std::vector<std::int64_t>& histogram) {
  constexpr bool kTriangles = std::tuple_size_v<Element> == 3;
  // the largest possible smallest angle: 60 or 70.5 degrees
  constexpr double kOfLargestMin = kTriangles ? 0.5 : 1.0 / 3;
  const View<std::int64_t> steps = make_view<std::int64_t>("pnpbs::quality", kQualitySteps);
  std::fill_n(steps.data(), kQualitySteps, 0);
  const auto count = [&](double quality) {
    const auto step = static_cast<std::int64_t>(kQualitySteps * quality);
    std::atomic_ref entry(steps(std::clamp<std::int64_t>(step, 0, kQualitySteps - 1)));
    entry.fetch_add(1, std::memory_order_relaxed);
  };
  const QualitySums sums =
      sums_over("pnpbs::quality_sums", measured.nodes.count, QualitySums(kOfLargestMin),
                [&](std::int64_t i, QualitySums& sum) {
                  for_elements_of<Element, Dim>(measured, stars, i, [&](const Element& corners) {
                    const double quality = quality_of(corners);
                    count(quality);
                    ++sum.elements;
                    sum.quality.add(quality);
                    sum.min = std::min(sum.min, quality);
                    const Angles angles = angles_of(corners);
                    sum.obtuse += angles.obtuse;
                    sum.max_cosine = std::max(sum.max_cosine, angles.max_cosine);
                  });
                });
  histogram.assign(steps.data(), steps.data() + kQualitySteps);
  return sums;
}

template <class Element, int Dim>
SimplexQuality measure_simplices(const Communicator& comm, const MeasuredNodes<Dim>& measured,
                                 const Stars<Dim>& stars) {
  std::vector<std::int64_t> histogram;
  const QualitySums own = local_quality_sums<Element, Dim>(measured, stars, histogram);
  SimplexQuality found;
  found.elements =
      static_cast<std::int64_t>(comm.allreduce_sum(static_cast<std::uint64_t>(own.elements)));
  const double quality = comm.allreduce_sum(own.quality).value();
  comm.allreduce_sum(histogram);
  if (found.elements == 0) return found;
  found.obtuse =
      static_cast<std::int64_t>(comm.allreduce_sum(static_cast<std::uint64_t>(own.obtuse)));
  found.mean = quality / static_cast<double>(found.elements);
  found.one_percent = one_percent_of(histogram, found.elements);
  found.min = -comm.allreduce_max(-own.min);
  found.min_angle = kDegrees * std::acos(std::min(1.0, comm.allreduce_max(own.max_cosine)));
  return found;
}

// ------------------------------------------------------------------ nodes ----------------------

template <int Dim>
double irregular_share(const Communicator& comm, const Nodes<Dim>& nodes, const Stars<Dim>& stars,
                       int neighbours) {
  const auto count = [&](const char* label, const auto& counts) {
    return static_cast<double>(comm.allreduce_sum(sum_of(label, nodes.count, [&](std::int64_t i) {
      return nodes.owned(i) && nodes.moves(i) && counts(i) ? 1 : 0;
    })));
  };
  const double inner = count("pnpbs::inner_nodes", [](std::int64_t) { return true; });
  const double irregular =
      count("pnpbs::irregular_nodes", [&](std::int64_t i) { return stars.size(i) != neighbours; });
  return inner > 0 ? irregular / inner : 0;
}

}  // namespace

template <int Dim>
std::vector<EdgeBand> edge_bands_to_judge(const Communicator& comm,
                                          const MeasuredNodes<Dim>& measured,
                                          const Stars<Dim>& stars, const View<char>& left_out) {
  const Nodes<Dim>& nodes = measured.nodes;
  const auto counts = [&](std::int64_t i, std::int64_t j) {
    return left_out.extent(0) == 0 || !(left_out(i) || left_out(j));
  };
  const auto counts_inside = [&](std::int64_t i, std::int64_t j) {
    return nodes.moves(i) && nodes.moves(j) && counts(i, j);
  };
  const SpacingBands bands = bands_of_nodes<Dim>(comm, measured);
  EdgeSums judged = edge_sums<Dim>(comm, measured, stars, bands, counts);
  if (!worst_missed_band(bands_with_edges(bands, judged))) return bands_with_edges(bands, judged);
  if constexpr (Dim == 3) {
    const auto counts_off_features = [&](std::int64_t i, std::int64_t j) {
      return !is_on_feature(nodes, i) && !is_on_feature(nodes, j) && counts(i, j);
    };
    const EdgeSums off_features = edge_sums<Dim>(comm, measured, stars, bands, counts_off_features);
    for (std::size_t k = 0; k < judged.of.size(); ++k)
      if (ratio_of(judged.of[k]).mean > 1) judged.of[k] = off_features.of[k];
  }
  const EdgeSums inside = edge_sums<Dim>(comm, measured, stars, bands, counts_inside);
  for (std::size_t k = 0; k < judged.of.size(); ++k)
    if (inside.of[k].edges >= kEnoughEdges && off(inside.of[k]) < off(judged.of[k]))
      judged.of[k] = inside.of[k];
  return bands_with_edges(bands, judged);
}

namespace {

SimplexQuality measure_simplices(const Communicator& comm, const MeasuredNodes<2>& measured,
                                 const DelaunayStars& stars) {
  return measured.embedding.is_sphere()
             ? measure_simplices<SpaceTriangle, 2>(comm, measured, stars)
             : measure_simplices<PlaneTriangle, 2>(comm, measured, stars);
}
SimplexQuality measure_simplices(const Communicator& comm, const MeasuredNodes<3>& measured,
                                 const VolumeStars& stars) {
  return stars.are_on_surfaces() ? measure_simplices<SpaceTriangle, 3>(comm, measured, stars)
                                 : measure_simplices<TetrahedronCorners, 3>(comm, measured, stars);
}

int regular_neighbours(const DelaunayStars&) { return Lattice<2>::kNeighbours; }
int regular_neighbours(const VolumeStars& stars) {
  return stars.are_on_surfaces() ? Lattice<2>::kNeighbours : Lattice<3>::kNeighbours;
}

}  // namespace

template <int Dim>
ElementQuality measure_elements(const Communicator& comm, const MeasuredNodes<Dim>& measured,
                                const Stars<Dim>& stars,
                                [[maybe_unused]] const FillGhosts& fill_ghosts) {
  const SpacingBands bands = bands_of_nodes<Dim>(comm, measured);
  const EdgeSums edges =
      edge_sums<Dim>(comm, measured, stars, bands, [](std::int64_t, std::int64_t) { return true; });
  ElementQuality found;
  found.simplex = measure_simplices(comm, measured, stars);
  if constexpr (Dim == 2) found.cell = measure_cells(comm, measured, stars, bands, fill_ghosts);
  found.edge = ratio_of(edges.all());
  found.bands = bands_with_edges(bands, edges);
  found.irregular = irregular_share<Dim>(comm, measured.nodes, stars, regular_neighbours(stars));
  return found;
}

const EdgeBand* worst_missed_band(const std::vector<EdgeBand>& bands) {
  constexpr double kMissed = 0.1;
  const EdgeBand* worst = nullptr;
  for (const EdgeBand& band : bands)
    if (band.ratio.edges >= kEnoughEdges && off(band.ratio) > (worst ? off(worst->ratio) : kMissed))
      worst = &band;
  return worst;
}

template std::vector<EdgeBand> edge_bands_to_judge<2>(const Communicator&, const MeasuredNodes<2>&,
                                                      const Stars<2>&, const View<char>&);
template std::vector<EdgeBand> edge_bands_to_judge<3>(const Communicator&, const MeasuredNodes<3>&,
                                                      const Stars<3>&, const View<char>&);
template ElementQuality measure_elements<2>(const Communicator&, const MeasuredNodes<2>&,
                                            const Stars<2>&, const FillGhosts&);
template ElementQuality measure_elements<3>(const Communicator&, const MeasuredNodes<3>&,
                                            const Stars<3>&, const FillGhosts&);

}  // namespace pnpbs
