#ifndef OBSCURA_SRC_CORE_PASS_TIMER_H_
#define OBSCURA_SRC_CORE_PASS_TIMER_H_

#include <chrono>
#include <string_view>
#include <vector>

#include "obscura/run_options.h"

namespace obscura {

// Adds up the time of the passes of a run, by name. If nobody asked for it, it does nothing and
// reads no clock.
class PassTimer {
 public:
  explicit PassTimer(std::vector<PassTime>* times = nullptr) : times_(times) {
    if (times_) times_->clear();
  }

  // Runs one pass, or one of many rounds of it; `name` lives as long as the program.
  template <class Body>
  void time(const char* name, const Body& body) const {
    if (!times_) return body();
    const auto start = std::chrono::steady_clock::now();
    body();
    const std::chrono::duration<double, std::milli> spent =
        std::chrono::steady_clock::now() - start;
    entry(name).milliseconds += spent.count();
  }

 private:
  PassTime& entry(const char* name) const {
    for (PassTime& t : *times_) {
      if (std::string_view(t.name) == name) return t;
    }
    return times_->emplace_back(PassTime{name, 0});
  }

  std::vector<PassTime>* times_;
};

}  // namespace obscura

#endif  // OBSCURA_SRC_CORE_PASS_TIMER_H_
