// SPDX-License-Identifier: BSD-3-Clause
// A file that appears under its name only when it is complete: written aside in the same
// folder, then renamed.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "io/sink.hpp"
#include "io/temporaries.hpp"

namespace pnpbs::io {

class OutputFile {
 public:
  // path "-" is standard output. A path that is there and is no regular file (/dev/null, a
  // pipe) is written directly, since it cannot be replaced.
  explicit OutputFile(const std::string& path);

  // Throws if it could not be written: asked before the long run.
  void check() const;

  // Calls writer with the sink to fill. before_write: see Sink.
  void write(const std::function<void(Sink&)>& writer, const std::function<void()>& before_write);

  // Gives the complete file its name.
  void publish();

  bool is_standard_output() const { return path_ == "-"; }
  const std::string& path() const { return path_; }

 private:
  bool written_aside() const;
  int open_aside(std::unique_ptr<Temporary>& temporary) const;
  int open_target();
  std::string quoted() const;

  std::string path_;    // as the user gave it
  std::string target_;  // behind symbolic links
  std::unique_ptr<Temporary> temporary_;
};

}  // namespace pnpbs::io
