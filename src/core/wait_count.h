#ifndef OBSCURA_SRC_CORE_WAIT_COUNT_H_
#define OBSCURA_SRC_CORE_WAIT_COUNT_H_

#include <atomic>
#include <thread>

namespace obscura {

// What one thread has finished, for others that follow it closely. On a cache line of its own.
class alignas(64) WaitCount {
 public:
  // Makes everything written before visible to the thread that waits for it.
  void set(int finished) { finished_.store(finished, std::memory_order_release); }
  int get() const { return finished_.load(std::memory_order_acquire); }
  // Returns once `wanted` are finished. Waits a few loads long, then lets other threads run: there
  // may be more of them than processors.
  void wait_for(int wanted) const {
    for (int loads = 0; get() < wanted; ++loads) {
      if (loads > 64) std::this_thread::yield();
    }
  }

 private:
  std::atomic<int> finished_{0};
};

}  // namespace obscura

#endif  // OBSCURA_SRC_CORE_WAIT_COUNT_H_
