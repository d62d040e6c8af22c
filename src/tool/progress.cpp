// SPDX-License-Identifier: BSD-3-Clause
#include "tool/progress.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <string_view>
#include <utility>

#include "tool/interrupt.hpp"
#include "tool/numbers.hpp"

namespace pnpbs::tool {
namespace {

using namespace std::chrono_literals;

constexpr auto between_redraws = 100ms;
constexpr int narrowest_bar = 10;
constexpr int widest_bar = 40;

bool can_redraw_lines() {
  const char* terminal = std::getenv("TERM");
  return ::isatty(STDERR_FILENO) && !(terminal && std::string_view(terminal) == "dumb");
}

int terminal_width() {
  winsize size{};
  const bool known = ::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
  return known ? size.ws_col : 80;
}

std::string bar(double fraction, int width) {
  const int done = static_cast<int>(fraction * width);
  std::string text(static_cast<std::size_t>(done), '=');
  if (done < width) text += '>';
  text.resize(static_cast<std::size_t>(width), ' ');
  return "[" + text + "]";
}

std::string percent(double fraction) {
  const std::string number = std::to_string(static_cast<int>(100 * fraction));
  return std::string(3 - std::min<std::size_t>(3, number.size()), ' ') + number + " %";
}

}  // namespace

Progress::Progress(bool wanted, bool forced)
    : wanted_(wanted), shown_(wanted && (forced || can_redraw_lines())) {}

void Progress::watch(pnpbs_placement placement, Turn turn) {
  turn_ = std::move(turn);
  placement_ = placement;
  pnpbs_placement_set_monitor(placement, monitor, this);
}

std::int32_t Progress::monitor(double fraction, std::int64_t step, std::int64_t nodes,
                               double max_speed, void* user) {
  auto* const progress = static_cast<Progress*>(user);
  try {
    progress->note_held_spacing(nodes);
    progress->update(fraction, step, nodes, max_speed);
  } catch (...) {
    // An error of the progress bar must not end the run.
  }
  return progress->turn_(fraction, step, interrupted()) ? 1 : 0;
}

void Progress::update(double fraction, std::int64_t step, std::int64_t nodes, double max_speed) {
  const auto now = Clock::now();
  if (!shown_ || now - last_ < between_redraws) return;
  last_ = now;
  if (nodes == 0) {
    say("laying the first nodes");
    return;
  }
  fraction = std::isfinite(fraction) ? std::clamp(fraction, 0.0, 1.0) : 0;
  const double elapsed = std::chrono::duration<double>(now - begin_).count();
  std::string right = " step " + std::to_string(step) + ", " + grouped(nodes) + " nodes, speed " +
                      short_number(max_speed, 2);
  if (fraction > 0.02) right += ", " + duration(elapsed * (1 - fraction) / fraction) + " left";
  const std::string left = percent(fraction) + " ";
  const int room = terminal_width() - static_cast<int>(left.size() + right.size()) - 3;
  draw(left + (room < narrowest_bar ? "" : bar(fraction, std::min(room, widest_bar))) + right);
}

// Returns ", with about 5 000 nodes, for some 20 s", estimated from the time per node of the last
// round.
std::string Progress::expected_work(std::int64_t nodes) const {
  std::int64_t expected = 0;
  if (pnpbs_placement_get_int64(placement_, "unresolved_nodes", &expected) < 0 || expected <= 0)
    return "";
  std::string text = ", with about " + grouped(expected) + " nodes";
  const double elapsed = std::chrono::duration<double>(Clock::now() - begin_).count();
  if (nodes > 0)
    text += ", for some " +
            duration(elapsed * static_cast<double>(expected) / static_cast<double>(nodes));
  return text;
}

// A run with reduced d takes several times as long, so a note is printed before.
void Progress::note_held_spacing(std::int64_t nodes) {
  std::int64_t places = 0;
  if (!wanted_ || pnpbs_placement_get_int64(placement_, "unresolved_places", &places) < 0) return;
  if (places > unresolved_places_) {
    clear();
    std::cerr << "pnpbs: note: the elements do not follow the shape, or have small angles, at "
              << grouped(places - unresolved_places_)
              << " places; d is reduced around them, and the run continues" << expected_work(nodes)
              << " (option conforming_rounds)\n";
  }
  unresolved_places_ = places;
}

void Progress::say(const std::string& what) {
  if (shown_) draw(what);
}

// Overwrites the current line. Longer text is cut, because a wrapped line cannot be overwritten.
void Progress::draw(const std::string& line) {
  const auto width = static_cast<std::size_t>(std::max(1, terminal_width() - 1));
  std::cerr << "\r" << line.substr(0, width) << "\033[K" << std::flush;
  drawn_ = true;
}

void Progress::clear() {
  if (drawn_) std::cerr << "\r\033[K" << std::flush;
  drawn_ = false;
}

}  // namespace pnpbs::tool
