#include "io/sequences/camera_list.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

namespace obscura::tools {
namespace {

constexpr const char* kFlat = "[1,0,0,0, 0,2,0,0, 0,0,-1,-0.1, 0,0,-1,0]";
constexpr const char* kRows = "[[1,0,0,0],[0,2,0,0],[0,0,-1,-0.1],[0,0,-1,0]]";

class CameraList : public testing::Test {
 protected:
  ~CameraList() override { std::filesystem::remove(path_); }
  Status read(const std::string& text, const std::vector<int>& frames) {
    std::ofstream(path_) << text;
    return read_cameras(path_, frames, &cameras_);
  }
  const std::string path_ =
      std::filesystem::temp_directory_path() / ("obscura-cameras-" + std::to_string(getpid()));
  std::vector<ProjectionMatrix> cameras_;
};

TEST_F(CameraList, ListsAndObjectsOfMatrices) {
  const std::string flat = kFlat, rows = kRows;
  ASSERT_TRUE(read("[" + flat + "," + rows + "]", {3, 5}).ok());
  ASSERT_EQ(cameras_.size(), 2u);
  EXPECT_EQ(cameras_[0], cameras_[1]);
  EXPECT_EQ(cameras_[0][5], 2);
  EXPECT_EQ(cameras_[0][11], -0.1);
  ASSERT_TRUE(read("{\"5\": " + flat + ", \"4\": " + flat + ", \"3\": " + rows + "}", {3, 5}).ok());
  EXPECT_EQ(cameras_.size(), 2u);
}

TEST_F(CameraList, SaysWhichFrameHasNoMatrix) {
  const std::string flat = kFlat;
  EXPECT_NE(read("[" + flat + "]", {3, 5}).message().find("1 matrices for the 2 frames"),
            std::string::npos);
  EXPECT_NE(read("{\"3\": " + flat + "}", {3, 5}).message().find("no matrix for frame 5"),
            std::string::npos);
  EXPECT_NE(read("{\"3\": [1, 2]}", {3}).message().find("the matrix of frame 3 must be"),
            std::string::npos);
}

TEST_F(CameraList, RefusesWhatIsNoListOfMatrices) {
  std::string deep(100000, '[');
  for (const std::string& text :
       {std::string(""), std::string("7"), std::string("[[1e999]]"), std::string("{\"3\": null}"),
        std::string("[[\"a\"]]"), std::string("[[[1,2],[3]]]"), std::string("[1"), deep}) {
    EXPECT_FALSE(read(text, {3}).ok()) << text.substr(0, 20);
    EXPECT_TRUE(cameras_.empty());
  }
}

}  // namespace
}  // namespace obscura::tools
