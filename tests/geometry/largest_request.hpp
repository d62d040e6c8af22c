// SPDX-License-Identifier: BSD-3-Clause
// The largest block of memory requested from operator new, which this header replaces in the whole
// program. Must be included by one source file only.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <new>

inline std::size_t largest_request = 0;

[[gnu::noinline]] void* operator new(std::size_t size) {
  largest_request = std::max(largest_request, size);
  if (void* memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  largest_request = std::max(largest_request, size);
  return std::malloc(size);
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
