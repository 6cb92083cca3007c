#ifndef OBSCURA_IO_MESHES_GLTF_DOCUMENT_H_
#define OBSCURA_IO_MESHES_GLTF_DOCUMENT_H_

#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "io/meshes/vec3.h"
#include "nlohmann/json.hpp"

namespace obscura::tools {

// What is wrong with a glTF file; used inside its reader only.
struct GltfError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// The JSON of a glTF file, its buffers and typed access to both. Every access is checked; the first
// that fails throws GltfError with a clause that names the element.
class GltfDocument {
 public:
  using Json = nlohmann::json;

  GltfDocument(std::string path, std::string_view bytes);

  const Json& root() const { return root_; }
  std::size_t total_bytes() const { return total_bytes_; }

  // Element `index` of a top-level array such as "meshes".
  const Json& element(const char* array, std::int64_t index) const;
  std::size_t size(const char* array) const;
  // A whole number that is not negative; `fallback` where the key is absent.
  static std::int64_t whole(const Json& object, const char* key, std::int64_t fallback);
  static std::vector<double> numbers(const Json& object, const char* key, std::size_t count);

  std::vector<Vec3> positions(std::int64_t accessor, bool* single_precision);
  std::vector<std::uint32_t> indices(std::int64_t accessor);

 private:
  struct Span {
    const std::uint8_t* data;
    std::size_t stride;
  };

  void parse_container(std::string_view bytes);
  void parse_json(std::string_view text);
  std::string_view buffer(std::int64_t index);
  std::string load_uri(const std::string& uri) const;
  Span span(const Json& view_owner, std::int64_t count, std::size_t element_bytes);
  template <class Read>
  void read_sparse(const Json& accessor, std::int64_t count, std::size_t element_bytes, Read read);

  const std::string path_;
  Json root_;
  std::string_view binary_;           // of a GLB
  std::vector<std::string> buffers_;  // loaded from URIs
  std::vector<bool> loaded_;
  std::size_t total_bytes_ = 0;
};

}  // namespace obscura::tools

#endif  // OBSCURA_IO_MESHES_GLTF_DOCUMENT_H_
