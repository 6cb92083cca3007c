// Sequences: the commands that make pictures, over the frames of --frames.
#include "apps/obscura/sequence.h"

#include <sys/resource.h>

#include <algorithm>
#include <filesystem>

#include "apps/obscura/output.h"
#include "fmt/format.h"
#include "io/images/exr.h"
#include "io/images/files.h"
#include "io/report/progress_bar.h"
#include "io/report/report.h"
#include "io/report/stopwatch.h"
#include "io/sequences/frame_names.h"
#include "obscura/version.h"

namespace obscura::app {
namespace {

// Options that change neither what a frame shows nor how it is stored.
constexpr const char* kWithoutEffect[] = {
    "help",    "help-all", "quiet", "output",        "into",
    "replace", "frames",   "shard", "skip-existing", "continue-on-error",
    "cameras", "threads",  "json",  "no-cache"};

Status interrupted_status() { return {StatusCode::kCancelled, "interrupted"}; }

// "7, 8, 30"
std::string list_of(const std::vector<int>& frames) {
  std::string out;
  for (int frame : frames) out += (out.empty() ? "" : ", ") + std::to_string(frame);
  return out;
}

double peak_megabytes() {
  rusage usage = {};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) * 1024 / 1e6;
}

}  // namespace

struct SequenceOptions::Plan {
  std::vector<int> frames;                       // of this shard
  std::vector<tools::ProjectionMatrix> cameras;  // as frames, or empty
};

void SequenceOptions::add_to(CLI::App* command, bool cameras) {
  command_ = command;
  auto add = [&](CLI::Option* option) {
    option->group("Sequences");
    return option;
  };
  CLI::Option* frames =
      add(command
              ->add_option("--frames", frames_,
                           "Frames of a sequence, such as 1-240, 1-240x2 (every second) or "
                           "1,5,10-20. INPUT and --output say where the number stands: ####, %04d "
                           "or $F4")
              ->type_name("LIST"));
  add(command
          ->add_option("--shard", shard_, "Make only the I-th of N parts of the frames, I from 1")
          ->type_name("I/N")
          ->needs(frames));
  add(command
          ->add_flag("--skip-existing", skip_existing_,
                     "Skip frames whose EXR file is there and was made with the same settings")
          ->needs(frames));
  add(command
          ->add_flag("--continue-on-error", continue_on_error_,
                     "Go on after a frame that fails; ends with a list of them and exit code 1")
          ->needs(frames));
  if (!cameras) return;
  add(command
          ->add_option("--cameras", cameras_,
                       "JSON file with the projection matrix of each frame: a list, or an object "
                       "by frame number")
          ->type_name("FILE")
          ->needs(frames));
}

std::string SequenceOptions::made_by(const std::string& input) const {
  // The file's name alone: a shot that moves to another folder stays the same.
  std::string text = fmt::format("obscura {} {} {}", version(), command_->get_name(),
                                 std::filesystem::path(input).filename().string());
  for (const CLI::Option* option : command_->get_options()) {
    const std::string name = option->get_single_name();
    if (option->count() == 0 || option->get_positional() ||
        std::find(std::begin(kWithoutEffect), std::end(kWithoutEffect), name) !=
            std::end(kWithoutEffect)) {
      continue;
    }
    text += " --" + name;
    for (const std::string& value : option->results()) text += " " + value;
  }
  return text;
}

Status SequenceOptions::plan(const std::string& input, const std::string& output,
                             Plan* plan) const {
  std::vector<int> all;
  if (Status s = tools::parse_frames(frames_, &all); !s.ok()) return s;
  tools::Shard shard;
  if (!shard_.empty()) {
    if (Status s = tools::parse_shard(shard_, &shard); !s.ok()) return s;
  }
  if (!tools::has_frame_number(output)) {
    return invalid_argument(
        fmt::format("{} {} has no place for the frame's number; write #### or %04d there",
                    into_ ? "--into" : "--output", output));
  }
  if (!tools::has_frame_number(input) && cameras_.empty()) {
    return invalid_argument(
        fmt::format("{} has no place for the frame's number; write #### or %04d there", input));
  }
  if (skip_existing_ && into_) {
    return invalid_argument(
        "--skip-existing does not go with --into, whose files are always there; give --replace");
  }
  if (skip_existing_ && tools::file_ending(output) != ".exr") {
    return invalid_argument(fmt::format(
        "--skip-existing needs EXR results, which say how they were made; {} is none", output));
  }
  std::vector<tools::ProjectionMatrix> cameras;
  if (!cameras_.empty()) {
    if (Status s = tools::read_cameras(cameras_, all, &cameras); !s.ok()) return s;
  }
  const auto step = static_cast<std::size_t>(shard.count);
  for (auto k = static_cast<std::size_t>(shard.index - 1); k < all.size(); k += step) {
    plan->frames.push_back(all[k]);
    if (!cameras.empty()) plan->cameras.push_back(cameras[k]);
    if (!into_ && tools::name_of_frame(input, all[k]) == tools::name_of_frame(output, all[k])) {
      return invalid_argument(
          fmt::format("--output {} is the input too; the frames must not replace it", output));
    }
  }
  return {};
}

bool SequenceOptions::is_made(const std::string& output, const std::string& made_by) const {
  std::error_code error;
  if (!skip_existing_ || !std::filesystem::exists(output, error)) return false;
  tools::ExrHeader header;
  if (Status s = tools::read_exr_header(output, &header); !s.ok()) {
    fmt::print(stderr, "obscura: note: {}; made again\n", s.message());
    return false;
  }
  if (header.made_by == made_by) return true;
  fmt::print(stderr, "obscura: note: {} was made {}; made again\n", output,
             header.made_by.empty() ? "by no sequence" : "otherwise: " + header.made_by);
  return false;
}

Status SequenceOptions::check(const std::string& input, const std::string& output) const {
  if (given()) {
    Plan plan;
    return this->plan(input, output, &plan);
  }
  std::error_code error;
  if (tools::has_frame_number(input) && tools::has_frame_number(output) &&
      !std::filesystem::exists(input, error)) {
    return invalid_argument(fmt::format(
        "there is no file {}; for a sequence give --frames, such as --frames 1-240", input));
  }
  return {};
}

Status SequenceOptions::run_one(const std::string& input, const std::string& output, bool quiet,
                                const std::string& json, const MakeFrame& make) const {
  if (Status s = check(input, output); !s.ok()) return s;
  const std::unique_ptr<CommandFrame> frame = make({input, output, nullptr, "", {}});
  {
    tools::ProgressBar bar(command_->get_name(), !quiet);
    const Status s = tools::run_frame(frame.get(), [&](double share) { return bar(share); });
    if (!s.ok()) return s;
  }
  if (!quiet && json != "-") fmt::print("{}\n", frame->line());
  return write_json(frame->report(), json);
}

Status SequenceOptions::run(const std::string& input, const std::string& output, bool quiet,
                            const std::string& json, const MakeFrame& make) const {
  if (!given()) return run_one(input, output, quiet, json, make);
  const tools::Stopwatch watch;
  Plan plan;
  if (Status s = this->plan(input, output, &plan); !s.ok()) return s;
  const std::string settings = made_by(input);
  const bool lines = !quiet && json != "-";
  tools::ProgressBar bar(fmt::format("{} frames", plan.frames.size()), !quiet);
  std::vector<int> failed;
  int written = 0, skipped = 0;

  tools::PipelineOptions pipeline;
  pipeline.count = static_cast<int>(plan.frames.size());
  pipeline.continue_on_error = continue_on_error_;
  pipeline.progress = [&](double share) { return bar(share); };
  pipeline.make = [&](int index, std::unique_ptr<tools::SequenceFrame>* frame) -> Status {
    if (tools::interrupted()) return interrupted_status();
    const int number = plan.frames[static_cast<std::size_t>(index)];
    FrameFiles files{tools::name_of_frame(input, number), tools::name_of_frame(output, number),
                     nullptr, settings, number};
    if (!plan.cameras.empty()) {
      files.projection = &plan.cameras[static_cast<std::size_t>(index)];
      for (double v : *files.projection) files.made_by += fmt::format(" {:.9g}", v);
    }
    if (!is_made(files.output, files.made_by)) *frame = make(files);
    return {};
  };
  pipeline.ended = [&](int index, tools::FrameEnd end, const Status& status,
                       const tools::SequenceFrame* frame) {
    bar.erase();
    const int number = plan.frames[static_cast<std::size_t>(index)];
    written += end == tools::FrameEnd::kWritten;
    skipped += end == tools::FrameEnd::kSkipped;
    if (end == tools::FrameEnd::kFailed) failed.push_back(number);
    if (lines && end == tools::FrameEnd::kWritten) {
      fmt::print("{}\n", static_cast<const CommandFrame*>(frame)->line());
      std::fflush(stdout);
    }
    if (end == tools::FrameEnd::kFailed && continue_on_error_) {
      fmt::print(stderr, "obscura: frame {}: {}\n", number, status.message());
    }
  };
  tools::StepTimes times;
  const Status status = tools::run_pipeline(pipeline, &times);
  bar.erase();
  if (status.code() == StatusCode::kCancelled || (!status.ok() && !continue_on_error_)) {
    return status;
  }
  if (lines) {
    fmt::print("{} frames written, {} skipped, {} failed, {:.2f} s\n", written, skipped,
               failed.size(), watch.seconds());
  }
  tools::Report report;
  report.settings["made_by"] = settings;
  report.settings["frames"] = frames_;
  report.add("sequence", "frames written", written);
  report.add("sequence", "frames skipped", skipped);
  report.add("sequence", "frames failed", static_cast<double>(failed.size()));
  report.add("sequence", "time", 1e3 * watch.seconds(), "ms");
  report.add("sequence", "time to load", 1e3 * times.read, "ms");
  report.add("sequence", "time to compute", 1e3 * times.compute, "ms");
  report.add("sequence", "time to write", 1e3 * times.write, "ms");
  report.add("sequence", "peak memory", peak_megabytes(), "MB");
  if (Status s = write_json(report, json); !s.ok()) return s;
  if (failed.empty()) return {};
  return {StatusCode::kInternal, fmt::format("{} of {} frames failed: {}", failed.size(),
                                             plan.frames.size(), list_of(failed))};
}

}  // namespace obscura::app
