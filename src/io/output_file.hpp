// SPDX-License-Identifier: BSD-3-Clause
// Files that appear under their names only when they are complete: written aside in the same
// folder, then renamed, all or none.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "io/sink.hpp"
#include "io/temporaries.hpp"

namespace pnpbs::io {

class OutputFile {
 public:
  // path "-" is standard output. A path that is there and is no regular file (/dev/null, a
  // pipe) is written directly, since it cannot be replaced.
  explicit OutputFile(const std::string& path);

  // Throws Error(ErrorKind::file) if it could not be written: asked before the long run.
  void check() const;

  // Calls writer with the sink to fill. before_write: see to_descriptor.
  void write(const std::function<void(Sink&)>& writer, const std::function<void()>& before_write);

  // The same in steps. What is written aside is in the file of this name; it goes with this object
  // unless it is published.
  int open();
  void close(int descriptor) const;
  bool written_aside() const;
  const char* name_aside() const { return temporary_->path(); }
  bool removed() const { return temporary_ && temporary_->removed(); }  // by remove_temporaries

  // Giving the complete file its name, in steps. All files that belong together take a step before
  // any of them takes the next: see publish_together.
  void seal();               // from here on no signal removes it; throws if one has
  void publish();            // keeps what had its name before
  void withdraw() noexcept;  // puts that back; after any of the steps above
  void settle() noexcept;    // lets go of that

  bool is_standard_output() const { return path_ == "-"; }
  const std::string& path() const { return path_; }
  std::string quoted() const;  // for messages

 private:
  int open_aside(std::unique_ptr<Temporary>& temporary) const;
  void set_old_aside();

  std::string path_;    // as the user gave it
  std::string target_;  // behind symbolic links
  std::unique_ptr<Temporary> temporary_;
  // What had the name before, while it can be put back: by its name aside.
  std::string old_;
  bool old_is_linked_ = false;  // has its name, too, until another file takes it
  bool published_ = false;
};

// Runs one step of a work on all that take part, and throws on all of them if it has thrown on one.
using Together = std::function<void(const std::function<void()>& step)>;

// Gives the files of all that take part their names, or none of them.
void publish_together(const std::vector<OutputFile*>& files, const Together& together);

}  // namespace pnpbs::io
