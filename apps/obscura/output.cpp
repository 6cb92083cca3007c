#include "apps/obscura/output.h"

#include <algorithm>
#include <cstdio>
#include <sstream>

#include "fmt/format.h"
#include "io/images/files.h"

namespace obscura::app {
namespace {

struct Kind {
  const char* name;
  ImageView<float> Outputs::*scalar;
  VectorView<float> Outputs::*vector;
};
constexpr Kind kKinds[] = {
    {"visibility", &Outputs::visibility, nullptr},
    {"bent-normal", nullptr, &Outputs::bent_normal},
    {"cone-angle", &Outputs::cone_angle, nullptr},
    {"uniform-integral", nullptr, &Outputs::uniform_integral},
    {"cosine-integral", nullptr, &Outputs::cosine_integral},
    {"standard-error", &Outputs::standard_error, nullptr},
};

const Kind* find_kind(const std::string& name) {
  for (const Kind& k : kKinds) {
    if (name == k.name) return &k;
  }
  return nullptr;
}

}  // namespace

std::string OutputImages::all_names() {
  std::string names;
  for (const Kind& k : kKinds) names += (names.empty() ? "" : ", ") + std::string(k.name);
  return names;
}

Status OutputImages::parse(const std::string& names, OutputImages* outputs) {
  OutputImages result;
  std::istringstream list(names);
  for (std::string name; std::getline(list, name, ',');) {
    if (!find_kind(name)) {
      return invalid_argument(
          fmt::format("--outputs names '{}'; it must be a list of {}", name, all_names()));
    }
    if (std::find(result.names_.begin(), result.names_.end(), name) != result.names_.end()) {
      return invalid_argument(fmt::format("--outputs names '{}' twice", name));
    }
    result.names_.push_back(name);
  }
  if (result.names_.empty()) {
    return invalid_argument("--outputs is empty; it must be a list of " + all_names());
  }
  *outputs = std::move(result);
  return {};
}

Status OutputImages::check_file(const std::string& path) const {
  if (path.ends_with(".exr") || names_.size() == 1) return {};
  return invalid_argument(
      fmt::format("--output {} can hold one result; name one in --outputs, or write .exr", path));
}

Outputs OutputImages::allocate(int width, int height) {
  image_ = tools::Image(width, height);
  Outputs outputs;
  for (const std::string& name : names_) {
    if (find_kind(name)->scalar) {
      image_.add(name);
    } else {
      for (const char* axis : {".X", ".Y", ".Z"}) image_.add(name + axis);
    }
  }
  // Views only now: adding a channel moves the others.
  int channel = 0;
  for (const std::string& name : names_) {
    const Kind& kind = *find_kind(name);
    if (kind.scalar) {
      outputs.*kind.scalar = image_.view(channel++);
    } else {
      outputs.*
          kind.vector = {image_.view(channel), image_.view(channel + 1), image_.view(channel + 2)};
      channel += 3;
    }
  }
  return outputs;
}

Status write_json(const tools::Report& report, const std::string& path) {
  if (path.empty()) return {};
  const std::string json = report.to_json();
  if (path == "-") {
    std::fputs(json.c_str(), stdout);
    return {};
  }
  return tools::write_text(path, json);
}

}  // namespace obscura::app
