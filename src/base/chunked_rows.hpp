// SPDX-License-Identifier: BSD-3-Clause
// Rows of varying length that several threads write at the same time. Each thread fills whole
// chunks of consecutive rows. Memory is kept and used again by the next build.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "base/execution.hpp"

namespace pnpbs {

// A table of rows whose storage is one array for each chunk of `ChunkRows` rows.
template <class T, int ChunkRows = 512>
class ChunkedRows {
 public:
  // Replaces the table by `rows` rows. make_writer() is called once per chunk and returns a writer;
  // writer(row, out) appends the entries of a row to the vector `out`. Writers may throw.
  template <class MakeWriter>
  void build(const char* label, std::int64_t rows, const MakeWriter& make_writer) {
    make_chunks(rows);
    for_each(label, static_cast<std::int64_t>(chunks_.size()), [&](std::int64_t c) {
      Chunk& chunk = chunks_[static_cast<std::size_t>(c)];
      auto writer = make_writer();
      for (std::int64_t k = 0; k < ChunkRows; ++k) {
        chunk.begin_row(k);
        if (c * ChunkRows + k < rows) writer(c * ChunkRows + k, chunk.entries);
      }
      chunk.end();
    });
  }

  // Builds this table and `others`, which has the same number of rows, in one pass. The writer is
  // called as writer(row, out, out_of_others).
  template <class U, class MakeWriter>
  void build_with(ChunkedRows<U, ChunkRows>& others, const char* label, std::int64_t rows,
                  const MakeWriter& make_writer) {
    make_chunks(rows);
    others.make_chunks(rows);
    for_each(label, static_cast<std::int64_t>(chunks_.size()), [&](std::int64_t c) {
      Chunk& chunk = chunks_[static_cast<std::size_t>(c)];
      auto& other = others.chunks_[static_cast<std::size_t>(c)];
      auto writer = make_writer();
      for (std::int64_t k = 0; k < ChunkRows; ++k) {
        chunk.begin_row(k);
        other.begin_row(k);
        if (c * ChunkRows + k < rows) writer(c * ChunkRows + k, chunk.entries, other.entries);
      }
      chunk.end();
      other.end();
    });
  }

  // Writes the rows again for which again(row) is true and keeps the other rows. `rows` must equal
  // the number of rows of the last build.
  template <class Again, class MakeWriter>
  void rewrite(const char* label, std::int64_t rows, const Again& again,
               const MakeWriter& make_writer) {
    for_each(label, static_cast<std::int64_t>(chunks_.size()), [&](std::int64_t c) {
      const std::int64_t first = c * ChunkRows, last = std::min(first + ChunkRows, rows);
      std::int64_t i = first;
      while (i < last && !again(i)) ++i;
      if (i == last) return;
      std::vector<T> entries;
      std::array<std::int32_t, ChunkRows + 1> offset{};
      auto writer = make_writer();
      for (i = first; i < last; ++i) {
        offset[static_cast<std::size_t>(i - first)] = static_cast<std::int32_t>(entries.size());
        const std::span<const T> there = std::as_const(*this).row(i);
        if (again(i))
          writer(i, entries);
        else
          entries.insert(entries.end(), there.begin(), there.end());
      }
      for (std::int64_t k = last - first; k <= ChunkRows; ++k)
        offset[static_cast<std::size_t>(k)] = static_cast<std::int32_t>(entries.size());
      Chunk& chunk = chunks_[static_cast<std::size_t>(c)];
      chunk.entries.swap(entries);
      chunk.offset = offset;
      give_back(chunk.entries);
    });
  }

  // Releases the memory of chunk `c`. The rows of this chunk must not be read until the next build.
  void drop_chunk(std::int64_t c) { chunks_[static_cast<std::size_t>(c)] = {}; }

  std::span<T> row(std::int64_t i) {
    const std::span<const T> row = std::as_const(*this).row(i);
    return {const_cast<T*>(row.data()), row.size()};
  }
  std::span<const T> row(std::int64_t i) const {
    const Chunk& chunk = chunks_[static_cast<std::size_t>(i / ChunkRows)];
    const std::size_t k = static_cast<std::size_t>(i % ChunkRows);
    return {chunk.entries.data() + chunk.offset[k],
            static_cast<std::size_t>(chunk.offset[k + 1] - chunk.offset[k])};
  }

 private:
  template <class, int>
  friend class ChunkedRows;

  void make_chunks(std::int64_t rows) {
    chunks_.resize(static_cast<std::size_t>((rows + ChunkRows - 1) / ChunkRows));
    for (Chunk& chunk : chunks_) chunk.entries.clear();
  }

  // Releases memory that the doubling of vectors has allocated in excess. A sixteenth is left as
  // spare room, since rows may be a little longer in the next build.
  static void give_back(std::vector<T>& entries) {
    if (entries.capacity() <= entries.size() + entries.size() / 4) return;
    std::vector<T> fitting;
    fitting.reserve(entries.size() + entries.size() / 16);
    fitting.assign(entries.begin(), entries.end());
    entries.swap(fitting);
  }

  struct Chunk {
    std::vector<T> entries;
    std::array<std::int32_t, ChunkRows + 1> offset{};

    void begin_row(std::int64_t k) {
      offset[static_cast<std::size_t>(k)] = static_cast<std::int32_t>(entries.size());
    }
    void end() {
      begin_row(ChunkRows);
      give_back(entries);
    }
  };
  std::vector<Chunk> chunks_;
};

}  // namespace pnpbs
