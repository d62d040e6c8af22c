// SPDX-License-Identifier: BSD-3-Clause
#include "spacing/shape_spacing.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "base/error.hpp"
#include "base/space_vectors.hpp"
#include "base/started_execution.hpp"
#include "geometry/plane/edges.hpp"
#include "geometry/volume/triangles.hpp"

namespace pnpbs {
namespace {

// A part of a piece, represented by its centroid.
template <int Dim>
struct Part {
  FacetCorners<Dim> corners;
  std::size_t piece;
};

double longest_edge(const FacetCorners<2>& part) { return distance<2>(part[0], part[1]); }
double longest_edge(const FacetCorners<3>& part) {
  return std::max({distance<3>(part[0], part[1]), distance<3>(part[1], part[2]),
                   distance<3>(part[2], part[0])});
}

template <int Dim>
Point<Dim> mean_of(const FacetCorners<Dim>& corners) {
  Point<Dim> middle{};
  for (const Point<Dim>& corner : corners)
    for (std::size_t k = 0; k < Dim; ++k) middle[k] += corner[k] / Dim;
  return middle;
}

template <int Dim>
void append_halves(const Part<Dim>& part, std::vector<Part<Dim>>& parts) {
  std::size_t longest = 0;
  const auto edge = [&](std::size_t k) {
    return distance<Dim>(part.corners[k], part.corners[(k + 1) % Dim]);
  };
  for (std::size_t k = 1; k < Dim; ++k)
    if (edge(k) > edge(longest)) longest = k;
  const std::size_t next = (longest + 1) % Dim;
  const Point<Dim> middle = middle_of<Dim>(part.corners[longest], part.corners[next]);
  for (const std::size_t end : {longest, next}) {
    parts.push_back(part);
    parts.back().corners[end] = middle;
  }
}

// Returns the unit normal on the front of a facet; 0 or NaN if the facet has no extent.
Point<2> unit_normal(const FacetCorners<2>& f) {
  const double whole = distance<2>(f[0], f[1]);
  return {(f[0][1] - f[1][1]) / whole, (f[1][0] - f[0][0]) / whole};
}
Point<3> unit_normal(const FacetCorners<3>& f) {
  return unit_vector(cross(difference(f[1], f[0]), difference(f[2], f[0])));
}

template <int Dim>
class Widths {
 public:
  explicit Widths(const ShapeIndex<Dim>& index) : index_(index) {
    for (const ShapePiece<Dim>& piece : index.shape())
      normals_.push_back(piece.is_facet() ? unit_normal(piece.corners) : Point<Dim>{});
  }

  // Returns sources whose d is the width itself.
  std::vector<ShapeSource<Dim>> run() const {
    constexpr std::size_t kMaxParts = 50'000'000;
    std::vector<Part<Dim>> parts;
    for (std::size_t p = 0; p < index_.shape().size(); ++p)
      if (normals_[p] != Point<Dim>{}) parts.push_back({index_.shape()[p].corners, p});
    std::vector<ShapeSource<Dim>> sources;
    while (!parts.empty()) {
      std::vector<char> small(parts.size());
      std::vector<std::vector<ShapeSource<Dim>>> found(parts.size());
      for_each_if_started("pnpbs::Widths", std::ssize(parts), [&](std::int64_t number) {
        const auto i = static_cast<std::size_t>(number);
        small[i] = is_small(parts[i]);
        if (small[i]) found[i] = sources_at(parts[i]);
      });
      std::vector<Part<Dim>> halves;
      for (std::size_t i = 0; i < parts.size(); ++i) {
        if (!small[i]) append_halves(parts[i], halves);
        sources.insert(sources.end(), found[i].begin(), found[i].end());
      }
      if (sources.size() + halves.size() > kMaxParts)
        throw Error(ErrorKind::spacing,
                    "the domain is so narrow that its width would be measured at more than " +
                        std::to_string(kMaxParts) +
                        " points: repair the geometry where it is narrow, or set the spacing in "
                        "another way");
      parts = std::move(halves);
    }
    return sources;
  }

 private:
  // Calls visit(place) for each side of the part on which the domain lies.
  template <class Visit>
  void for_places(const Part<Dim>& part, const Visit& visit) const {
    const ShapePiece<Dim>& piece = index_.shape()[part.piece];
    typename ShapeIndex<Dim>::Place place{mean_of<Dim>(part.corners), normals_[part.piece],
                                          piece.ends};
    if (piece.front_inside) visit(place);
    for (double& along : place.ahead) along = -along;
    if (piece.back_inside) visit(place);
  }

  bool is_small(const Part<Dim>& part) const {
    constexpr double kMinPart = 1e-6;  // [size of the domain]
    const double edge = longest_edge(part.corners);
    bool small = true;
    for_places(part, [&](const auto& place) {
      small = small && index_.clearance_ahead(place, 2 * edge) >= 2 * edge;
    });
    for (const Point<Dim>& corner : part.corners)
      small = small && index_.foot_of(corner, ends_of(part), 2 * edge).gap >= 2 * edge;
    return small || edge <= kMinPart * index_.size();
  }

  // Adds widths that a small part does not detect because its normal points elsewhere: those of
  // pieces that have its corners in front of them, at most a few part lengths away. `seen` is the
  // width already known.
  void add_feet(const Part<Dim>& part, double seen, std::vector<ShapeSource<Dim>>& sources) const {
    constexpr double kAsMuch = 0.9;
    const double reach = std::min(seen, 4.5 * longest_edge(part.corners));
    for (const Point<Dim>& corner : part.corners) {
      const auto foot = index_.foot_of(corner, ends_of(part), reach);
      if (foot.width > kAsMuch * seen || foot.gap == reach) continue;
      for (const Point<Dim>& end : {corner, foot.x}) {
        FacetCorners<Dim> point;
        point.fill(end);
        sources.push_back({point, foot.width});
      }
    }
  }

  const std::array<std::int32_t, Dim>& ends_of(const Part<Dim>& part) const {
    return index_.shape()[part.piece].ends;
  }

  std::vector<ShapeSource<Dim>> sources_at(const Part<Dim>& part) const {
    std::vector<ShapeSource<Dim>> sources;
    double width = ShapePiece<Dim>::kNone;
    for_places(part, [&](const auto& place) { width = std::min(width, index_.width(place)); });
    if (std::isfinite(width)) sources.push_back({part.corners, width});
    add_feet(part, width, sources);
    return sources;
  }

  const ShapeIndex<Dim>& index_;
  std::vector<Point<Dim>> normals_;
};

}  // namespace

template <int Dim>
double ShapeSource<Dim>::limit(const Point<Dim>& at, double growth) const {
  return d + growth * distance<Dim>(nearest_on(corners, at), at);
}

template <int Dim>
std::vector<ShapeSource<Dim>> shape_sources(const ShapeIndex<Dim>& index,
                                            const ShapeRequirements& demands, double max) {
  std::vector<ShapeSource<Dim>> sources;
  const auto add = [&](const FacetCorners<Dim>& corners, double d) {
    if (d < max) sources.push_back({corners, d});
  };
  for (const ShapePiece<Dim>& piece : index.shape()) {
    double d = ShapePiece<Dim>::kNone;
    if (demands.nodes_per_turn > 0)
      d = std::min(d, 2 * std::numbers::pi * piece.radius / demands.nodes_per_turn);
    if (demands.nodes_per_edge > 0) d = std::min(d, piece.edge / demands.nodes_per_edge);
    add(piece.corners, d);
  }
  if (demands.nodes_across > 0)
    for (const ShapeSource<Dim>& source : Widths<Dim>(index).run())
      add(source.corners, source.d / demands.nodes_across);
  return sources;
}

std::vector<ShapeSource<3>> sources_on_sphere(const ShapeIndex<2>& in_chart,
                                              const StereographicChart& chart,
                                              const ShapeRequirements& demands, double max) {
  constexpr double kAny = std::numeric_limits<double>::infinity();
  std::vector<ShapeSource<3>> sources;
  for (const auto& [corners, d] : shape_sources<2>(in_chart, demands, kAny)) {
    const auto [a, b] = corners;
    const double along = d / chart.stretch(middle_of<2>(a, b));
    if (along < max)
      sources.push_back({{chart.on_sphere(a), chart.on_sphere(b), chart.on_sphere(b)}, along});
  }
  return sources;
}

template struct ShapeSource<2>;
template struct ShapeSource<3>;
template std::vector<ShapeSource<2>> shape_sources<2>(const ShapeIndex<2>&,
                                                      const ShapeRequirements&, double);
template std::vector<ShapeSource<3>> shape_sources<3>(const ShapeIndex<3>&,
                                                      const ShapeRequirements&, double);

template <int Dim>
ShapeSpacing<Dim>::ShapeSpacing(const ShapeIndex<Dim>& index, const ShapeRequirements& demands,
                                const ShapeLimits& limits)
    : ShapeSpacing(shape_sources(index, demands, limits.max_in(index.size())), index.size(),
                   limits) {}

template <int Dim>
ShapeSpacing<Dim>::ShapeSpacing(std::vector<ShapeSource<Dim>> sources, double size,
                                const ShapeLimits& limits)
    : min_(limits.min),
      max_(limits.max_in(size)),
      growth_(limits.growth),
      sources_(std::make_shared<const GrowthSources<Dim, ShapeSource<Dim>>>(std::move(sources))) {}

template <int Dim>
void ShapeSpacing<Dim>::evaluate(std::int64_t n, const Point<Dim>* x, double* d) const {
  for_each_if_started("pnpbs::ShapeSpacing", n, [&](std::int64_t i) {
    d[i] = factor_ * std::max(min_, sources_->limit(x[i], max_, growth_ / factor_));
  });
}

template <int Dim>
std::shared_ptr<const Spacing<Dim>> ShapeSpacing<Dim>::with_sizes_multiplied(double factor) const {
  auto resized = std::make_shared<ShapeSpacing>(*this);
  resized->factor_ *= factor;
  return resized;
}

template class ShapeSpacing<2>;
template class ShapeSpacing<3>;

}  // namespace pnpbs
