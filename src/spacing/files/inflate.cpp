// SPDX-License-Identifier: BSD-3-Clause
#include "spacing/files/inflate.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace pnpbs {

namespace {

struct Damaged {};

constexpr int kMaxBits = 15;  // of a code

// Codes of Huffman's, by how many have each length and which symbols they stand for, by code.
class HuffmanCode {
 public:
  explicit HuffmanCode(std::span<const std::uint8_t> lengths) : symbols_(lengths.size()) {
    for (const std::uint8_t length : lengths) ++counts_[length];
    int left = 1;  // codes of the length so far that are still free
    for (std::size_t length = 1; length <= kMaxBits; ++length) {
      left = 2 * left - counts_[length];
      if (left < 0) throw Damaged();
    }
    std::array<std::uint16_t, kMaxBits + 1> next{};
    for (std::size_t length = 1; length < kMaxBits; ++length)
      next[length + 1] = static_cast<std::uint16_t>(next[length] + counts_[length]);
    for (std::size_t symbol = 0; symbol < lengths.size(); ++symbol)
      if (lengths[symbol] != 0)
        symbols_[next[lengths[symbol]]++] = static_cast<std::uint16_t>(symbol);
  }

  template <class Bits>
  int read(Bits& bits) const {
    int code = 0, first = 0, index = 0;
    for (std::size_t length = 1; length <= kMaxBits; ++length) {
      code |= static_cast<int>(bits.take(1));
      const int count = counts_[length];
      if (code - count < first) return symbols_[static_cast<std::size_t>(index + code - first)];
      index += count;
      first = (first + count) << 1;
      code <<= 1;
    }
    throw Damaged();
  }

 private:
  std::array<std::uint16_t, kMaxBits + 1> counts_{};
  std::vector<std::uint16_t> symbols_;
};

class Inflater {
 public:
  Inflater(std::string_view packed, std::size_t bytes) : in_(packed), most_(bytes) {
    out_.reserve(bytes);
  }

  std::string run() {
    read_header();
    bool last = false;
    while (!last) {
      last = take(1) != 0;
      const auto kind = take(2);
      if (kind == 0)
        copy_stored();
      else if (kind == 1)
        read_block(fixed_lengths(), std::vector<std::uint8_t>(30, 5));
      else if (kind == 2)
        read_own_codes();
      else
        throw Damaged();
    }
    check_sum();
    return std::move(out_);
  }

  // Bits come from the lowest of each byte on.
  std::uint32_t take(int count) {
    while (held_ < count) {
      if (at_ >= in_.size()) throw Damaged();
      bits_ |= static_cast<std::uint32_t>(static_cast<unsigned char>(in_[at_++])) << held_;
      held_ += 8;
    }
    const std::uint32_t value = bits_ & ((std::uint32_t{1} << count) - 1);
    bits_ >>= count;
    held_ -= count;
    return value;
  }

 private:
  void read_header() {
    const std::uint32_t method = take(8), flags = take(8);
    const bool has_dictionary = (flags & 32) != 0;
    if ((method & 15) != 8 || (method * 256 + flags) % 31 != 0 || has_dictionary) throw Damaged();
  }

  void start_at_byte() { bits_ = 0, held_ = 0; }

  void copy_stored() {
    start_at_byte();
    const std::uint32_t length = take(16), complement = take(16);
    if (length != (~complement & 0xffff) || length > in_.size() - at_ ||
        length > most_ - out_.size())
      throw Damaged();
    out_.append(in_.substr(at_, length));
    at_ += length;
  }

  static std::vector<std::uint8_t> fixed_lengths() {
    std::vector<std::uint8_t> lengths(288, 8);
    std::fill(lengths.begin() + 144, lengths.begin() + 256, std::uint8_t{9});
    std::fill(lengths.begin() + 256, lengths.begin() + 280, std::uint8_t{7});
    return lengths;
  }

  void read_own_codes() {
    constexpr std::array<std::uint8_t, 19> order{16, 17, 18, 0, 8,  7, 9,  6, 10, 5,
                                                 11, 4,  12, 3, 13, 2, 14, 1, 15};
    const std::size_t literals = take(5) + 257, distances = take(5) + 1, given = take(4) + 4;
    if (literals > 286 || distances > 30) throw Damaged();
    std::vector<std::uint8_t> own(19, 0);
    for (std::size_t k = 0; k < given; ++k) own[order[k]] = static_cast<std::uint8_t>(take(3));
    const HuffmanCode code(own);
    std::vector<std::uint8_t> lengths;
    while (lengths.size() < literals + distances) {
      const int symbol = code.read(*this);
      std::uint8_t repeated = 0;
      std::size_t times = 1;
      if (symbol < 16) {
        repeated = static_cast<std::uint8_t>(symbol);
      } else if (symbol == 16) {
        if (lengths.empty()) throw Damaged();
        repeated = lengths.back();
        times = 3 + take(2);
      } else {
        times = symbol == 17 ? 3 + take(3) : 11 + take(7);
      }
      lengths.insert(lengths.end(), times, repeated);
    }
    if (lengths.size() > literals + distances) throw Damaged();
    const auto split = lengths.begin() + static_cast<std::ptrdiff_t>(literals);
    read_block({lengths.begin(), split}, {split, lengths.end()});
  }

  void read_block(const std::vector<std::uint8_t>& literals,
                  const std::vector<std::uint8_t>& distances) {
    constexpr int kEnd = 256;
    const HuffmanCode literal(literals), distance(distances);
    for (int symbol = literal.read(*this); symbol != kEnd; symbol = literal.read(*this)) {
      if (symbol > kEnd) {
        copy(length_of(symbol - kEnd - 1), distance);
      } else {
        if (out_.size() >= most_) throw Damaged();
        out_.push_back(static_cast<char>(symbol));
      }
    }
  }

  std::size_t length_of(int symbol) {
    constexpr int kLongest = 28;
    if (symbol > kLongest) throw Damaged();
    if (symbol == kLongest) return 258;
    const int extra = symbol < 8 ? 0 : (symbol - 4) / 4;
    const auto base = symbol < 8 ? 3 + symbol : 3 + ((4 + symbol % 4) << extra);
    return static_cast<std::size_t>(base) + take(extra);
  }

  void copy(std::size_t length, const HuffmanCode& code) {
    const int symbol = code.read(*this);
    if (symbol > 29) throw Damaged();
    const int extra = symbol < 4 ? 0 : (symbol - 2) / 2;
    const auto base = symbol < 4 ? 1 + symbol : 1 + ((2 + symbol % 2) << extra);
    const std::size_t back = static_cast<std::size_t>(base) + take(extra);
    if (back > out_.size() || length > most_ - out_.size()) throw Damaged();
    for (std::size_t from = out_.size() - back, k = 0; k < length; ++k)
      out_.push_back(out_[from + k]);
  }

  // Adler's, of what came out.
  void check_sum() {
    start_at_byte();
    std::uint32_t told = 0;
    for (int k = 0; k < 4; ++k) told = told * 256 + take(8);
    std::uint32_t a = 1, b = 0;
    for (const char c : out_) {
      a = (a + static_cast<unsigned char>(c)) % 65521;
      b = (b + a) % 65521;
    }
    if (told != b * 65536 + a || out_.size() != most_) throw Damaged();
  }

  std::string_view in_;
  std::size_t most_, at_ = 0;
  std::uint32_t bits_ = 0;
  int held_ = 0;
  std::string out_;
};

}  // namespace

std::optional<std::string> inflated(std::string_view packed, std::size_t bytes) {
  if (!may_inflate_to(packed.size(), bytes)) return std::nullopt;
  try {
    return Inflater(packed, bytes).run();
  } catch (const Damaged&) {
    return std::nullopt;
  }
}

}  // namespace pnpbs
