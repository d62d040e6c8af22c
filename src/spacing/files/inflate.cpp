// SPDX-License-Identifier: BSD-3-Clause
#include "spacing/files/inflate.hpp"

#include <dlfcn.h>

#include "base/error.hpp"
#include "base/opened_library.hpp"

namespace pnpbs {

namespace {

// zlib's uncompress(), unchanged since zlib 1.0 (zlib.net/manual.html). The length is the capacity
// on entry and the size of the decompressed data on return. The function returns 0 on success.
using Uncompress = int (*)(unsigned char* bytes, unsigned long* length, const unsigned char* packed,
                           unsigned long packed_length);

Uncompress opened_uncompress() {
  void* library = open_library({"libz.so.1", "libz.1.dylib", "libz.so", "libz.dylib"});
  void* found = library ? dlsym(library, "uncompress") : nullptr;
  if (!found)
    throw Error(ErrorKind::unsupported,
                "compressed data cannot be read, as no zlib (libz.so.1) can be opened: install it, "
                "or write the file uncompressed");
  return reinterpret_cast<Uncompress>(found);
}

}  // namespace

std::optional<std::string> inflated(std::string_view packed, std::size_t bytes) {
  static const Uncompress uncompress = opened_uncompress();
  std::string result(bytes, '\0');
  auto length = static_cast<unsigned long>(bytes);
  const int status = uncompress(reinterpret_cast<unsigned char*>(result.data()), &length,
                                reinterpret_cast<const unsigned char*>(packed.data()),
                                static_cast<unsigned long>(packed.size()));
  if (status != 0 || length != bytes) return {};
  return result;
}

}  // namespace pnpbs
