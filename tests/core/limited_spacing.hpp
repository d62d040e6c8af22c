// SPDX-License-Identifier: BSD-3-Clause
// A spacing with limited growth.
#pragma once

#include <functional>
#include <memory>
#include <utility>

#include "spacing/sizing_field.hpp"

template <int Dim>
pnpbs::SizingField<Dim> limited_spacing(
    std::shared_ptr<const pnpbs::Communicator> comm,
    std::unique_ptr<const pnpbs::LineOfSight<Dim>> ways,
    std::shared_ptr<const pnpbs::Spacing<Dim>> spacing, double growth,
    const pnpbs::NodeLimit& limit, const std::function<void()>& beat = [] {}) {
  pnpbs::SizingField<Dim> field(std::move(spacing));
  field.set_beat(beat);
  field.limit_growth(std::move(comm), std::move(ways), growth, limit);
  return field;
}
