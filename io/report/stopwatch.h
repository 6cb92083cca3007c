#ifndef OBSCURA_IO_REPORT_STOPWATCH_H_
#define OBSCURA_IO_REPORT_STOPWATCH_H_

#include <chrono>

namespace obscura::tools {

// Wall time since it was made.
class Stopwatch {
 public:
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace obscura::tools

#endif  // OBSCURA_IO_REPORT_STOPWATCH_H_
