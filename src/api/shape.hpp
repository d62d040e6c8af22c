// SPDX-License-Identifier: BSD-3-Clause
// Results of shape queries of a domain, which are kept until the domain changes.
#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <tuple>
#include <vector>

#include "base/space_vectors.hpp"
#include "shape/shape.hpp"
#include "spacing/shape_spacing.hpp"
#include "sphere/great_circle.hpp"

namespace pnpbs::api {

// The indices of a domain's shape and the shape spacings that have been requested. Shapes on a
// sphere use points in space, hence Dim = 3.
template <int Dim>
class DomainShapes {
 public:
  explicit DomainShapes(const Domain<Dim>& checked) : index_(shape_of(checked)) {}
  explicit DomainShapes(const PlaneDomain& on_sphere) requires(Dim == 3)
      : sphere_(Sphere{on_sphere.embedding().chart(), ShapeIndex<2>(shape_of(on_sphere))}),
        index_(shape_on_sphere(on_sphere)) {}

  const ShapeIndex<Dim>& index() const { return index_; }
  // Returns the distance from x to the geometry with this tag, or to the boundary for tag 0. On a
  // sphere it is measured along the sphere.
  double distance(std::int32_t tag, const Point<Dim>& x) const {
    if constexpr (Dim == 3)
      if (sphere_) {
        const double radius = sphere_->chart.radius();
        const Point<3> at = shifted({}, radius, unit_vector(x));
        return radius * angle_between(at, nearest(tag, at));
      }
    return pnpbs::distance<Dim>(nearest(tag, x), x);
  }

  // Returns the shape spacing for these demands, and computes it on first request. Thread-safe.
  const ShapeSpacing<Dim>& spacing(const ShapeRequirements& demands, const ShapeLimits& limits) {
    const std::lock_guard<std::mutex> lock(mutex_);
    for (const auto& known : spacings_)
      if (known->demands == demands && known->limits == limits) return known->spacing;
    spacings_.push_back(
        std::make_unique<Known>(Known{demands, limits, spacing_for(demands, limits)}));
    return spacings_.back()->spacing;
  }

 private:
  struct Sphere {
    StereographicChart chart;
    ShapeIndex<2> in_chart;
  };
  struct Known {
    ShapeRequirements demands;
    ShapeLimits limits;
    ShapeSpacing<Dim> spacing;
  };

  Point<Dim> nearest(std::int32_t tag, const Point<Dim>& x) const {
    return tag == 0 ? index_.nearest_on_boundary(x) : index_.nearest_with_tag(tag, x);
  }
  ShapeSpacing<Dim> spacing_for(const ShapeRequirements& demands, const ShapeLimits& limits) const {
    if constexpr (Dim == 3)
      if (sphere_)
        return {sources_on_sphere(sphere_->in_chart, sphere_->chart, demands,
                                  limits.max_in(index_.size())),
                index_.size(), limits};
    return {index_, demands, limits};
  }

  std::optional<Sphere> sphere_;
  ShapeIndex<Dim> index_;
  std::mutex mutex_;
  std::vector<std::unique_ptr<Known>> spacings_;
};

}  // namespace pnpbs::api
