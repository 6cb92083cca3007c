#ifndef OBSCURA_SUPPORT_PROGRESS_STOPWATCH_H_
#define OBSCURA_SUPPORT_PROGRESS_STOPWATCH_H_

#include <chrono>

namespace obscura::support {

// Wall time since it was made.
class Stopwatch {
 public:
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace obscura::support

#endif  // OBSCURA_SUPPORT_PROGRESS_STOPWATCH_H_
