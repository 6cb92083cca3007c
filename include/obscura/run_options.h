#ifndef OBSCURA_RUN_OPTIONS_H_
#define OBSCURA_RUN_OPTIONS_H_

#include <functional>
#include <vector>

#include "obscura/executor.h"

namespace obscura {

// Wall time of one pass of a run.
struct PassTime {
  const char* name;
  double milliseconds;
};

// Threads and progress of one call. Every function of the library that computes takes them, and
// works on no other threads than these.
struct RunOptions {
  // From 1, at most 1024; 1: the calling thread alone; 0: every processor.
  int threads = 0;
  // Not null: the caller's own threads, in place of `threads`.
  Executor* executor = nullptr;
  // Called now and then, from one thread at a time, with the share done in [0, 1]; returning false
  // stops the run with StatusCode::kCancelled.
  std::function<bool(double)> progress{};
  // Estimators: replaced by what each pass took, in their order; a method's page names them.
  std::vector<PassTime>* pass_times = nullptr;
};

}  // namespace obscura

#endif  // OBSCURA_RUN_OPTIONS_H_
