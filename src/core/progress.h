#ifndef OBSCURA_SRC_CORE_PROGRESS_H_
#define OBSCURA_SRC_CORE_PROGRESS_H_

#include <atomic>
#include <cstdint>
#include <functional>
#include <mutex>

namespace obscura {

// Counts finished work from many threads and tells the caller's progress callback, which is called
// by one thread at a time and may stop the work.
class Progress {
 public:
  Progress(std::int64_t total, const std::function<bool(double)>& callback)
      : total_(total > 0 ? total : 1), callback_(callback) {}

  // Adds finished work; false once the caller has asked to stop.
  bool advance(std::int64_t amount = 1) {
    const std::int64_t done = done_.fetch_add(amount, std::memory_order_relaxed) + amount;
    if (callback_ && mutex_.try_lock()) {
      // Do not call it again once it has asked to stop, also not from a thread that waited for the
      // lock.
      if (!cancelled() && !callback_(static_cast<double>(done) / static_cast<double>(total_))) {
        cancelled_ = true;
      }
      mutex_.unlock();
    }
    return !cancelled();
  }
  bool cancelled() const { return cancelled_.load(std::memory_order_relaxed); }

 private:
  const std::int64_t total_;
  const std::function<bool(double)>& callback_;
  std::atomic<std::int64_t> done_{0};
  std::atomic<bool> cancelled_{false};
  std::mutex mutex_;
};

}  // namespace obscura

#endif  // OBSCURA_SRC_CORE_PROGRESS_H_
