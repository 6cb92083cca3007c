#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>

#include "obscura/executor.h"

namespace obscura {
namespace {

class TbbExecutor final : public Executor {
 public:
  // More threads than processors would only wait for each other.
  explicit TbbExecutor(int threads) : arena_(std::min(threads, tbb::info::default_concurrency())) {}

  int thread_count() const override { return arena_.max_concurrency(); }

  void parallel_for(int count, FunctionRef<void(int, int)> body) override {
    if (count <= 0) return;
    if (thread_count() == 1) {
      for (int i = 0; i < count; ++i) body(i, 0);
      return;
    }
    arena_.execute([&] {
      tbb::parallel_for(
          0, count,
          [&](int i) { body(i, std::max(0, tbb::this_task_arena::current_thread_index())); },
          tbb::simple_partitioner());
    });
  }

 private:
  tbb::task_arena arena_;
};

}  // namespace

std::unique_ptr<Executor> make_executor(int threads) {
  return std::make_unique<TbbExecutor>(threads > 0 ? threads : tbb::info::default_concurrency());
}

}  // namespace obscura
