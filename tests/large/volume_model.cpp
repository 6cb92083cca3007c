// Writes a gyroid of any size plane by plane, as bytes, x fastest; matter has values above 120.
// usage: obscura_volume_model NX NY NZ FILE.raw
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <vector>

int main(int argc, char** argv) {
  int size[3] = {};
  for (int a = 0; a < 3 && argc == 5; ++a) size[a] = std::atoi(argv[1 + a]);
  if (size[0] < 1 || size[1] < 1 || size[2] < 1) {
    std::fputs("usage: obscura_volume_model NX NY NZ FILE.raw\n", stderr);
    return 2;
  }
  // A cell of the gyroid has 85 voxels along a side.
  auto phase = [](int i) { return 0.0739f * static_cast<float>(i); };
  std::vector<float> sine(static_cast<std::size_t>(size[0])), cosine(sine.size());
  for (int x = 0; x < size[0]; ++x) {
    sine[static_cast<std::size_t>(x)] = std::sin(phase(x));
    cosine[static_cast<std::size_t>(x)] = std::cos(phase(x));
  }
  std::ofstream out(argv[4], std::ios::binary);
  std::vector<std::uint8_t> row(sine.size());
  for (int z = 0; z < size[2]; ++z) {
    const float sz = std::sin(phase(z)), cz = std::cos(phase(z));
    for (int y = 0; y < size[1]; ++y) {
      const float sy = std::sin(phase(y)), cy = std::cos(phase(y));
      for (std::size_t x = 0; x < row.size(); ++x) {
        const float f = sine[x] * cy + sy * cz + sz * cosine[x];
        row[x] = static_cast<std::uint8_t>(std::clamp((f + 1.5f) * 80, 0.0f, 255.0f));
      }
      out.write(reinterpret_cast<const char*>(row.data()),
                static_cast<std::streamsize>(row.size()));
    }
  }
  out.close();
  return out.good() ? 0 : 1;
}
