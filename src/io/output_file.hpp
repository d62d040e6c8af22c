// SPDX-License-Identifier: BSD-3-Clause
// Files that appear under their names only when complete. They are written to temporary files in
// the same folder and then renamed, all or none.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "io/sink.hpp"
#include "io/temporaries.hpp"

namespace pnpbs::io {

// An output file.
class OutputFile {
 public:
  // Path "-" is standard output. An existing path that is not a regular file (/dev/null, a pipe) is
  // written directly, since it cannot be replaced.
  explicit OutputFile(const std::string& path);

  // Throws Error(ErrorKind::file) if the file cannot be written, so that this is known before a
  // long run.
  void check() const;

  // Writes the file by calling writer(sink). `before_write`: see to_descriptor().
  void write(const std::function<void(Sink&)>& writer, const std::function<void()>& before_write);

  // Open, write and close the file in steps. The temporary file is named name_aside(), and is
  // removed with this object unless published.
  int open();
  void close(int descriptor) const;
  bool written_aside() const;
  const char* name_aside() const { return temporary_->path(); }
  // Returns whether remove_temporaries() has removed the file.
  bool removed() const { return temporary_ && temporary_->removed(); }

  // Publish the complete file in steps. All files that belong together must take a step before any
  // of them takes the next one, see publish_together().
  void seal();               // protects it from remove_temporaries(); throws if that has removed it
  void publish();            // renames it; keeps the old file
  void withdraw() noexcept;  // restores the old file; allowed after any step above
  void settle() noexcept;    // removes the old file

  bool is_standard_output() const { return path_ == "-"; }
  const std::string& path() const { return path_; }
  std::string quoted() const;  // name in messages

 private:
  int open_aside(std::unique_ptr<Temporary>& temporary) const;
  void set_old_aside();

  std::string path_;    // as given by the user
  std::string target_;  // after following symbolic links
  std::unique_ptr<Temporary> temporary_;
  // Temporary name of the old file, while it can be restored; empty if none exists.
  std::string old_;
  bool old_is_linked_ = false;  // the old file also keeps its name until it is replaced
  bool published_ = false;
};

// Runs a step on all participants and throws on all of them if it throws on one.
using Together = std::function<void(const std::function<void()>& step)>;

// Publishes the files of all participants, or none of them.
void publish_together(const std::vector<OutputFile*>& files, const Together& together);

}  // namespace pnpbs::io
