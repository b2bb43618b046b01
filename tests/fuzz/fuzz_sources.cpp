// SPDX-License-Identifier: BSD-3-Clause
// Whole sources on disk with one file mutated: opened, described, read to the end.
#include <zlib.h>

#include <fstream>

#include "edgevo/datasets/describe.h"
#include "edgevo/datasets/ground_truth.h"
#include "edgevo/datasets/open_source.h"
#include "edgevo/datasets/virtual_kitti.h"
#include "fuzz/mutate.h"
#include "unit/datasets/symphony_lake_folder.h"
#include "unit/datasets/virtual_kitti_folder.h"
#include "unit/mrpt_bridge/rawlog_test_tools.h"

namespace edgevo {
namespace {

namespace fs = std::filesystem;
using test::fuzz;
using test::FuzzCounts;
using test::read_text;
using test::TempFolder;
using test::write_text;

constexpr int kImages = 3;

void use_source(const SourceOptions& options) {
  const auto source = open_source(options);
  describe(*source);
  ground_truth_tum(options, *source);
  std::optional<Timestamp> previous;
  while (const auto frame = source->next()) {
    EXPECT_EQ(frame->image.width, source->camera().pinhole().width);
    EXPECT_EQ(frame->image.pixels.size(), size_t(frame->image.width) * size_t(frame->image.height));
    EXPECT_TRUE(!previous || *previous < frame->time);
    previous = frame->time;
  }
}

// Mutates `file` in the folder of the source, `rounds` times.
FuzzCounts fuzz_file(const std::string& root, const std::string& file, int rounds, uint64_t seed) {
  SourceOptions options;
  options.path = root;
  const std::string path = root + "/" + file, valid = read_text(path);
  const auto counts = fuzz(valid, rounds, seed, [&](const std::string& bytes) {
    write_text(path, bytes);
    use_source(options);
  });
  write_text(path, valid);
  use_source(options);  // the valid file is accepted
  return counts;
}

// Mutates `file`, and uses the sequence in the folder `sequence` with its depth.
FuzzCounts fuzz_virtual_kitti(const std::string& sequence, const std::string& file, int rounds,
                              uint64_t seed) {
  SourceOptions options;
  options.path = sequence;
  const std::string valid = read_text(file);
  const auto counts = fuzz(valid, rounds, seed, [&](const std::string& bytes) {
    write_text(file, bytes);
    use_source(options);
    const VirtualKitti v = read_virtual_kitti(options);
    EXPECT_EQ(v.T_world_cam.size(), v.images.size());
    for (const std::string& depth : v.depths)
      read_virtual_kitti_depth(depth, v.camera.pinhole().width, v.camera.pinhole().height);
  });
  write_text(file, valid);
  return counts;
}

TEST(FuzzSources, VirtualKitti1) {
  TempFolder folder;
  test::write_virtual_kitti_1(folder.path());
  const std::string sequence = folder.path() + "/vkitti_1.3.1_rgb/0001/15-deg-left";
  test::expect_both(fuzz_virtual_kitti(
      sequence, folder.path() + "/vkitti_1.3.1_extrinsicsgt/0001_15-deg-left.txt", 500, 91));
  EXPECT_EQ(fuzz_virtual_kitti(sequence, folder.path() + "/vkitti_1.3.1_depthgt/0001/15-deg-left/00001.png",
                               500, 92)
                .accepted,
            0);
}

TEST(FuzzSources, VirtualKitti2) {
  TempFolder folder;
  const std::string sequence = folder.path() + "/Scene01/clone";
  test::write_virtual_kitti_2(sequence);
  test::expect_both(fuzz_virtual_kitti(sequence, sequence + "/extrinsic.txt", 500, 93));
  test::expect_both(fuzz_virtual_kitti(sequence, sequence + "/intrinsic.txt", 500, 94));
}

TEST(FuzzSources, EdgevoFolder) {
  TempFolder folder;
  test::write_edgevo_layout(folder.path(), kImages);
  uint64_t seed = 10;
  for (const char* file : {"times.txt", "camera.txt"})
    test::expect_both(fuzz_file(folder.path(), file, 500, ++seed));
  // Every damage of a PNG is found by its checksums.
  EXPECT_EQ(fuzz_file(folder.path(), "images/000001.png", 500, ++seed).accepted, 0);
}

TEST(FuzzSources, JpegAndPgm) {
  TempFolder folder;
  test::write_edgevo_layout(folder.path(), kImages);
  fs::remove(folder / "images/000001.png");
  ASSERT_TRUE(to_mrpt(test::make_image(1)).saveToFile(folder / "images/000001.jpg"));
  test::expect_both(fuzz_file(folder.path(), "images/000001.jpg", 500, 20));
  fs::remove(folder / "images/000001.jpg");
  ASSERT_TRUE(to_mrpt(test::make_image(1)).saveToFile(folder / "images/000001.pgm"));
  test::expect_both(fuzz_file(folder.path(), "images/000001.pgm", 500, 21));
}

TEST(FuzzSources, Kitti) {
  TempFolder folder;
  const std::string root = folder / "sequences/07";
  test::write_images(root + "/image_0", kImages);
  write_text(root + "/times.txt", "0.000000e+00\n1.036224e-01\n2.0e-01\n");
  write_text(root + "/calib.txt", "P0: 20 0 12 0 0 21 8 0 0 0 1 0\nP1: 20 0 12 -8 0 21 8 0 0 0 1 0\n");
  write_text(folder / "poses/07.txt",
             "1 0 0 0 0 1 0 0 0 0 1 0\n1 0 0 0 0 1 0 0 0 0 1 1\n0 0 1 3 0 1 0 0 -1 0 0 5\n");
  uint64_t seed = 30;
  for (const char* file : {"times.txt", "calib.txt", "../../poses/07.txt"})
    test::expect_both(fuzz_file(root, file, 500, ++seed));
}

TEST(FuzzSources, TumRgbd) {
  TempFolder folder;
  const std::string root = folder / "freiburg1";
  fs::create_directories(root + "/rgb");
  for (int i = 0; i < 2; ++i)
    write_png(root + "/rgb/" + std::to_string(i) + ".png", test::make_image(i, 640, 480));
  write_text(root + "/rgb.txt", "# color images\n1.5 rgb/0.png\n2.5 rgb/1.png\n");
  test::expect_both(fuzz_file(root, "rgb.txt", 200, 40));
}

TEST(FuzzSources, Euroc) {
  TempFolder folder;
  const std::string cam = folder / "mav0/cam0";
  fs::create_directories(cam + "/data");
  for (int i = 0; i < 2; ++i) write_png(cam + "/data/" + std::to_string(i) + ".png", test::make_image(i));
  write_text(cam + "/data.csv",
             "#timestamp [ns],filename\n1403636579763555584,0.png\n1403636579863555584,1.png\n");
  write_text(cam + "/sensor.yaml",
             "T_BS:\n  cols: 4\n  rows: 4\n  data: [0, -1, 0, 0.5,\n    1, 0, 0, 0,\n    0, 0, 1, 0,\n    0, "
             "0, 0, 1]\n"
             "resolution: [24, 16]\nintrinsics: [20, 21, 12, 8]\ndistortion_model: radial-tangential\n"
             "distortion_coefficients: [0.1, 0, 0, 0]\n");
  write_text(folder / "mav0/state_groundtruth_estimate0/data.csv",
             "#t\n1403636579763555584,1,2,3,1,0,0,0,0,0,0\n");
  uint64_t seed = 50;
  for (const char* file :
       {"mav0/cam0/data.csv", "mav0/cam0/sensor.yaml", "mav0/state_groundtruth_estimate0/data.csv"})
    test::expect_both(fuzz_file(folder.path(), file, 500, ++seed));
}

TEST(FuzzSources, SymphonyLake) {
  TempFolder folder;
  const SurveyLocation survey = test::write_survey(folder.path(), "141107", kImages);
  uint64_t seed = 70;
  for (const char* file : {"image_auxilliary.csv", "../../Maps/141107/optposes.csv"})
    test::expect_both(fuzz_file(survey.folder(), file, 1000, ++seed));
}

class FuzzRawlog : public ::testing::Test {
 protected:
  FuzzRawlog() {
    fs::create_directories(folder_ / "x_Images");
    RawlogWriter writer(folder_ / "x.rawlog");
    for (int i = 0; i < kImages; ++i) {
      const std::string name = std::to_string(i) + ".png";
      write_png(folder_ / ("x_Images/" + name), test::make_image(i));
      writer.write(i == 1 ? test::embedded(i) : test::external(i, name));
    }
    writer.close();
    options_.path = folder_ / "x.rawlog";
  }
  FuzzCounts run(const std::string& valid, int rounds, uint64_t seed) const {
    return fuzz(valid, rounds, seed, [&](const std::string& bytes) {
      write_text(options_.path, bytes);
      use_source(options_);
    });
  }
  TempFolder folder_;
  SourceOptions options_;
};

// Every damage is found by the checksum, but for the few bytes of the gz header that mean nothing.
TEST_F(FuzzRawlog, CompressedBytes) { EXPECT_LT(run(read_text(options_.path), 2000, 60).accepted, 100); }

// Between the objects, where no length can be hit: unknown classes, versions and end marks. (What MRPT reads
// inside an object is guarded by the checksum: a wrong length there would allocate gigabytes.)
TEST_F(FuzzRawlog, ObjectHeaders) {
  const std::string payload = test::inflate(options_.path);
  const std::string name = "CObservationImage";
  Random random(61);
  int refused = 0;
  for (int i = 0; i < 500; ++i) {
    std::string bytes = payload;
    size_t at = bytes.find(name);
    for (int n = random.below(kImages); n > 0; --n) at = bytes.find(name, at + 1);
    bytes[at + size_t(random.below(int(name.size())))] = char(random.below(256));
    test::write_gz(options_.path, bytes);
    refused += !test::error_of([&] { use_source(options_); }).empty();
  }
  EXPECT_GT(refused, 400);
}

}  // namespace
}  // namespace edgevo
