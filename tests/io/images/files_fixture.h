#ifndef OBSCURA_TESTS_IO_IMAGES_FILES_FIXTURE_H_
#define OBSCURA_TESTS_IO_IMAGES_FILES_FIXTURE_H_

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <sstream>
#include <string>

#include "io/images/image.h"

namespace obscura::tools {

// A test with a folder of its own.
class FilesTest : public testing::Test {
 protected:
  FilesTest() {
    std::string pattern = (std::filesystem::temp_directory_path() / "obscura-XXXXXX").string();
    folder_ = mkdtemp(pattern.data());
  }
  ~FilesTest() override { std::filesystem::remove_all(folder_); }

  std::string path(const std::string& name) const { return folder_ + "/" + name; }
  void write(const std::string& name, const std::string& bytes) const {
    std::ofstream(path(name), std::ios::binary) << bytes;
  }
  std::string content(const std::string& name) const {
    std::ifstream in(path(name), std::ios::binary);
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
  }
  std::ptrdiff_t files_in_folder() const {
    return std::distance(std::filesystem::directory_iterator(folder_), {});
  }

  std::string folder_;
};

// Channels whose values all differ, in steps of 1/8.
inline Image ramp(int width, int height, std::initializer_list<const char*> names) {
  Image image(width, height);
  float v = 0;
  for (const char* name : names) {
    for (float& x : image.add(name)) x = v += 0.125f;
  }
  return image;
}

}  // namespace obscura::tools

#endif  // OBSCURA_TESTS_IO_IMAGES_FILES_FIXTURE_H_
