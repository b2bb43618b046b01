// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/segmentation/moving_objects.h"

#include <gtest/gtest.h>

#include "support/pasted_body.h"

namespace edgevo {
namespace {

using test::BodyPlace;

const BodyPlace kBody{120, 80, 70};

BodyPlace right_by(double px) { return {kBody.left + px, kBody.top, kBody.width}; }

// A camera that stands before a plane; a body in front of it, which the map has at rest.
class Bodies : public ::testing::Test {
 protected:
  Bodies() { reference->cloud = views.cloud(SE3(), kBody); }

  bool look(const BodyPlace& at) {
    return bodies.look(*views.pyramid(SE3(), at), *reference, SE3(), AlignmentParams());
  }
  int follow(const BodyPlace& at, const SE3& T_cur_last = SE3()) {
    bodies.follow(*views.pyramid(SE3(), at));
    return bodies.evaluate(camera(), T_cur_last, 0.5);
  }
  std::shared_ptr<const Reference> scene() const { return bodies.without(reference, camera(), SE3()); }
  Pinhole camera() const { return views.scene.camera.pinhole(); }

  test::SceneWithBody views;
  std::shared_ptr<Reference> reference = std::make_shared<Reference>();
  MovingObjects bodies;
};

TEST_F(Bodies, WithoutOneTheReferenceStaysTheSame) {
  EXPECT_FALSE(look(kBody));
  EXPECT_EQ(scene(), reference);
  EXPECT_TRUE(bodies.areas().empty());
}

TEST_F(Bodies, ABodyOnProbationIsSkippedByPosesOnly) {
  ASSERT_TRUE(look(right_by(6)));
  EXPECT_LT(scene()->cloud.points.size(), reference->cloud.points.size());
  EXPECT_LT(scene()->known_points, int(reference->cloud.points.size()));
  EXPECT_EQ(scene()->cloud.patches.size(), reference->cloud.patches.size());
  EXPECT_TRUE(bodies.areas().empty()) << "nothing is dropped from the map yet";
}

TEST_F(Bodies, ABodyThatMovesOnCounts) {
  ASSERT_TRUE(look(right_by(6)));
  EXPECT_EQ(follow(right_by(12)), 1);
  ASSERT_EQ(bodies.areas().boxes.size(), 1u);
  EXPECT_TRUE(bodies.areas().cover({right_by(12).left + 35, kBody.top + 35}));
  EXPECT_FALSE(bodies.areas().cover({20, 20}));
  EXPECT_EQ(follow(right_by(18)), 0) << "it counts already";
  EXPECT_NEAR(bodies.areas().boxes[0].left, right_by(18).left, 6);
}

TEST_F(Bodies, ABodyThatComesIntoViewIsCoveredAsItDoes) {
  const auto at = [](double left) { return BodyPlace{left, 80, 70}; };
  reference->cloud = views.cloud(SE3(), at(-35));
  ASSERT_TRUE(look(at(-29)));
  for (double left = -23; left <= 19; left += 6) follow(at(left));
  ASSERT_EQ(bodies.areas().boxes.size(), 1u);
  const ImageBox area = bodies.areas().boxes[0];
  EXPECT_LT(area.left, 19 + 10) << "it was found with half of it in view";
  EXPECT_GT(area.left, 19 - 12) << "the scene next to it is no part of it";
  EXPECT_LT(area.right, 19 + 70 + 12);
}

TEST_F(Bodies, ABodyThatStandsIsGivenUpAfterSixtyFrames) {
  ASSERT_TRUE(look(right_by(6)));
  for (int i = 0; i < 61; ++i) EXPECT_EQ(follow(right_by(6)), 0);
  EXPECT_EQ(scene(), reference);
}

// A lorry that is followed looks far away until the gap changes.
TEST_F(Bodies, ABodyThatKeepsItsPlaceForLongStaysOnProbation) {
  ASSERT_TRUE(look(right_by(6)));
  for (int i = 0; i < 30; ++i) EXPECT_EQ(follow(right_by(6)), 0);
  EXPECT_LT(scene()->cloud.points.size(), reference->cloud.points.size());
  EXPECT_EQ(follow(right_by(12)), 1);
}

// What moves in the image as something at rest that is nearer than most of the scene is that.
TEST_F(Bodies, APartThatTheMapHasAtAWrongDepthIsGivenBack) {
  constexpr double kUsualPx = 2, kOwnPx = 2.5;
  const SE3 aside(Eigen::Quaterniond::Identity(), {kUsualPx / (camera().fx * 0.5), 0, 0});
  ASSERT_TRUE(look(right_by(6)));
  for (int i = 1; i <= 5; ++i) EXPECT_EQ(follow(right_by(6 + kOwnPx * i), aside), 0) << i;
  EXPECT_EQ(scene(), reference);
}

// The more a camera moves, the less is the image of what is at rest, and has a relief, a similarity.
TEST_F(Bodies, APartIsNoBodyByLessThanItsReliefMayMoveIt) {
  const SE3 aside(Eigen::Quaterniond::Identity(), {8 / (camera().fx * 0.5), 0, 0});
  ASSERT_TRUE(look(right_by(6)));
  const auto follow_to = [&](int right, int down, const SE3& T_cur_last) {
    return follow({right_by(6).left + right, kBody.top + down, kBody.width}, T_cur_last);
  };
  for (int i = 1; i <= 4; ++i) EXPECT_EQ(follow_to(4 * i, i, aside), 0) << i << " px off, parallax " << 8 * i;
  int proved = 0;
  for (int i = 5; i <= 8; ++i) proved += follow_to(16, i, SE3());
  EXPECT_EQ(proved, 1) << "8 px off, parallax 32";
}

TEST_F(Bodies, ABodyThatCountsDoesSoForAsLongAsItIsSeen) {
  ASSERT_TRUE(look(right_by(6)));
  ASSERT_EQ(follow(right_by(12)), 1);
  for (int i = 0; i < 90; ++i) follow(right_by(12 + i % 2));
  EXPECT_EQ(bodies.areas().boxes.size(), 1u);
}

TEST_F(Bodies, ABodyThatIsNoLongerSeenIsForgotten) {
  ASSERT_TRUE(look(right_by(6)));
  ASSERT_EQ(follow(right_by(12)), 1);
  for (int i = 0; i < 4; ++i) follow({-500, 0, 70});
  EXPECT_TRUE(bodies.areas().empty());
  EXPECT_EQ(scene(), reference);
}

}  // namespace
}  // namespace edgevo
