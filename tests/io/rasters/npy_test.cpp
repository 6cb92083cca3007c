#include "io/rasters/npy.h"

#include <gtest/gtest.h>

namespace obscura::tools {
namespace {

std::string npy(const std::string& dictionary, const std::string& data) {
  std::string bytes = "\x93NUMPY";
  bytes += {'\1', '\0', static_cast<char>(dictionary.size()), '\0'};
  return bytes + dictionary + data;
}

TEST(Npy, KeepsWhatItWrites) {
  Image image(3, 2);
  image.add("a") = {1, 2, 3, 4, 5, 6.5f};
  std::string bytes;
  encode_npy(image, &bytes);
  EXPECT_EQ(bytes.size() % 64, 6 * sizeof(float));
  Image read;
  ASSERT_TRUE(decode_npy(bytes, "x.npy", &read).ok());
  EXPECT_EQ(read.width, 3);
  EXPECT_EQ(read.height, 2);
  EXPECT_EQ(read.channels[0].values, image.channels[0].values);
}

TEST(Npy, ReadsEveryOrderAndType) {
  Image read;
  ASSERT_TRUE(decode_npy(npy("{'descr': '>i2', 'fortran_order': False, 'shape': (2, 1), }\n",
                             std::string("\x01\x02\xff\xfe", 4)),
                         "x", &read)
                  .ok());
  EXPECT_EQ(read.channels[0].values, (std::vector<float>{258, -2}));
  ASSERT_TRUE(decode_npy(npy("{'descr': '|u1', 'fortran_order': True, 'shape': (2, 3), }\n",
                             std::string("\x01\x02\x03\x04\x05\x06", 6)),
                         "x", &read)
                  .ok());
  EXPECT_EQ(read.channels[0].values, (std::vector<float>{1, 3, 5, 2, 4, 6}));
}

TEST(Npy, RefusesWhatItIsNot) {
  Image read;
  auto message = [&](const std::string& bytes) {
    const Status s = decode_npy(bytes, "x.npy", &read);
    EXPECT_EQ(s.code(), StatusCode::kInvalidInput);
    return s.message();
  };
  auto expect = [&](const char* part, const std::string& bytes) {
    EXPECT_NE(message(bytes).find(part), std::string::npos) << message(bytes);
  };
  expect("no NumPy header", "");
  expect("no NumPy header", "PK\3\4 a zip file");
  expect("truncated", std::string("\x93NUMPY\1\0\xff\xff{'descr", 17));
  expect("two axes", npy("{'descr': '<f4', 'fortran_order': False, 'shape': (4,), }", "1234"));
  expect("two axes", npy("{'descr': '<f4', 'fortran_order': False, 'shape': (1, 1, 1), }", "1234"));
  expect("truncated", npy("{'descr': '<f4', 'fortran_order': False, 'shape': (2, 2), }", "1234"));
  expect("its shape is (0, 2)",
         npy("{'descr': '<f4', 'fortran_order': False, 'shape': (0, 2), }", ""));
  expect("its shape is",
         npy("{'descr': '<f4', 'fortran_order': False, 'shape': (99999999, 9), }", ""));
  expect("integers, float32",
         npy("{'descr': '<c8', 'fortran_order': False, 'shape': (1, 1), }", "12345678"));
  expect("no plain numbers", npy("{'descr': [('x', '<f4')], 'shape': (1, 1), }", "1234"));
}

}  // namespace
}  // namespace obscura::tools
