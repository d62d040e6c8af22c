// SPDX-License-Identifier: BSD-3-Clause
// A shared array of numbers or plain records in host memory. Copies refer to the same entries,
// which are freed with the last of them. Freeing throws nothing and allocates nothing, which a
// Kokkos::View does, in a destructor: a lack of memory would end the process there.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <new>
#include <type_traits>

namespace pnpbs {

template <class T>
class View {
  using Entry = std::remove_const_t<T>;
  static_assert(std::is_trivially_destructible_v<Entry>);

 public:
  View() = default;
  // Allocates n entries, without values, aligned to cache lines.
  explicit View(std::int64_t n) : entries_(allocated(n), Free{}), size_(n) {}
  // Refers to the entries of another view, which this one does not change.
  template <class U>
  requires(std::same_as<const U, T>) View(const View<U>& other)
      : entries_(other.entries_), size_(other.size_) {}  // NOLINT: implicit

  T& operator()(std::integral auto i) const { return entries_.get()[i]; }
  T* data() const { return entries_.get(); }
  std::size_t extent(int) const { return static_cast<std::size_t>(size_); }
  std::size_t size() const { return static_cast<std::size_t>(size_); }

 private:
  template <class U>
  friend class View;

  static constexpr std::align_val_t kAlignment{64};
  struct Free {
    void operator()(Entry* entries) const noexcept { ::operator delete(entries, kAlignment); }
  };
  static Entry* allocated(std::int64_t n) {
    constexpr std::int64_t kMost =
        std::numeric_limits<std::int64_t>::max() / static_cast<std::int64_t>(sizeof(Entry));
    if (n < 0 || n > kMost) throw std::bad_array_new_length();
    return static_cast<Entry*>(
        ::operator new(static_cast<std::size_t>(n) * sizeof(Entry), kAlignment));
  }

  std::shared_ptr<T> entries_;
  std::int64_t size_ = 0;
};

// `label` says what the array is, for readers of the code.
template <class T>
View<T> make_view(const char* /*label*/, std::int64_t n) {
  return View<T>(n);
}

}  // namespace pnpbs
