#ifndef OBSCURA_TESTS_REFERENCE_PLAIN_THREADS_H_
#define OBSCURA_TESTS_REFERENCE_PLAIN_THREADS_H_

#include <algorithm>
#include <atomic>
#include <thread>
#include <vector>

#include "obscura/executor.h"

namespace obscura::reference {

// As many threads as are asked for, also far more than there are processors; make_executor makes no
// more than those.
class PlainThreads final : public Executor {
 public:
  explicit PlainThreads(int threads) : threads_(threads) {}

  int thread_count() const override { return threads_; }
  void parallel_for(int count, FunctionRef<void(int, int)> body) override {
    std::atomic<int> next{0};
    auto work = [&](int worker) {
      for (int i = next++; i < count; i = next++) body(i, worker);
    };
    std::vector<std::thread> others;
    for (int w = 1; w < std::min(threads_, count); ++w) others.emplace_back(work, w);
    work(0);
    for (std::thread& t : others) t.join();
  }

 private:
  const int threads_;
};

}  // namespace obscura::reference

#endif  // OBSCURA_TESTS_REFERENCE_PLAIN_THREADS_H_
