// SPDX-License-Identifier: BSD-3-Clause
// What corners measure is an input of p_right, whose weights hold for the measurements that they were fitted
// to. The evidence along a made street is compared with that recorded for the weights, to a hundredth of it
// or of a percent: an estimator that differs more is another input.
// tests/unit/confidence/fit_of_trust_test.cpp does the same for what becomes of it.
#include <gtest/gtest.h>

#include <functional>

#include "corner_evaluation.h"
#include "support/corner_street.h"
#include "support/recorded_values.h"

namespace edgevo {
namespace {

constexpr const char* kHeadingOfCorners =
    "# What corners measure along a made street, as the weights of p_right\n"
    "# (modules/confidence/src/trust_table.h) were fitted to it: written by\n"
    "#   EDGEVO_RECORD=1 build/release/bin/test_features --gtest_filter=FitOfTrust.*\n"
    "# right after a fit (share/doc/numbers.md, refit), and only then.\n";

constexpr const char* kRemedyOfCorners =
    "What corners measure is not what the weights of p_right were fitted to. Either take the change back, "
    "or\n"
    "fit again, on a corpus made by this program (the old one holds the old measurements):\n"
    "share/doc/numbers.md#refit-p_right-after-touching-its-inputs. After the fit record what it was fitted "
    "to:\n"
    "  EDGEVO_RECORD=1 build/release/bin/test_features --gtest_filter=FitOfTrust.*\n"
    "If p_right keeps recall and alarms without a fit, record alone, and give the figures in the commit.";

using MotionOfFrame = std::function<SE3(int)>;

SE3 with_length(const SE3& T, double factor) { return {T.rotation(), factor * T.translation()}; }

void add_evidence(const std::string& name, double moving_share, const MotionOfFrame& truth,
                  const MotionOfFrame& odometry, test::RecordedValues* values) {
  test::CornerStreet street(moving_share);
  CornerEvaluation evaluation;
  SE3 T_cam_world;
  evaluation.add(street.look(T_cam_world, 0), std::nullopt);
  evaluation.begin_map(0.1);
  for (int i = 1; i <= 130; ++i) {
    T_cam_world = truth(i) * T_cam_world;
    const CornerEvidence e = evaluation.add(street.look(T_cam_world, i), odometry(i)).value();
    if (i % 26 != 0) continue;
    std::vector<double> percent;
    for (const double share : {e.agreeing_share, e.change_10, e.change_10_sigma, e.change_50,
                               e.change_50_sigma, e.motion_error, e.motion_sigma, e.motion_error_depths})
      percent.push_back(100 * share);
    values->add(name + ", percent, frame " + std::to_string(i), percent);
    values->add(name + ", corners and degrees, frame " + std::to_string(i),
                {double(e.tracks), e.rotation_deg, e.rotation_sigma_deg});
  }
}

TEST(FitOfTrust, TheWeightsWereFittedToWhatCornersMeasureToday) {
  test::RecordedValues values(EDGEVO_SOURCE_DIR "/tests/unit/features/fit_of_trust_corners.txt", 0.01);
  const MotionOfFrame right = test::street_drive;
  add_evidence("a right odometry", 0, right, right, &values);
  add_evidence("a fifth of the corners moves", 0.2, right, right, &values);
  add_evidence(
      "the unit shrinks", 0, right,
      [](int i) { return with_length(test::street_drive(i), std::pow(0.99, i)); }, &values);
  add_evidence(
      "a wrong rotation and direction", 0, right,
      [](int i) {
        const SE3 turned = SE3::exp((Vector6d() << 0.1, 0, 0, 0, 0.004, 0).finished());
        return turned * test::street_drive(i);
      },
      &values);
  add_evidence(
      "a rotation on the spot", 0,
      [](int) { return SE3::exp((Vector6d() << 0, 0, -0.01, 0, 0.01, 0).finished()); },
      [](int) { return SE3::exp((Vector6d() << 0.02, 0, -0.01, 0, 0.01, 0).finished()); }, &values);
  const std::string differences = values.differences(kHeadingOfCorners);
  EXPECT_TRUE(differences.empty()) << differences << kRemedyOfCorners;
}

}  // namespace
}  // namespace edgevo
