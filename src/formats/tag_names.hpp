// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

namespace pnpbs {

// Tags for names, from 1 in the order in which they are asked for. No name ("") is one, too.
class TagNames {
 public:
  std::int32_t tag_of(const std::string& name) {
    const auto [entry, is_new] =
        tags_.try_emplace(name, static_cast<std::int32_t>(tags_.size() + 1));
    if (is_new && !name.empty()) names_.emplace_back(entry->second, name);
    return entry->second;
  }

  // Those that are not empty, by tag.
  std::vector<std::pair<std::int32_t, std::string>> take_names() { return std::move(names_); }

 private:
  std::unordered_map<std::string, std::int32_t> tags_;
  std::vector<std::pair<std::int32_t, std::string>> names_;
};

}  // namespace pnpbs
