// SPDX-License-Identifier: BSD-3-Clause
// Parsers of text.
#include <gtest/gtest.h>

#include "edgevo/benchmark/bench_list.h"
#include "edgevo/core/params.h"
#include "edgevo/core/timestamp.h"
#include "edgevo/datasets/camera_file.h"
#include "edgevo/datasets/open_source.h"
#include "edgevo/evaluation/trajectory.h"
#include "fuzz/mutate.h"

namespace edgevo {
namespace {

using test::expect_both;
using test::fuzz;

constexpr int kRounds = 8000;

TEST(FuzzText, CameraNumbers) {
  expect_both(fuzz("# fx fy\n20 21 12 8 0.1 -0.02 0.001 0.002 24 16 0.003\n", kRounds, 1,
                   [](const std::string& text) { parse_camera(text, "f").check("result"); }));
}

TEST(FuzzText, CameraYaml) {
  expect_both(
      fuzz("%YAML:1.0\n---\nimage_width: 24\nimage_height: 16\ncamera_matrix: !!opencv-matrix\n  rows: 3\n  "
           "cols: 3\n"
           "  data: [20, 0, 12, # c\n   0, 21, 8, 0, 0, 1]\ndistortion_model: plumb_bob\n"
           "distortion_coefficients: {rows: 1, cols: 5, data: [0.1, -0.02, 0.001, 0.002, 0.003]}\n",
           kRounds, 2, [](const std::string& text) { parse_camera(text, "f").check("result"); }));
}

// The other forms of calibration files.
TEST(FuzzText, CameraForms) {
  uint64_t seed = 20;
  for (const char* valid :
       {"image_width: 24\nimage_height: 16\ncamera_matrix:\n  rows: 3\n  data:\n  - 20\n  - 0\n  - 12\n  - "
        "0\n  - 21\n  "
        "- 8\n  - 0\n  - 0\n  - 1\ndist_coeffs:\n- - 0.1\n  - 0\n- [0, 0]\n",
        "header:\n  stamp:\n    sec: 1\nheight: 16\nwidth: 24\nd: [0.1, 0, 0, 0]\nk: [[20, 0, 12], [0, 21, "
        "8], [0, 0, "
        "1]]\nbinning_x: 0\nroi:\n  x_offset: 0\n---\nheight: 16\nwidth: 24\nd: [0.1, 0, 0, 0]\nk: [20, 0, "
        "12, 0, 21, "
        "8, 0, 0, 1]\n---\n",
        "# oST\n[image]\nwidth\n24\nheight\n16\n[c]\ncamera matrix\n20 0 12\n0 21 8\n0 0 1\ndistortion\n0.1 "
        "0 0 0 0\n",
        "20 21 12 8 0\n24 16\ncrop\n20 10\n", "RadTan 0.9 0.8 0.5 0.5 0.1 0 0 0\n24 16\nnone\n"})
    expect_both(fuzz(valid, kRounds / 2, ++seed,
                     [](const std::string& text) { parse_camera(text, "f").check("result"); }));
}

struct FuzzedParams {
  double percentile = 0.9;
  int levels = 4;
  bool realtime = false;
  std::string name = "a";

  void visit(KeyVisitor& v) {
    {
      const auto group = v.group("edges");
      v.number("percentile", percentile, 0, 1, "help");
      v.integer("levels", levels, 1, 8, "help");
    }
    v.boolean("realtime", realtime, "help");
    v.text("name", name, {"a", "b"}, "help");
  }
};

TEST(FuzzText, Parameters) {
  expect_both(fuzz("edges:\n  percentile: 0.8  # c\n  levels: 3\nrealtime: true\nname: 'b'\n", kRounds, 3,
                   [](const std::string& text) {
                     FuzzedParams p;
                     read_params(text, "f", [&](ParamVisitor& v) { p.visit(v); });
                     EXPECT_TRUE(p.percentile >= 0 && p.percentile <= 1 && p.levels >= 1 && p.levels <= 8)
                         << text;
                     EXPECT_TRUE(p.name == "a" || p.name == "b") << text;
                   }));
}

TEST(FuzzText, Trajectory) {
  expect_both(fuzz("# t tx ty tz qx qy qz qw\n0.1 1 2 3 0 0 0 1\n0.2 1 2 3.5 0 0.6 0 0.8\n", kRounds, 5,
                   [](const std::string& text) { parse_trajectory(text, "f"); }));
}

TEST(FuzzText, BenchList) {
  expect_both(
      fuzz("seeds: 1..3 7\nvariants: normal every3+glare\nsequences:\n  a:\n    source: scene:desk\n  b:\n   "
           " source: x\n    variants: glare\n",
           kRounds, 8, [](const std::string& text) {
             const BenchList list = parse_bench_list(text, "f", {"glare"});
             EXPECT_GT(list.jobs(), 0) << text;
             for (const BenchSequence& s : list.sequences)
               EXPECT_EQ(s.name.find_first_of("/."), std::string::npos) << text;
           }));
}

TEST(FuzzText, FrameRange) {
  expect_both(fuzz("10:300", kRounds, 6, [](const std::string& text) {
    SourceOptions options;
    set_frame_range(text, &options);
    EXPECT_GE(options.first, 0);
    EXPECT_TRUE(!options.last || *options.last > options.first);
  }));
}

TEST(FuzzText, Seconds) {
  Random random(7);
  int accepted = 0, refused = 0;
  for (int i = 0; i < kRounds; ++i) {
    Timestamp t;
    ++(parse_seconds(test::mutate(&random, "1305031102.1753041"), &t) ? accepted : refused);
  }
  EXPECT_GT(accepted, 0);
  EXPECT_GT(refused, 0);
}

}  // namespace
}  // namespace edgevo
