#include "io/meshes/gltf_document.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>

#include "io/meshes/file_bytes.h"
#include "io/meshes/words.h"

namespace obscura::tools {
namespace {

constexpr int kDeepest = 64;

// Brackets inside brackets, outside of strings: parsers of JSON are not to be trusted with more.
int depth_of(std::string_view text) {
  int depth = 0, deepest = 0;
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quoted) {
      if (c == '\\') ++i;
      if (c == '"') quoted = false;
    } else if (c == '"') {
      quoted = true;
    } else if (c == '{' || c == '[') {
      deepest = std::max(deepest, ++depth);
    } else if (c == '}' || c == ']') {
      --depth;
    }
  }
  return deepest;
}

std::uint32_t word(std::string_view bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (int i = 3; i >= 0; --i) value = value << 8 | std::uint8_t(bytes[at + std::size_t(i)]);
  return value;
}

std::string decode_base64(std::string_view text) {
  std::string bytes;
  bytes.reserve(text.size() / 4 * 3);
  std::uint32_t bits = 0;
  int held = 0;
  for (char c : text) {
    int value = 0;
    if (c >= 'A' && c <= 'Z') {
      value = c - 'A';
    } else if (c >= 'a' && c <= 'z') {
      value = c - 'a' + 26;
    } else if (c >= '0' && c <= '9') {
      value = c - '0' + 52;
    } else if (c == '+' || c == '-') {
      value = 62;
    } else if (c == '/' || c == '_') {
      value = 63;
    } else if (c == '=') {
      break;
    } else {
      throw GltfError("has a data: URI that is not base64");
    }
    bits = bits << 6 | std::uint32_t(value);
    held += 6;
    if (held >= 8) {
      held -= 8;
      bytes += char(bits >> held & 0xFF);
    }
  }
  return bytes;
}

std::string decode_percent(const std::string& uri) {
  auto digit = [](char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    if (c >= 'A' && c <= 'F') return c - 'A' + 10;
    return -1;
  };
  std::string text;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    if (uri[i] == '%' && i + 2 < uri.size() && digit(uri[i + 1]) >= 0 && digit(uri[i + 2]) >= 0) {
      text += char(digit(uri[i + 1]) * 16 + digit(uri[i + 2]));
      i += 2;
    } else {
      text += uri[i];
    }
  }
  return text;
}

// componentType of the specification.
std::size_t component_bytes(std::int64_t type) {
  switch (type) {
    case 5120:
    case 5121:
      return 1;
    case 5122:
    case 5123:
      return 2;
    case 5125:
    case 5126:
      return 4;
    default:
      throw GltfError(fmt::format("has an accessor of component type {}", type));
  }
}

template <class T>
T load(const std::uint8_t* p) {
  T value;
  std::memcpy(&value, p, sizeof(T));
  return value;
}

double component(const std::uint8_t* p, std::int64_t type, bool normalized) {
  auto scaled = [&](double value, double largest) {
    return normalized ? std::max(value / largest, -1.0) : value;
  };
  switch (type) {
    case 5120:
      return scaled(load<std::int8_t>(p), 127);
    case 5121:
      return scaled(*p, 255);
    case 5122:
      return scaled(load<std::int16_t>(p), 32767);
    case 5123:
      return scaled(load<std::uint16_t>(p), 65535);
    case 5125:
      return load<std::uint32_t>(p);
    default:
      return load<float>(p);
  }
}

}  // namespace

GltfDocument::GltfDocument(std::string path, std::string_view bytes) : path_(std::move(path)) {
  total_bytes_ = bytes.size();
  parse_container(bytes);
  const std::size_t count = size("buffers");
  buffers_.resize(count);
  loaded_.resize(count);
}

void GltfDocument::parse_container(std::string_view bytes) {
  if (!bytes.starts_with("glTF")) return parse_json(bytes);
  if (bytes.size() < 20) throw GltfError("is cut short within the header of a GLB");
  if (word(bytes, 4) != 2)
    throw GltfError(fmt::format("is GLB version {}; 2 is read", word(bytes, 4)));
  std::string_view json;
  std::size_t at = 12;
  while (bytes.size() - at >= 8) {
    const std::size_t length = word(bytes, at);
    const std::uint32_t kind = word(bytes, at + 4);
    if (length > bytes.size() - at - 8) {
      throw GltfError(
          fmt::format("is cut short: a chunk of {} bytes has {}", length, bytes.size() - at - 8));
    }
    if (kind == 0x4E4F534A && json.empty()) json = bytes.substr(at + 8, length);
    if (kind == 0x004E4942 && binary_.empty()) binary_ = bytes.substr(at + 8, length);
    at = std::min(bytes.size(), at + 8 + (length + 3) / 4 * 4);
  }
  if (json.empty()) throw GltfError("is a GLB without a JSON chunk");
  parse_json(json);
}

void GltfDocument::parse_json(std::string_view text) {
  if (const int depth = depth_of(text); depth > kDeepest) {
    throw GltfError(
        fmt::format("has JSON nested {} deep; glTF needs no more than {}", depth, kDeepest));
  }
  root_ = Json::parse(text, nullptr, false);
  if (root_.is_discarded()) throw GltfError("is not JSON, as glTF is");
  if (!root_.is_object()) throw GltfError("is JSON, but no object, as glTF is");
  if (!root_.contains("asset")) throw GltfError("is JSON, but has no 'asset', as glTF has");
}

std::size_t GltfDocument::size(const char* array) const {
  const auto found = root_.find(array);
  if (found == root_.end()) return 0;
  if (!found->is_array()) throw GltfError(fmt::format("has '{}' that is no array", array));
  return found->size();
}

const GltfDocument::Json& GltfDocument::element(const char* array, std::int64_t index) const {
  const std::size_t count = size(array);
  if (index < 0 || std::size_t(index) >= count) {
    throw GltfError(fmt::format("names element {} of '{}', which has {}", index, array, count));
  }
  const Json& found = root_[array][std::size_t(index)];
  if (!found.is_object()) {
    throw GltfError(fmt::format("has an element {} of '{}' that is no object", index, array));
  }
  return found;
}

std::int64_t GltfDocument::whole(const Json& object, const char* key, std::int64_t fallback) {
  const auto found = object.find(key);
  if (found == object.end()) return fallback;
  constexpr double kLargest = 1e15;
  if (found->is_number()) {
    const double value = found->get<double>();
    if (value >= 0 && value <= kLargest && value == std::floor(value)) return std::int64_t(value);
  }
  throw GltfError(fmt::format("has a '{}' that is no whole number from 0", key));
}

std::vector<double> GltfDocument::numbers(const Json& object, const char* key, std::size_t count) {
  const auto found = object.find(key);
  if (found == object.end()) return {};
  std::vector<double> values;
  if (found->is_array()) {
    for (const Json& value : *found) {
      if (value.is_number()) values.push_back(value.get<double>());
    }
  }
  if (values.size() != count || found->size() != count) {
    throw GltfError(fmt::format("has a '{}' that is not {} numbers", key, count));
  }
  return values;
}

std::string GltfDocument::load_uri(const std::string& uri) const {
  if (uri.starts_with("data:")) {
    const std::size_t comma = uri.find(',');
    if (comma == std::string::npos || uri.substr(0, comma).find(";base64") == std::string::npos) {
      throw GltfError("has a data: URI that is not base64");
    }
    return decode_base64(std::string_view(uri).substr(comma + 1));
  }
  const std::filesystem::path name = decode_percent(uri);
  const bool climbs = std::ranges::any_of(name, [](const auto& part) { return part == ".."; });
  if (name.empty() || name.is_absolute() || climbs || uri.find("://") != std::string::npos) {
    throw GltfError(fmt::format("keeps a buffer in '{}'; buffers are read from its own folder only",
                                printable(uri)));
  }
  const std::string file = (std::filesystem::path(path_).parent_path() / name).string();
  std::string bytes;
  if (Status s = read_file_bytes(file, &bytes); !s.ok()) {
    throw GltfError("needs a buffer that cannot be read: " + s.message());
  }
  return bytes;
}

std::string_view GltfDocument::buffer(std::int64_t index) {
  const Json& json = element("buffers", index);
  const auto i = std::size_t(index);
  const auto length = std::size_t(whole(json, "byteLength", 0));
  std::string_view bytes = binary_;
  if (json.contains("uri")) {
    if (!json["uri"].is_string())
      throw GltfError(fmt::format("has a buffer {} whose uri is no text", i));
    if (!loaded_[i]) {
      buffers_[i] = load_uri(json["uri"].get_ref<const std::string&>());
      loaded_[i] = true;
      total_bytes_ += buffers_[i].size();
    }
    bytes = buffers_[i];
  } else if (index != 0 || binary_.empty()) {
    throw GltfError(fmt::format("has a buffer {} without bytes", i));
  }
  if (bytes.size() < length) {
    throw GltfError(fmt::format("is cut short: buffer {} should have {} bytes and has {}", i,
                                length, bytes.size()));
  }
  return bytes.substr(0, length);
}

// `count` elements from where `view_owner` (an accessor, or part of a sparse one) says.
GltfDocument::Span GltfDocument::span(const Json& view_owner, std::int64_t count,
                                      std::size_t element_bytes) {
  const std::int64_t view_index = whole(view_owner, "bufferView", -1);
  const Json& view = element("bufferViews", view_index);
  const std::string_view bytes = buffer(whole(view, "buffer", -1));
  const auto start = std::size_t(whole(view, "byteOffset", 0));
  const auto length = std::size_t(whole(view, "byteLength", 0));
  const auto offset = std::size_t(whole(view_owner, "byteOffset", 0));
  const auto stride = std::size_t(whole(view, "byteStride", std::int64_t(element_bytes)));
  if (start > bytes.size() || length > bytes.size() - start) {
    throw GltfError(fmt::format("has a bufferView {} that reaches beyond its buffer", view_index));
  }
  if (stride < element_bytes || stride > 252 + element_bytes) {
    throw GltfError(
        fmt::format("has a byteStride of {} for elements of {} bytes", stride, element_bytes));
  }
  const auto n = std::size_t(count);
  if (n > 0 && (offset > length || element_bytes > length - offset ||
                n - 1 > (length - offset - element_bytes) / stride)) {
    throw GltfError(fmt::format("has an accessor of {} elements that reaches beyond bufferView {}",
                                n, view_index));
  }
  return {reinterpret_cast<const std::uint8_t*>(bytes.data()) + start + offset, stride};
}

template <class Read>
void GltfDocument::read_sparse(const Json& accessor, std::int64_t count, std::size_t element_bytes,
                               Read read) {
  const auto found = accessor.find("sparse");
  if (found == accessor.end()) return;
  const Json& sparse = *found;
  if (!sparse.is_object() || !sparse.contains("indices") || !sparse.contains("values")) {
    throw GltfError("has a sparse accessor without indices and values");
  }
  const std::int64_t entries = whole(sparse, "count", 0);
  const std::int64_t type = whole(sparse["indices"], "componentType", 0);
  const std::size_t bytes = component_bytes(type);
  const Span at = span(sparse["indices"], entries, bytes);
  const Span values = span(sparse["values"], entries, element_bytes);
  for (std::int64_t i = 0; i < entries; ++i) {
    const double index = component(at.data + std::size_t(i) * at.stride, type, false);
    if (!(index >= 0 && index < double(count))) {
      throw GltfError(
          fmt::format("has a sparse accessor that names element {:.0f} of {}", index, count));
    }
    read(std::size_t(index), values.data + std::size_t(i) * values.stride);
  }
}

std::vector<Vec3> GltfDocument::positions(std::int64_t accessor_index, bool* single_precision) {
  const Json& accessor = element("accessors", accessor_index);
  const std::int64_t count = whole(accessor, "count", 0),
                     type = whole(accessor, "componentType", 0);
  if (accessor.value("type", Json()) != "VEC3") {
    throw GltfError(
        fmt::format("has positions in accessor {}, which is not of type VEC3", accessor_index));
  }
  const std::size_t size = component_bytes(type);
  const auto normalized_entry = accessor.find("normalized");
  const bool normalized = normalized_entry != accessor.end() && normalized_entry->is_boolean() &&
                          normalized_entry->get<bool>();
  *single_precision = type == 5126;
  if (!accessor.contains("bufferView")) {
    throw GltfError(fmt::format("has no bytes for the positions in accessor {}", accessor_index));
  }
  auto read = [&](const std::uint8_t* p) {
    return Vec3{component(p, type, normalized), component(p + size, type, normalized),
                component(p + 2 * size, type, normalized)};
  };
  const Span from = span(accessor, count, 3 * size);
  std::vector<Vec3> result;
  result.reserve(std::size_t(count));
  for (std::int64_t i = 0; i < count; ++i) {
    result.push_back(read(from.data + std::size_t(i) * from.stride));
  }
  read_sparse(accessor, count, 3 * size,
              [&](std::size_t i, const std::uint8_t* p) { result[i] = read(p); });
  return result;
}

std::vector<std::uint32_t> GltfDocument::indices(std::int64_t accessor_index) {
  const Json& accessor = element("accessors", accessor_index);
  const std::int64_t count = whole(accessor, "count", 0),
                     type = whole(accessor, "componentType", 0);
  if (accessor.value("type", Json()) != "SCALAR" ||
      (type != 5121 && type != 5123 && type != 5125)) {
    throw GltfError(fmt::format("has indices in accessor {}, which is not of unsigned scalars",
                                accessor_index));
  }
  const std::size_t size = component_bytes(type);
  const Span from = span(accessor, count, size);
  std::vector<std::uint32_t> result;
  result.reserve(std::size_t(count));
  for (std::int64_t i = 0; i < count; ++i) {
    result.push_back(
        std::uint32_t(component(from.data + std::size_t(i) * from.stride, type, false)));
  }
  read_sparse(accessor, count, size, [&](std::size_t i, const std::uint8_t* p) {
    result[i] = std::uint32_t(component(p, type, false));
  });
  return result;
}

}  // namespace obscura::tools
