#include "io/sequences/pipeline.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <mutex>
#include <stdexcept>
#include <vector>

namespace obscura::tools {
namespace {

// What happened, in order: 'r', 'c' or 'w' and the frame's index.
struct Log {
  std::mutex mutex;
  std::condition_variable changed;
  std::vector<std::pair<char, int>> events;
  std::atomic<int> in_memory{0}, most{0};

  void add(char what, int index) {
    const std::lock_guard lock(mutex);
    events.emplace_back(what, index);
    changed.notify_all();
  }
  std::vector<int> indices(char what) {
    std::vector<int> list;
    for (const auto& e : events) {
      if (e.first == what) list.push_back(e.second);
    }
    return list;
  }
};

class TestFrame : public SequenceFrame {
 public:
  TestFrame(Log* log, int index, char fails) : log_(*log), index_(index), fails_(fails) {
    const int now = ++log_.in_memory;
    log_.most = std::max<int>(log_.most, now);
  }
  ~TestFrame() override { --log_.in_memory; }
  Status read() override { return step('r'); }
  Status compute(const std::function<bool(double)>& progress) override {
    if (!progress(0.5)) return {StatusCode::kCancelled, "cancelled"};
    return step('c');
  }
  Status write() override { return step('w'); }

 private:
  Status step(char what) {
    if (fails_ == 'x' && what == 'c') throw std::runtime_error("thrown");
    if (what == fails_) return {StatusCode::kInternal, "frame " + std::to_string(index_)};
    log_.add(what, index_);
    return {};
  }
  Log& log_;
  const int index_;
  const char fails_;
};

struct Ended {
  std::vector<int> written, skipped, failed;
};

PipelineOptions options_of(Log* log, Ended* ended, int count, int bad, char fails) {
  PipelineOptions o;
  o.count = count;
  o.make = [=](int index, std::unique_ptr<SequenceFrame>* frame) -> Status {
    if (index == bad && fails == 's') return {};
    *frame = std::make_unique<TestFrame>(log, index, index == bad ? fails : ' ');
    return {};
  };
  o.ended = [=](int index, FrameEnd end, const Status&, const SequenceFrame*) {
    (end == FrameEnd::kWritten   ? ended->written
     : end == FrameEnd::kSkipped ? ended->skipped
                                 : ended->failed)
        .push_back(index);
  };
  o.progress = [](double) { return true; };
  return o;
}

std::vector<int> up_to(int n) {
  std::vector<int> list;
  for (int k = 0; k < n; ++k) list.push_back(k);
  return list;
}

TEST(Pipeline, WritesEveryFrameInOrderWithThreeInMemory) {
  Log log;
  Ended ended;
  StepTimes times;
  EXPECT_TRUE(run_pipeline(options_of(&log, &ended, 50, -1, ' '), &times).ok());
  for (char step : {'r', 'c', 'w'}) EXPECT_EQ(log.indices(step), up_to(50));
  EXPECT_EQ(ended.written, up_to(50));
  EXPECT_LE(log.most, 3);
  EXPECT_EQ(log.in_memory, 0);
}

TEST(Pipeline, FramesBeforeAFailureAreWrittenAndNoneAfterIt) {
  for (char step : {'r', 'c', 'w', 'x'}) {
    Log log;
    Ended ended;
    StepTimes times;
    const Status s = run_pipeline(options_of(&log, &ended, 50, 20, step), &times);
    EXPECT_EQ(s.code(), StatusCode::kInternal) << step;
    EXPECT_EQ(s.message(), step == 'x' ? "thrown" : "frame 20");
    EXPECT_EQ(log.indices('w'), up_to(20)) << step;
    EXPECT_EQ(ended.failed, std::vector<int>{20}) << step;
    EXPECT_EQ(log.in_memory, 0);
  }
}

TEST(Pipeline, GoesOnAfterAFailureWhereAsked) {
  for (char step : {'r', 'c', 'w', 'x'}) {
    Log log;
    Ended ended;
    StepTimes times;
    PipelineOptions o = options_of(&log, &ended, 50, 20, step);
    o.continue_on_error = true;
    EXPECT_FALSE(run_pipeline(o, &times).ok());
    EXPECT_EQ(ended.written.size(), 49u) << step;
    EXPECT_EQ(ended.failed, std::vector<int>{20}) << step;
  }
}

TEST(Pipeline, SkipsWhatNeedNotBeMade) {
  Log log;
  Ended ended;
  StepTimes times;
  EXPECT_TRUE(run_pipeline(options_of(&log, &ended, 9, 4, 's'), &times).ok());
  EXPECT_EQ(ended.skipped, std::vector<int>{4});
  EXPECT_EQ(log.indices('w').size(), 8u);
  EXPECT_TRUE(run_pipeline(options_of(&log, &ended, 0, -1, ' '), &times).ok());
}

TEST(Pipeline, CancelledEvenWhereItGoesOnAfterFailures) {
  Log log;
  Ended ended;
  StepTimes times;
  PipelineOptions o = options_of(&log, &ended, 50, -1, ' ');
  o.continue_on_error = true;
  o.progress = [](double share) { return share < 0.5; };  // in frame 24: (24 + 0.5) / 50 = 0.49
  EXPECT_EQ(run_pipeline(o, &times).code(), StatusCode::kCancelled);
  EXPECT_EQ(ended.written.size() + ended.failed.size(), log.indices('w').size() + 1);
  EXPECT_LT(log.indices('w').size(), 29u);
}

// Frame 1 is read only after frame 0 was computed for long: both go on at the same time.
TEST(Pipeline, StepsOfDifferentFramesOverlap) {
  class Waiting : public SequenceFrame {
   public:
    Waiting(Log* log, int index) : log_(*log), index_(index) {}
    Status read() override {
      log_.add('r', index_);
      return {};
    }
    Status compute(const std::function<bool(double)>&) override {
      if (index_ != 0) return {};
      std::unique_lock lock(log_.mutex);
      const bool seen = log_.changed.wait_for(lock, std::chrono::seconds(20), [&] {
        return std::find(log_.events.begin(), log_.events.end(), std::pair('r', 1)) !=
               log_.events.end();
      });
      return seen ? Status() : Status{StatusCode::kInternal, "frame 1 was not read"};
    }
    Status write() override { return {}; }

   private:
    Log& log_;
    const int index_;
  };
  Log log;
  Ended ended;
  StepTimes times;
  PipelineOptions o = options_of(&log, &ended, 2, -1, ' ');
  o.make = [&](int index, std::unique_ptr<SequenceFrame>* frame) -> Status {
    *frame = std::make_unique<Waiting>(&log, index);
    return {};
  };
  const Status s = run_pipeline(o, &times);
  EXPECT_TRUE(s.ok()) << s.message();
}

}  // namespace
}  // namespace obscura::tools
