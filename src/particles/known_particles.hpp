// SPDX-License-Identifier: BSD-3-Clause
// The particles that a rank knows while they find their places: its own in the order of their ids,
// then its ghosts, in the order of theirs.
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
  std::vector<char> kept;  // 0: there is one too many here
  std::shared_ptr<const ExchangePattern> pattern;

  std::int64_t count() const { return static_cast<std::int64_t>(x.size()); }
};

}  // namespace pnpbs
