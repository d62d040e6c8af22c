// SPDX-License-Identifier: BSD-3-Clause
#include "io/output_file.hpp"

#include <dirent.h>
#include <fcntl.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <climits>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <string_view>
#include <system_error>

#include "base/error.hpp"
#include "base/mixed_hash.hpp"

namespace pnpbs::io {
namespace {

// Output files, and the cleanup of unfinished files that a killed process has left. They are
// removed when the file is written again.

std::uint64_t hash_of(std::string_view text, std::uint64_t hash = 0) {
  for (const char letter : text) hash = mixed(hash ^ static_cast<unsigned char>(letter));
  return mixed(hash ^ text.size());
}

// Returns a hash of the machine, its boot and the container, in which process ids are unique.
std::uint64_t process_space() {
  char host[256] = "";
  ::gethostname(host, sizeof host - 1);
  std::string start;
  std::getline(std::ifstream("/proc/sys/kernel/random/boot_id"), start);
  std::error_code none;
  const std::string container = std::filesystem::read_symlink("/proc/self/ns/pid", none).string();
  return hash_of(container, hash_of(start, hash_of(host)));
}

// Returns the prefix of temporary names for this target. The process id and a random number follow.
std::string prefix_of(const std::filesystem::path& target) {
  static const std::uint64_t space = process_space();
  return ".pnpbs-" + std::to_string(hash_of(target.filename().string(), space)) + "-";
}

// Returns whether the process in the name has ended, i.e. no process has this id.
bool has_ended(std::string_view rest_of_name) {
  pid_t process = 0;
  const char* const end = rest_of_name.data() + rest_of_name.size();
  const auto read = std::from_chars(rest_of_name.data(), end, process);
  if (read.ec != std::errc() || read.ptr == end || *read.ptr != '-' || process <= 0) return false;
  return ::kill(process, 0) != 0 && errno == ESRCH;
}

// Returns an unused name in the folder of `target`. It identifies the target, the machine and this
// process.
std::string unfinished_name_beside(const std::string& target) {
  static std::random_device random;
  const std::filesystem::path path(target);
  return (path.parent_path() /
          (prefix_of(path) + std::to_string(::getpid()) + "-" + std::to_string(random())))
      .string();
}

// Removes the temporary files for this target whose processes have ended on this machine since its
// boot. Other files stay, because their processes may still be running elsewhere.
// Uses system calls, since the iterators of std::filesystem abort if memory is exhausted.
void remove_abandoned_beside(const std::string& target) noexcept {
  DIR* folder = nullptr;
  try {
    const std::filesystem::path path(target);
    const std::string prefix = prefix_of(path);
    const std::string parent = path.parent_path().string();
    folder = ::opendir(parent.empty() ? "." : parent.c_str());
    if (!folder) return;
    while (const dirent* entry = ::readdir(folder)) {
      const std::string_view name = entry->d_name;
      if (name.starts_with(prefix) && has_ended(name.substr(prefix.size())))
        ::unlinkat(::dirfd(folder), entry->d_name, 0);
    }
  } catch (...) {
    // The files may stay; writing the new file is more important.
  }
  if (folder) ::closedir(folder);
}

[[noreturn]] void fail(const std::string& what, int error) {
  throw Error(ErrorKind::file, "cannot write " + what + ": " + std::strerror(error));
}

// Returns the file to which symbolic links lead, existing or not. Renaming onto a link would
// replace the link.
std::string behind_links(const std::string& path) {
  constexpr int kMaxLinks = 40;
  std::error_code error;
  const std::filesystem::path there = std::filesystem::canonical(path, error);
  if (!error) return there.string();
  std::filesystem::path target = path;
  for (int link = 0; link < kMaxLinks && std::filesystem::is_symlink(target, error); ++link)
    target = target.parent_path() / std::filesystem::read_symlink(target, error);
  return std::filesystem::is_symlink(target, error) ? path : target.string();
}

// Returns a name for the old file, which may be the only copy. The cleanup does not remove files of
// such names.
std::string name_for_old_beside(const std::string& target) {
  static std::random_device random;
  const std::filesystem::path folder = std::filesystem::path(target).parent_path();
  const std::string name =
      ".pnpbs-old-" + std::to_string(::getpid()) + "-" + std::to_string(random());
  return (folder / name).string();
}

// Copies the permissions of a file that will be replaced.
void copy_permissions(const std::string& from, int to) {
  struct stat status;
  if (::stat(from.c_str(), &status) == 0) ::fchmod(to, status.st_mode & 07777);
}

}  // namespace

OutputFile::OutputFile(const std::string& path) : path_(path), target_(behind_links(path)) {}

std::string OutputFile::quoted() const {
  return is_standard_output() ? "standard output" : "'" + path_ + "'";
}

bool OutputFile::written_aside() const {
  std::error_code error;
  const auto type = std::filesystem::status(target_, error).type();
  return !is_standard_output() && (type == std::filesystem::file_type::regular ||
                                   type == std::filesystem::file_type::not_found);
}

void OutputFile::check() const {
  if (is_standard_output()) return;
  std::error_code error;
  if (std::filesystem::is_directory(target_, error)) fail(quoted(), EISDIR);
  if (std::filesystem::exists(target_, error) && ::access(target_.c_str(), W_OK) != 0) {
    fail(quoted(), errno);
  }
  if (!written_aside()) return;
  const std::filesystem::path target(target_);
  if (target.filename().empty() || target.filename().string().size() > NAME_MAX) {
    fail(quoted(), target.filename().empty() ? EISDIR : ENAMETOOLONG);
  }
  std::unique_ptr<Temporary> trial;
  ::close(open_aside(trial));
}

int OutputFile::open_aside(std::unique_ptr<Temporary>& temporary) const {
  // The name is registered before the file is created, so that a signal always finds it.
  temporary = std::make_unique<Temporary>(unfinished_name_beside(target_));
  const int descriptor = ::open(temporary->path(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (descriptor < 0) {
    temporary->keep();  // the file belongs to another process
    fail(quoted(), errno);
  }
  if (temporary->removed()) {  // a signal came before it was created
    ::close(descriptor);
    ::unlink(temporary->path());
    fail(quoted(), EINTR);
  }
  copy_permissions(target_, descriptor);
  return descriptor;
}

int OutputFile::open() {
  if (written_aside()) {
    remove_abandoned_beside(target_);
    return open_aside(temporary_);
  }
  const int descriptor =
      is_standard_output() ? ::dup(STDOUT_FILENO) : ::open(target_.c_str(), O_WRONLY | O_CLOEXEC);
  if (descriptor < 0) fail(quoted(), errno);
  return descriptor;
}

void OutputFile::close(int descriptor) const {
  if (::close(descriptor) != 0) fail(quoted(), errno);
}

void OutputFile::write(const std::function<void(Sink&)>& writer,
                       const std::function<void()>& before_write) {
  const int descriptor = open();
  try {
    Sink sink(to_descriptor(descriptor, quoted(), before_write));
    writer(sink);
    sink.flush();
  } catch (...) {
    ::close(descriptor);
    temporary_.reset();
    throw;
  }
  close(descriptor);
}

// ------------------------------------------------------------------ publishing -----------------

void OutputFile::seal() {
  if (temporary_ && !temporary_->seal()) fail(quoted(), EINTR);
}

// Renames the old file by a second link, so that its name always refers to a file. On file systems
// without links it is renamed.
void OutputFile::set_old_aside() {
  const std::string aside = name_for_old_beside(target_);
  old_is_linked_ = ::link(target_.c_str(), aside.c_str()) == 0;
  if (!old_is_linked_ && std::rename(target_.c_str(), aside.c_str()) != 0) {
    if (errno != ENOENT) fail(quoted(), errno);
    return;  // there was no old file
  }
  old_ = aside;
}

void OutputFile::publish() {
  if (!temporary_) return;
  set_old_aside();
  if (std::rename(temporary_->path(), target_.c_str()) != 0) fail(quoted(), errno);
  published_ = true;
  temporary_->keep();
}

void OutputFile::withdraw() noexcept {
  if (!old_.empty() && old_is_linked_ && !published_)
    ::unlink(old_.c_str());
  else if (!old_.empty())
    std::rename(old_.c_str(), target_.c_str());
  else if (published_)
    ::unlink(target_.c_str());
  old_.clear();
  published_ = false;
  temporary_.reset();
}

void OutputFile::settle() noexcept {
  if (!old_.empty()) ::unlink(old_.c_str());
  old_.clear();
  published_ = false;
  temporary_.reset();
}

void publish_together(const std::vector<OutputFile*>& files, const Together& together) {
  try {
    together([&] {
      for (OutputFile* file : files) file->seal();
    });
    together([&] {
      for (OutputFile* file : files) file->publish();
    });
  } catch (...) {
    for (OutputFile* file : files) file->withdraw();
    throw;
  }
  for (OutputFile* file : files) file->settle();
}

}  // namespace pnpbs::io
