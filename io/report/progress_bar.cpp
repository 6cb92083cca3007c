#include "io/report/progress_bar.h"

#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>

#include "fmt/format.h"

namespace obscura::tools {
namespace {

volatile std::sig_atomic_t g_interrupted = 0;

}  // namespace

ProgressBar::ProgressBar(std::string label, bool enabled)
    : label_(std::move(label)),
      enabled_(enabled && isatty(STDERR_FILENO)),
      start_(Clock::now()),
      last_(start_) {}

ProgressBar::~ProgressBar() { erase(); }

void ProgressBar::erase() {
  if (drawn_) std::fputs("\r\033[K", stderr);
  drawn_ = false;
}

std::string ProgressBar::line(const std::string& label, double share, double seconds) {
  constexpr int kWidth = 30;
  share = std::clamp(share, 0.0, 1.0);
  const int filled = static_cast<int>(share * kWidth);
  std::string out = fmt::format("{} [{:#>{}}{:>{}}] {:3.0f} %", label, "", filled, "",
                                kWidth - filled, 100 * share);
  if (share > 0.02) out += fmt::format(", {:.0f} s left", seconds * (1 - share) / share);
  return out;
}

bool ProgressBar::operator()(double share) {
  const Clock::time_point now = Clock::now();
  const double seconds = std::chrono::duration<double>(now - start_).count();
  const bool due = now - last_ > std::chrono::milliseconds(200);
  if (enabled_ && seconds > 1 && due) {
    last_ = now;
    drawn_ = true;
    fmt::print(stderr, "\r{}\033[K", line(label_, share, seconds));
    std::fflush(stderr);
  }
  return !interrupted();
}

void catch_interrupts() {
  std::signal(SIGINT, [](int) { g_interrupted = 1; });
  std::signal(SIGTERM, [](int) { g_interrupted = 1; });
}

bool interrupted() { return g_interrupted != 0; }

}  // namespace obscura::tools
