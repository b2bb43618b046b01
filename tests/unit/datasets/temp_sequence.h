// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Small sequences in temporary folders, for tests of the readers.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "edgevo/core/bad_frame.h"
#include "edgevo/core/error.h"
#include "edgevo/core/image_source.h"
#include "edgevo/core/random.h"
#include "edgevo/mrpt_bridge/image_file.h"
#include "support/temp_folder.h"

namespace edgevo::test {

namespace fs = std::filesystem;

inline void write_text(const std::string& path, const std::string& text) {
  fs::create_directories(fs::path(path).parent_path());
  std::ofstream(path, std::ios::binary) << text;
}

inline std::string read_text(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// Image of noise over a ramp: no two seeds give the same pixels.
inline GrayImage make_image(int seed, int width = 24, int height = 16) {
  Random random(uint64_t(seed) + 1);
  GrayImage image{width, height, {}};
  for (int i = 0; i < width * height; ++i)
    image.pixels.push_back(uint8_t((i % width) * 4 + random.below(100)));
  return image;
}

constexpr const char* kCameraLine =
    "# fx fy cx cy k1 k2 p1 p2 width height k3\n20 21 12 8 0.1 -0.02 0.001 0.002 24 16 0.003\n";

/// Writes images 0 .. count-1 as `folder/NNNNNN.png`.
inline void write_images(const std::string& folder, int count) {
  fs::create_directories(folder);
  for (int i = 0; i < count; ++i) {
    char name[32];
    std::snprintf(name, sizeof name, "/%06d.png", i);
    write_png(folder + name, make_image(i));
  }
}

/// Times 10 ms apart, with ticks that a double-precision epoch would lose.
inline std::string make_times(int count) {
  std::string text;
  for (int i = 0; i < count; ++i) text += to_string(Timestamp{13050311021753041 + 100000 * i}) + "\n";
  return text;
}

inline void write_edgevo_layout(const std::string& root, int count) {
  write_images(root + "/images", count);
  write_text(root + "/times.txt", make_times(count));
  write_text(root + "/camera.txt", kCameraLine);
  write_text(root + "/groundtruth_tum.txt", "# t tx ty tz qx qy qz qw\n0 0 0 0 0 0 0 1\n");
}

inline std::vector<Frame> read_all(ImageSource& source) {
  std::vector<Frame> frames;
  while (auto frame = source.next()) frames.push_back(std::move(*frame));
  return frames;
}

/// The message of the InputError that `action` throws; empty if it throws none. Any other exception passes
/// through.
template <class F>
std::string error_of(F&& action) {
  try {
    action();
  } catch (const InputError& e) {
    EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos) << "more than one line: " << e.what();
    return e.what();
  }
  return {};
}

/// Reads until the source throws and returns how many frames came before; the message must contain `part`.
inline int frames_before_error(ImageSource& source, const std::string& part) {
  int count = 0;
  bool may_go_on = false;
  const std::string message = error_of([&] {
    try {
      while (source.next()) ++count;
    } catch (const BadFrame& e) {
      EXPECT_EQ(e.index(), count);
      may_go_on = true;
      throw;
    }
  });
  EXPECT_THAT(message, ::testing::HasSubstr(part));
  if (!may_go_on) {
    EXPECT_FALSE(source.next().has_value()) << "not at its end after a throw";
  }
  return count;
}

inline bool same_pixels(const GrayImage& a, const GrayImage& b) {
  return a.width == b.width && a.height == b.height && a.pixels == b.pixels;
}

/// Folder of a real sequence next to the checkout (or under EDGEVO_DATA); empty if it is not there.
inline std::string real_sequence(const std::string& name) {
  const char* data = std::getenv("EDGEVO_DATA");
  const std::string root = data ? data : std::string(EDGEVO_SOURCE_DIR) + "/../shared/data";
  return fs::is_directory(root + "/" + name) ? root + "/" + name : std::string();
}

}  // namespace edgevo::test
