// SPDX-License-Identifier: BSD-3-Clause
// Mutated calibration files of every dialect and every lens. EDGEVO_FUZZ_ROUNDS sets the number of mutations
// of each, for runs under a sanitizer.
#include <cstdlib>
#include <fstream>
#include <set>

#include "edgevo/datasets/camera_file.h"
#include "fuzz/mutate.h"
#include "support/camera_dialects.h"
#include "support/camera_examples.h"
#include "support/temp_folder.h"

namespace edgevo {
namespace {

using test::expect_both;
using test::fuzz;

int rounds(int usual) {
  const char* const text = std::getenv("EDGEVO_FUZZ_ROUNDS");
  return text ? std::atoi(text) : usual;
}

// What is accepted can be used, and written and read again.
void use(const Camera& camera) {
  camera.check("result");
  for (const Eigen::Vector2d& px : {Eigen::Vector2d(0, 0), Eigen::Vector2d(camera.width / 2, camera.height)})
    if (const auto ray = camera.unproject(px)) camera.project(*ray);
  camera.max_angle();
  EXPECT_NO_THROW(parse_camera(camera_yaml(camera, ""), "written")) << camera_yaml(camera, "");
}

TEST(FuzzCameras, Dialects) {
  constexpr int kRounds = 300;
  std::set<std::string> seen;
  uint64_t seed = 200;
  for (const test::DialectText& dialect : test::camera_dialects()) {
    if (!seen.insert(dialect.text).second) continue;
    SCOPED_TRACE(dialect.name);
    expect_both(fuzz(dialect.text, rounds(kRounds), ++seed,
                     [&](const std::string& text) { use(parse_camera(text, "f", dialect.sensor)); }));
  }
}

TEST(FuzzCameras, Lenses) {
  constexpr int kRounds = 200;
  uint64_t seed = 300;
  for (const test::CameraExample& example : test::camera_examples()) {
    SCOPED_TRACE(example.name);
    expect_both(fuzz(camera_yaml(example.camera, ""), rounds(kRounds), ++seed,
                     [](const std::string& text) { use(parse_camera(text, "f")); }));
    for (const std::string& format : camera_file_formats()) {
      std::string text;
      try {
        text = camera_file_text(example.camera, format, "");
      } catch (const InputError&) {
        continue;  // that program does not have the lens
      }
      expect_both(fuzz(text, rounds(kRounds), ++seed,
                       [](const std::string& mutated) { use(parse_camera(mutated, "f")); }));
    }
  }
}

TEST(FuzzCameras, ColmapDatabase) {
  constexpr int kRounds = 300;
  test::TempFolder folder;
  const std::string path = folder / "database.db";
  test::write_colmap_database(path);
  std::ifstream file(path, std::ios::binary);
  const std::string valid{std::istreambuf_iterator<char>(file), {}};
  const auto parse = [&](const std::string& bytes) {
    std::ofstream(path, std::ios::binary) << bytes;
    use(read_camera_file(path, "1"));
  };
  expect_both(fuzz(valid, rounds(kRounds), 400, parse));
}

}  // namespace
}  // namespace edgevo
