#include <ImfChannelList.h>
#include <ImfCompression.h>
#include <ImfFrameBuffer.h>
#include <ImfInputPart.h>
#include <ImfMatrixAttribute.h>
#include <ImfOutputFile.h>
#include <ImfStringAttribute.h>

#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <limits>
#include <stdexcept>

#include "io/images/exr.h"
#include "io/images/exr_checked_file.h"
#include "io/images/exr_native.h"

namespace obscura::tools {
namespace {

// Pixels of a source file's channels in their own types, over its data window.
struct StoredChannel {
  std::string name;
  Imf::PixelType type;
  std::vector<char> pixels;
  bool depth;
};

std::ptrdiff_t bytes_of(Imf::PixelType type) { return type == Imf::HALF ? 2 : 4; }

// Attributes that say how pixels are stored, not what they show.
bool describes_storage(std::string_view name) {
  static constexpr const char* kNames[] = {
      "channels",  "compression", "dataWindow", "displayWindow",      "lineOrder",
      "tiles",     "type",        "version",    "chunkCount",         "name",
      "multiView", "preview",     "view",       "maxSamplesPerPixel", "dwaCompressionLevel"};
  return std::find(std::begin(kNames), std::end(kNames), name) != std::end(kNames);
}

Status read_stored(const std::string& path, const Image& own, ExrHeader* header,
                   std::vector<StoredChannel>* channels) {
  return guard_exr(path, [&]() -> Status {
    std::unique_ptr<Imf::MultiPartInputFile> file;
    if (Status s = open_exr(path, header, &file); !s.ok()) return s;
    if (Status s = refuse_deep(path, *header); !s.ok()) return s;
    const PixelWindow& w = header->data_window;
    const std::size_t pixels = static_cast<std::size_t>(w.width()) * w.height();
    for (const ExrHeader::Channel& c : header->channels) {
      if (own.find(c.name)) continue;
      if (c.subsampled) {
        return invalid_input(
            fmt::format("{}: channel {} is subsampled and cannot be kept", path, c.name));
      }
      const Imf::PixelType type = file->header(0).channels()[c.name.c_str()].type;
      channels->push_back({c.name, type, std::vector<char>(pixels * bytes_of(type)),
                           looks_like_depth(c.name) || looks_like_back_depth(c.name)});
    }
    Imf::FrameBuffer frame;
    for (StoredChannel& c : *channels) {
      const std::ptrdiff_t bytes = bytes_of(c.type);
      frame.insert(c.name, Imf::Slice(c.type, origin_of(c.pixels.data(), w, bytes),
                                      static_cast<std::size_t>(bytes),
                                      static_cast<std::size_t>(bytes * w.width())));
    }
    Imf::InputPart part(*file, 0);
    part.setFrameBuffer(frame);
    part.readPixels(w.min_y, w.max_y);
    return {};
  });
}

// Lays a channel over another window; pixels that the file lacks are 0, or background in a depth.
void move_window(const PixelWindow& from, const PixelWindow& to, StoredChannel* c) {
  const std::ptrdiff_t bytes = bytes_of(c->type);
  std::vector<char> out(static_cast<std::size_t>(to.width()) * to.height() * bytes);
  if (c->depth && c->type != Imf::UINT) {
    const float infinite = std::numeric_limits<float>::infinity();
    const half infinite_half = half::posInf();
    const void* value = c->type == Imf::HALF ? static_cast<const void*>(&infinite_half) : &infinite;
    for (std::size_t i = 0; i < out.size(); i += bytes) std::memcpy(&out[i], value, bytes);
  }
  const int x0 = std::max(from.min_x, to.min_x), x1 = std::min(from.max_x, to.max_x);
  for (int y = std::max(from.min_y, to.min_y); x0 <= x1 && y <= std::min(from.max_y, to.max_y);
       ++y) {
    const std::size_t in =
        static_cast<std::size_t>(y - from.min_y) * from.width() + x0 - from.min_x;
    const std::size_t at = static_cast<std::size_t>(y - to.min_y) * to.width() + x0 - to.min_x;
    std::memcpy(&out[at * bytes], &c->pixels[in * bytes], (x1 - x0 + 1) * bytes);
  }
  c->pixels = std::move(out);
}

void add_matrix(const char* name, const std::optional<ExrHeader::Matrix>& matrix,
                Imf::Header* header) {
  if (!matrix) return;
  Imath::M44f m;
  for (int i = 0; i < 16; ++i) m[i / 4][i % 4] = static_cast<float>((*matrix)[i]);
  header->insert(name, Imf::M44fAttribute(m));
}

Status cannot_write(const std::string& path, const std::string& reason) {
  return {StatusCode::kInternal, fmt::format("cannot write {}: {}", path, reason)};
}

}  // namespace

Status write_exr(const std::string& path, const Image& image, const ExrWriteOptions& options) {
  const PixelWindow own{0, 0, image.width - 1, image.height - 1};
  PixelWindow display = options.display_window.value_or(own);
  PixelWindow data = options.data_window.value_or(own);
  ExrHeader kept_header;
  std::vector<StoredChannel> kept;
  if (!options.keep_channels_of.empty()) {
    const std::string& source = options.keep_channels_of;
    if (Status s = read_stored(source, image, &kept_header, &kept); !s.ok()) return s;
    display = data = kept_header.display_window;
    if (options.kept_guard_band) {
      const PixelWindow w = kept_header.whole_window();
      const GuardBand& g = *options.kept_guard_band;
      data = {w.min_x + g.left, w.min_y + g.top, w.max_x - g.right, w.max_y - g.bottom};
    }
    if (data.width() != image.width || data.height() != image.height) {
      return invalid_input(
          fmt::format("{}: what it shows is {}x{}, the result {}x{}; channels cannot be kept",
                      source, data.width(), data.height(), image.width, image.height));
    }
    for (StoredChannel& c : kept) move_window(kept_header.data_window, data, &c);
  }
  Imf::Header header(to_box(display), to_box(data));
  if (kept_header.native) {
    const auto& other = *static_cast<const Imf::Header*>(kept_header.native.get());
    for (auto it = other.begin(); it != other.end(); ++it) {
      if (!describes_storage(it.name())) header.insert(it.name(), it.attribute());
    }
  }
  add_matrix("worldToCamera", options.world_to_camera, &header);
  add_matrix("worldToNDC", options.world_to_ndc, &header);
  if (!image.occluder.empty()) {
    header.insert(kOccluderAttribute, Imf::StringAttribute(image.occluder));
  }
  if (!options.made_by.empty()) {
    header.insert(kMadeByAttribute, Imf::StringAttribute(options.made_by));
  }
  // Every reader takes ZIP, by blocks of 16 rows, which several threads share.
  header.compression() = Imf::ZIP_COMPRESSION;
  if (!options.compression.empty()) {
    Imf::Compression compression;
    if (Status s = parse_exr_compression(options.compression, &compression); !s.ok()) return s;
    header.compression() = compression;
  }

  Imf::FrameBuffer frame;
  auto add = [&](const std::string& name, Imf::PixelType type, const void* pixels) {
    const std::ptrdiff_t bytes = bytes_of(type);
    header.channels().insert(name, Imf::Channel(type));
    frame.insert(name, Imf::Slice(type, origin_of(const_cast<void*>(pixels), data, bytes),
                                  static_cast<std::size_t>(bytes),
                                  static_cast<std::size_t>(bytes * data.width())));
  };
  std::vector<std::vector<half>> halves;
  halves.reserve(image.channels.size());
  for (const Image::Channel& c : image.channels) {
    bool as_half = options.half;
    for (const ExrHeader::Channel& typed : options.types) {
      if (typed.name == c.name) as_half = typed.type == "half";
    }
    if (as_half) {
      halves.emplace_back(c.values.begin(), c.values.end());
      add(c.name, Imf::HALF, halves.back().data());
    } else {
      add(c.name, Imf::FLOAT, c.values.data());
    }
  }
  for (const StoredChannel& c : kept) add(c.name, c.type, c.pixels.data());
  CheckedFile stream(path);
  if (int error = stream.error(); error != 0) return cannot_write(path, std::strerror(error));
  Status status;
  try {
    Imf::OutputFile file(stream, header);
    file.setFrameBuffer(frame);
    file.writePixels(data.height());
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& e) {
    status = cannot_write(path, e.what());
  }
  // The errno is the plainer reason, where there is one.
  const int error = stream.close();
  return error != 0 ? cannot_write(path, std::strerror(error)) : status;
}

}  // namespace obscura::tools
