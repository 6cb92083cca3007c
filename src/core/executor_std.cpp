// Plain threads, for ThreadSanitizer: it reports false races inside Debian's TBB.
#include <algorithm>
#include <atomic>
#include <exception>
#include <thread>
#include <vector>

#include "obscura/executor.h"

namespace obscura {
namespace {

class StdExecutor final : public Executor {
 public:
  explicit StdExecutor(int threads) : threads_(threads) {}

  int thread_count() const override { return threads_; }

  void parallel_for(int count, FunctionRef<void(int, int)> body) override {
    std::atomic<int> next{0};
    auto work = [&](int worker) {
      for (int i = next++; i < count; i = next++) body(i, worker);
    };
    std::vector<std::thread> others;
    try {
      others.reserve(static_cast<std::size_t>(threads_));
      for (int w = 1; w < std::min(threads_, count); ++w) others.emplace_back(work, w);
    } catch (const std::exception&) {
      // The system gives no more threads: those that there are do the work.
    }
    work(0);
    for (std::thread& t : others) t.join();
  }

 private:
  const int threads_;
};

}  // namespace

std::unique_ptr<Executor> make_executor(int threads) {
  const int available = static_cast<int>(std::thread::hardware_concurrency());
  return std::make_unique<StdExecutor>(threads > 0 ? threads : std::max(1, available));
}

}  // namespace obscura
