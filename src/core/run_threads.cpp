#include "core/run_threads.h"

#include "core/text.h"

namespace obscura {

// Here, so that the class has one table of functions, in the library.
Executor::~Executor() = default;

void RunThreads::set(const RunOptions& options) {
  status_ = {};
  executor_ = options.executor;
  if (executor_ && executor_->thread_count() < 1) {
    status_ = invalid_argument(
        text("executor has ", executor_->thread_count(), " threads; it must have at least 1"));
    executor_ = nullptr;
  }
  if (options.executor) return;
  const int threads = options.threads;
  if (threads < 0 || threads > 1024) {
    status_ = invalid_argument(text("threads is ", threads, "; it must be in [0, 1024]"));
    return;
  }
  if (!own_ || own_threads_ != threads) {
    own_ = make_executor(threads);
    own_threads_ = threads;
  }
  executor_ = own_.get();
}

}  // namespace obscura
