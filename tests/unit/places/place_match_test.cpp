// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/places/place_match.h"

#include <gmock/gmock.h>

#include "false_alarms.h"
#include "rendered_view.h"

namespace edgevo {
namespace {

using test::RenderedView;
using test::street;
using test::ViewRenderer;
using ::testing::Lt;

// Squared error of the match, normalised by its covariance: seven directions.
double normalised_error(const PlaceMatch& match, const RenderedView& a, double unit_a, const RenderedView& b,
                        double unit_b) {
  const SE3 metres = a.T_world_cam.inverse() * b.T_world_cam;
  const Sim3 truth{unit_a / unit_b, SE3(metres.rotation(), unit_a * metres.translation())};
  const Vector7d off = (match.T_a_b * truth.inverse()).log();
  return off.dot(match.covariance.ldlt().solve(off));
}

TEST(PlaceMatch, FindsTheSimilarityOfTwoMapsOfOnePlace) {
  double sum = 0;
  int count = 0;
  for (const int frame : {20, 60, 100}) {
    const RenderedView a = street().view(frame), b = street().view(frame + 1, 2.5);
    const auto match = match_views(street().pinhole(), a.place(), b.place());
    ASSERT_TRUE(match) << frame;
    EXPECT_NEAR(match->T_a_b.scale, 1 / 2.5, 0.02 / 2.5) << frame;
    sum += normalised_error(*match, a, 1, b, 2.5), ++count;
  }
  EXPECT_LT(sum / count, 14);
}

TEST(PlaceMatch, KnowsAPlaceInOtherLight) {
  const RenderedView a = street().view(40);
  for (const char* light : {"drift", "gamma", "vignette", "shadows", "glare"}) {
    PlaceEvidence evidence;
    const RenderedView b = street().view(41, 1, light);
    EXPECT_TRUE(match_views(street().pinhole(), a.place(), b.place(), &evidence))
        << light << ": " << evidence.agreeing << " of " << evidence.pairs << " corners, edges "
        << evidence.edges_log_alarms;
  }
}

TEST(PlaceMatch, KnowsNoPlaceWhereThereIsNone) {
  const ViewRenderer other("street", 9);
  const RenderedView a = street().view(40);
  for (int frame = 0; frame < 120; frame += 15) {
    EXPECT_FALSE(match_views(street().pinhole(), a.place(), other.view(frame).place())) << frame;
    if (std::abs(frame - 40) < 20) continue;
    EXPECT_FALSE(match_views(street().pinhole(), a.place(), street().view(frame).place())) << frame;
  }
}

TEST(PlaceMatch, AMirroredPlaceIsAnotherOne) {
  const RenderedView a = street().view(40);
  EXPECT_FALSE(match_views(street().pinhole(), a.place(), street().view(40, 1, "", true).place()));
  EXPECT_FALSE(match_views(street().pinhole(), a.place(), street().view(41, 1, "", true).place()));
}

TEST(PlaceMatch, ViewsWithoutAnythingMatchNothing) {
  const RenderedView a = street().view(40);
  const RenderedView nothing;
  EXPECT_FALSE(match_views(street().pinhole(), a.place(), nothing.place()));
  EXPECT_FALSE(match_views(street().pinhole(), nothing.place(), a.place()));
  RenderedView without_map = street().view(41);
  without_map.points.clear();
  EXPECT_FALSE(match_views(street().pinhole(), a.place(), without_map.place()));
  EXPECT_FALSE(match_views(street().pinhole(), without_map.place(), a.place()));
}

TEST(PlaceMatch, IsDeterministic) {
  const RenderedView a = street().view(40), b = street().view(42);
  const auto first = match_views(street().pinhole(), a.place(), b.place()),
             second = match_views(street().pinhole(), a.place(), b.place());
  ASSERT_TRUE(first && second);
  EXPECT_EQ(first->T_a_b.scale, second->T_a_b.scale);
  EXPECT_EQ(first->covariance, second->covariance);
}

// Poses by chance: the expected number of those that so many corners agree with is at most what is claimed.
TEST(FalseAlarms, CornersByChanceAreNoProof) {
  EXPECT_GT(log_alarms_of_corners(20, 3, 1e-4), 0);
  EXPECT_GT(log_alarms_of_corners(40, 5, 1e-4), -6);
  EXPECT_LT(log_alarms_of_corners(40, 8, 1e-4), -6);
  // A large image makes the same agreement less probable, more pairs make it more probable.
  EXPECT_THAT(log_alarms_of_corners(40, 7, 1e-5), Lt(log_alarms_of_corners(40, 7, 1e-3)));
  EXPECT_THAT(log_alarms_of_corners(20, 7, 1e-4), Lt(log_alarms_of_corners(200, 7, 1e-4)));
}

TEST(FalseAlarms, BoundsTheTailOfTheBinomialDistribution) {
  EXPECT_EQ(log_alarms_of_share(100, 0.1, 0.1), 0);
  EXPECT_EQ(log_alarms_of_share(100, 0.05, 0.1), 0);
  // Of 100 edges, 30 or more agree, where each does with 0.1: exactly 1.0e-8.
  EXPECT_GT(log_alarms_of_share(100, 0.3, 0.1), -8.0);
  EXPECT_LT(log_alarms_of_share(100, 0.3, 0.1), -6.5);
}

}  // namespace
}  // namespace edgevo
