// SPDX-License-Identifier: BSD-3-Clause
#include "tool/domain.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "tool/exit.hpp"

namespace pnpbs::tool {
namespace {

constexpr std::size_t max_bytes = std::size_t{1} << 30;  // an endless stream is an error

std::string standard_input() {
  std::string text;
  char part[1 << 16];
  for (;;) {
    const ssize_t size = ::read(STDIN_FILENO, part, sizeof part);
    if (size == 0) return text;
    if (size < 0 && errno == EINTR) continue;
    if (size < 0)
      throw BadInput(std::string("cannot read standard input: ") + std::strerror(errno));
    text.append(part, static_cast<std::size_t>(size));
    if (text.size() > max_bytes) throw BadInput("standard input is longer than 1 GiB");
  }
}

}  // namespace

void read_domain(const std::string& path, pnpbs_domain domain, pnpbs_context context,
                 const Ranks& ranks) {
  const bool from_input = path == "-";
  const std::string text = from_input ? ranks.from_first(standard_input) : "";
  ranks.agreed([&] {
    if (from_input) {
      check(pnpbs_domain_parse_poly(domain, text.data(), static_cast<std::int64_t>(text.size()),
                                    "standard input"),
            context);
    } else {
      check(pnpbs_domain_read_poly(domain, path.c_str()), context);
    }
    check(pnpbs_domain_check(domain), context);
  });
}

}  // namespace pnpbs::tool
