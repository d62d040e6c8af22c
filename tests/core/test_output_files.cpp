// SPDX-License-Identifier: BSD-3-Clause
// The temporary file of a killed process is removed when the same file is written again; other
// files stay.
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "geometry/run_suite.hpp"
#include "io/output_file.hpp"

using namespace pnpbs;

namespace {

class Folder {
 public:
  Folder() {
    char name[] = "test_output_files_XXXXXX";
    path_ = ::mkdtemp(name);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  ~Folder() { std::filesystem::remove_all(path_); }

  std::string file(const char* name) const { return path_ + "/" + name; }
  int unfinished() const {
    int count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(path_))
      count += entry.path().filename().string().starts_with(".pnpbs-");
    return count;
  }

 private:
  std::string path_;
};

// A process that writes a file until it is killed.
class Writer {
 public:
  explicit Writer(const std::string& path) {
    int ready[2];
    ck_assert_int_eq(::pipe(ready), 0);
    process_ = ::fork();
    if (process_ == 0) {
      io::OutputFile file(path);
      file.open();
      if (::write(ready[1], "!", 1) != 1) std::abort();
      for (;;) ::pause();
    }
    char said = 0;
    ck_assert_int_eq(::read(ready[0], &said, 1), 1);
    ::close(ready[0]);
    ::close(ready[1]);
  }
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;
  ~Writer() { kill(); }

  void kill() {
    if (process_ <= 0) return;
    ::kill(process_, SIGKILL);
    ::waitpid(process_, nullptr, 0);
    process_ = 0;
  }

 private:
  pid_t process_;
};

void write(const std::string& path) {
  io::OutputFile file(path);
  file.write([](io::Sink& sink) { sink.bytes("done\n", 5); }, {});
  io::publish_together({&file}, [](const std::function<void()>& step) { step(); });
}

START_TEST(what_was_abandoned_goes) {
  const Folder folder;
  Writer writer(folder.file("nodes.csv"));
  writer.kill();
  ck_assert_int_eq(folder.unfinished(), 1);
  write(folder.file("nodes.csv"));
  ck_assert_int_eq(folder.unfinished(), 0);
  ck_assert_int_eq(static_cast<int>(std::filesystem::file_size(folder.file("nodes.csv"))), 5);
}
END_TEST

START_TEST(what_others_write_stays) {
  const Folder folder;
  Writer other(folder.file("nodes.csv2"));
  other.kill();
  write(folder.file("nodes.csv"));
  ck_assert_int_eq(folder.unfinished(), 1);  // that of the other file
  const Writer alive(folder.file("nodes.csv"));
  write(folder.file("nodes.csv"));
  ck_assert_int_eq(folder.unfinished(), 2);
}
END_TEST

}  // namespace

TEST_SUITE(test_output_files) {
  return run_suite("output_files", {what_was_abandoned_goes, what_others_write_stays});
}
