// SPDX-License-Identifier: BSD-3-Clause
// What has been asked of a domain's shape, kept until the domain changes.
#pragma once

#include <memory>
#include <mutex>
#include <tuple>
#include <vector>

#include "spacing/shape_spacing.hpp"

namespace pnpbs::api {

template <int Dim>
class DomainShapes {
 public:
  explicit DomainShapes(const Domain<Dim>& checked) : index_(shape_of(checked)) {}

  const ShapeIndex<Dim>& index() const { return index_; }

  const ShapeSpacing<Dim>& spacing(const ShapeDemands& demands, const ShapeLimits& limits) {
    const std::lock_guard<std::mutex> lock(mutex_);
    for (const auto& known : spacings_)
      if (known->demands == demands && known->limits == limits) return known->spacing;
    spacings_.push_back(std::make_unique<Known>(Known{demands, limits, {index_, demands, limits}}));
    return spacings_.back()->spacing;
  }

 private:
  struct Known {
    ShapeDemands demands;
    ShapeLimits limits;
    ShapeSpacing<Dim> spacing;
  };

  ShapeIndex<Dim> index_;
  std::mutex mutex_;
  std::vector<std::unique_ptr<Known>> spacings_;
};

}  // namespace pnpbs::api
