// SPDX-License-Identifier: BSD-3-Clause
// Search for the neighbours of the nodes of one bucket. Candidates are all nodes near the bounding
// box of these nodes. They are copied to plain arrays in the order of their ids, so that the
// distance tests run with SIMD and find neighbours in the order of the lists.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <vector>

#include "base/nodes.hpp"
#include "neighbors/buckets.hpp"

namespace pnpbs {

inline constexpr std::int32_t kTestGroup = 8;  // tests done side by side
inline constexpr std::int32_t kTestWord = 64;  // tests whose results fill one integer

// Returns a bit for each bubble c of some groups: 1 if its distance to the point with the
// coordinates nearest(k, x_c[k]) is less than half_radius * (d + d_c).
template <int Dim, class Nearest>
inline std::uint64_t near_bits(const std::array<const double*, Dim>& xs, const double* ds,
                               std::int32_t groups, double half_radius, double d,
                               const Nearest& nearest) {
  std::uint64_t bits = 0;
  const std::uint64_t tests = static_cast<std::uint64_t>(groups) * kTestGroup;
#pragma omp simd reduction(| : bits)
  for (std::uint64_t c = 0; c < tests; ++c) {
    double square = 0;
    for (int k = 0; k < Dim; ++k) {
      const double gap = xs[k][c] - nearest(k, xs[k][c]);
      square += gap * gap;
    }
    const double reach = half_radius * (d + ds[c]);
    bits |= static_cast<std::uint64_t>(square < reach * reach) << c;
  }
  return bits;
}

// The candidates of one bucket. An object can be used for one bucket after the other.
template <int Dim>
class Candidates {
 public:
  // Gathers and tests the candidates of this bucket, which must not be empty, for lists with this
  // radius.
  void gather(const Nodes<Dim>& nodes, const Buckets<Dim>& buckets, double radius,
              std::int32_t bucket);

  std::int32_t bucket() const { return bucket_; }
  std::int32_t count() const { return count_; }
  std::int32_t node(std::int32_t c) const { return found_[index(c)].node; }

  // Returns the number of neighbours of node i, which must be in the bucket.
  std::int32_t neighbour_count(std::int64_t i) const {
    std::int32_t n = 0;
    const std::uint64_t* const bits = bits_of(i);
    for (std::int32_t w = 0; w < words_; ++w) n += std::popcount(bits[w]);
    return n;
  }

  // Calls visit(j) for these neighbours, by increasing id.
  template <class Visit>
  void for_neighbours(std::int64_t i, const Visit& visit) const {
    const std::uint64_t* const bits = bits_of(i);
    for (std::int32_t w = 0; w < words_; ++w)
      for (std::uint64_t left = bits[w]; left != 0; left &= left - 1)
        visit(found_[index(w * kTestWord + std::countr_zero(left))].node);
  }

  // Removes the pairs for which keep(i, j) is false. `keep` must be symmetric. It is called only if
  // may_occlude is true for i or j, and only once for a pair within the bucket.
  template <class MayOcclude, class Keep>
  void keep_pairs(const MayOcclude& may_occlude, const Keep& keep) {
    hiding_.assign(index(words_), 0);
    std::uint64_t any = 0;
    for (std::int32_t c = 0; c < count_; ++c) {
      const std::uint64_t hides = may_occlude(node(c));
      hiding_[index(c / kTestWord)] |= hides << (c % kTestWord);
      any |= hides;
    }
    if (any == 0) return;  // almost always
    for (std::int32_t o = 0; o < last_ - first_; ++o) {
      const std::uint64_t all = may_occlude(first_ + o) ? ~std::uint64_t{0} : 0;
      for (std::int32_t w = 0; w < words_; ++w)
        for (std::uint64_t left = row(o)[w] & (hiding_[index(w)] | all); left != 0;
             left &= left - 1) {
          const std::int32_t c = w * kTestWord + std::countr_zero(left), j = node(c);
          const bool own = first_ <= j && j < last_;
          if ((own && j - first_ < o) || keep(first_ + o, j)) continue;
          drop(o, c);
          if (own) drop(j - first_, own_[index(o)]);
        }
    }
  }

 private:
  struct Found {
    std::int64_t id;
    std::int32_t node;
  };
  // Bounds of the nodes of the bucket.
  struct Surroundings {
    Box<Dim> box;
    double max;  // largest spacing
  };

  static std::size_t index(std::int64_t i) { return static_cast<std::size_t>(i); }
  static std::int32_t groups_of(std::int32_t n) { return (n + kTestGroup - 1) / kTestGroup; }
  const std::uint64_t* row(std::int64_t own) const {
    return bits_.data() + index(own) * index(words_);
  }
  const std::uint64_t* bits_of(std::int64_t i) const { return row(i - first_); }
  void drop(std::int32_t own, std::int32_t c) {
    bits_[index(own) * index(words_) + index(c / kTestWord)] &=
        ~(std::uint64_t{1} << (c % kTestWord));
  }
  Surroundings surroundings(const Nodes<Dim>& nodes) const;
  void add_near(const Nodes<Dim>& nodes, const Surroundings& around, std::int32_t first,
                std::int32_t last);
  void sort_by_id();
  void copy(const Nodes<Dim>& nodes);
  void test();

  std::int32_t bucket_ = -1;
  std::int32_t first_ = 0, last_ = 0;  // range of the bucket's own nodes
  double half_radius_ = 0;
  std::int32_t count_ = 0;
  std::int32_t words_ = 0;                  // number of bit words per own node
  std::vector<Found> found_;                // the first count_ entries; the rest is spare room
  std::array<std::vector<double>, Dim> x_;  // whole groups, padded with far-away points
  std::vector<double> d_;
  std::vector<std::int32_t> own_;      // indices of the bucket's own nodes among the candidates
  std::vector<std::uint64_t> bits_;    // neighbours of each own node, a bit per candidate
  std::vector<std::uint64_t> hiding_;  // candidates that may occlude, a bit for each
};

template <int Dim>
void Candidates<Dim>::gather(const Nodes<Dim>& nodes, const Buckets<Dim>& buckets, double radius,
                             std::int32_t bucket) {
  bucket_ = bucket;
  first_ = buckets.begin(bucket);
  last_ = buckets.end(bucket);
  half_radius_ = 0.5 * radius;
  count_ = 0;
  const Surroundings around = surroundings(nodes);
  // Consecutive buckets are contiguous in memory and are processed as one range.
  std::int32_t first = 0, last = 0;
  buckets.for_neighbours(bucket, [&](std::int32_t other) {
    if (buckets.begin(other) != last) {
      add_near(nodes, around, first, last);
      first = buckets.begin(other);
    }
    last = buckets.end(other);
  });
  add_near(nodes, around, first, last);
  sort_by_id();
  copy(nodes);
  test();
}

template <int Dim>
typename Candidates<Dim>::Surroundings Candidates<Dim>::surroundings(
    const Nodes<Dim>& nodes) const {
  Surroundings around{{nodes.position(first_), nodes.position(first_)}, nodes.d(first_)};
  for (std::int32_t i = first_ + 1; i < last_; ++i) {
    for (int k = 0; k < Dim; ++k) {
      around.box.low[k] = std::min(around.box.low[k], nodes.x[k](i));
      around.box.high[k] = std::max(around.box.high[k], nodes.x[k](i));
    }
    around.max = std::max(around.max, nodes.d(i));
  }
  return around;
}

// Uses the same arithmetic as the tests of pairs. As rounding is monotonic, no node near one of the
// bucket is rejected here.
template <int Dim>
void Candidates<Dim>::add_near(const Nodes<Dim>& nodes, const Surroundings& around,
                               std::int32_t first, std::int32_t last) {
  const auto room = index(count_ + last - first + 1);  // rejected nodes are written, too
  if (found_.size() < room) found_.resize(room + kTestWord);
  const std::int64_t* const ids = nodes.id.data();
  Found* next = found_.data() + count_;
  std::int32_t start = first;
  for (; start < last && start + kTestGroup <= nodes.count; start += kTestGroup) {
    std::array<const double*, Dim> xs;
    for (int k = 0; k < Dim; ++k) xs[k] = nodes.x[k].data() + start;
    std::uint64_t bits = near_bits<Dim>(xs, nodes.d.data() + start, 1, half_radius_, around.max,
                                        [box = around.box](int k, double x) {
                                          return std::min(std::max(x, box.low[k]), box.high[k]);
                                        });
    bits &= (std::uint64_t{1} << std::min(kTestGroup, last - start)) - 1;
    // About one node in three is near, so branches are mispredicted too often.
    for (std::int32_t lane = 0; lane < kTestGroup; ++lane) {
      *next = {ids[start + lane], start + lane};
      next += bits >> lane & 1;
    }
  }
  // The last nodes of the array, fewer than a group, are accepted without a test.
  for (; start < last; ++start) *next++ = {ids[start], start};
  count_ = static_cast<std::int32_t>(next - found_.data());
}

// Sorts the candidates by id. They are nearly sorted already because ids follow the order of the
// buckets, except for nodes that moved or were inserted later.
template <int Dim>
void Candidates<Dim>::sort_by_id() {
  constexpr std::int32_t kMany = 256;
  Found *const first = found_.data(), *const last = first + count_;
  if (count_ > kMany) {
    std::sort(first, last, [](const Found& a, const Found& b) { return a.id < b.id; });
    return;
  }
  for (Found* next = first + 1; next < last; ++next) {
    if (next[-1].id < next->id) continue;
    const Found moving = *next;
    Found* at = next;
    for (; at > first && at[-1].id > moving.id; --at) *at = at[-1];
    *at = moving;
  }
}

template <int Dim>
void Candidates<Dim>::copy(const Nodes<Dim>& nodes) {
  const std::int32_t padded = groups_of(count_) * kTestGroup;
  if (d_.size() < index(padded)) {
    for (int k = 0; k < Dim; ++k) x_[k].resize(index(padded + kTestWord));
    d_.resize(index(padded + kTestWord));
  }
  const auto own = static_cast<std::uint32_t>(last_ - first_);
  if (own_.size() <= own) own_.resize(own + 8);
  for (std::int32_t c = 0; c < count_; ++c) {
    const std::int32_t j = node(c);
    for (int k = 0; k < Dim; ++k) x_[k][index(c)] = nodes.x[k](j);
    d_[index(c)] = nodes.d(j);
    // All other nodes write to the spare entry behind those of the own nodes, which avoids a
    // branch.
    own_[std::min(static_cast<std::uint32_t>(j - first_), own)] = c;
  }
  for (std::int32_t c = count_; c < padded; ++c) {
    for (int k = 0; k < Dim; ++k) x_[k][index(c)] = kFarAway;
    d_[index(c)] = 0;
  }
}

// Tests each node of the bucket against all candidates but itself.
template <int Dim>
void Candidates<Dim>::test() {
  const std::int32_t groups = groups_of(count_), groups_per_word = kTestWord / kTestGroup;
  words_ = (groups + groups_per_word - 1) / groups_per_word;
  const std::size_t room = index(last_ - first_) * index(words_);
  if (bits_.size() < room) bits_.resize(2 * room);
  std::uint64_t* bits = bits_.data();
  for (std::int32_t o = 0; o < last_ - first_; ++o, bits += words_) {
    const std::int32_t own = own_[index(o)];
    Point<Dim> x;
    for (int k = 0; k < Dim; ++k) x[k] = x_[k][index(own)];
    for (std::int32_t w = 0; w < words_; ++w) {
      std::array<const double*, Dim> xs;
      for (int k = 0; k < Dim; ++k) xs[k] = x_[k].data() + w * kTestWord;
      bits[w] = near_bits<Dim>(xs, d_.data() + w * kTestWord,
                               std::min(groups_per_word, groups - w * groups_per_word),
                               half_radius_, d_[index(own)], [x](int k, double) { return x[k]; });
    }
    bits[own / kTestWord] &= ~(std::uint64_t{1} << (own % kTestWord));
  }
}

}  // namespace pnpbs
