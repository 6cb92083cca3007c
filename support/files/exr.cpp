#include "support/files/exr.h"

#include <ImfChannelList.h>
#include <ImfCompression.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfMatrixAttribute.h>
#include <ImfOutputFile.h>
#include <ImfStandardAttributes.h>
#include <ImfThreading.h>

#include <algorithm>
#include <filesystem>
#include <mutex>
#include <thread>

#include "fmt/format.h"
#include "support/files/atomic_file.h"

namespace obscura::support {
namespace {

PixelWindow from_box(const Imath::Box2i& b) { return {b.min.x, b.min.y, b.max.x, b.max.y}; }
Imath::Box2i to_box(const PixelWindow& w) { return {{w.min_x, w.min_y}, {w.max_x, w.max_y}}; }

const char* type_name(Imf::PixelType type) {
  return type == Imf::HALF ? "half" : type == Imf::FLOAT ? "float" : "uint";
}

// OpenEXR's own threads serve all files; started once.
void start_threads() {
  static std::once_flag once;
  std::call_once(once, [] {
    Imf::setGlobalThreadCount(static_cast<int>(std::thread::hardware_concurrency()));
  });
}

void fill_header(const Imf::Header& native, ExrHeader* header) {
  header->display_window = from_box(native.displayWindow());
  header->data_window = from_box(native.dataWindow());
  header->channels.clear();
  for (auto it = native.channels().begin(); it != native.channels().end(); ++it) {
    header->channels.push_back({it.name(), type_name(it.channel().type)});
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
  header->attributes.clear();
  for (auto it = native.begin(); it != native.end(); ++it) header->attributes.push_back(it.name());
  header->native = std::make_shared<Imf::Header>(native);
}

Status check_windows(const std::string& path, const ExrHeader& h) {
  for (const PixelWindow* w : {&h.display_window, &h.data_window}) {
    const std::int64_t width = std::int64_t{w->max_x} - w->min_x + 1;
    const std::int64_t height = std::int64_t{w->max_y} - w->min_y + 1;
    if (width >= 1 && height >= 1 && width <= 65535 && height <= 65535) continue;
    return invalid_input(
        fmt::format("{}: a window of {}x{}; each side must be in [1, 65535]", path, width, height));
  }
  return {};
}

// A header may claim any size. Compression by more than this does not occur in EXR, so a file that
// small holds no such image, and nothing is allocated for it.
constexpr double kMostCompression = 1200;

Status check_plausible(const std::string& path, const ExrHeader& h, std::size_t channels) {
  std::error_code error;
  const auto bytes = static_cast<double>(std::filesystem::file_size(path, error));
  const double pixels = static_cast<double>(h.data_window.width()) * h.data_window.height();
  if (!error && pixels * 2 * static_cast<double>(std::max<std::size_t>(channels, 1)) >
                    bytes * kMostCompression) {
    return invalid_input(fmt::format("{}: truncated: {:.0f} bytes cannot hold {}x{} pixels", path,
                                     bytes, h.data_window.width(), h.data_window.height()));
  }
  return {};
}

// Runs what may throw; every exception of OpenEXR ends here.
template <class F>
Status guarded(const std::string& path, F&& f) {
  if (Status s = check_readable(path); !s.ok()) return s;
  try {
    return f();
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& e) {
    std::string reason = e.what();
    std::replace(reason.begin(), reason.end(), '\n', ' ');
    return invalid_input(fmt::format("{}: not a readable EXR file ({})", path, reason));
  }
}

}  // namespace

const ExrHeader::Channel* ExrHeader::find(const std::string& name) const {
  for (const Channel& c : channels) {
    if (c.name == name) return &c;
  }
  return nullptr;
}

Status read_exr_header(const std::string& path, ExrHeader* header) {
  return guarded(path, [&]() -> Status {
    Imf::InputFile file(path.c_str());
    fill_header(file.header(), header);
    return check_windows(path, *header);
  });
}

Status read_exr(const std::string& path, const std::vector<std::string>& wanted, ExrHeader* header,
                Image* image) {
  start_threads();
  return guarded(path, [&]() -> Status {
    Imf::InputFile file(path.c_str());
    fill_header(file.header(), header);
    if (Status s = check_windows(path, *header); !s.ok()) return s;
    if (Status s = check_plausible(path, *header, header->channels.size()); !s.ok()) return s;
    const PixelWindow& w = header->data_window;
    Image result(w.width(), w.height());
    for (const ExrHeader::Channel& c : header->channels) {
      const Imf::Channel& native = file.header().channels()[c.name.c_str()];
      const bool asked_for =
          wanted.empty() || std::find(wanted.begin(), wanted.end(), c.name) != wanted.end();
      if (!asked_for) continue;
      if (native.xSampling != 1 || native.ySampling != 1) {
        if (wanted.empty()) continue;  // subsampled chroma is never depth
        return invalid_input(fmt::format("{}: channel {} is subsampled", path, c.name));
      }
      result.add(c.name);
    }
    Imf::FrameBuffer frame;
    for (Image::Channel& c : result.channels) {
      // OpenEXR addresses pixel (x, y) at base + x * 4 + y * row, with x, y in the data window.
      const std::ptrdiff_t row = std::ptrdiff_t{w.width()} * 4;
      char* base =
          reinterpret_cast<char*>(c.values.data()) - w.min_x * std::ptrdiff_t{4} - w.min_y * row;
      frame.insert(c.name, Imf::Slice(Imf::FLOAT, base, 4, static_cast<std::size_t>(row)));
    }
    file.setFrameBuffer(frame);
    file.readPixels(w.min_y, w.max_y);
    *image = std::move(result);
    return {};
  });
}

Status write_exr(const std::string& path, const Image& image, const ExrWriteOptions& options) {
  start_threads();
  const PixelWindow own{0, 0, image.width - 1, image.height - 1};
  const PixelWindow data = options.data_window.value_or(own);
  Imf::Header header(to_box(options.display_window.value_or(own)), to_box(data));
  if (options.attributes_of && options.attributes_of->native) {
    const auto& other = *static_cast<const Imf::Header*>(options.attributes_of->native.get());
    static constexpr const char* kStorage[] = {
        "channels",  "compression", "dataWindow",        "displayWindow", "lineOrder",
        "tiles",     "type",        "version",           "chunkCount",    "name",
        "multiView", "preview",     "maxSamplesPerPixel"};
    for (auto it = other.begin(); it != other.end(); ++it) {
      const bool storage =
          std::any_of(std::begin(kStorage), std::end(kStorage),
                      [&](const char* n) { return std::string_view(n) == it.name(); });
      if (!storage) header.insert(it.name(), it.attribute());
    }
  }
  auto add_matrix = [&](const char* name, const std::optional<ExrHeader::Matrix>& matrix) {
    if (!matrix) return;
    Imath::M44f m;
    for (int i = 0; i < 16; ++i) m[i / 4][i % 4] = static_cast<float>((*matrix)[i]);
    header.insert(name, Imf::M44fAttribute(m));
  };
  add_matrix("worldToCamera", options.world_to_camera);
  add_matrix("worldToNDC", options.world_to_ndc);
  // ZIP of scanline blocks is what every reader takes; level 4 of zlib is OpenEXR's own default.
  header.compression() = Imf::ZIP_COMPRESSION;

  std::vector<std::vector<half>> halves;
  halves.reserve(image.channels.size());
  Imf::FrameBuffer frame;
  const std::ptrdiff_t width = image.width;
  for (const Image::Channel& c : image.channels) {
    std::string type = options.half ? "half" : "float";
    for (const auto& own_type : options.types) {
      if (own_type.name == c.name) type = own_type.type;
    }
    const bool as_half = type == "half";
    header.channels().insert(c.name, Imf::Channel(as_half ? Imf::HALF : Imf::FLOAT));
    const std::ptrdiff_t size = as_half ? 2 : 4;
    char* pixels;
    if (as_half) {
      halves.emplace_back(c.values.begin(), c.values.end());
      pixels = reinterpret_cast<char*>(halves.back().data());
    } else {
      pixels = const_cast<char*>(reinterpret_cast<const char*>(c.values.data()));
    }
    char* base = pixels - data.min_x * size - data.min_y * width * size;
    frame.insert(c.name,
                 Imf::Slice(as_half ? Imf::HALF : Imf::FLOAT, base, static_cast<std::size_t>(size),
                            static_cast<std::size_t>(width * size)));
  }
  try {
    Imf::OutputFile file(path.c_str(), header);
    file.setFrameBuffer(frame);
    file.writePixels(image.height);
    return {};
  } catch (const std::exception& e) {
    return {StatusCode::kInternal, fmt::format("cannot write {}: {}", path, e.what())};
  }
}

}  // namespace obscura::support
