#ifndef OBSCURA_SRC_CORE_RUN_THREADS_H_
#define OBSCURA_SRC_CORE_RUN_THREADS_H_

#include <memory>

#include "obscura/run_options.h"
#include "obscura/status.h"

namespace obscura {

// The threads of a run: the caller's, or made here and kept for the next run that wants as many.
class RunThreads {
 public:
  RunThreads() = default;
  explicit RunThreads(const RunOptions& options) { set(options); }

  void set(const RunOptions& options);

  // Not ok: the number of threads is out of range, and there is no executor.
  const Status& status() const { return status_; }
  Executor& executor() const { return *executor_; }

 private:
  Status status_;
  std::unique_ptr<Executor> own_;
  int own_threads_ = 0;
  Executor* executor_ = nullptr;
};

}  // namespace obscura

#endif  // OBSCURA_SRC_CORE_RUN_THREADS_H_
