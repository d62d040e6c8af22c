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

}  // namespace

MshPeriodic::MshPeriodic(const NodeSource& nodes, const MshGroups& groups, SharedFile& file)
    : dimension_(nodes.contents().dimension - 1), periods_(nodes.contents().periods) {
  if (!nodes.contents().is_periodic) return;
  for (const MshGroup& group : groups.tagged)
    first_entity_ = std::max(first_entity_, group.number + 1);
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
}

std::vector<MshGroup> MshPeriodic::entities(const TagGroup& box) const {
  std::vector<MshGroup> entities;
  for (std::size_t link = 0; link < links_.size(); ++link)
    for (const bool of_partners : {false, true})
      entities.push_back({dimension_, entity(link, of_partners), "", box});
  return entities;
}

void MshPeriodic::append(int format, SharedFile& file) const {
  if (links_.empty()) return;
  file.append_text("$Periodic\n" + std::to_string(links_.size()) + "\n");
  for (std::size_t k = 0; k < links_.size(); ++k) {
    const Link& link = links_[k];
    file.append([&](Sink& sink) {
      if (!file.is_first()) return;
      for (const std::int64_t number :
           {std::int64_t{dimension_}, entity(k, false), entity(k, true)}) {
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
