#include "io/report/progress_bar.h"

#include <sys/time.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>

#include "fmt/format.h"
#include "io/images/atomic_file.h"

namespace obscura::tools {
namespace {

volatile std::sig_atomic_t g_interrupted = 0;

// Calls only what a signal handler may.
void end_now(int) {
  remove_temporaries();
  constexpr char kMessage[] = "obscura: interrupted\n";
  if (write(STDERR_FILENO, kMessage, sizeof(kMessage) - 1) < 0) _exit(2);
  _exit(1);
}

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
  struct sigaction action = {};
  action.sa_handler = [](int) {
    if (g_interrupted) end_now(0);
    g_interrupted = 1;
    // Whatever does not ask interrupted() is ended before a second is over.
    const itimerval soon{{0, 0}, {0, 700000}};
    setitimer(ITIMER_REAL, &soon, nullptr);
  };
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  action.sa_handler = end_now;
  sigaction(SIGALRM, &action, nullptr);
}

bool interrupted() { return g_interrupted != 0; }

}  // namespace obscura::tools
