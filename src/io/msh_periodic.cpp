// SPDX-License-Identifier: BSD-3-Clause
#include "io/msh_periodic.hpp"

#include <algorithm>

#include "base/index.hpp"

namespace pnpbs::io {

namespace {

// Components of images are -1, 0 or 1.
constexpr std::int32_t kAlong = 3;
constexpr std::size_t kImages = 27;

std::int32_t code_of(const std::array<std::int32_t, 3>& image) {
  return ((image[0] + 1) * kAlong + image[1] + 1) * kAlong + image[2] + 1;
}

// Returns the groups of the facets on the lower and upper side, if these are flat and the copies on
// the upper side have these periods; else null.
std::array<const MshGroup*, 2> flat_sides(const Contents& all, const MshGroups& groups,
                                          const std::array<std::int32_t, 3>& image) {
  std::array<const MshGroup*, 2> sides{};
  if (std::ranges::count(image, 0) != 2 || std::ranges::count(image, 1) != 1) return sides;
  const auto axis = static_cast<std::size_t>(std::ranges::find(image, 1) - image.begin());
  for (std::size_t high = 0; high < 2; ++high)
    if (const std::int32_t tag = all.flat_tags[2 * axis + high]; tag != 0)
      sides[high] = groups.of(tag);
  return sides;
}

}  // namespace

MshPeriodic::MshPeriodic(const NodeSource& nodes, const MshGroups& groups, SharedFile& file)
    : dimension_(nodes.contents().dimension - 1), periods_(nodes.contents().periods) {
  if (!nodes.contents().is_periodic) return;
  std::vector<std::int64_t> counts(kImages, 0);
  nodes.for_nodes([&](const NodeRows& rows) {
    std::vector<Pair> own;
    for (std::size_t i = 0; i < rows.partners.size(); ++i) {
      const std::int64_t number = rows.first + static_cast<std::int64_t>(i);
      if (rows.partners[i] == number) continue;
      own.push_back({code_of(rows.images[i]), number + 1, rows.partners[i] + 1});
      ++counts[index(own.back().tag)];
    }
    pairs_.add_window(std::move(own), file.ranks());
  });
  pairs_.sort();
  file.ranks().allreduce_sum(counts);
  for (std::int32_t x = -1; x <= 1; ++x)
    for (std::int32_t y = -1; y <= 1; ++y)
      for (std::int32_t z = -1; z <= 1; ++z)
        if (const std::int64_t pairs = counts[index(code_of({x, y, z}))]; pairs > 0)
          links_.push_back({{x, y, z}, pairs});
  std::int64_t free = 1;
  for (const MshGroup& group : groups.tagged) free = std::max(free, group.number + 1);
  for (Link& link : links_) {
    const auto [low, high] = flat_sides(nodes.contents(), groups, link.image);
    link.has_facets = low && high && low != high;
    link.entities = {link.has_facets ? high->number : free,
                     link.has_facets ? low->number : free + 1};
    if (!link.has_facets) free += 2;
  }
}

std::vector<MshGroup> MshPeriodic::entities(const TagGroup& box) const {
  std::vector<MshGroup> entities;
  for (const Link& link : links_)
    for (const std::int64_t number : link.entities)
      if (!link.has_facets) entities.push_back({dimension_, number, "", box});
  return entities;
}

void MshPeriodic::append(int format, SharedFile& file) const {
  if (links_.empty()) return;
  file.append_text("$Periodic\n" + std::to_string(links_.size()) + "\n");
  for (const Link& link : links_) {
    file.append([&](Sink& sink) {
      if (!file.is_first()) return;
      for (const std::int64_t number :
           {std::int64_t{dimension_}, link.entities[0], link.entities[1]}) {
        sink.number(number);
        sink.text(" ");
      }
      sink.text(format == 2 ? "\nAffine" : "\n16");
      for (std::size_t row = 0; row < 4; ++row)
        for (std::size_t column = 0; column < 4; ++column) {
          sink.text(" ");
          sink.number(row == column            ? 1.0
                      : row < 3 && column == 3 ? link.image[row] * periods_[row]
                                               : 0.0);
        }
      sink.text("\n");
      sink.number(link.pairs);
      sink.text("\n");
    });
    pairs_.append(code_of(link.image), file, [](const Pair& pair, Sink& sink) {
      sink.number(pair.number);
      sink.text(" ");
      sink.number(pair.partner);
      sink.text("\n");
    });
  }
  file.append_text("$EndPeriodic\n");
}

}  // namespace pnpbs::io
