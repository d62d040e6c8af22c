// SPDX-License-Identifier: BSD-3-Clause
// Temporary files that are removed when the process ends, unless published. Their list can be read
// by a signal handler.
#pragma once

#include <string>

namespace pnpbs::io {

// The name of a file that is removed with this object, or by a signal handler.
class Temporary {
 public:
  explicit Temporary(const std::string& path);
  ~Temporary();
  Temporary(const Temporary&) = delete;
  Temporary& operator=(const Temporary&) = delete;

  const char* path() const;
  // Protects the file from remove_temporaries(). Returns false if that has removed it already.
  bool seal();
  void keep();           // the file has its final name and stays
  bool removed() const;  // true if remove_temporaries() has removed it

 private:
  struct Entry;
  enum class State { open, sealed, kept };
  static Entry* free_entry();

  Entry* entry_;
  State state_ = State::open;
  friend void remove_temporaries();
};

// Removes all files on the list that are not sealed. Async-signal-safe.
void remove_temporaries();

}  // namespace pnpbs::io
