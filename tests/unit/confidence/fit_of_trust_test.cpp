// SPDX-License-Identifier: BSD-3-Clause
// The weights of p_right (src/trust_table.h) hold for the doubts that they were fitted to. Doubts on a grid
// of evidence, the memory of `MotionConfidence` and `MotionHistory`, and the constants in them are compared
// with those recorded for the table, fit_of_trust.txt; tests/unit/features/fit_of_trust_test.cpp does the
// same for what corners measure.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <utility>

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

using C = CornerEvidence;

// Corners that contradict a motion in its rotation and its translation.
CornerEvidence corners_with(double rotation_deg, double motion_error) {
  CornerEvidence c;
  c.tracks = 60;
  c.motion_error = motion_error, c.motion_sigma = 0.05;
  c.rotation_deg = rotation_deg, c.rotation_sigma_deg = 0.4;
  return c;
}

void add_corner_evidence(test::RecordedValues* values) {
  const auto sweep = [&](const std::string& name, double C::*field, const Sweep& at) {
    CornerEvidence c = corners_with(2, 0.1);
    values->add(name, along(at, [&](double x) { return c.*field = x, evidence_of_corners(c, 0.5); }));
  };
  sweep("rotation", &C::rotation_deg, {0, 0.5, 1, 2.5, 3, 3.5, 9, 20, kNotKnown});
  sweep("rotation by its sigma", &C::rotation_sigma_deg, {0, 0.5, 2, 7, kNotKnown});
  sweep("translation", &C::motion_error, {0, 0.1, 0.2, 0.25, 0.3, 1, 5, kNotKnown});
  sweep("translation by its sigma", &C::motion_sigma, {0, 0.1, 0.2, 0.4, kNotKnown});
  values->add("corners by length", along({0, 0.01, 0.05, 0.1, 1, kNotKnown}, [](double length) {
                return evidence_of_corners(corners_with(1, 0.3), length);
              }));
  values->add("map", along({0, 0.001, 0.01, 0.1, 1, kNotKnown},
                           [](double moved) { return evidence_of_map(moved, 0.5); }));
}

FrameEvidence middling_evidence() {
  FrameEvidence e;
  e.median_depth = 12;
  e.residual_px = 0.9;
  e.pose_sigmas.fill(2e-3);
  e.focal_error = 0.1, e.focal_error_sigma = 0.02;
  e.corners = corners_with(1.5, 0.1);
  return e;
}

void add_other_evidence(test::RecordedValues* values) {
  values->add("focal length by error", along({-0.3, -0.1, 0, 0.03, 0.1, 0.3, kNotKnown}, [](double e) {
                return probability_of_wrong_focal_length(e, 0.02, 20);
              }));
  values->add("focal length by sigma", along({0, 0.02, 0.05, 0.1}, [](double s) {
                return probability_of_wrong_focal_length(0.1, s, 20);
              }));
  values->add("focal length by turn", along({0, 5, 20, 60}, [](double turn) {
                return probability_of_wrong_focal_length(0.1, 0.02, turn);
              }));
  values->add("turn by turn",
              along({0, 0.05, 0.1, 0.2, 0.5}, [](double turn) { return evidence_of_turn(turn, 0.05, 0.1); }));
  values->add("turn by length", along({0.01, 0.05, 0.1, 0.2, 0.5},
                                      [](double length) { return evidence_of_turn(0.2, length, 0.1); }));
  values->add("step by recent",
              along({0, 0.1, 0.5, 1, 2, 5}, [](double recent) { return change_of_step(recent, 0.8, 12); }));
  values->add("step by usual without a depth",
              along({0.1, 0.5, 1, 2, 5}, [](double usual) { return change_of_step(0.8, usual, kNotKnown); }));
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
      if (is_odd) {
        e.residual_px = 1.4, e.pose_sigmas.fill(0.5), e.corners->motion_error = 0.7;
        if (i > 200) e.corners.reset();
      }
      if (i == 150) history.interrupt();
      if (i == 170) history.interrupt();
      if (i == 230) history.begin_map();
      const double step = is_odd ? 0.9 : 0.5 + 0.001 * i;
      const Vector6d motion = (Vector6d() << 0, 0, step, 0, 0.01, 0).finished();
      const SE3 before = std::exchange(T_map_cam, T_map_cam * SE3::exp(motion));
      history.add({T_map_cam, (is_odd ? SE3() : T_map_cam.inverse() * before)});
      e.moved_by_map = history.newest().moved_by_map / e.median_depth;
      const FrameConfidence t = trust.add({e, history.newest()});
      if (i % 9 == 0 || (i >= 118 && i < 140)) found.push_back(t.doubts[k]);
    }
    values->add(std::string("Trust over a run, doubt ") + trust_table::kTerms[k].name, found);
  }
}

void add_constants(test::RecordedValues* values) {
  values->add("bounds of a wrong motion, frames, share of length, share of depth, degrees",
              {double(kMotionTolerance.frames), kMotionTolerance.share_of_length,
               kMotionTolerance.share_of_depth, kMotionTolerance.rotation_deg});
  values->add("largest step that is none, error of a turn", {kSmallStep, ConfidenceParams().turn_error});
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
  Sweep weights{trust_table::kBias};
  for (const trust_table::Term& term : trust_table::kTerms)
    weights.push_back(term.weight), weights.push_back(term.usual);
  values->add("bias, weights and usual values of the table", weights);
  values->add("doubtful below", {trust_table::kDoubtfulBelow});
}

TEST(FitOfTrust, TheWeightsWereFittedToTheDoubtsOfToday) {
  test::RecordedValues values(EDGEVO_SOURCE_DIR "/tests/unit/confidence/fit_of_trust.txt", 1e-6);
  add_table(&values);
  add_constants(&values);
  add_corner_evidence(&values);
  add_other_evidence(&values);
  add_memory(&values);
  const std::string differences = values.differences(kHeading);
  EXPECT_TRUE(differences.empty()) << differences << kRemedy;
}

}  // namespace
}  // namespace edgevo
