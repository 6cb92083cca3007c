#ifndef OBSCURA_TESTS_IO_MESHES_TEMPORARY_FOLDER_H_
#define OBSCURA_TESTS_IO_MESHES_TEMPORARY_FOLDER_H_

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace obscura::tools {

// A folder for the files of one test, removed with it.
class TemporaryFolder : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() /
              ("obscura_" + std::to_string(::getpid()) + "_" +
               testing::UnitTest::GetInstance()->current_test_info()->name());
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string write(const std::string& name, const std::string& contents) {
    const std::string path = (folder_ / name).string();
    std::ofstream(path, std::ios::binary) << contents;
    return path;
  }

  std::filesystem::path folder_;
};

}  // namespace obscura::tools

#endif  // OBSCURA_TESTS_IO_MESHES_TEMPORARY_FOLDER_H_
