// SPDX-License-Identifier: BSD-3-Clause
// The mask of what is fixed to the camera.
#include "cell_labels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgcodecs.hpp>

#include "edgevo/core/random.h"
#include "edgevo/edges/opencv_view.h"
#include "support/temp_folder.h"
#include "view_of_part.h"

namespace edgevo {
namespace {

using test::Body;
using test::gripper;
using test::kPartHeight;
using test::kPartWidth;
using test::MaskedBuilder;
using test::no_body;
using test::on_part;
using test::part_camera;
using test::part_view;
using test::random_blocks;
using test::show;

struct Covered {
  double of_part = 0, of_scene = 0;
};

// Shares of the edges of an image on the part and of the scene that lie under the mask.
Covered covered(const GrayImage& image, const FramePyramid& masked) {
  EdgeParams plain;
  plain.find_own_parts = false;
  double part = 0, part_masked = 0, scene = 0, scene_masked = 0;
  const auto unmasked = PyramidBuilder(part_camera(), plain).build(image);
  for (const EdgePixel& e : unmasked->finest().edges.pixels) {
    const bool is_masked = masked.is_ego(e.x, e.y);
    if (on_part(e.x, e.y))
      ++part, part_masked += is_masked;
    else if (!on_part(e.x - 5, e.y) && !on_part(e.x + 5, e.y) && !on_part(e.x, e.y + 5))
      ++scene, scene_masked += is_masked;
  }
  return {part_masked / part, scene_masked / scene};
}

TEST(CellLabels, ThePartIsMaskedAndTheSceneIsNot) {
  MaskedBuilder builder(part_camera(), EdgeParams());
  const auto pyramid = show(&builder, 70, 3, 1.3, gripper);
  ASSERT_TRUE(pyramid->ego_mask);
  const Covered share = covered(pyramid->source, *pyramid);
  EXPECT_GT(share.of_part, 0.95);
  EXPECT_LT(share.of_scene, 0.02);
  for (const EdgePixel& e : pyramid->finest().edges.pixels) EXPECT_FALSE(pyramid->is_ego(e.x, e.y));
}

// A part of little contrast before a scene of as little, or of much, image by image.
GrayImage faint_view(int i, bool is_scene_faint) {
  const Body body = [&](double x, double y) -> std::optional<double> {
    if (on_part(x, y)) return 100 + 0.15 * random_blocks(x, y, 2);
    if (!is_scene_faint) return std::nullopt;
    return 100 + 0.15 * random_blocks(x + 3 * i, y + 1.3 * i, 1);
  };
  return part_view(3 * i, 1.3 * i, body, uint64_t(i + 1));
}

TEST(CellLabels, FaintEdgesStayMaskedWhereTheSceneHasTooMuchContrastForThem) {
  MaskedBuilder builder(part_camera(), EdgeParams());
  for (int i = 0; i < 30; ++i) builder.build(faint_view(i, true));
  std::shared_ptr<const FramePyramid> pyramid;
  for (int i = 30; i < 70; ++i) pyramid = builder.build(faint_view(i, false));
  ASSERT_TRUE(pyramid->ego_mask);
  const Covered share = covered(faint_view(70, true), *pyramid);
  EXPECT_GT(share.of_part, 0.9);
  EXPECT_LT(share.of_scene, 0.02);
}

TEST(CellLabels, AUniformPartIsMaskedByItsOutline) {
  MaskedBuilder builder(part_camera(), EdgeParams());
  std::shared_ptr<const FramePyramid> pyramid;
  for (int i = 0; i < 90; ++i) {
    const auto plain = [&](double x, double y) -> std::optional<double> {
      if (on_part(x, y)) return 110;
      return random_blocks((x + 3 * i) / 4, (y + 1.3 * i) / 4, 1);
    };
    pyramid = builder.build(part_view(0, 0, plain, uint64_t(i + 1)));
  }
  ASSERT_TRUE(pyramid->ego_mask);
  const Covered share = covered(pyramid->source, *pyramid);
  EXPECT_GT(share.of_part, 0.95);
  EXPECT_LT(share.of_scene, 0.03);
}

TEST(CellLabels, ASceneWithoutEdgesNextToAPartIsNotMasked) {
  const auto on_a_table = [](double x, double y) -> std::optional<double> {
    if (on_part(x, y)) return gripper(x, y);
    if (y > 190) return 120;
    return std::nullopt;
  };
  MaskedBuilder builder(part_camera(), EdgeParams());
  const auto pyramid = show(&builder, 40, 3, 1.3, on_a_table);
  ASSERT_TRUE(pyramid->ego_mask);
  EXPECT_TRUE(pyramid->is_ego(250, 260));
  EXPECT_FALSE(pyramid->is_ego(140, 260));
  EXPECT_FALSE(pyramid->is_ego(360, 260));
}

// A drive ahead: the view widens around its middle, where far things hardly grow, and keep their place but
// for the shaking of the vehicle, a pixel.
TEST(CellLabels, WhatIsStillInTheMiddleOfTheViewIsFarAhead) {
  MaskedBuilder builder(part_camera(), EdgeParams());
  Random shaking(5);
  for (int i = 0; i < 60; ++i) {
    const double sway = shaking.normal(), nod = shaking.normal(), size = 1 + 0.003 * i;
    const auto ahead = [&](double x, double y) -> std::optional<double> {
      const double u = x - kPartWidth / 2 + sway, v = y - kPartHeight / 2 + nod;
      const double angle = std::atan2(v, u), distance = std::hypot(u, v);
      if (distance < 50) return random_blocks(u / size, v / size, 2);
      return random_blocks(9 * 20 * angle / M_PI, 9 * (30 * std::log(distance / 50) - 0.9 * i), 1);
    };
    ASSERT_FALSE(builder.build(part_view(0, 0, ahead, uint64_t(i + 1)))->ego_mask) << i;
  }
}

// Text over the picture, thin and amid it.
TEST(CellLabels, AWatermarkIsMasked) {
  const auto letters = [](double x, double y) {
    if (x < 120 || x > 360 || y < 120 || y > 164 || std::fmod(x, 40) > 30) return false;
    return std::fmod(x, 40) < 5 || std::fmod(y - 120, 20) < 4;
  };
  MaskedBuilder builder(part_camera(), EdgeParams());
  std::shared_ptr<const FramePyramid> pyramid;
  for (int i = 0; i < 40; ++i) {
    const auto view = [&](double x, double y) {
      return letters(x, y) ? 250 : random_blocks((x + 6 * i) / 3, (y + 2.6 * i) / 3, 1);
    };
    pyramid = builder.build(part_view(0, 0, view, uint64_t(i + 1)));
  }
  ASSERT_TRUE(pyramid->ego_mask);
  int letters_masked = 0, all = 0;
  for (int x = 120; x < 360; x += 40) ++all, letters_masked += pyramid->is_ego(x + 1, 142);
  EXPECT_GE(letters_masked, all - 1);
  EXPECT_FALSE(pyramid->is_ego(240, 60));
  EXPECT_FALSE(pyramid->is_ego(240, 240));
}

// A part of three tenths of the view has the strongest of its edges.
std::optional<double> dashboard(double x, double y) {
  if (y < 0.7 * kPartHeight) return std::nullopt;
  return std::fmod(x, 40) < 4 || std::fmod(y, 32) < 4 ? 230 : 40;
}
GrayImage before_pale_scene(int i, const Body& body) {
  return part_view(
      0, 0,
      [&](double x, double y) -> std::optional<double> {
        if (const std::optional<double> gray = body(x, y)) return gray;
        return 20 + 0.9 * random_blocks((x + 3 * i) / 1.5, (y + 1.3 * i) / 1.5, 1);
      },
      uint64_t(i + 1));
}

TEST(CellLabels, APartWithTheStrongestEdgesIsFound) {
  MaskedBuilder builder(part_camera(), EdgeParams());
  std::shared_ptr<const FramePyramid> pyramid;
  for (int i = 0; i < 30; ++i) pyramid = builder.build(before_pale_scene(i, dashboard));
  ASSERT_TRUE(pyramid->ego_mask);
  EXPECT_TRUE(pyramid->is_ego(240, 280));
  EXPECT_NEAR(pyramid->ego_share(), 0.3, 0.06);
}

// Its texture takes nearly all edges of the image; what little the scene shows moves, all over the view.
TEST(CellLabels, ATexturedPartDoesNotOutvoteAFaintScene) {
  const Body textured = [](double x, double y) -> std::optional<double> {
    if (y < 0.65 * kPartHeight) return std::nullopt;
    return random_blocks(x, y, 2);
  };
  MaskedBuilder builder(part_camera(), EdgeParams());
  std::shared_ptr<const FramePyramid> pyramid;
  for (int i = 0; i < 30; ++i) {
    const Body view = [&](double x, double y) -> std::optional<double> {
      if (const std::optional<double> gray = textured(x, y)) return gray;
      return 100 + 0.4 * random_blocks(x + 3 * i, y + 1.3 * i, 1);
    };
    pyramid = builder.build(part_view(0, 0, view, uint64_t(i + 1)));
  }
  ASSERT_TRUE(pyramid->ego_mask);
  EXPECT_NEAR(pyramid->ego_share(), 0.35, 0.05);
}

TEST(CellLabels, AKnownPartHasNoVoteInAStandstill) {
  MaskedBuilder builder(part_camera(), EdgeParams());
  for (int i = 0; i < 30; ++i) {
    builder.build(before_pale_scene(i, dashboard));
    EXPECT_TRUE(builder.masks.still_cells().empty()) << i;
  }
  for (int k = 0; k < 2; ++k) builder.build(before_pale_scene(29, dashboard));
  const StillCells still = builder.masks.still_cells();
  EXPECT_TRUE(still.contain(0.5, 0.3));
  EXPECT_FALSE(still.contain(0.5, 0.9)) << "fixed to the camera, whether it stands or not";
}

// Its rows are not where the camera's motion moves those of the scene: rectified, it sways with every turn.
TEST(CellLabels, APartIsMaskedBehindARollingShutter) {
  MaskedBuilder builder(part_camera(), EdgeParams());
  ImageCorrection correction;
  correction.readout_s = 0.03;
  builder.builder.set_correction(correction);
  std::shared_ptr<const FramePyramid> pyramid;
  for (int i = 0; i < 60; ++i) {
    ImageMotion motion;
    motion.velocity.segment<2>(3) << 1.5 * std::sin(1.1 * i), 1.5 * std::cos(1.7 * i);  // rad/s
    pyramid = builder.build(part_view(i * 3, i * 1.3, gripper, uint64_t(i + 1)), motion);
  }
  ASSERT_TRUE(pyramid->ego_mask);
  EXPECT_GT(covered(pyramid->source, *pyramid).of_part, 0.95);
}

TEST(CellLabels, ThePartMayBeInViewUntilTheMaskHolds) {
  MaskedBuilder builder(part_camera(), EdgeParams());
  auto before = show(&builder, 1, 3, 1.3, gripper);
  int changes = 0;
  for (int i = 1; i < 40; ++i) {
    const bool was_possible = builder.masks.may_show_ego_part();
    const auto now = show(&builder, 1, 3, 1.3, gripper, i);
    if (now->ego_mask != before->ego_mask) {
      ++changes;
      EXPECT_TRUE(was_possible) << i;
    }
    before = now;
  }
  EXPECT_GT(changes, 0);
}

// The builder keeps no memory.
TEST(PyramidBuilder, TheSameImageHasTheSameEdgesWhateverCameBefore) {
  const GrayImage image = part_view(0, 0, gripper, 1);
  PyramidBuilder builder(part_camera(), EdgeParams());
  const auto first = builder.build(image);
  for (int i = 1; i < 30; ++i) builder.build(part_view(3 * i, 1.3 * i, gripper, uint64_t(i + 1)));
  const auto again = builder.build(image);
  ASSERT_EQ(first->finest().edges.pixels.size(), again->finest().edges.pixels.size());
  for (size_t i = 0; i < first->finest().edges.pixels.size(); ++i)
    EXPECT_EQ(first->finest().edges.pixels[i].position(), again->finest().edges.pixels[i].position());
}

TEST(CellLabels, ASceneWithoutAPartHasNoMask) {
  MaskedBuilder builder(part_camera(), EdgeParams());
  EXPECT_FALSE(show(&builder, 60, 2, 0.7, no_body)->ego_mask);
}

TEST(CellLabels, ACameraThatStandsMakesNoMaskWhateverCrosses) {
  MaskedBuilder builder(part_camera(), EdgeParams());
  for (int i = 0; i < 60; ++i) {
    const double left = -250 + 12 * i;
    const auto bus = [&](double x, double y) -> std::optional<double> {
      if (x < left || x > left + 250 || y < 60 || y > 260) return std::nullopt;
      return random_blocks(x - left, y, 3);
    };
    ASSERT_FALSE(builder.build(part_view(0, 0, bus, uint64_t(i + 1)))->ego_mask) << i;
  }
}

TEST(CellLabels, EdgesThatSlideAlongThemselvesAreNoPart) {
  const auto lines = [](double x, double y) -> std::optional<double> {
    if (!on_part(x, y)) return std::nullopt;
    return int(std::floor(y / 11)) % 2 == 0 ? 50 : 200;
  };
  MaskedBuilder builder(part_camera(), EdgeParams());
  EXPECT_FALSE(show(&builder, 40, 3, 0, lines)->ego_mask);
}

// Few edges across many, less than a tenth: they are as certain as if there were no others.
TEST(CellLabels, StripesWithAMarkAcrossThemAreAPart) {
  MaskedBuilder builder(part_camera(), EdgeParams());
  const auto pyramid = show(&builder, 70, 3, 1.3, [](double x, double y) -> std::optional<double> {
    if (!on_part(x, y)) return std::nullopt;
    if (y > 250 && y < 258 && x > 200 && x < 225) return 240;
    return std::fmod(x, 10) < 5 ? 60 : 160;
  });
  EXPECT_TRUE(pyramid->ego_mask);
}

// Marks that show in every other image remain suspects: enough to say that the stripes do not slide.
TEST(CellLabels, SuspectsAcrossACertainPartAreEnough) {
  const auto part = [](bool has_marks) {
    return [has_marks](double x, double y) -> std::optional<double> {
      if (!on_part(x, y)) return std::nullopt;
      if (has_marks && std::fmod(y, 40) < 8 && x > 200 && x < 290) return 240;
      return std::fmod(x, 10) < 5 ? 60 : 160;
    };
  };
  MaskedBuilder builder(part_camera(), EdgeParams());
  bool is_masked = false;
  for (int i = 0; i < 90; ++i) {
    is_masked |= show(&builder, 1, 3, 1.3, part(i > 40 && i % 2 > 0), i)->ego_mask != nullptr;
    ASSERT_FALSE(is_masked && i <= 40);
  }
  EXPECT_TRUE(is_masked);
}

TEST(CellLabels, AMaskIsTakenBackWhenWhatItCoversMoves) {
  MaskedBuilder builder(part_camera(), EdgeParams());
  ASSERT_TRUE(show(&builder, 30, 3, 1.3, gripper)->ego_mask);
  EXPECT_FALSE(show(&builder, 70, 3, 1.3, no_body, 30)->ego_mask);
}

TEST(CellLabels, WhatAMaskCoversStaysCoveredWhileNothingThereMoves) {
  const auto part = [](bool is_lit) {
    return [is_lit](double x, double y) -> std::optional<double> {
      if (x < 60 || x > 420 || y < 210) return std::nullopt;
      return is_lit || x < 180 ? random_blocks(x, y, 2) : 100;
    };
  };
  MaskedBuilder builder(part_camera(), EdgeParams());
  ASSERT_TRUE(show(&builder, 30, 3, 1.3, part(true))->is_ego(380, 270));
  EXPECT_TRUE(show(&builder, 25, 3, 1.3, part(false), 30)->is_ego(380, 270)) << "its instruments are dark";
}

TEST(CellLabels, AGivenMaskHoldsFromTheFirstImage) {
  const test::TempFolder folder;
  const std::string path = folder.path() + "/mask.png";
  cv::Mat mask(kPartHeight, kPartWidth, CV_8U, cv::Scalar(255));
  mask(cv::Rect(170, 210, 161, kPartHeight - 210)) = 0;
  cv::imwrite(path, mask);
  EdgeParams params;
  params.mask = path;
  const auto pyramid = MaskedBuilder(part_camera(), params).build(part_view(0, 0, gripper, 1));
  for (const EdgePixel& e : pyramid->finest().edges.pixels) EXPECT_FALSE(on_part(e.x, e.y));
  EXPECT_NEAR(pyramid->ego_share(), 161.0 * (kPartHeight - 210) / (kPartWidth * kPartHeight), 1e-9);
}

// What is masked by hand is evidence of nothing: no map waits for it, and no standstill is seen in it.
TEST(CellLabels, WhatIsMaskedByHandTakesNoPart) {
  const test::TempFolder folder;
  const std::string path = folder.path() + "/mask.png";
  cv::Mat mask(kPartHeight, kPartWidth, CV_8U, cv::Scalar(255));
  mask.rowRange(kPartHeight / 4, kPartHeight) = 0;
  cv::imwrite(path, mask);
  const auto part = [](double x, double y) -> std::optional<double> {
    if (y < kPartHeight / 4) return std::nullopt;
    return random_blocks(x, y, 2);
  };
  EdgeParams params;
  params.mask = path;
  MaskedBuilder builder(part_camera(), params);
  for (int i = 0; i < 40; ++i) {
    const auto pyramid = show(&builder, 1, 3, 1.3, part, i);
    EXPECT_FALSE(builder.masks.may_show_ego_part()) << i;
    EXPECT_TRUE(builder.masks.still_cells().empty()) << i;
    EXPECT_NEAR(pyramid->ego_share(), 0.75, 1e-9) << i;
  }
}

}  // namespace
}  // namespace edgevo
