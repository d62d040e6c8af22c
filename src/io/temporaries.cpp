// SPDX-License-Identifier: BSD-3-Clause
#include "io/temporaries.hpp"

#include <unistd.h>

#include <atomic>

namespace pnpbs::io {

// An entry of the list. Entries are never freed, because a signal may arrive while the list is read
// or changed. Entries of destroyed objects are reused, unless the signal handler has removed their
// files.
struct Temporary::Entry {
  std::string path;
  std::atomic<bool> taken{true};
  std::atomic<bool> live{false};  // `path` is read only if this is set
  Entry* next = nullptr;
  static std::atomic<Entry*> first;
};

std::atomic<Temporary::Entry*> Temporary::Entry::first{nullptr};
static_assert(std::atomic<bool>::is_always_lock_free);

Temporary::Entry* Temporary::free_entry() {
  for (Entry* entry = Entry::first; entry; entry = entry->next)
    if (!entry->taken.exchange(true)) return entry;
  auto* entry = new Entry;
  entry->next = Entry::first;
  while (!Entry::first.compare_exchange_weak(entry->next, entry)) {
  }
  return entry;
}

Temporary::Temporary(const std::string& path) : entry_(free_entry()) {
  entry_->path = path;
  entry_->live = true;
}

Temporary::~Temporary() {
  seal();
  if (state_ == State::open) return;  // remove_temporaries() has removed it
  if (state_ == State::sealed) ::unlink(path());
  entry_->taken = false;
}

const char* Temporary::path() const { return entry_->path.c_str(); }

bool Temporary::seal() {
  if (state_ == State::open && entry_->live.exchange(false)) state_ = State::sealed;
  return state_ != State::open;
}

void Temporary::keep() {
  if (seal()) state_ = State::kept;
}

bool Temporary::removed() const { return state_ == State::open && !entry_->live; }

void remove_temporaries() {
  for (Temporary::Entry* entry = Temporary::Entry::first; entry; entry = entry->next) {
    if (entry->live.exchange(false)) ::unlink(entry->path.c_str());
  }
}

}  // namespace pnpbs::io
