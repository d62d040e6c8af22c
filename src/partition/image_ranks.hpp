// SPDX-License-Identifier: BSD-3-Clause
// Ranks as holders of the nodes and of their images. In a periodic domain, a rank has a number of
// its own in each copy of the periodic cell, and a rank can be its own neighbour. In the cell
// itself, the number is that of the rank.
#pragma once

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include "base/periodic_cell.hpp"

namespace pnpbs {

template <int Dim>
class ImageRanks {
 public:
  ImageRanks() = default;
  ImageRanks(const PeriodicCell<Dim>& cell, int ranks) : cell_(cell), ranks_(ranks) {}

  const PeriodicCell<Dim>& cell() const { return cell_; }
  // Returns the number that stands for a rank in a copy of the cell.
  int number(int rank, const Image<Dim>& image) const {
    return rank + ranks_ * static_cast<int>(wrapped(cell_.id_shift(image)));
  }
  int rank(int number) const { return cell_.any() ? number % ranks_ : number; }
  Image<Dim> image(int number) const {
    return cell_.image_of_id(cell_.id_of(0) + unwrapped(number / ranks_));
  }
  // Return the translations of positions and ids of this rank to those of a rank in a copy of the
  // cell, and back.
  Translation<Dim> translation_to(int number) const { return {cell_, image(number)}; }
  Translation<Dim> translation_from(int number) const { return {cell_, opposite(image(number))}; }
  // Returns the number that stands for this rank, `me`, where `number` is the other one.
  int seen_by(int number, int me) const { return this->number(me, opposite(image(number))); }

 private:
  // The code of a translation, which may be negative, as one that is not, and 0 for none.
  static std::int64_t wrapped(std::int64_t shift) { return shift > 0 ? 2 * shift - 1 : -2 * shift; }
  static Image<Dim> opposite(Image<Dim> image) {
    for (std::int32_t& periods : image) periods = -periods;
    return image;
  }
  static std::int64_t unwrapped(std::int64_t code) {
    return code % 2 != 0 ? (code + 1) / 2 : -code / 2;
  }

  PeriodicCell<Dim> cell_;
  int ranks_ = 1;
};

// The order in which messages between ranks and their images are sent. Messages from one rank to
// another one arrive in the order in which they were sent. Both sides therefore sort them: the
// sender by the image of the receiver, which the receiver sees in the reverse order.
class MessageOrder {
 public:
  MessageOrder() = default;
  template <int Dim>
  MessageOrder(const std::vector<int>& numbers, const ImageRanks<Dim>& images)
      : sent_(numbers.size()), departs_(numbers.size()), arrives_(numbers.size()) {
    std::iota(sent_.begin(), sent_.end(), std::size_t{0});
    if (images.cell().any())
      std::ranges::stable_sort(sent_, {}, [&](std::size_t k) {
        return std::pair(images.rank(numbers[k]), images.image(numbers[k]));
      });
    for (const std::size_t k : sent_) ranks_.push_back(images.rank(numbers[k]));
    for (std::size_t first = 0, end = 0; first < sent_.size(); first = end) {
      while (end < sent_.size() && ranks_[end] == ranks_[first]) ++end;
      for (std::size_t at = first; at < end; ++at) arrives_[sent_[at]] = first + end - 1 - at;
    }
    for (std::size_t at = 0; at < sent_.size(); ++at) departs_[sent_[at]] = at;
  }

  // Returns the receivers of the messages in the order in which they are sent.
  const std::vector<int>& ranks() const { return ranks_; }
  // Return the positions of the messages to and from neighbour k in this order.
  std::size_t departure(std::size_t k) const { return departs_[k]; }
  std::size_t arrival(std::size_t k) const { return arrives_[k]; }

 private:
  std::vector<int> ranks_;
  std::vector<std::size_t> sent_, departs_, arrives_;
};

}  // namespace pnpbs
