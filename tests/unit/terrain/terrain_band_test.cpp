#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <mutex>

#include "obscura/terrain.h"
#include "tests/reference/terrain.h"

// Models computed band by band against the whole.
namespace obscura {
namespace {

using reference::Model;

class MemoryHulls final : public TerrainHulls {
 public:
  Status begin(int sweep) override {
    sweep_ = sweep;
    return {};
  }
  Status put(int column, std::span<const TerrainHullPoint> hull) override {
    const std::lock_guard lock(mutex_);
    most_ = std::max(most_, hull.size());
    const bool added = lines_.try_emplace({sweep_, column}, hull.begin(), hull.end()).second;
    return added ? Status() : Status(StatusCode::kInternal, "a second hull in a column");
  }
  Status get(int column, std::vector<TerrainHullPoint>* hull) override {
    const std::lock_guard lock(mutex_);
    const auto found = lines_.find({sweep_, column});
    if (found == lines_.end()) return {StatusCode::kInternal, "no such hull"};
    *hull = found->second;
    return {};
  }
  std::size_t most() const { return most_; }
  auto& lines() { return lines_; }

 private:
  std::mutex mutex_;
  std::map<std::pair<int, int>, std::vector<TerrainHullPoint>> lines_;
  int sweep_ = -1;
  std::size_t most_ = 0;
};

// Every quantity and the horizons.
struct Results {
  Results(int width, int height, int azimuths)
      : values(8 + azimuths, std::vector<float>(std::size_t(width) * height)), width(width) {}

  // Of rows from `first` on.
  TerrainOutputs rows(int first, int count) {
    views.clear();
    for (auto& v : values) {
      views.emplace_back(v.data() + std::size_t(first) * width, width, count);
    }
    TerrainOutputs o;
    o.svf = views[0];
    o.svf_normal = views[1];
    o.svf_cosine = views[2];
    o.openness = views[3];
    o.negative_openness = views[4];
    o.visible_sky = views[5];
    o.asvf = views[6];
    o.local_dominance = views[7];
    o.horizon = std::span(views).subspan(8);
    return o;
  }
  std::vector<std::vector<float>> values;
  std::vector<ImageView<float>> views;
  int width;
};

class Bands {
 public:
  Bands(const Model& m, TerrainSettings settings, std::span<const double> row_widths = {})
      : m_(m), settings_(settings), results(m.width, m.height, settings.azimuths) {
    whole_ = m.view();
    whole_.row_widths = row_widths;
    whole_.datum = 0.25;
  }
  Results whole() {
    Results r(m_.width, m_.height, settings_.azimuths);
    const Status s = compute_terrain(whole_, settings_, r.rows(0, m_.height));
    EXPECT_TRUE(s.ok()) << s.message();
    return r;
  }
  // In bands from row to row.
  void run(const std::vector<int>& rows) {
    for (const bool up : {false, true}) {
      std::unique_ptr<MemoryHulls> from, to;
      const int count = int(rows.size()) - 1;
      for (int i = 0; i < count; ++i) {
        const int b = up ? count - 1 - i : i;
        to = i + 1 < count ? std::make_unique<MemoryHulls>() : nullptr;
        const Status s = run_band(rows[b], rows[b + 1], up, from.get(), to.get());
        ASSERT_TRUE(s.ok()) << s.message();
        if (to) most = std::max(most, to->most());
        from = std::move(to);
      }
    }
  }
  Status run_band(int begin, int end, bool up, TerrainHulls* from, TerrainHulls* to) {
    const int above = std::min(begin, kTerrainBandHalo);
    const int below = std::min(m_.height - end, kTerrainBandHalo);
    ElevationModel model = whole_;
    const int rows = above + end - begin + below;
    const float* first = m_.heights.data() + std::size_t(begin - above) * m_.width;
    // A copy, so that a sanitizer sees what lies beyond it.
    std::vector<float> copy(first, first + std::size_t(rows) * m_.width);
    model.heights = {copy.data(), m_.width, rows};
    model.inner = {0, above, m_.width, end - begin};
    TerrainBand band;
    band.height = m_.height;
    band.row = begin - above;
    band.up = up;
    band.from = from;
    band.to = to;
    if (change) change(model, band);
    return compute_terrain_band(model, band, settings_, results.rows(begin, end - begin));
  }

  std::function<void(ElevationModel&, TerrainBand&)> change;

 private:
  const Model& m_;
  const TerrainSettings settings_;
  ElevationModel whole_;

 public:
  Results results;
  std::size_t most = 0;
};

void expect_same_bits(const Results& a, const Results& b) {
  for (std::size_t v = 0; v < a.values.size(); ++v) {
    int different = 0;
    for (std::size_t i = 0; i < a.values[v].size(); ++i) {
      const float x = a.values[v][i], y = b.values[v][i];
      different += !(x == y || (std::isnan(x) && std::isnan(y)));
    }
    EXPECT_EQ(different, 0) << "output " << v;
  }
}

Model mountains_with_holes(int width, int height) {
  Model m = reference::mountains(width, height, 30, 600);
  for (int y = 60; y < 90 && y < height; ++y) {
    for (int x = 50; x < 58 && x < width; ++x) m(x, y) = std::numeric_limits<float>::quiet_NaN();
  }
  for (int x = 0; x < width; x += 7)
    m(x, (x * 5) % height) = std::numeric_limits<float>::infinity();
  return m;
}

TEST(TerrainBand, HasTheBitsOfTheWhole) {
  const Model m = mountains_with_holes(310, 270);
  for (const int azimuths : {1, 16, 37}) {
    TerrainSettings settings;
    settings.azimuths = azimuths;
    Bands bands(m, settings);
    bands.run({0, 100, 101, 190, 270});
    expect_same_bits(bands.results, bands.whole());
  }
  Bands bands(m, {});
  bands.run({0, 270});
  expect_same_bits(bands.results, bands.whole());
}

TEST(TerrainBand, HasTheBitsOfTheWholeInAnyShapeAndOnARoundEarth) {
  for (const auto& size : {std::array{40, 300}, {300, 40}, {1, 150}, {150, 1}, {133, 128}}) {
    Model m = mountains_with_holes(size[0], size[1]);
    m.cell_height = 45;
    TerrainSettings settings;
    settings.curvature = true;
    settings.refraction = 0.13;
    Bands bands(m, settings);
    std::vector<int> rows;
    for (int y = 0; y < size[1]; y += 37) rows.push_back(y);
    rows.push_back(size[1]);
    bands.run(rows);
    expect_same_bits(bands.results, bands.whole());
  }
}

// Rows of five widths: each is swept for itself, through all bands.
TEST(TerrainBand, HasTheBitsOfTheWholeOnAGeographicGrid) {
  const Model m = mountains_with_holes(120, 200);
  std::vector<double> widths;
  for (int y = 0; y < 200; ++y) widths.push_back(30 * std::cos(0.9 + 0.0004 * y));
  Bands bands(m, {}, widths);
  bands.run({0, 33, 120, 121, 200});
  expect_same_bits(bands.results, bands.whole());
}

TEST(TerrainBand, HasTheBitsOfTheWholeForShortRadii) {
  const Model m = mountains_with_holes(150, 200);
  for (const double cells : {1.0, 10.0, 24.0}) {
    TerrainSettings settings;
    settings.radius = 30 * cells;
    Bands bands(m, settings);
    bands.run({0, 65, 70, 140, 200});
    expect_same_bits(bands.results, bands.whole());
  }
}

// Every cell of a bowl is seen from every other: no point may be left out.
TEST(TerrainBand, HandsOnEveryPointOfABowl) {
  Model m(180, 220, 10, 10);
  m.fill([](double x, double y) { return 1e-4 * (x * x + y * y); });
  for (const int azimuths : {4, 16}) {
    TerrainSettings settings;
    settings.azimuths = azimuths;
    Bands bands(m, settings);
    bands.run({0, 60, 110, 160, 220});
    if (azimuths == 4) {
      EXPECT_EQ(bands.most, 160u);
    }
    expect_same_bits(bands.results, bands.whole());
  }
}

TEST(TerrainBand, LostHullsAndWhatIsWrongAreNamed) {
  const Model m = reference::mountains(90, 200, 30, 600);
  Bands bands(m, {});
  MemoryHulls hulls, next;
  ASSERT_TRUE(bands.run_band(0, 80, false, nullptr, &hulls).ok());
  auto message = [&](auto&& change) {
    bands.change = change;
    next.lines().clear();
    const Status s = bands.run_band(80, 130, false, &hulls, &next);
    EXPECT_FALSE(s.ok());
    return s.message();
  };
  auto expect = [&](const char* part, auto&& change) {
    const std::string text = message(change);
    EXPECT_NE(text.find(part), std::string::npos) << text;
  };
  expect("band.height is 0", [](auto&, auto& b) { b.height = 0; });
  expect("band.row is 100", [](auto&, auto& b) { b.row = 100; });
  expect("inner is 80 cells wide", [](auto& m, auto&) { m.inner.width = 80; });
  expect("inner has 30 rows above", [](auto& m, auto&) { m.inner.y = 30; });
  expect("datum is missing", [](auto& m, auto&) { m.datum.reset(); });
  expect("datum is inf", [](auto& m, auto&) { m.datum = INFINITY; });
  expect("band.from or band.to is missing", [](auto&, auto& b) { b.to = nullptr; });
  MemoryHulls none;
  expect("no such hull", [&](auto&, auto& b) { b.from = &none; });
  auto damage = [&](const TerrainHullPoint& point) {
    return [&hulls, &none, point](auto&, TerrainBand& b) {
      none.lines() = hulls.lines();
      auto& hull = none.lines().begin()->second;
      hull.insert(hull.begin() + 1, point);
      b.from = &none;
    };
  };
  expect("are not those of this model", damage({1, 80}));
  expect("are not those of this model", damage({1, -1}));
  expect("are not those of this model", damage({1, 1 << 30}));
  bands.change = nullptr;
  next.lines().clear();
  EXPECT_TRUE(bands.run_band(80, 130, false, &hulls, &next).ok());
}

TEST(TerrainBand, LongFiniteRadiiAreRefused) {
  const Model m = reference::mountains(90, 200, 30, 600);
  TerrainSettings settings;
  settings.radius = 30 * 40;
  Bands bands(m, settings);
  const Status s = bands.run_band(0, 200, false, nullptr, nullptr);
  EXPECT_NE(s.message().find("radius is 1200; bands need infinity, or less than 750"),
            std::string::npos)
      << s.message();
}

}  // namespace
}  // namespace obscura
