// SPDX-License-Identifier: BSD-3-Clause
// The weights of p_right (src/trust_table.h) hold for the doubts that they were fitted to. Doubts on a grid
// of evidence, the memory of `MotionConfidence` and `MotionHistory`, and the constants in them are compared
// with those recorded for the table, fit_of_trust.txt; tests/unit/features/fit_of_trust_test.cpp does the
// same for what corners measure.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "consistency_tests.h"
#include "edgevo/confidence/motion_confidence.h"
#include "edgevo/confidence/tracking_check.h"
#include "edgevo/core/doubtful_frame.h"
#include "support/recorded_values.h"
#include "trust_table.h"

namespace edgevo {
namespace {

constexpr double kNotKnown = std::numeric_limits<double>::quiet_NaN();

constexpr const char* kHeading =
    "# What the weights of p_right (modules/confidence/src/trust_table.h) were fitted to: written by\n"
    "#   EDGEVO_RECORD=1 build/release/bin/test_confidence --gtest_filter=FitOfTrust.*\n"
    "# right after a fit (share/doc/numbers.md, refit), and only then.\n";

constexpr const char* kRemedy =
    "An input of p_right is not what its weights were fitted to. Either take the change back, or fit again:\n"
    "share/doc/numbers.md#refit-p_right-after-touching-its-inputs. After the fit record what it was fitted "
    "to:\n"
    "  EDGEVO_RECORD=1 build/release/bin/test_confidence --gtest_filter=FitOfTrust.*\n"
    "A change that alters no doubt of a frame, e.g. another unit, is recorded alone, and its commit says "
    "why.";

using Sweep = std::vector<double>;

// The values of `doubt` where one number goes through `at`.
template <class Doubt>
Sweep along(const Sweep& at, const Doubt& doubt) {
  Sweep values;
  for (const double x : at) values.push_back(doubt(x));
  return values;
}

const Sweep kShares{0, 0.05, 0.1, 0.2, 0.3, 0.5, 0.7, 0.9, 1};

using C = CornerEvidence;
using DoubtOfCorners = double (*)(const CornerEvidence&);

// Corners that contradict a motion in its length, in its rotation, or in the unit, and nothing else.
CornerEvidence corners_with(double length, double rotation_deg, double scale) {
  CornerEvidence c;
  c.tracks = 60, c.agreeing_share = 0.5;
  c.change_10 = scale, c.change_10_sigma = 0.05, c.change_50 = -scale, c.change_50_sigma = 0.05;
  c.motion_error = length, c.motion_sigma = 0.06, c.motion_error_depths = 0.08 * length;
  c.rotation_deg = rotation_deg, c.rotation_sigma_deg = 0.4;
  return c;
}

void add_corner_doubts(test::RecordedValues* values) {
  const auto sweep = [&](const std::string& name, DoubtOfCorners doubt, CornerEvidence base, double C::*field,
                         const Sweep& at) {
    values->add(name, along(at, [&](double x) { return base.*field = x, doubt(base); }));
  };
  const CornerEvidence length = corners_with(0.6, 0, 0), turn = corners_with(0, 6, 0),
                       scale = corners_with(0, 0, 0.3);
  const DoubtOfCorners motion = [](const CornerEvidence& c) { return inconsistency_of_corner_motion(c); };
  sweep("motion by length", motion, length, &C::motion_error, {0, 0.1, 0.2, 0.3, 0.4, 0.6, 0.9, kNotKnown});
  sweep("motion by sigma of length", motion, length, &C::motion_sigma, {0, 0.05, 0.1, 0.15, 0.3, kNotKnown});
  sweep("motion by depths", motion, length, &C::motion_error_depths, {0, 0.005, 0.02, 0.1, kNotKnown});
  sweep("motion by sigma of scale", motion, length, &C::change_10_sigma, {0, 0.1, 0.29, 0.31, kNotKnown});
  sweep("motion by rotation", motion, turn, &C::rotation_deg, {0, 0.3, 0.5, 1, 3, 5, 9, 20, kNotKnown});
  sweep("motion by sigma of rotation", motion, turn, &C::rotation_sigma_deg, {0, 0.5, 2, 7, kNotKnown});
  sweep("motion by agreement", motion, turn, &C::agreeing_share, {0, 0.7, 0.79, 0.81, 0.9, 1, kNotKnown});
  const auto unit = inconsistency_of_corner_scale;
  sweep("scale by ten frames", unit, scale, &C::change_10, {-0.9, -0.4, 0, 0.04, 0.06, 0.4, 0.9, kNotKnown});
  sweep("scale by its sigma", unit, scale, &C::change_10_sigma, {0, 0.1, 0.2, 0.4, kNotKnown});
  sweep("scale by fifty frames", unit, scale, &C::change_50, {-0.9, -0.4, 0, 0.4, 0.9, kNotKnown});
  sweep("scale by that sigma", unit, scale, &C::change_50_sigma, {0, 0.1, 0.2, 0.4, kNotKnown});
  sweep("agreement", inconsistency_of_corner_agreement, turn, &C::agreeing_share,
        {0, 0.3, 0.6, 0.9, 1, kNotKnown});

  const DoubtOfCorners witness = [](const CornerEvidence& c) {
    return inconsistency_without_cross_check(c, 0.01);
  };
  CornerEvidence vague = length;
  vague.motion_sigma = 0.15;
  sweep("witness by sigma of length", witness, length, &C::motion_sigma,
        {0.05, 0.1, 0.12, 0.2, 0.24, 0.26, kNotKnown});
  sweep("witness by depths", witness, vague, &C::motion_error_depths, {0, 0.019, 0.021, 0.1, kNotKnown});
  sweep("witness by sigma of scale", witness, vague, &C::change_10_sigma, {0, 0.29, 0.31, kNotKnown});
  vague.motion_error_depths = 0.01;
  sweep("witness by rotation", witness, vague, &C::rotation_deg, {0, 9, kNotKnown});
  CornerEvidence few = vague;
  values->add("witness by corners", along({0, 14, 15, 60}, [&](double n) {
                return few.tracks = int(n), inconsistency_without_cross_check(few, 0.01);
              }));
  values->add("witness by pose sigma", along({0, 0.05, 0.099, 0.101, 0.2, kNotKnown}, [](double s) {
                return inconsistency_without_cross_check(std::nullopt, s);
              }));
}

// Every field in the middle of its ramp.
FrameEvidence middling_evidence() {
  FrameEvidence e;
  e.saturated_share = 0.05, e.edge_blur = 0.5, e.median_depth = 12;
  e.visible_points = 900, e.inlier_share = 0.6, e.residual_px = 0.9;
  e.pose_sigmas.fill(2e-3);
  e.known_points = 150, e.view_share = 0.2;
  e.focal_error = 0.1, e.focal_error_sigma = 0.02;
  e.corners = corners_with(0.3, 1.5, 0.1);
  return e;
}

void add_other_doubts(test::RecordedValues* values) {
  values->add("focal length by error", along({-0.3, -0.1, 0, 0.03, 0.1, 0.3, kNotKnown}, [](double e) {
                return inconsistency_of_focal_length(e, 0.02, 10);
              }));
  values->add("focal length by sigma", along({0, 0.02, 0.049, 0.051, 0.1}, [](double s) {
                return inconsistency_of_focal_length(0.1, s, 20);
              }));
  values->add("focal length by turn", along({0, 5, 20, 60}, [](double turn) {
                return inconsistency_of_focal_length(0.1, 0.02, turn);
              }));
  values->add("turn by turn", along({0, 0.05, 0.1, 0.2, 0.5},
                                    [](double turn) { return inconsistency_of_turn(turn, 0.05, 0.1); }));
  values->add("turn by length", along({0.01, 0.05, 0.1, 0.2, 0.5},
                                      [](double length) { return inconsistency_of_turn(0.2, length, 0.1); }));
  values->add("turn error", along({0, 0.049, 0.051, 0.2}, [](double turn) {
                return turn_error(*middling_evidence().corners, turn);
              }));
  values->add("step by recent", along({0, 0.1, 0.5, 1, 2, 5},
                                      [](double recent) { return inconsistency_of_step(recent, 0.8, 12); }));
  values->add("step by usual without a depth", along({0.1, 0.5, 1, 2, 5}, [](double usual) {
                return inconsistency_of_step(0.8, usual, kNotKnown);
              }));
  values->add("residual", along({0, 0.5, 0.6, 0.7, 1, 2, 20, kNotKnown},
                                [](double px) { return inconsistency_of_residual(px); }));
  values->add("adjustment", along({0, 0.5, 1, 1.5, 2, 4, kNotKnown},
                                  [](double moved) { return inconsistency_of_adjustment(moved); }));
}

void add_image_doubts(test::RecordedValues* values) {
  FrameEvidence e = middling_evidence();
  values->add("starvation by inlier share",
              along(kShares, [&](double x) { return e.inlier_share = x, inconsistency_of_starvation(e); }));
  e = middling_evidence();
  values->add("starvation by points", along({0, 10, 40, 100, 299, 301, 1000}, [&](double x) {
                return e.known_points = int(x), inconsistency_of_starvation(e);
              }));
  e = middling_evidence();
  values->add("starvation by view",
              along(kShares, [&](double x) { return e.view_share = x, inconsistency_of_starvation(e); }));
  values->add("image by blur", along({0.3, 0.49, 0.51, 0.6, 0.8, kNotKnown}, [](double blur) {
                return inconsistency_of_image(blur, 0.45, 0.1, 0.1);
              }));
  values->add("image by usual blur", along({0.3, 0.5, 0.6, kNotKnown}, [](double usual) {
                return inconsistency_of_image(0.62, usual, 0.1, 0.1);
              }));
  values->add("image by saturation",
              along(kShares, [](double share) { return inconsistency_of_image(0.4, 0.45, share, 0.1); }));
}

// Means and medians: a frame that differs from those before it, and how long it counts.
void add_memory(test::RecordedValues* values) {
  for (size_t k = 0; k < kConsistencyTests; ++k) {
    MotionConfidence trust;
    MotionHistory history;
    Sweep found;
    SE3 T_map_cam;
    for (int i = 0; i < 280; ++i) {
      const bool is_odd = (i >= 120 && i < 126) || i % 7 == 0;
      FrameEvidence e = middling_evidence();
      e.edge_blur += 0.001 * i, e.corners->motion_error_depths = 1e-4 * i;  // what is usual follows
      if (is_odd) {
        e.residual_px = 1.4, e.inlier_share = 0.45, e.edge_blur = 0.8, e.saturated_share = 0.3;
        e.pose_sigmas.fill(0.5), e.corners->motion_error_depths = 0.006;
        if (i > 200) e.corners.reset();
      }
      AdjustmentEvidence adjustment;
      adjustment.moved = is_odd ? 2.2 : 1.3;
      if (i % 4 == 0) trust.add_adjustment(adjustment);
      if (i == 150) history.interrupt();
      if (i == 170) history.interrupt();
      if (i == 230) history.begin_map();
      const double step = is_odd ? 0.9 : 0.5 + 0.001 * i;
      T_map_cam = T_map_cam * SE3::exp((Vector6d() << 0, 0, step, 0, 0.01, 0).finished());
      history.add({T_map_cam});
      const FrameConfidence t = trust.add({e, i < 230 ? 0 : 1, history.newest()});
      if (i % 9 == 0 || (i >= 118 && i < 140)) found.push_back(t.doubts[k]);
    }
    values->add(std::string("Trust over a run, doubt ") + trust_table::kTerms[k].name, found);
  }
}

void add_constants(test::RecordedValues* values) {
  values->add("bounds of a wrong motion, frames, share of length, share of depth, degrees",
              {double(kMotionTolerance.frames), kMotionTolerance.share_of_length,
               kMotionTolerance.share_of_depth, kMotionTolerance.rotation_deg});
  values->add("largest doubt, times of a step outlier", {kMaxInconsistency, StepGateParams().times});
  Sweep deciding;
  for (size_t k = 0; k < kConsistencyTests; ++k) {
    Inconsistencies doubts{};
    while (doubts[k] < 3 && p_right_limit(doubts) == 1) doubts[k] += 0.01;
    deciding.push_back(doubts[k]);
  }
  values->add("values that decide alone", deciding);
  TrackingCheck check;
  Matrix6d covariance = Matrix6d::Identity() * 1e-4;
  Sweep moved;
  for (const double off : {0.0, 0.005, 0.01, 0.02, 0.05})
    moved.push_back(check.add(SE3(),
                              SE3::exp((Vector6d() << off, off, 1, off, 0, 0).finished()) *
                                  SE3(Eigen::Quaterniond::Identity(), {0, 0, -1}),
                              covariance));
  values->add("squared move of a keyframe", moved);
}

// The table that the inputs are recorded for.
void add_table(test::RecordedValues* values) {
  Sweep weights, knots;
  for (const trust_table::Term& term : trust_table::kTerms) weights.push_back(term.weight);
  for (const CalibrationKnot& knot : trust_table::kKnots)
    knots.push_back(knot.sum), knots.push_back(knot.p_right);
  values->add("weights of the table", weights);
  values->add("knots of the table", knots);
  values->add("doubtful below", {trust_table::kDoubtfulBelow});
}

TEST(FitOfTrust, TheWeightsWereFittedToTheDoubtsOfToday) {
  test::RecordedValues values(EDGEVO_SOURCE_DIR "/tests/unit/confidence/fit_of_trust.txt", 1e-6);
  add_table(&values);
  add_constants(&values);
  add_corner_doubts(&values);
  add_other_doubts(&values);
  add_image_doubts(&values);
  add_memory(&values);
  const std::string differences = values.differences(kHeading);
  EXPECT_TRUE(differences.empty()) << differences << kRemedy;
}

}  // namespace
}  // namespace edgevo
