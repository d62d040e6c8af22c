// SPDX-License-Identifier: BSD-3-Clause
// What has been used last, within a number of bytes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <list>
#include <unordered_map>
#include <utility>

namespace pnpbs::geo {

// Values have bytes().
template <class Value>
class RecentlyUsed {
 public:
  explicit RecentlyUsed(std::size_t most_bytes) : most_bytes_(most_bytes) {}

  // The value of this number, made if it is not there. It is there until the next call, even where
  // it alone has more bytes than all may have.
  template <class Make>
  const Value& get(std::int64_t number, const Make& make) {
    const auto found = places_.find(number);
    if (found != places_.end()) {
      values_.splice(values_.begin(), values_, found->second);
      return values_.front().second;
    }
    Value made = make();
    bytes_ += made.bytes();
    values_.emplace_front(number, std::move(made));
    places_[number] = values_.begin();
    while (bytes_ > most_bytes_ && values_.size() > 1) drop_last();
    return values_.front().second;
  }

 private:
  using Values = std::list<std::pair<std::int64_t, Value>>;

  void drop_last() {
    bytes_ -= values_.back().second.bytes();
    places_.erase(values_.back().first);
    values_.pop_back();
  }

  std::size_t most_bytes_, bytes_ = 0;
  Values values_;  // the last used first
  std::unordered_map<std::int64_t, typename Values::iterator> places_;
};

}  // namespace pnpbs::geo
