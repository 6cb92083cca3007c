#ifndef OBSCURA_IO_SEQUENCES_PIPELINE_H_
#define OBSCURA_IO_SEQUENCES_PIPELINE_H_

#include <functional>
#include <memory>

#include "obscura/status.h"

namespace obscura::tools {

// Wall time in which each step was busy, in seconds.
struct StepTimes {
  double read = 0, compute = 0, write = 0;

  double sum() const { return read + compute + write; }
};

// One frame of a sequence. Its three steps run one after the other, on threads of their own.
class SequenceFrame {
 public:
  virtual ~SequenceFrame() = default;
  virtual Status read() = 0;
  virtual Status compute(const std::function<bool(double)>& progress) = 0;
  virtual Status write() = 0;

  StepTimes times{};  // filled by who runs the steps
};

// The three steps of a frame that is alone.
Status run_frame(SequenceFrame* frame, const std::function<bool(double)>& progress);

enum class FrameEnd { kWritten, kSkipped, kFailed };

struct PipelineOptions {
  int count = 0;
  bool continue_on_error = false;
  // Makes frame `index`, with index from 0 in order; leaves null what need not be made. Called on
  // the thread that reads.
  std::function<Status(int index, std::unique_ptr<SequenceFrame>*)> make;
  // Called on the caller's thread, in order of ending. The frame is null unless it was written.
  std::function<void(int index, FrameEnd end, const Status& status, const SequenceFrame* frame)>
      ended;
  // As RunOptions::progress, over all frames.
  std::function<bool(double share)> progress;
};

// Reads, computes and writes frames at the same time: while one is computed on the caller's thread,
// the next is read and the one before is written. At most three frames are in memory.
// Frames are written in order. After a failure the frames before are still written, and no further
// ones are unless continue_on_error; the first failure is returned. progress that returns false
// ends the sequence with kCancelled.
Status run_pipeline(const PipelineOptions& options, StepTimes* times);

}  // namespace obscura::tools

#endif  // OBSCURA_IO_SEQUENCES_PIPELINE_H_
