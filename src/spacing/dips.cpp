// SPDX-License-Identifier: BSD-3-Clause
#include "spacing/dips.hpp"

#include <algorithm>
#include <tuple>

#include "comm/records.hpp"
#include "spacing/growth_source.hpp"

namespace pnpbs {

template <int Dim>
std::vector<Point<Dim>> dips_over_ranks(const Communicator& comm, const std::vector<Point<Dim>>& x,
                                        const std::vector<double>& d,
                                        const std::vector<double>& limits) {
  constexpr double kDip = 0.75;  // limits may be a third too high, as one source stands for a leaf
  constexpr std::size_t kMaxDips = 1 << 16;
  std::vector<GrowthSource<Dim>> dips;
  const auto keep_finest = [&] {
    std::ranges::sort(dips, {},
                      [](const GrowthSource<Dim>& dip) { return std::tie(dip.d, dip.x); });
    if (dips.size() > kMaxDips) dips.resize(kMaxDips);
  };
  for (std::size_t k = 0; k < x.size(); ++k)
    if (d[k] < kDip * limits[k]) dips.push_back({x[k], d[k]});
  keep_finest();
  Bytes mine;
  for (const GrowthSource<Dim>& dip : dips) pack(mine, dip);
  dips.clear();
  for_records<GrowthSource<Dim>>(comm.allgather(mine),
                                 [&](const GrowthSource<Dim>& dip) { dips.push_back(dip); });
  keep_finest();
  std::vector<Point<Dim>> places;
  for (const GrowthSource<Dim>& dip : dips) places.push_back(dip.x);
  return places;
}

template std::vector<Point<2>> dips_over_ranks<2>(const Communicator&, const std::vector<Point<2>>&,
                                                  const std::vector<double>&,
                                                  const std::vector<double>&);
template std::vector<Point<3>> dips_over_ranks<3>(const Communicator&, const std::vector<Point<3>>&,
                                                  const std::vector<double>&,
                                                  const std::vector<double>&);

}  // namespace pnpbs
