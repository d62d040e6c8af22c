// SPDX-License-Identifier: BSD-3-Clause
// Detection of dips: points between the samples where d is far below the limit that the growth from
// the samples allows.
#pragma once

#include <vector>

#include "base/types.hpp"
#include "comm/communicator.hpp"

namespace pnpbs {

// Returns the points x of all ranks at which d is far below the limit. If there are very many,
// returns the finest. The result is the same on all ranks.
// Collective.
template <int Dim>
std::vector<Point<Dim>> dips_over_ranks(const Communicator& comm, const std::vector<Point<Dim>>& x,
                                        const std::vector<double>& d,
                                        const std::vector<double>& limits);

extern template std::vector<Point<2>> dips_over_ranks<2>(const Communicator&,
                                                         const std::vector<Point<2>>&,
                                                         const std::vector<double>&,
                                                         const std::vector<double>&);
extern template std::vector<Point<3>> dips_over_ranks<3>(const Communicator&,
                                                         const std::vector<Point<3>>&,
                                                         const std::vector<double>&,
                                                         const std::vector<double>&);

}  // namespace pnpbs
