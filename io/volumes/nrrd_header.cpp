#include "io/volumes/nrrd_header.h"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "io/images/atomic_file.h"
#include "obscura/settings.h"

namespace obscura::tools {
namespace {

constexpr std::int64_t kMostHeader = 1 << 20;

std::string trimmed(const std::string& s) {
  const std::size_t begin = s.find_first_not_of(" \t\r");
  if (begin == std::string::npos) return "";
  return s.substr(begin, s.find_last_not_of(" \t\r") - begin + 1);
}

std::string lower(std::string s) {
  for (char& c : s) c = char(std::tolower(static_cast<unsigned char>(c)));
  return s;
}

// "slice%03d.raw 1 20 1": the pattern with the numbers from the first to the last.
Status expand_pattern(const std::string& path, const std::string& text,
                      std::vector<std::string>* names) {
  std::istringstream in(text);
  std::string pattern, word;
  double range[3] = {0, 0, 1};
  in >> pattern;
  bool good = true;
  int count = 0;
  for (; good && in >> word && count < 4; ++count) {
    double n = 0;
    good = parse_number(word, &n) && n == std::floor(n) && std::abs(n) < 1e9;
    if (count < 3) range[count] = n;  // the fourth is the axis that the files lie along
  }
  // %d or %0Nd, once.
  const std::size_t percent = pattern.find('%');
  std::size_t end = percent + 1;
  while (end < pattern.size() && std::isdigit(static_cast<unsigned char>(pattern[end]))) ++end;
  good = good && count >= 3 && range[2] != 0 && end < pattern.size() && pattern[end] == 'd' &&
         end - percent <= 3 && pattern.find('%', end) == std::string::npos;
  const double steps = good ? (range[1] - range[0]) / range[2] : -1;
  if (!(steps >= 0 && steps < 65536)) {
    return invalid_input(fmt::format(
        "{}: its data file is \"{:.80}\"; a pattern has the form NAME%03d.raw FIRST LAST "
        "STEP",
        path, text));
  }
  const std::string digits = pattern.substr(percent + 1, end - percent - 1);
  const bool zeros = digits.starts_with('0');
  const int width = digits.empty() ? 0 : std::stoi(digits);
  for (int i = 0; i <= static_cast<int>(steps); ++i) {
    const auto n = static_cast<std::int64_t>(range[0] + i * range[2]);
    const std::string number =
        zeros ? fmt::format("{:0{}}", n, width) : fmt::format("{:{}}", n, width);
    names->push_back(pattern.substr(0, percent) + number + pattern.substr(end + 1));
  }
  return {};
}

}  // namespace

Status read_nrrd_header(const std::string& path, NrrdHeader* header) {
  if (Status s = check_readable(path); !s.ok()) return s;
  std::ifstream file(path, std::ios::binary);
  std::string line(8, '\0');
  file.read(line.data(), 8);
  if (!file || line.substr(0, 7) != "NRRD000") {
    return invalid_input(fmt::format("{}: is not NRRD; it does not begin with NRRD000", path));
  }
  std::getline(file, line);
  std::int64_t total = 0;
  while (std::getline(file, line)) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (line.empty()) {
      header->end = file.tellg();
      return {};
    }
    total += std::int64_t(line.size());
    if (total > kMostHeader) break;
    if (line[0] == '#') continue;
    const std::size_t colon = line.find(':');
    if (colon == std::string::npos) {
      return invalid_input(
          fmt::format("{}: its header has a line without a colon: \"{:.60}\"", path, line));
    }
    if (colon + 1 < line.size() && line[colon + 1] == '=') continue;  // the user's own
    const std::string key = lower(trimmed(line.substr(0, colon)));
    header->fields[key] = trimmed(line.substr(colon + 1));
    // The names of the data's files are the header's last lines.
    if ((key == "data file" || key == "datafile") && header->fields[key].starts_with("LIST")) {
      while (std::getline(file, line) && total < kMostHeader) {
        total += std::int64_t(line.size()) + 1;
        if (!trimmed(line).empty()) header->data_files.push_back(trimmed(line));
      }
      break;
    }
  }
  header->end = -1;  // allowed where the data lie elsewhere
  return {};
}

Status find_nrrd_data(const std::string& path, const NrrdHeader& h, std::vector<std::string>* data,
                      std::int64_t* offset) {
  std::string name = h.get("data file");
  if (name.empty()) name = h.get("datafile");
  *offset = 0;
  std::vector<std::string> names;
  if (name.starts_with("LIST")) {
    names = h.data_files;
    if (names.empty()) {
      return invalid_input(fmt::format("{}: its data file is LIST, but no file follows", path));
    }
  } else if (name.find('%') != std::string::npos) {
    if (Status s = expand_pattern(path, name, &names); !s.ok()) return s;
  } else if (!name.empty()) {
    names = {name};
  } else {
    if (h.end < 0) {
      return invalid_input(
          fmt::format("{}: its header has no end; a blank line or a data file is missing", path));
    }
    *data = {path};
    *offset = h.end;
    return {};
  }
  for (const std::string& n : names) {
    data->push_back((std::filesystem::path(path).parent_path() / n).string());
  }
  return {};
}

}  // namespace obscura::tools
