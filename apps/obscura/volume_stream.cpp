// obscura volume --memory: fields slab by slab, from file to file.
#include "apps/obscura/volume_stream.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>

#include "apps/obscura/scratch_file.h"
#include "apps/obscura/terrain_options.h"
#include "apps/obscura/work_folder.h"
#include "fmt/format.h"
#include "io/images/atomic_file.h"
#include "io/images/files.h"
#include "io/report/progress_bar.h"
#include "io/report/stopwatch.h"

namespace obscura::app {
namespace {

namespace fs = std::filesystem;
constexpr int kMostRounds = 100;  // as in memory: 800 sweeps

// Options that a stream of slabs does not have.
Status check_streamed(const VolumeCommand& c, const VolumeRequest& p) {
  if (c.fields.empty() || !c.output.empty()) {
    return unsupported("--memory computes --fields; pictures need the volume in memory");
  }
  if (tools::file_ending(c.fields) != ".nrrd") {
    return unsupported(fmt::format("--memory writes .nrrd; --fields is '{}'", c.fields));
  }
  if (c.sequence.given() || !c.json.empty()) {
    return unsupported("--memory is for one volume, without --frames and --json");
  }
  const auto light = p.light.kind;
  if (light != tools::VolumeLight::kAmbient && light != tools::VolumeLight::kTranslucent) {
    return unsupported(
        fmt::format("--memory has the lights ao and translucent:ALPHA, not {}", p.light_name));
  }
  if (p.settings.picture.method != VolumeMethod::kSweep ||
      p.settings.occlusion.precision != VisibilityPrecision::kU8) {
    return unsupported("--memory has --method sweep and --precision u8 only");
  }
  if (!c.table.given("iso")) {
    return invalid_argument(
        "--memory needs --iso; the histogram is made in memory. obscura info prints Otsu's "
        "threshold");
  }
  return {};
}

// Passes that are done, as the work folder remembers them.
struct Passes {
  int distance = 0, changed = 0, measured = 0, fallen = 0;

  std::string text() const {
    return fmt::format("{} {} {} {}\n", distance, changed, measured, fallen);
  }
  bool parse(const std::string& text) {
    return std::sscanf(text.c_str(), "%d %d %d %d", &distance, &changed, &measured, &fallen) == 4;
  }
};

class VolumeStream {
 public:
  VolumeStream(const VolumeCommand& c, const VolumeRequest& p, Executor* executor, bool quiet)
      : c_(c), settings_(p.settings), folder_(c.fields + ".work"), bar_("volume", !quiet) {
    run_.executor = executor;
    settings_.occlusion.alpha =
        p.light.kind == tools::VolumeLight::kTranslucent ? p.light.alpha : 1.0f;
    run_.progress = [this](double share) { return bar_(std::min(1.0, (at_ + share) / steps_)); };
  }

  Status open(double memory) {
    if (Status s = c_.volume.open(c_.input, &file_); !s.ok()) return s;
    const FieldsKind kind = settings_.picture.fields_of;
    const int cell = field_cell(settings_.occlusion.transport);
    const StreamBytes bytes = stream_bytes(file_.volume(), kind, settings_.occlusion.transport,
                                           run_.executor->thread_count());
    const double planes = std::floor((memory - bytes.fixed) / bytes.plane / cell) * cell;
    if (planes < cell) {
      return too_little_memory(memory, "slab of planes", bytes.fixed + cell * bytes.plane);
    }
    const int depth = file_.volume().size[2];
    const int count = static_cast<int>(std::ceil(depth / std::min<double>(planes, depth)));
    slabs_ = tools::split_planes(depth, cell, count);
    // Slabs of equal size may be a cell larger than asked.
    while (slabs_.size() > 1 && slabs_[0].planes() > planes) {
      slabs_ = tools::split_planes(depth, cell, static_cast<int>(slabs_.size()) + 1);
    }
    std::string about = "volume " + c_.volume.text();
    visit_fields(settings_, [&](const auto& value, const Field& field) {
      about += fmt::format(" {}={}", field.name, write_setting(value));
    });
    about += fmt::format(" alpha={} slabs={}", settings_.occlusion.alpha, slabs_.size());
    if (Status s = open_work_folder(folder_, c_.input, about); !s.ok()) return s;
    std::string text;
    if (fs::exists(path("passes.txt"))) {
      if (Status s = tools::read_bytes(path("passes.txt"), &text); !s.ok()) return s;
      if (!passes_.parse(text)) {
        return invalid_input(fmt::format("{} is damaged; remove {}", path("passes.txt"), folder_));
      }
    }
    const int rounds = (settings_.distance.sweeps + 7) / 8;
    steps_ = static_cast<double>(slabs_.size()) * (2 * rounds + 2);
    at_ = static_cast<double>(slabs_.size()) * (passes_.distance + passes_.fallen);
    return {};
  }

  Status measure() {
    const int rounds = (settings_.distance.sweeps + 7) / 8;
    while (!passes_.measured) {
      const bool rising = passes_.distance % 2 == 0;
      int changed = rising ? 0 : passes_.changed;
      if (Status s = distance_pass(rising, &changed); !s.ok()) return s;
      ++passes_.distance;
      passes_.changed = changed;
      const int round = passes_.distance / 2;
      const bool most = round >= (settings_.distance.converge ? kMostRounds : rounds);
      const bool settled = settings_.distance.converge && round >= rounds && !changed;
      passes_.measured = int{!rising && (most || settled)};
      if (Status s = remember(); !s.ok()) return s;
    }
    return {};
  }

  // The half of the light from above; its visibilities are kept for the last pass.
  Status fall() {
    if (passes_.fallen) return {};
    ScratchFile distances, out;
    if (Status s = distances.open(path(newest())); !s.ok()) return s;
    if (Status s = out.create(path("fallen.u8")); !s.ok()) return s;
    OcclusionBlock& block = block_;
    std::vector<std::int16_t> face;
    for (std::size_t i = slabs_.size(); i-- > 0;) {
      if (Status s = start(distances, slabs_[i]); !s.ok()) return s;
      std::span<const std::int16_t> up;
      if (i + 1 < slabs_.size()) up = face;
      face.resize(block.face_size());
      if (Status s = block.sweep(false, up, face, run_); !s.ok()) return s;
      const auto half = block.half(false);
      const std::int64_t bytes = static_cast<std::int64_t>(half.size());
      if (Status s = out.write(first_of(slabs_[i], block), half.data(), bytes); !s.ok()) return s;
      ++at_;
    }
    passes_.fallen = 1;
    return remember();
  }

  // The other half, and the file.
  Status rise() {
    ScratchFile distances, fallen, out;
    const bool light = settings_.picture.fields_of != FieldsKind::kDistance;
    if (Status s = distances.open(path(newest())); !s.ok()) return s;
    if (Status s = light ? fallen.open(path("fallen.u8")) : Status(); !s.ok()) return s;
    if (Status s = out.create(path("field.nrrd")); !s.ok()) return s;
    std::vector<std::int16_t> face;
    std::vector<float> values;
    std::int64_t end = 0;
    for (std::size_t i = 0; i < slabs_.size(); ++i) {
      if (light) {
        if (Status s = start(distances, slabs_[i]); !s.ok()) return s;
        if (Status s = sweep_up(i, fallen, &face); !s.ok()) return s;
        if (Status s =
                tools::field_values(settings_.picture.fields_of, block_.field(), run_, &values);
            !s.ok()) {
          return s;
        }
      } else {
        if (Status s = read_distances(distances, slabs_[i], &values); !s.ok()) return s;
      }
      if (i == 0) {
        if (Status s = write_header(&out, &end); !s.ok()) return s;
      }
      const auto bytes = static_cast<std::int64_t>(values.size() * sizeof(float));
      if (Status s = out.write(end, values.data(), bytes); !s.ok()) return s;
      end += bytes;
      ++at_;
    }
    out.close();
    std::error_code error;
    fs::rename(path("field.nrrd"), c_.fields, error);
    if (error) {
      return {StatusCode::kInternal,
              fmt::format("cannot write {}: {}", c_.fields, error.message())};
    }
    // A run that is ended while it removes its files leaves a folder from which the next one begins
    // anew.
    fs::remove(path("passes.txt"), error);
    fs::remove_all(folder_, error);
    return {};
  }

  std::size_t slabs() const { return slabs_.size(); }
  const tools::VolumeImage& volume() const { return file_.volume(); }
  bool begun() const { return passes_.distance > 0; }
  void forget() {
    std::error_code error;
    if (!begun()) fs::remove_all(folder_, error);
  }
  void erase_bar() { bar_.erase(); }

 private:
  std::string path(const char* name) const { return folder_ + "/" + name; }
  // The distances of the last finished pass. A pass writes another file than it reads, since a slab
  // that was swept twice would not have the same bits.
  const char* newest() const { return passes_.distance % 2 ? "odd.f32" : "even.f32"; }
  const char* next() const { return passes_.distance % 2 ? "even.f32" : "odd.f32"; }
  Status remember() { return tools::write_text(path("passes.txt"), passes_.text()); }

  std::int64_t plane_bytes() const {
    return std::int64_t{4} * file_.volume().size[0] * file_.volume().size[1];
  }
  GridView<float> grid(std::vector<float>& distance, const tools::Slab& slab) const {
    const auto n = file_.volume().size;
    const tools::Double3 h = file_.volume().spacing();
    return {distance.data(), {n[0], n[1], slab.planes()}, {float(h[0]), float(h[1]), float(h[2])}};
  }
  Status read_distances(const ScratchFile& from, const tools::Slab& slab,
                        std::vector<float>* distance) const {
    distance->resize(static_cast<std::size_t>(plane_bytes() / 4 * slab.planes()));
    return from.read(slab.begin * plane_bytes(), distance->data(), slab.planes() * plane_bytes());
  }

  Status distance_pass(bool rising, int* changed) {
    ScratchFile in, out;
    const bool first = passes_.distance == 0;
    if (Status s = first ? Status() : in.open(path(newest())); !s.ok()) return s;
    if (Status s = out.create(path(next())); !s.ok()) return s;
    const auto n = file_.volume().size;
    std::vector<float> face(distance_face_size(n[0], n[1]));
    std::vector<float>& distance = distance_;
    VolumeRange range;
    for (std::size_t k = 0; k < slabs_.size(); ++k) {
      const tools::Slab& slab = slabs_[rising ? k : slabs_.size() - 1 - k];
      if (first) {
        distance.resize(static_cast<std::size_t>(plane_bytes() / 4 * slab.planes()));
        if (Status s = begin(slab, grid(distance, slab), &range); !s.ok()) return s;
      } else {
        if (Status s = read_distances(in, slab, &distance); !s.ok()) return s;
      }
      std::span<const float> up;
      if (k > 0) up = face;
      bool fell = false;
      if (Status s = sweep_distance_block(grid(distance, slab), rising, up, face, &fell, run_);
          !s.ok()) {
        return s;
      }
      *changed |= int{fell};
      if (Status s =
              out.write(slab.begin * plane_bytes(), distance.data(), slab.planes() * plane_bytes());
          !s.ok()) {
        return s;
      }
      ++at_;
    }
    if (!first) return {};
    if (range.finite == 0) return invalid_input("volume has no finite voxel; give one that has");
    const Status s = check_isovalue(range, settings_.distance);
    return s.ok() ? s : Status(s.code(), "--iso: " + s.message());
  }

  // Samples of a slab, their range, and the distances beside the surface.
  Status begin(const tools::Slab& slab, GridView<float> distance, VolumeRange* range) {
    tools::SlabSamples samples;
    if (Status s = samples.read(file_, slab); !s.ok()) return s;
    RunOptions silent;
    silent.executor = run_.executor;
    VolumeRange own;
    if (Status s = tools::slab_range(samples, silent, &own); !s.ok()) return s;
    tools::add_to_range(own, range);
    return start_distance_block(samples.image.view(), samples.below, samples.above,
                                settings_.distance, distance, silent);
  }

  Status start(const ScratchFile& distances, const tools::Slab& slab) {
    if (Status s = read_distances(distances, slab, &distance_); !s.ok()) return s;
    return block_.start(grid(distance_, slab), settings_.occlusion, run_);
  }
  // Where a slab's visibilities lie in a file of a half.
  std::int64_t first_of(const tools::Slab& slab, const OcclusionBlock& block) const {
    const int cell = field_cell(settings_.occlusion.transport);
    return slab.begin / cell * static_cast<std::int64_t>(block.face_size());
  }
  Status sweep_up(std::size_t i, const ScratchFile& fallen, std::vector<std::int16_t>* face) {
    std::span<const std::int16_t> up;
    if (i > 0) up = *face;
    face->resize(block_.face_size());
    if (Status s = block_.sweep(true, up, *face, run_); !s.ok()) return s;
    return block_.restore(false, [&](std::span<std::uint8_t> half) {
      return fallen.read(first_of(slabs_[i], block_), half.data(),
                         static_cast<std::int64_t>(half.size()));
    });
  }
  Status write_header(ScratchFile* out, std::int64_t* end) const {
    const FieldsKind kind = settings_.picture.fields_of;
    tools::FieldGrid grid = tools::field_grid(kind, file_.volume(), block_.field());
    const int cell = kind == FieldsKind::kDistance ? 1 : field_cell(settings_.occlusion.transport);
    grid.size[2] = (file_.volume().size[2] + cell - 1) / cell;
    const std::string header = tools::nrrd_field_header(grid, tools::field_names(kind));
    *end = static_cast<std::int64_t>(header.size());
    return out->write(0, header.data(), *end);
  }

  const VolumeCommand& c_;
  VolumeSettings settings_;
  const std::string folder_;
  tools::ProgressBar bar_;
  RunOptions run_;
  tools::PlaneFile file_;
  std::vector<tools::Slab> slabs_;
  // Memory that slab after slab uses.
  std::vector<float> distance_;
  OcclusionBlock block_;
  Passes passes_;
  double at_ = 0, steps_ = 1;  // slabs done, and all
};

}  // namespace

StreamBytes stream_bytes(const tools::VolumeImage& volume, FieldsKind kind, Transport transport,
                         int threads) {
  constexpr double kDirections[] = {1, 3, 6, 10};
  const double plane = double(volume.size[0]) * volume.size[1], cell = field_cell(transport);
  const double d = kDirections[int(transport)], coarse = plane / (cell * cell);
  // Samples with two planes more, and distances; three planes of values and signs for each thread
  // that begins, planes of both stages, and the face.
  const double samples = double(tools::bytes_of(volume.type));
  StreamBytes distance{plane * (2 * samples + 15 * threads + 16 + 8), plane * (samples + 4)};
  if (kind == FieldsKind::kDistance) return {kProgramBytes + distance.fixed, distance.plane};
  // Transmittances, both halves, one of them twice while it comes from its file, and the floats
  // that are written; two planes of state and each thread's planes, and the faces.
  const double channels = kind == FieldsKind::kScalar ? 1 : 8;
  const double values = 1 + 8 * d + 4 * channels;
  const StreamBytes light{coarse * (16 * d + threads * (4 * d + 4) + 8 * d),
                          4 * plane + coarse / cell * values};
  return {kProgramBytes + std::max(distance.fixed, light.fixed),
          std::max(distance.plane, light.plane)};
}

Status stream_volume(const VolumeCommand& c, const VolumeRequest& p, Executor* executor,
                     bool quiet) {
  if (Status s = check_streamed(c, p); !s.ok()) return s;
  double memory = 0;
  if (Status s = parse_memory(c.memory, &memory); !s.ok()) return s;
  return_large_arrays();
  const tools::IgnoreFileSizeSignal ignore;
  const tools::Stopwatch watch;
  VolumeStream stream(c, p, executor, quiet);
  Status s = stream.open(memory);
  if (!s.ok()) return s;
  if (!quiet && stream.begun()) fmt::print("{}: goes on with a run that was ended\n", c.fields);
  s = stream.measure();
  if (s.ok() && p.settings.picture.fields_of != FieldsKind::kDistance) s = stream.fall();
  if (s.ok()) s = stream.rise();
  stream.erase_bar();
  if (s.code() == StatusCode::kCancelled) {
    return {s.code(), fmt::format("interrupted; the same command goes on from {}.work", c.fields)};
  }
  if (!s.ok()) {
    stream.forget();
    return s;
  }
  const auto n = stream.volume().size;
  if (!quiet) {
    fmt::print("{}: {} of {}x{}x{} voxels in {} slabs, {:.2f} s\n", c.fields,
               enum_name(p.settings.picture.fields_of), n[0], n[1], n[2], stream.slabs(),
               watch.seconds());
  }
  return {};
}

}  // namespace obscura::app
