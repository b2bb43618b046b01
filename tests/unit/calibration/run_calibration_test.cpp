// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/calibration/run_calibration.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "edgevo/core/error.h"
#include "edgevo/core/output_file.h"
#include "support/temp_folder.h"

namespace edgevo {
namespace {

using ::testing::HasSubstr;
using State = CameraPosterior::State;

template <class Call>
std::string error_of(Call&& call) {
  try {
    call();
  } catch (const InputError& e) {
    EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos) << "more than one line: " << e.what();
    return e.what();
  }
  return {};
}

// A short summary.yaml: its other contents need not even be YAML that the strict reader accepts.
std::string summary(const std::string& state, const std::string& more = "") {
  return "command: \"edgevo run a[1 # {\"\ncamera:\n  width: 640\n  height: 480\n  fx: 500.5\n  fy: 501\n  "
         "cx: 320\n  cy: 240\n  k1: 0.1\n"
         "self_calibration:\n  state: \"" +
         state + "\"\n  result: \"words: of it\"\n" + more + "scale:\n  source: none\nnot_written: []\n";
}

class RunCalibrationFile : public ::testing::Test {
 protected:
  RunCalibration read(const std::string& text) {
    write_file(folder.path() + "/summary.yaml", text);
    return read_run_calibration(folder.path());
  }
  test::TempFolder folder;
};

TEST_F(RunCalibrationFile, ReadsCameraAndRefinement) {
  const RunCalibration run = read(
      summary("applied",
              "  residual_k1: 0.01234\n  estimate: 0.01234\n  standard_deviation: 0.002\n  keyframes: 61\n"));
  EXPECT_EQ(run.camera.pinhole().fx, 500.5);
  EXPECT_EQ(run.camera.distortion().k1, 0.1);
  EXPECT_EQ(run.k1_state, State::kApplied);
  EXPECT_EQ(run.refinement.applied.k1, 0.01234);
  EXPECT_EQ(run.refinement.given.sigma_of(CameraNumber::kK1), 0.002);
  EXPECT_EQ(run.refinement.given.keyframes, 61);
  const FoldedCamera corrected = corrected_camera(run);
  EXPECT_NEAR(corrected.camera.distortion().k1, 0.1123, 0.002);
  EXPECT_LT(corrected.max_error_px, 0.01);
}

TEST_F(RunCalibrationFile, ReadsTheShutter) {
  const CameraPosterior refinement =
      read(summary(
               "insignificant",
               "  residual_k1: 0\n  shutter: \"applied\"\n  shutter_result: \"rows: rectified\"\n  "
               "readout_s: 0.0221\n"
               "  readout_estimate: 0.0217\n  readout_standard_deviation: 0.0015\n  readout_keyframes: 30\n"))
          .refinement;
  EXPECT_EQ(refinement.state_of(CameraNumber::kReadout), State::kApplied);
  EXPECT_EQ(refinement.applied.readout_s, 0.0221);
  EXPECT_EQ(refinement.given.mean_of(CameraNumber::kReadout), 0.0217);
  EXPECT_EQ(refinement.given.sigma_of(CameraNumber::kReadout), 0.0015);
  EXPECT_EQ(refinement.given.keyframes, 30);
  EXPECT_EQ(read(summary("insignificant")).refinement.state_of(CameraNumber::kReadout), State::kOff)
      << "a run of an earlier version";
}

TEST_F(RunCalibrationFile, ReadsTheWholeLens) {
  const CameraPosterior found =
      read(summary("insignificant",
                   "  residual_k1: 0\n  lens_result: \"not applied: x\"\n  lens_k1: 0.02\n"
                   "  lens_k1_standard_deviation: 0.004\n  lens_k2: -0.01\n"
                   "  lens_k2_standard_deviation: 0.003\n  lens_focal: 0.006\n"
                   "  lens_focal_standard_deviation: 0.005\n  lens_keyframes: 60\n"))
          .refinement;
  EXPECT_EQ(found.whole.mean_of(CameraNumber::kK2), -0.01);
  EXPECT_EQ(found.whole.sigma_of(CameraNumber::kK2), 0.003);
  EXPECT_EQ(found.whole.mean_of(CameraNumber::kFocal), 0.006);
  EXPECT_NEAR(found.focal_sigma(), 0.005, 1e-12);
  EXPECT_EQ(found.whole.keyframes, 60);
}

TEST_F(RunCalibrationFile, InsignificantRefinementLeavesTheCamera) {
  const FoldedCamera corrected = corrected_camera(
      read(summary("insignificant", "  residual_k1: 0\n  estimate: 0.0005\n  standard_deviation: 0.002\n")));
  EXPECT_EQ(corrected.camera.distortion().k1, 0.1);
  EXPECT_EQ(corrected.max_shift_px, 0);
}

TEST_F(RunCalibrationFile, WithoutARefinementItSaysWhatToDo) {
  const auto error = [&](const char* state) {
    return error_of([&] { corrected_camera(read(summary(state))); });
  };
  EXPECT_THAT(error("off"), HasSubstr("summary.yaml: self-calibration was off; run again"));
  EXPECT_THAT(error("too_early"), HasSubstr("too short to calibrate the camera; run on a longer sequence"));
  EXPECT_THAT(error("not_observable"), HasSubstr("does not determine the camera's distortion; run on"));
}

TEST_F(RunCalibrationFile, InvalidSummaryIsReportedWithItsLine) {
  EXPECT_THAT(error_of([&] { read_run_calibration(folder.path() + "/none"); }),
              HasSubstr("none/summary.yaml: cannot be read"));
  EXPECT_THAT(error_of([&] { read(summary("maybe")); }),
              HasSubstr("summary.yaml:11: self_calibration.state: 'maybe' is not one of"));
  EXPECT_THAT(error_of([&] { read("scale:\n  source: none\n"); }), HasSubstr("holds no camera"));
  EXPECT_THAT(error_of([&] { read("camera:\n  width: 640\n  focal: 3\n"); }),
              HasSubstr("summary.yaml:3: unknown parameter"));
  EXPECT_THAT(error_of([&] { read("camera:\n  width: 640\n  height: 480\n"); }),
              HasSubstr("state of self_calibration"));
}

}  // namespace
}  // namespace edgevo
