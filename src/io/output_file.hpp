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

  // Throws Error(PNPBS_ERROR_FILE) if it could not be written: asked before the long run.
  void check() const;

  // Calls writer with the sink to fill. before_write: see to_descriptor.
  void write(const std::function<void(Sink&)>& writer, const std::function<void()>& before_write);

  // The same in steps. What is written aside is in the file of this name; it goes with this object
  // unless it is published.
  int open();
  void close(int descriptor) const;
  bool written_aside() const;
  const char* name_aside() const { return temporary_->path(); }

  // Gives the complete file its name.
  void publish();

  bool is_standard_output() const { return path_ == "-"; }
  const std::string& path() const { return path_; }
  std::string quoted() const;  // for messages

 private:
  int open_aside(std::unique_ptr<Temporary>& temporary) const;

  std::string path_;    // as the user gave it
  std::string target_;  // behind symbolic links
  std::unique_ptr<Temporary> temporary_;
};

}  // namespace pnpbs::io
