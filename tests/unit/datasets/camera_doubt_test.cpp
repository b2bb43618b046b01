// SPDX-License-Identifier: BSD-3-Clause
#include "camera_doubt.h"

#include "edgevo/datasets/open_source.h"
#include "unit/datasets/temp_sequence.h"

namespace edgevo {
namespace {

using test::TempFolder;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

struct Doubted {
  const char* name;
  Camera camera;
  const char* doubt;
};

class ImplausibleCamera : public ::testing::TestWithParam<Doubted> {};

TEST_P(ImplausibleCamera, IsDoubted) {
  EXPECT_THAT(doubt_about(GetParam().camera), HasSubstr(GetParam().doubt));
}

INSTANTIATE_TEST_SUITE_P(
    All, ImplausibleCamera,
    ::testing::Values(
        Doubted{"matrix_of_half_the_image",
                {{353.5456, 353.5456, 300.69, 91.305, 1226, 370}},
                "of about 602x184"},
        Doubted{"matrix_of_three_quarters", {{530.3, 530.3, 451.3, 137.2, 1226, 370}}, "of about 904x275"},
        Doubted{
            "matrix_of_twice_the_image", {{1414.2, 1414.2, 1203.8, 366.2, 1226, 370}}, "of about 2409x733"},
        Doubted{"sides_exchanged", {{500, 500, 320, 240, 480, 640}}, "middle of 640x480"},
        Doubted{"centre_near_the_border", {{707, 707, 1100, 183, 1226, 370}}, "far from the middle"},
        Doubted{"centre_aside", {{718.9, 718.9, 687.2, 185.2, 1241, 376}}, "far from the middle"},
        Doubted{"centre_aside_in_a_square", {{300, 300, 360, 321, 640, 640}}, "far from the middle"},
        Doubted{"half_the_focal_length", {{300, 300, 601, 183, 1226, 370}}, "A view of 128 degrees"},
        Doubted{"telescope", {{12572, 12572, 320, 240, 640, 480}}, "A view of 3 degrees"},
        Doubted{"stretched", {{707, 540, 601, 183, 1226, 370}}, "fx and fy differ by 31 %"},
        Doubted{"slightly_stretched", {{707, 813, 601, 183, 1226, 370}}, "fx and fy differ by 15 %"},
        Doubted{"folded", {{500, 500, 320, 240, 640, 480}, {-0.9, 0.1, 0, 0, 0}}, "folds the image over"},
        Doubted{"narrowed", {{707, 707, 601, 183, 1226, 370}, {5, 20, 0, 0, 0}}, "narrows the view"},
        Doubted{"fisheye_as_plumb_bob",
                {{707, 707, 601, 183, 1226, 370}, {-0.0131, 0.0231, -0.0385, 0.0121, 0}},
                "larger than those of any lens"}),
    [](const auto& test) { return std::string(test.param.name); });

// Cameras of published data sets.
TEST(CameraDoubt, RealCamerasAreNotDoubted) {
  const Camera real[] = {
      {{718.856, 718.856, 607.1928, 185.2157, 1241, 376}},    // KITTI
      {{645.2401, 645.2401, 635.9587, 194.1291, 1344, 372}},  // Karlsruhe
      {{517.306408, 516.469215, 318.643040, 255.313989, 640, 480},
       {0.262383, -0.953104, -0.005358, 0.002628, 1.163314}},  // TUM freiburg1
      {{520.908620, 521.007327, 325.141442, 249.701764, 640, 480},
       {0.231222, -0.784899, -0.003257, -0.000105, 0.917205}},
      {{458.654, 457.296, 367.215, 248.375, 752, 480},
       {-0.28340811, 0.07395907, 0.00019359, 1.76187114e-05, 0}},                              // EuRoC
      {{335.419, 335.353, 129.925, 99.186, 240, 180}, {-0.1386, 0.0934, -0.0003, 0.0002, 0}},  // DAVIS
      {{1035.3, 1035.1, 596.96, 520.41, 1280, 1024}, {-0.0006, -0.0005, 0, 0, 0.0018}},        // endoscope
      {{638.967, 638.967, 182, 337, 364, 674}, {0.0451545, 0, 0, 0, 0}},  // telephone, upright
      {{500, 500, 320, 335, 640, 600}},                                   // cut at the top
      {{725, 725, 620.5, 187, 1242, 375}}};
  for (const Camera& camera : real) EXPECT_EQ(doubt_about(camera), "") << camera.pinhole().fx;
}

TEST(CameraDoubt, IsAWarningOfTheSource) {
  TempFolder folder;
  test::write_edgevo_layout(folder.path(), 2);
  SourceOptions options;
  options.path = folder.path();
  EXPECT_TRUE(open_source(options)->decisions().empty());
  test::write_text(folder / "camera.txt", "10 10 5.5 3.5 0 0 0 0 24 16");
  const auto source = open_source(options);
  EXPECT_THAT(input_warnings(source->decisions()), ElementsAre(HasSubstr("of about 12x8, not 24x16")));
  EXPECT_EQ(test::read_all(*source).size(), 2u);
}

}  // namespace
}  // namespace edgevo
