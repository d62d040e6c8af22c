// SPDX-License-Identifier: BSD-3-Clause
#include "io/file_seal.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

#include "base/error.hpp"
#include "base/mixed_hash.hpp"

namespace pnpbs::io {

namespace {

constexpr std::array<char, 8> kMark{'P', 'N', 'P', 'B', 'S', 'e', 'n', 'd'};

// The end of a sealed file, after the list of the extents that are left out.
struct SealEnd {
  std::int64_t extents = 0;
  std::uint64_t checksum = 0;
  std::array<char, 8> mark = kMark;
};

using OpenFile = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

[[noreturn]] void fail_of_system(const char* what, const std::string& name) {
  throw Error(ErrorKind::file, std::string(what) + name + ": " + std::strerror(errno));
}

OpenFile open(const std::string& path, const char* mode, const char* what,
              const std::string& name) {
  OpenFile file(std::fopen(path.c_str(), mode), std::fclose);
  if (!file) fail_of_system(what, name);
  return file;
}

void read(const OpenFile& file, std::int64_t place, void* bytes, std::size_t size,
          const std::string& name) {
  if (::fseeko(file.get(), place, SEEK_SET) != 0 || std::fread(bytes, 1, size, file.get()) != size)
    throw Error(ErrorKind::file, "cannot read " + name + ": it ends too early");
}

std::int64_t size_of(const OpenFile& file) {
  return ::fseeko(file.get(), 0, SEEK_END) == 0 ? ::ftello(file.get()) : -1;
}

// Returns the checksum of the bytes up to `end` without the extents, which must be sorted.
std::uint64_t checksum_without(const OpenFile& file, const std::vector<Extent>& extents,
                               std::int64_t end, const std::string& name) {
  std::uint64_t sum = mixed(static_cast<std::uint64_t>(end));
  std::array<std::uint64_t, 8192> words;
  const auto add = [&](std::int64_t from, std::int64_t to) {
    while (from < to) {
      const std::int64_t size = std::min<std::int64_t>(to - from, sizeof words);
      words.fill(0);
      read(file, from, words.data(), static_cast<std::size_t>(size), name);
      for (std::int64_t k = 0; k < (size + 7) / 8; ++k)
        sum = mixed(sum ^ words[static_cast<std::size_t>(k)]);
      from += size;
    }
  };
  std::int64_t from = 0;
  for (const Extent& extent : extents) {
    sum = mixed(sum ^ static_cast<std::uint64_t>(extent.begin));
    sum = mixed(sum ^ static_cast<std::uint64_t>(extent.size));
    add(from, extent.begin);
    from = extent.begin + extent.size;
  }
  add(from, end);
  return sum;
}

}  // namespace

void add_seal(const std::string& path, const std::string& name, std::vector<Extent> left_out) {
  const char* const what = "cannot write ";
  std::sort(left_out.begin(), left_out.end(),
            [](const Extent& a, const Extent& b) { return a.begin < b.begin; });
  OpenFile file = open(path, "r+b", what, name);
  const std::int64_t end = size_of(file);
  SealEnd seal;
  seal.extents = std::ssize(left_out);
  seal.checksum = checksum_without(file, left_out, end, name);
  errno = 0;
  bool done = ::fseeko(file.get(), end, SEEK_SET) == 0;
  for (const Extent& extent : left_out)
    done = done && std::fwrite(&extent, sizeof extent, 1, file.get()) == 1;
  done = done && std::fwrite(&seal, sizeof seal, 1, file.get()) == 1;
  if (std::fclose(file.release()) != 0 || !done) fail_of_system(what, name);
}

void require_seal(const std::string& path, const std::string& name) {
  constexpr std::int64_t kMostExtents = 1000, kExtent = sizeof(Extent), kEnd = sizeof(SealEnd);
  const OpenFile file = open(path, "rb", "cannot read ", name);
  const std::int64_t size = size_of(file);
  SealEnd seal;
  seal.mark = {};
  if (size >= kEnd) read(file, size - kEnd, &seal, sizeof seal, name);
  if (seal.mark != kMark)
    throw Error(ErrorKind::file,
                name + " is an HDF5 file, but no checkpoint of PNPBS, or its end is missing");
  const std::string damaged = name + " is damaged: the checksum of its layout does not match";
  if (seal.extents < 0 || seal.extents > kMostExtents) throw Error(ErrorKind::file, damaged);
  const std::int64_t end = size - kEnd - seal.extents * kExtent;
  if (end < 0) throw Error(ErrorKind::file, damaged);
  std::vector<Extent> extents(static_cast<std::size_t>(seal.extents));
  if (!extents.empty()) read(file, end, extents.data(), extents.size() * sizeof(Extent), name);
  std::int64_t from = 0;
  for (const Extent& extent : extents) {
    if (extent.begin < from || extent.size < 0 || extent.begin > end ||
        extent.size > end - extent.begin)
      throw Error(ErrorKind::file, damaged);
    from = extent.begin + extent.size;
  }
  if (checksum_without(file, extents, end, name) != seal.checksum)
    throw Error(ErrorKind::file, damaged);
}

}  // namespace pnpbs::io
