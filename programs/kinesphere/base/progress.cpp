// A bar that shows how far a run has come, on terminals only.
#include "base/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace kinesphere::program {

std::string progress_line(double elapsed, double total, double spent) {
  constexpr int width = 30;
  const double done = total > 0 ? std::clamp(elapsed / total, 0.0, 1.0) : 1.0;
  const int filled = static_cast<int>(done * width);
  std::string line = fmt::format("[{:#<{}}{:.<{}}] {:3.0f} %  {:.4g} of {:.4g} s", "", filled, "",
                                 width - filled, 100 * done, elapsed, total);
  if (done > 0) line += fmt::format(", {:.0f} s left", spent * (1 - done) / done);
  return line;
}

Progress::Progress(double begin, double end)
    : begin_(begin),
      end_(end),
      visible_(::isatty(STDERR_FILENO) != 0),
      started_(Clock::now()),
      next_(started_) {}

Progress::~Progress() {
  if (visible_) std::fputs("\r\x1b[K", stderr);
}

void Progress::show(double time) {
  const Clock::time_point now = Clock::now();
  if (!visible_ || now < next_) return;
  next_ = now + std::chrono::milliseconds(100);
  const double spent = std::chrono::duration<double>(now - started_).count();
  fmt::print(stderr, "\r{}\x1b[K", progress_line(time - begin_, end_ - begin_, spent));
  std::fflush(stderr);
}

}  // namespace kinesphere::program
