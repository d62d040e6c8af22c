// SPDX-License-Identifier: BSD-3-Clause
#include "io/temporaries.hpp"

#include <unistd.h>

#include <atomic>

namespace pnpbs::io {

// Entries are never freed: a signal may come while the list is being walked or changed.
struct Temporary::Entry {
  std::string path;
  std::atomic<bool> live{true};
  Entry* next = nullptr;
  static std::atomic<Entry*> first;
};

std::atomic<Temporary::Entry*> Temporary::Entry::first{nullptr};
static_assert(std::atomic<bool>::is_always_lock_free);

Temporary::Temporary(const std::string& path) : entry_(new Entry) {
  entry_->path = path;
  entry_->next = Entry::first.load();
  Entry::first.store(entry_);
}

Temporary::~Temporary() {
  if (entry_->live.exchange(false)) ::unlink(path());
}

const char* Temporary::path() const { return entry_->path.c_str(); }

void Temporary::keep() { entry_->live = false; }

bool Temporary::removed() const { return !entry_->live; }

void remove_temporaries() {
  for (Temporary::Entry* entry = Temporary::Entry::first; entry; entry = entry->next) {
    if (entry->live.exchange(false)) ::unlink(entry->path.c_str());
  }
}

}  // namespace pnpbs::io
