// SPDX-License-Identifier: BSD-3-Clause
// Undistortion, and rolling-shutter rectification.
#include "undistortion.h"

#include <gtest/gtest.h>

#include <cmath>

#include "edgevo/edges/frame_pyramid.h"

namespace edgevo {
namespace {

// A smooth image, so that gray levels reveal positions: `shown(u, v)` is the position in the image of the
// scene that pixel (u, v) shows.
template <class F>
GrayImage picture(int width, int height, const F& shown) {
  GrayImage image{width, height, std::vector<uint8_t>(size_t(width) * height)};
  for (int v = 0; v < height; ++v)
    for (int u = 0; u < width; ++u) {
      const Eigen::Vector2d p = shown(double(u), double(v));
      image.pixels[size_t(v) * width + u] =
          uint8_t(std::lround(128 + 60 * std::sin(p.x() / 9) + 50 * std::cos(p.y() / 7)));
    }
  return image;
}

GrayImage still(int width, int height) {
  return picture(width, height, [](double u, double v) { return Eigen::Vector2d(u, v); });
}

Camera lens(int width, int height) {
  return {{0.9 * width, 0.9 * width, 0.49 * width, 0.51 * height, width, height}, {-0.2, 0, 0, 0, 0}};
}

int largest_difference(const Plane<uint8_t>& a, const Plane<uint8_t>& b, int border) {
  int largest = 0;
  for (int y = border; y < a.height() - border; ++y)
    for (int x = border; x < a.width() - border; ++x)
      largest = std::max(largest, std::abs(int(a.row(y)[x]) - int(b.row(y)[x])));
  return largest;
}

TEST(ShiftedUndistortion, WithoutAShiftIsUndistortion) {
  for (const auto& [width, height] : {std::pair(300, 170), {257, 33}, {64, 48}}) {
    const RectificationMaps maps = Rectification(lens(width, height)).maps();
    const GrayImage image = still(width, height);
    Plane<uint8_t> plain(width, height), shifted(width, height);
    Undistortion(maps, width, height).apply(image.view(), &plain);
    ShiftedUndistortion(maps).apply(ShiftGrid(width, height), image.view(), &shifted);
    EXPECT_LE(largest_difference(plain, shifted, 0), 1) << width << "x" << height;
  }
}

TEST(ShiftedUndistortion, SamplesAtTheShiftedPosition) {
  const int width = 270, height = 150;
  const Camera pinhole(lens(width, height).pinhole());
  ShiftGrid shift(width, height);
  const auto dx = [](double u, double v) { return 3 + 0.01 * u - 0.02 * v; };
  const auto dy = [](double u, double v) { return -2 + 0.015 * v + 0.005 * u; };
  for (int row = 0; row < shift.rows(); ++row)
    for (int column = 0; column < shift.columns(); ++column) {
      const double u = column * ShiftGrid::kCell, v = row * ShiftGrid::kCell;
      shift.set(column, row, float(dx(u, v)), float(dy(u, v)));
    }
  Plane<uint8_t> out(width, height);
  ShiftedUndistortion(Rectification(pinhole).maps()).apply(shift, still(width, height).view(), &out);
  const GrayImage expected =
      picture(width, height, [&](double u, double v) { return Eigen::Vector2d(u + dx(u, v), v + dy(u, v)); });
  for (int v = 12; v < height - 12; ++v)
    for (int u = 12; u < width - 12; ++u)
      EXPECT_NEAR(out.row(v)[u], expected.pixels[size_t(v) * width + u], 2) << u << " " << v;
}

// An image whose rows were exposed one after the other becomes that at the time of the middle row.
TEST(PyramidBuilder, RectifiesTheRowsOfARollingShutter) {
  const int width = 320, height = 240;
  const double readout_s = 0.03;
  for (const bool with_lens : {false, true}) {
    Camera camera = lens(width, height);
    if (!with_lens) camera.set_distortion({});
    ImageMotion motion;
    motion.velocity << 0.4, -0.5, 0.3, 0.1, 0.2, -0.3;
    motion.idepth.setConstant(0.9);
    const Pinhole p = camera.pinhole();
    // The raw pixel shows the true point x whose to_file(x) is its position, found by from_file().
    const GrayImage rolling = picture(width, height, [&](double u, double v) {
      const auto ray = camera.unproject({u, v});
      EXPECT_TRUE(ray);
      const Eigen::Vector2d x = from_file(camera, {0, readout_s}, motion, ray->head<2>() / ray->z());
      return Eigen::Vector2d(p.fx * x.x() + p.cx, p.fy * x.y() + p.cy);
    });
    PyramidBuilder builder(camera, EdgeParams());
    const auto uncorrected = builder.build(rolling, motion);
    builder.set_correction({0, readout_s});
    const auto straight = builder.build(rolling, motion), unknown = builder.build(rolling);
    Plane<uint8_t> truth(width, height);
    const GrayImage scene = still(width, height);
    std::copy(scene.pixels.begin(), scene.pixels.end(), truth.row(0));
    EXPECT_LE(largest_difference(straight->finest().gray, truth, 16), 3) << with_lens;
    EXPECT_GT(largest_difference(uncorrected->finest().gray, truth, 16), 20) << with_lens;
    EXPECT_EQ(largest_difference(unknown->finest().gray, uncorrected->finest().gray, 0), 0)
        << "without motion an image does not change";
    EXPECT_EQ(straight->correction.readout_s, readout_s);
  }
}

// Cached maps are recomputed for another lens, with and without a rolling shutter.
TEST(PyramidBuilder, ACorrectedLensAppliesToTheNextImage) {
  const int width = 320, height = 240;
  ImageMotion motion;
  motion.velocity << 0.4, -0.5, 0.3, 0.1, 0.2, -0.3;
  motion.idepth.setConstant(0.9);
  const GrayImage image = still(width, height);
  for (const double readout_s : {0.0, 0.03}) {
    PyramidBuilder used(lens(width, height), EdgeParams()), fresh(lens(width, height), EdgeParams());
    used.set_correction({0, readout_s});
    const auto before = used.build(image, motion);
    used.set_correction({0.05, readout_s});
    fresh.set_correction({0.05, readout_s});
    const auto after = used.build(image, motion), expected = fresh.build(image, motion);
    EXPECT_EQ(largest_difference(after->finest().gray, expected->finest().gray, 0), 0) << readout_s;
    EXPECT_GT(largest_difference(after->finest().gray, before->finest().gray, 0), 20) << readout_s;
  }
}

TEST(PyramidBuilder, ASharedCorrectionIsThatOfTheOtherBuilder) {
  ImageMotion motion;
  motion.velocity << 0.4, -0.5, 0.3, 0.1, 0.2, -0.3;
  motion.idepth.setConstant(0.9);
  const Camera camera = lens(320, 240);
  const GrayImage image = still(320, 240);
  PyramidBuilder shared(camera, EdgeParams());
  {
    PyramidBuilder other(camera, EdgeParams());
    other.set_correction({0.05, 0.03});
    const auto expected = other.build(image, motion);
    shared.share_correction(other);
    EXPECT_EQ(shared.correction(), other.correction());
    EXPECT_EQ(largest_difference(shared.build(image, motion)->finest().gray, expected->finest().gray, 0), 0);
  }
  PyramidBuilder fresh(camera, EdgeParams());
  fresh.set_correction({0.05, 0});
  shared.set_correction({0.05, 0});
  EXPECT_EQ(largest_difference(shared.build(image)->finest().gray, fresh.build(image)->finest().gray, 0), 0)
      << "the other builder is gone";
}

}  // namespace
}  // namespace edgevo
