#ifndef OBSCURA_TESTS_SCENE_VOLUMES_VOLUME_FILES_H_
#define OBSCURA_TESTS_SCENE_VOLUMES_VOLUME_FILES_H_

#include <gtest/gtest.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "scene/volumes/load_volume.h"

namespace obscura::tools {

// A test with a folder of its own.
class VolumeFileTest : public testing::Test {
 protected:
  VolumeFileTest() {
    std::string pattern = (std::filesystem::temp_directory_path() / "obscura-XXXXXX").string();
    folder_ = mkdtemp(pattern.data());
  }
  ~VolumeFileTest() override { std::filesystem::remove_all(folder_); }

  std::string path(const std::string& name) const { return folder_ + "/" + name; }
  std::string write(const std::string& name, const std::string& bytes) const {
    std::ofstream(path(name), std::ios::binary) << bytes;
    return path(name);
  }
  std::string write_gzip(const std::string& name, const std::string& bytes) const {
    gzFile file = gzopen(path(name).c_str(), "wb");
    gzwrite(file, bytes.data(), unsigned(bytes.size()));
    gzclose(file);
    return path(name);
  }
  // Loading fails with one line that holds `part`, and leaves the volume alone.
  static void expect_refused(const std::string& spec, const std::string& part,
                             const std::optional<RawLayout>& raw = {}) {
    VolumeImage image;
    image.name = "untouched";
    const Status s = load_volume(spec, raw, &image);
    EXPECT_FALSE(s.ok()) << spec;
    EXPECT_NE(s.message().find(part), std::string::npos) << s.message();
    EXPECT_EQ(s.message().find('\n'), std::string::npos) << s.message();
    EXPECT_EQ(image.name, "untouched");
  }

  std::string folder_;
};

inline float value_at(const VolumeImage& image, int x, int y, int z) {
  std::vector<float> row(std::size_t(image.size[0]));
  volume_row(image.view(), y, z, row.data());
  return row[std::size_t(x)];
}

template <class T>
std::string bytes_of_values(const std::vector<T>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

// NIfTI-1, field by field at its offset.
struct NiftiBytes {
  std::string bytes = std::string(352, '\0');
  bool big = false;

  template <class T>
  NiftiBytes& put(int offset, T value) {
    char field[sizeof(T)];
    std::memcpy(field, &value, sizeof(T));
    if (big) std::reverse(field, field + sizeof(T));
    bytes.replace(std::size_t(offset), sizeof(T), field, sizeof(T));
    return *this;
  }
  NiftiBytes(int nx, int ny, int nz, int datatype, bool big_endian = false) : big(big_endian) {
    put<std::int32_t>(0, 348);
    const int dim[] = {3, nx, ny, nz, 1, 1, 1, 1};
    for (int i = 0; i < 8; ++i) put<std::int16_t>(40 + 2 * i, std::int16_t(dim[i]));
    put<std::int16_t>(70, std::int16_t(datatype));
    for (int i = 0; i < 4; ++i) put<float>(76 + 4 * i, 1);
    put<float>(108, 352);
    bytes.replace(344, 4, "n+1\0", 4);
  }
  std::string with(const std::string& data) const { return bytes + data; }
};

}  // namespace obscura::tools

#endif  // OBSCURA_TESTS_SCENE_VOLUMES_VOLUME_FILES_H_
