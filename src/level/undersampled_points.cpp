// SPDX-License-Identifier: BSD-3-Clause
#include "level/undersampled_points.hpp"

#include <algorithm>
#include <tuple>
#include <vector>

#include "base/point_text.hpp"
#include "comm/records.hpp"
#include "method/constants.hpp"

namespace pnpbs {

namespace {

using Place = UndersampledSpacing::Place;

constexpr std::size_t kMaxPlaces = 1 << 16;

void keep_finest(std::vector<Place>& places) {
  std::ranges::sort(places, {}, [](const Place& place) { return std::tie(place.d, place.x); });
  if (places.size() > kMaxPlaces) places.resize(kMaxPlaces);
}

// Returns the finest undersampled point of each leaf, among the nodes of this rank.
std::vector<Place> undersampled_points_of_own(const Level<3>& level) {
  const Nodes<3>& nodes = level.nodes;
  const BackgroundTree<3>& tree = level.map().tree();
  struct Found {
    std::int32_t leaf;
    Place place;
  };
  std::vector<Found> found;
  for (std::int64_t i = 0; i < nodes.count; ++i) {
    if (!nodes.owned(i) || !nodes.moves(i)) continue;
    const std::int32_t leaf = level.neighbourhood.buckets().bucket_of(i);
    const double sampled = level.map().leaf_min_spacing(leaf);
    if (nodes.d(i) >= method::kFarFiner * sampled) continue;
    found.push_back(
        {leaf, {nodes.d(i), sampled, tree.cell_side(tree.leaf_cell(leaf)), nodes.position(i)}});
  }
  std::ranges::sort(found, {},
                    [](const Found& one) { return std::tie(one.leaf, one.place.d, one.place.x); });
  const auto same_leaf = [](const Found& a, const Found& b) { return a.leaf == b.leaf; };
  found.erase(std::unique(found.begin(), found.end(), same_leaf), found.end());
  std::vector<Place> places;
  for (const Found& one : found) places.push_back(one.place);
  return places;
}

MessageText text_of(const std::vector<Place>& places) {
  const Place& finest = places.front();
  return "the spacing d = " + rounded_text(finest.d) + " near " + rounded_point_text<3>(finest.x) +
         " is smaller than at all samples around it, where it is " + rounded_text(finest.sampled) +
         " or more: let d grow gradually from this point, by " +
         number_text(method::kGrowthFollowed) + " times the distance or less";
}

}  // namespace

UndersampledSpacing::UndersampledSpacing(std::vector<Place> places)
    : AgreedError(ErrorKind::spacing, text_of(places)), places_(std::move(places)) {}

void require_sampled_spacing(const Level<3>& level) {
  std::vector<Place> places;
  Bytes mine;
  collective_try(*level.comm, [&] {
    places = undersampled_points_of_own(level);
    keep_finest(places);
    for (const Place& place : places) pack(mine, place);
  });
  if (level.comm->allreduce_max(!places.empty()) == 0) return;
  places.clear();
  for_records<Place>(level.comm->allgather(mine),
                     [&](const Place& place) { places.push_back(place); });
  keep_finest(places);
  throw UndersampledSpacing(std::move(places));
}

}  // namespace pnpbs
