#ifndef OBSCURA_IO_REPORT_PROGRESS_BAR_H_
#define OBSCURA_IO_REPORT_PROGRESS_BAR_H_

#include <chrono>
#include <string>

namespace obscura::tools {

// A line on stderr with the share done and the time left, for work that takes over a second and
// only where stderr is a terminal. Erases itself.
class ProgressBar {
 public:
  ProgressBar(std::string label, bool enabled);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  // Call with the share done, in [0, 1]. Returns false once the user has pressed Ctrl-C.
  bool operator()(double share);

  // Takes the line away, for other text to be printed.
  void erase();

  // "[#####     ]  50 %, 12 s left": what a line shows (for tests).
  static std::string line(const std::string& label, double share, double seconds);

 private:
  using Clock = std::chrono::steady_clock;
  const std::string label_;
  const bool enabled_;
  const Clock::time_point start_;
  Clock::time_point last_;
  bool drawn_ = false;
};

// From here on Ctrl-C and SIGTERM set a flag, so that long work can stop without leaving half a
// file. Work that does not stop by itself is ended 0.7 s later, or by a second signal; temporary
// files are removed.
void catch_interrupts();
bool interrupted();

}  // namespace obscura::tools

#endif  // OBSCURA_IO_REPORT_PROGRESS_BAR_H_
