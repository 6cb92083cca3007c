#include "io/sequences/camera_list.h"

#include <cmath>

#include "fmt/format.h"
#include "io/images/atomic_file.h"
#include "nlohmann/json.hpp"

namespace obscura::tools {
namespace {

using nlohmann::json;

constexpr std::size_t kMostBytes = std::size_t{1} << 28;
constexpr int kDeepest = 8;

bool read_matrix(const json& value, ProjectionMatrix* matrix) {
  std::vector<json> numbers;
  if (!value.is_array()) return false;
  for (const json& row : value) {
    if (!row.is_array()) {
      numbers.push_back(row);
    } else if (row.size() == 4 && value.size() == 4) {
      numbers.insert(numbers.end(), row.begin(), row.end());
    } else {
      return false;
    }
  }
  if (numbers.size() != 16) return false;
  for (std::size_t k = 0; k < 16; ++k) {
    if (!numbers[k].is_number()) return false;
    (*matrix)[k] = numbers[k].get<double>();
    if (!std::isfinite((*matrix)[k])) return false;
  }
  return true;
}

// JSON nested so deeply that parsing it would exhaust the stack is none of ours.
bool too_deep(int depth, json::parse_event_t, json&) {
  if (depth > kDeepest) throw std::runtime_error("it is nested too deeply");
  return true;
}

}  // namespace

Status read_cameras(const std::string& path, const std::vector<int>& frames,
                    std::vector<ProjectionMatrix>* cameras) {
  std::string text;
  if (Status s = read_bytes(path, &text, kMostBytes); !s.ok()) return s;
  json root;
  try {
    root = json::parse(text, too_deep);
  } catch (const std::exception& e) {
    return invalid_input(fmt::format("{}: not a JSON file of matrices ({})", path, e.what()));
  }
  if (!root.is_array() && !root.is_object()) {
    return invalid_input(fmt::format(
        "{}: it must be a list with a matrix per frame, or an object of frame numbers and matrices",
        path));
  }
  if (root.is_array() && root.size() != frames.size()) {
    return invalid_input(
        fmt::format("{}: it has {} matrices for the {} frames of --frames; a list must have one "
                    "per frame, an object of frame numbers may have more",
                    path, root.size(), frames.size()));
  }
  std::vector<ProjectionMatrix> list(frames.size());
  for (std::size_t k = 0; k < frames.size(); ++k) {
    const std::string name = std::to_string(frames[k]);
    if (root.is_object() && !root.contains(name)) {
      return invalid_input(fmt::format("{}: it has no matrix for frame {}", path, name));
    }
    if (!read_matrix(root.is_object() ? root[name] : root[k], &list[k])) {
      return invalid_input(fmt::format(
          "{}: the matrix of frame {} must be 16 finite numbers, or 4 rows of 4", path, name));
    }
  }
  *cameras = std::move(list);
  return {};
}

}  // namespace obscura::tools
