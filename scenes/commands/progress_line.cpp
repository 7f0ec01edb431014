#include "scenes/commands/progress_line.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <utility>

#include "scenes/commands/standard_error.h"

namespace tact::scenes {
namespace {

std::string time_left_text(double seconds) {
  const auto whole = static_cast<long long>(std::ceil(seconds));
  return whole < 120 ? fmt::format("{} s", whole) : fmt::format("{} min", (whole + 30) / 60);
}

}  // namespace

std::string progress_text(std::string_view unit, int done, int all, double seconds, std::string_view note) {
  std::string text = fmt::format("{} {} of {}, {} %", unit, done, all, 100LL * done / all);
  if (done > 0) text += fmt::format(", {} left", time_left_text(seconds / done * (all - done)));
  if (!note.empty()) text += fmt::format(", {}", note);
  return text;
}

ProgressLine::ProgressLine(std::string unit, int all, Beside beside)
    : unit_(std::move(unit)),
      all_(all),
      wanted_(isatty(STDERR_FILENO) != 0 && (beside == Beside::nothing || isatty(STDOUT_FILENO) == 0)),
      start_(Clock::now()),
      next_(start_ + std::chrono::seconds(1)) {}

void ProgressLine::show(int done, std::string_view note) {
  const Clock::time_point now = Clock::now();
  if (!wanted_ || now < next_) return;
  next_ = now + std::chrono::milliseconds(100);
  const double seconds = std::chrono::duration<double>(now - start_).count();
  write_error(fmt::format("\r{}\x1b[K", progress_text(unit_, done, all_, seconds, note)));
  shown_ = true;
}

void ProgressLine::clear() {
  if (shown_) write_error("\r\x1b[K");
  shown_ = false;
}

}  // namespace tact::scenes
