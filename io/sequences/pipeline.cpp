#include "io/sequences/pipeline.h"

#include <condition_variable>
#include <deque>
#include <exception>
#include <mutex>
#include <new>
#include <thread>

#include "io/report/stopwatch.h"

namespace obscura::tools {
namespace {

constexpr int kInMemory = 3;  // one read, one computed, one written

struct Item {
  int index = 0;
  FrameEnd end = FrameEnd::kWritten;
  Status status{};
  std::unique_ptr<SequenceFrame> frame{};

  void fail(Status s) {
    status = std::move(s);
    end = FrameEnd::kFailed;
    frame.reset();
  }
};

// A step's status, whatever it throws; `seconds` becomes its time.
template <class F>
Status timed(double* seconds, F&& step) {
  const Stopwatch watch;
  Status status;
  try {
    status = step();
  } catch (const std::bad_alloc&) {
    status = {StatusCode::kOutOfMemory, "not enough memory for a frame"};
  } catch (const std::exception& e) {
    status = {StatusCode::kInternal, e.what()};
  }
  *seconds = watch.seconds();
  return status;
}

class Pipeline {
 public:
  Pipeline(const PipelineOptions& options, StepTimes* times) : o_(options), times_(times) {}

  Status run() {
    std::jthread reader([this] { read_all(); });
    std::jthread writer([this] { write_all(); });
    std::unique_lock lock(mutex_);
    while (true) {
      changed_.wait(lock, [&] {
        return !ended_.empty() || !read_.empty() || (reader_ended_ && in_memory_ == 0);
      });
      if (!ended_.empty()) {
        Item item = std::move(ended_.front());
        ended_.pop_front();
        lock.unlock();
        if (!item.status.ok() && first_failure_.ok()) first_failure_ = item.status;
        ++done_;
        o_.ended(item.index, item.end, item.status, item.frame.get());
        item.frame.reset();
        lock.lock();
        --in_memory_;
        changed_.notify_all();
      } else if (!read_.empty()) {
        Item item = std::move(read_.front());
        read_.pop_front();
        if (stopped_) {
          --in_memory_;
          changed_.notify_all();
          continue;
        }
        lock.unlock();
        compute(&item);
        lock.lock();
        if (!item.status.ok() && stops(item.status)) stopped_ = true;
        computed_.push_back(std::move(item));
        changed_.notify_all();
      } else {
        break;
      }
    }
    all_computed_ = true;
    changed_.notify_all();
    lock.unlock();
    reader.join();
    writer.join();
    return first_failure_;
  }

 private:
  bool stops(const Status& s) const {
    return !o_.continue_on_error || s.code() == StatusCode::kCancelled;
  }

  void compute(Item* item) {
    if (!item->frame) return;  // skipped or failed; it passes through to keep the order
    const Status s = timed(&item->frame->times.compute, [&] {
      return item->frame->compute(
          [&](double share) { return o_.progress((done_ + share) / o_.count); });
    });
    times_->compute += item->frame->times.compute;
    if (!s.ok()) item->fail(s);
  }

  void read_all() {
    for (int index = 0; index < o_.count; ++index) {
      {
        std::unique_lock lock(mutex_);
        changed_.wait(lock, [&] { return stopped_ || in_memory_ < kInMemory; });
        if (stopped_) break;
        ++in_memory_;
      }
      Item item{.index = index};
      double seconds = 0;
      const Status s = timed(&seconds, [&] {
        const Status made = o_.make(index, &item.frame);
        return made.ok() && item.frame ? item.frame->read() : made;
      });
      times_->read += seconds;
      if (item.frame) item.frame->times.read = seconds;
      if (!s.ok()) {
        item.fail(s);
      } else if (!item.frame) {
        item.end = FrameEnd::kSkipped;
      }
      const std::lock_guard lock(mutex_);
      read_.push_back(std::move(item));
      changed_.notify_all();
    }
    const std::lock_guard lock(mutex_);
    reader_ended_ = true;
    changed_.notify_all();
  }

  void write_all() {
    std::unique_lock lock(mutex_);
    bool failed = false;
    while (true) {
      changed_.wait(lock, [&] { return !computed_.empty() || all_computed_; });
      if (computed_.empty()) return;
      Item item = std::move(computed_.front());
      computed_.pop_front();
      if (failed) {
        --in_memory_;
        changed_.notify_all();
        continue;
      }
      lock.unlock();
      if (item.frame) {
        const Status s = timed(&item.frame->times.write, [&] { return item.frame->write(); });
        times_->write += item.frame->times.write;
        if (!s.ok()) item.fail(s);
      }
      lock.lock();
      if (!item.status.ok() && stops(item.status)) failed = stopped_ = true;
      ended_.push_back(std::move(item));
      changed_.notify_all();
    }
  }

  const PipelineOptions& o_;
  StepTimes* const times_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Item> read_, computed_, ended_;
  int in_memory_ = 0;
  bool reader_ended_ = false, all_computed_ = false, stopped_ = false;
  // Of the caller's thread.
  int done_ = 0;
  Status first_failure_;
};

}  // namespace

Status run_frame(SequenceFrame* frame, const std::function<bool(double)>& progress) {
  Status s = timed(&frame->times.read, [&] { return frame->read(); });
  if (s.ok()) s = timed(&frame->times.compute, [&] { return frame->compute(progress); });
  if (s.ok()) s = timed(&frame->times.write, [&] { return frame->write(); });
  return s;
}

Status run_pipeline(const PipelineOptions& options, StepTimes* times) {
  return Pipeline(options, times).run();
}

}  // namespace obscura::tools
