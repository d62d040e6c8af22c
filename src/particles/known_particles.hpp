// SPDX-License-Identifier: BSD-3-Clause
// The particles of a rank while they are separated: the owned ones in the order of their ids, then
// the ghosts in the order of theirs.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "base/types.hpp"
#include "comm/exchange_pattern.hpp"

namespace pnpbs {

template <int Dim>
struct KnownParticles {
  std::int64_t owned = 0;
  std::vector<Point<Dim>> x;
  std::vector<double> d;
  std::vector<std::int64_t> ids;
  std::vector<char> kept;  // 0 if the particle is left out.
  std::shared_ptr<const ExchangePattern> pattern;

  std::int64_t count() const { return static_cast<std::int64_t>(x.size()); }
};

}  // namespace pnpbs
