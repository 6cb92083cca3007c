#include "io/meshes/read_obj.h"

#include <fmt/format.h>

#include "io/meshes/words.h"

namespace obscura::tools {
namespace {

class ObjReader {
 public:
  ObjReader(const std::string& path, std::string_view bytes, MeshBuilder* builder)
      : path_(path), lines_(bytes), builder_(*builder) {}

  Status read() {
    std::string_view line;
    std::string joined;
    while (lines_.next(&line)) {
      while (line.ends_with('\\')) {
        // A longer logical line than any real one: a file of backslashes is not to be copied again
        // and again.
        if (joined.size() > kLongestLine) return wrong("is longer than 1 MiB");
        joined.append(line.data(), line.size() - 1);
        joined += ' ';
        if (!lines_.next(&line)) line = {};
      }
      if (!joined.empty()) {
        joined.append(line);
        line = joined;
      }
      if (Status s = read_line(line); !s.ok()) return s;
      joined.clear();
    }
    return add_faces();
  }

 private:
  static constexpr std::size_t kLongestLine = 1 << 20;

  struct Face {
    std::size_t line, end;  // in the file; behind its last corner
  };

  Status wrong_in(std::size_t line, const std::string& what) const {
    return invalid_input(fmt::format("{}: line {} {}", path_, line, what));
  }
  Status wrong(const std::string& what) const { return wrong_in(lines_.number(), what); }

  Status read_line(std::string_view line) {
    Words words(line.substr(0, line.find('#')));
    const std::string_view keyword = words.next();
    if (keyword == "v") return read_vertex(words);
    if (keyword == "f" || keyword == "fo") return read_face(words);
    return {};
  }

  Status read_vertex(Words& words) {
    double p[3];
    for (double& x : p) {
      const std::string_view word = words.next();
      if (!parse_number(word, &x)) {
        return wrong(fmt::format("has '{}' for a coordinate", printable(word)));
      }
    }
    builder_.add_vertex({p[0], p[1], p[2]}, false);
    return {};
  }

  // Faces may name vertices that follow, so they are kept until all are known.
  Status read_face(Words& words) {
    for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
      std::int64_t index = 0;
      if (!parse_number(word.substr(0, word.find('/')), &index) || index == 0) {
        return wrong(fmt::format("has '{}' for a corner", printable(word)));
      }
      corners_.push_back(index > 0 ? index - 1 : std::int64_t(builder_.vertex_count()) + index);
    }
    faces_.push_back({lines_.number(), corners_.size()});
    return {};
  }

  Status add_faces() {
    const auto count = std::int64_t(builder_.vertex_count());
    std::vector<std::uint32_t> polygon;
    std::size_t first = 0;
    for (const Face& face : faces_) {
      polygon.clear();
      for (std::size_t i = first; i < face.end; ++i) {
        const std::int64_t corner = corners_[i];
        if (corner < 0 || corner >= count) {
          return wrong_in(face.line, fmt::format("names vertex {} of {}", corner + 1, count));
        }
        polygon.push_back(std::uint32_t(corner));
      }
      builder_.add_polygon(polygon);
      first = face.end;
    }
    return {};
  }

  const std::string& path_;
  Lines lines_;
  MeshBuilder& builder_;
  std::vector<std::int64_t> corners_;
  std::vector<Face> faces_;
};

}  // namespace

Status read_obj(const std::string& path, std::string_view bytes, MeshBuilder* builder) {
  return ObjReader(path, bytes, builder).read();
}

}  // namespace obscura::tools
