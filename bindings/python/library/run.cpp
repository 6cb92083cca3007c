#include "library/run.h"

#include <unistd.h>

#include <atomic>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <thread>

#include "library/arrays.h"

namespace obscura::python {
namespace {

// The process that imported the module. A child of fork() has none of its parent's threads, and
// the pool would wait for them for ever.
const pid_t g_importer = getpid();

}  // namespace

void run(int threads, const py::object& progress,
         const std::function<Status(const RunOptions&)>& work) {
  std::atomic<bool> stop{false};
  std::atomic<double> share{0};
  std::mutex mutex;
  std::condition_variable changed;
  bool done = false;
  Status status;
  RunOptions options;
  options.threads = getpid() == g_importer ? threads : 1;
  options.progress = [&](double s) {
    share = s;
    return !stop;
  };
  std::optional<py::error_already_set> error;
  {
    const py::gil_scoped_release released;
    std::thread worker([&] {
      Status result = work(options);
      const std::lock_guard lock(mutex);
      status = std::move(result);
      done = true;
      changed.notify_one();
    });
    std::unique_lock lock(mutex);
    while (!changed.wait_for(lock, std::chrono::milliseconds(50), [&] { return done; })) {
      lock.unlock();
      {
        const py::gil_scoped_acquire held;
        try {
          if (PyErr_CheckSignals() != 0) throw py::error_already_set();
          if (!error && !progress.is_none()) progress(share.load());
        } catch (py::error_already_set& e) {
          if (!error) error.emplace(std::move(e));
          stop = true;
        }
      }
      lock.lock();
    }
    lock.unlock();
    worker.join();
  }
  if (error) throw py::error_already_set(*error);
  raise(status);
  if (!progress.is_none()) progress(1.0);
}

}  // namespace obscura::python
