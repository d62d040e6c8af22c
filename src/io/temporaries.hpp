// SPDX-License-Identifier: BSD-3-Clause
// Files that must not outlive the process unless they are published: a list that a signal
// handler can walk.
#pragma once

#include <string>

namespace pnpbs::io {

// The name of a file that is removed when this object, or the process, ends.
class Temporary {
 public:
  explicit Temporary(const std::string& path);
  ~Temporary();
  Temporary(const Temporary&) = delete;
  Temporary& operator=(const Temporary&) = delete;

  const char* path() const;
  // From here on remove_temporaries leaves it alone. False if that has removed it already.
  bool seal();
  void keep();           // it has its final name now
  bool removed() const;  // by remove_temporaries

 private:
  struct Entry;
  enum class State { open, sealed, kept };
  static Entry* free_entry();

  Entry* entry_;
  State state_ = State::open;
  friend void remove_temporaries();
};

// Removes every file still on the list, but those sealed. Async-signal-safe.
void remove_temporaries();

}  // namespace pnpbs::io
