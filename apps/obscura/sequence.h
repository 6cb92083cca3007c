#ifndef OBSCURA_APPS_OBSCURA_SEQUENCE_H_
#define OBSCURA_APPS_OBSCURA_SEQUENCE_H_

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "CLI/CLI.hpp"
#include "io/report/report.h"
#include "io/sequences/camera_list.h"
#include "io/sequences/pipeline.h"
#include "obscura/status.h"

namespace obscura::app {

// What a command needs to know to make one picture, of a sequence or alone.
struct FrameFiles {
  std::string input, output;
  const tools::ProjectionMatrix* projection = nullptr;  // of --cameras
  std::string made_by;                                  // "" where it is alone
  std::optional<int> number{};                          // the frame's, in a sequence
};

// A frame of a command.
class CommandFrame : public tools::SequenceFrame {
 public:
  // What it has written, and its times and settings for --json.
  virtual std::string line() const = 0;
  virtual tools::Report report() const = 0;
};

using MakeFrame = std::function<std::unique_ptr<CommandFrame>(const FrameFiles&)>;

// --frames and what belongs to it: a command that runs over the frames of a sequence.
class SequenceOptions {
 public:
  // `cameras`: whether the command reads depth images, whose cameras a file can hold.
  void add_to(CLI::App* command, bool cameras);

  // The results go into files that are there, which the input may be.
  void set_into(bool into) { into_ = into; }
  bool given() const { return command_->count("--frames") > 0; }

  // What can be wrong before a frame is read, for commands that prepare at length; run() does it
  // too.
  Status check(const std::string& input, const std::string& output) const;

  // Runs over the frames; without --frames, over the one frame that the files name.
  Status run(const std::string& input, const std::string& output, bool quiet,
             const std::string& json, const MakeFrame& make) const;

 private:
  struct Plan;
  Status plan(const std::string& input, const std::string& output, Plan* plan) const;
  // Without --frames.
  Status run_one(const std::string& input, const std::string& output, bool quiet,
                 const std::string& json, const MakeFrame& make) const;
  // Whether a frame's file is there and was made by `made_by`; says where it was made otherwise.
  bool is_made(const std::string& output, const std::string& made_by) const;
  // The options that decide what a frame shows, as text.
  std::string made_by(const std::string& input) const;

  CLI::App* command_ = nullptr;
  std::string frames_, shard_, cameras_;
  bool skip_existing_ = false, continue_on_error_ = false, into_ = false;
};

}  // namespace obscura::app

#endif  // OBSCURA_APPS_OBSCURA_SEQUENCE_H_
