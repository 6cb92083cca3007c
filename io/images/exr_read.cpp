#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfInputPart.h>
#include <ImfMatrixAttribute.h>
#include <ImfPartType.h>
#include <ImfStringAttribute.h>
#include <ImfThreading.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <mutex>
#include <thread>

#include "io/images/atomic_file.h"
#include "io/images/exr.h"
#include "io/images/exr_native.h"
#include "io/images/unfolding.h"

namespace obscura::tools {
namespace {

constexpr int kMostPixels = 65535;  // on a side
// Pixel coordinates beyond this are a mistake, and would overflow in sums.
constexpr int kFarthestPixel = 1 << 24;

const char* type_name(Imf::PixelType type) {
  return type == Imf::HALF ? "half" : type == Imf::FLOAT ? "float" : "uint";
}

// Limits and threads of OpenEXR, which serve all files.
void set_up_once(int threads = 0) {
  static std::once_flag once;
  std::call_once(once, [threads] {
    const int all = static_cast<int>(std::thread::hardware_concurrency());
    const int wanted = threads > 0 ? std::min(threads, all) : all;
    // OpenEXR's workers come beside the calling thread, which is enough for one.
    Imf::setGlobalThreadCount(wanted == 1 ? 0 : wanted);
    Imf::Header::setMaxImageSize(kMostPixels, kMostPixels);
    Imf::Header::setMaxTileSize(kMostPixels, kMostPixels);
  });
}

void fill_header(const Imf::Header& native, ExrHeader* header) {
  header->part_name = native.hasName() ? native.name() : "";
  header->deep = native.hasType() && Imf::isDeepData(native.type());
  header->display_window = from_box(native.displayWindow());
  header->data_window = from_box(native.dataWindow());
  header->channels.clear();
  for (auto it = native.channels().begin(); it != native.channels().end(); ++it) {
    const Imf::Channel& c = it.channel();
    header->channels.push_back(
        {it.name(), type_name(c.type), c.xSampling != 1 || c.ySampling != 1});
  }
  auto matrix = [&](const char* name) -> std::optional<ExrHeader::Matrix> {
    const auto* attribute = native.findTypedAttribute<Imf::M44fAttribute>(name);
    if (!attribute) return std::nullopt;
    ExrHeader::Matrix m;
    for (int i = 0; i < 16; ++i) m[i] = attribute->value()[i / 4][i % 4];
    return m;
  };
  header->world_to_camera = matrix("worldToCamera");
  header->world_to_ndc = matrix("worldToNDC");
  const auto* occluder = native.findTypedAttribute<Imf::StringAttribute>(kOccluderAttribute);
  header->occluder = occluder ? occluder->value() : "";
  const auto* made_by = native.findTypedAttribute<Imf::StringAttribute>(kMadeByAttribute);
  header->made_by = made_by ? made_by->value() : "";
  header->attributes.clear();
  for (auto it = native.begin(); it != native.end(); ++it) header->attributes.push_back(it.name());
  header->native = std::make_shared<Imf::Header>(native);
}

Status check_windows(const std::string& path, const ExrHeader& h) {
  for (const PixelWindow* w : {&h.display_window, &h.data_window}) {
    const std::int64_t width = std::int64_t{w->max_x} - w->min_x + 1;
    const std::int64_t height = std::int64_t{w->max_y} - w->min_y + 1;
    if (width < 1 || height < 1 || width > kMostPixels || height > kMostPixels) {
      return invalid_input(fmt::format("{}: a window of {}x{}; each side must be in [1, {}]", path,
                                       width, height, kMostPixels));
    }
    for (int v : {w->min_x, w->min_y, w->max_x, w->max_y}) {
      if (v >= -kFarthestPixel && v <= kFarthestPixel) continue;
      return invalid_input(fmt::format("{}: a window reaches to pixel {}; it must be in [{}, {}]",
                                       path, v, -kFarthestPixel, kFarthestPixel));
    }
  }
  return {};
}

// The bytes of pixels that a byte of the file can stand for, generously. Deflate ends at 1032,
// fewer bytes for a float than its own four; DWA drops what is flat altogether.
double most_compression(Imf::Compression compression) {
  const bool dwa = compression == Imf::DWAA_COMPRESSION || compression == Imf::DWAB_COMPRESSION;
  return dwa ? 1e5 : 2500;
}

// A header may claim any size; nothing is allocated for one that the file cannot hold.
Status check_plausible(const std::string& path, const Imf::Header& native, const ExrHeader& h) {
  std::error_code error;
  const auto bytes = static_cast<double>(std::filesystem::file_size(path, error));
  double pixel_bytes = 0;
  for (const ExrHeader::Channel& c : h.channels) {
    if (!c.subsampled) pixel_bytes += c.type == "half" ? 2 : 4;
  }
  const double claimed =
      pixel_bytes * static_cast<double>(h.data_window.width()) * h.data_window.height();
  if (error) return {};
  if (claimed <= bytes * most_compression(native.compression())) {
    return check_unfolding(path, h.data_window.width(), h.data_window.height(), pixel_bytes / 4,
                           bytes);
  }
  return invalid_input(
      fmt::format("{}: truncated: {:.0f} bytes cannot hold {} channels of {}x{} pixels", path,
                  bytes, h.channels.size(), h.data_window.width(), h.data_window.height()));
}

}  // namespace

const ExrHeader::Channel* ExrHeader::find(const std::string& name) const {
  for (const Channel& c : channels) {
    if (c.name == name) return &c;
  }
  return nullptr;
}

PixelWindow ExrHeader::whole_window() const {
  const PixelWindow &a = data_window, &b = display_window;
  return {std::min(a.min_x, b.min_x), std::min(a.min_y, b.min_y), std::max(a.max_x, b.max_x),
          std::max(a.max_y, b.max_y)};
}

void set_exr_threads(int threads) { set_up_once(threads); }

Status open_exr(const std::string& path, ExrHeader* header,
                std::unique_ptr<Imf::MultiPartInputFile>* file, int part) {
  if (Status s = check_readable(path); !s.ok()) return s;
  set_up_once();
  if (Status s = check_exr_attributes(path); !s.ok()) return s;
  *file = std::make_unique<Imf::MultiPartInputFile>(path.c_str());
  const Imf::Header& native = (*file)->header(part);
  fill_header(native, header);
  header->part = part;
  if (Status s = check_windows(path, *header); !s.ok()) return s;
  return check_plausible(path, native, *header);
}

Status refuse_deep(const std::string& path, const ExrHeader& header) {
  if (!header.deep) return {};
  return invalid_input(
      fmt::format("{}: part {} is a deep image; it must be flattened first", path, header.part));
}

Status read_exr_header(const std::string& path, ExrHeader* header) {
  return guard_exr(path, [&]() -> Status {
    std::unique_ptr<Imf::MultiPartInputFile> file;
    return open_exr(path, header, &file);
  });
}

Status read_exr_headers(const std::string& path, std::vector<ExrHeader>* parts) {
  return guard_exr(path, [&]() -> Status {
    std::unique_ptr<Imf::MultiPartInputFile> file;
    parts->assign(1, {});
    if (Status s = open_exr(path, &parts->front(), &file); !s.ok()) return s;
    constexpr int kMostParts = 1024;
    for (int part = 1; part < std::min(file->parts(), kMostParts); ++part) {
      ExrHeader& header = parts->emplace_back();
      fill_header(file->header(part), &header);
      header.part = part;
      if (Status s = check_windows(path, header); !s.ok()) return s;
      if (Status s = check_plausible(path, file->header(part), header); !s.ok()) return s;
    }
    return {};
  });
}

Status read_exr(const std::string& path, const std::vector<std::string>& wanted, ExrHeader* header,
                Image* image, int part) {
  return guard_exr(path, [&]() -> Status {
    std::unique_ptr<Imf::MultiPartInputFile> file;
    if (Status s = open_exr(path, header, &file, part); !s.ok()) return s;
    if (Status s = refuse_deep(path, *header); !s.ok()) return s;
    const PixelWindow& w = header->data_window;
    Image result(w.width(), w.height());
    result.occluder = header->occluder;
    for (const ExrHeader::Channel& c : header->channels) {
      const bool named = std::find(wanted.begin(), wanted.end(), c.name) != wanted.end();
      if (named && c.subsampled) {
        return invalid_input(fmt::format("{}: channel {} is subsampled", path, c.name));
      }
      // Subsampled chroma is never asked for by "all".
      if (named || (wanted.empty() && !c.subsampled)) result.add(c.name);
    }
    Imf::FrameBuffer frame;
    for (Image::Channel& c : result.channels) {
      frame.insert(c.name, Imf::Slice(Imf::FLOAT, origin_of(c.values.data(), w, 4), 4,
                                      static_cast<std::size_t>(w.width()) * 4));
    }
    Imf::InputPart input(*file, part);
    input.setFrameBuffer(frame);
    input.readPixels(w.min_y, w.max_y);
    *image = std::move(result);
    return {};
  });
}

}  // namespace obscura::tools
