// SPDX-License-Identifier: BSD-3-Clause
#include "trust_runs.h"

#include <filesystem>
#include <sstream>
#include <utility>

#include "csv_table.h"
#include "edgevo/core/error.h"
#include "edgevo/core/input_file.h"
#include "edgevo/confidence/frame_status.h"

namespace edgevo::training {
namespace {

std::optional<int> count_of(const CsvTable& row, const char* column) {
  const double value = row.number(column);
  return std::isfinite(value) ? std::optional<int>(int(value)) : std::nullopt;
}

CornerEvidence corners_of(const CsvTable& row) {
  CornerEvidence c;
  c.tracks = count_of(row, "corners").value_or(0);
  c.agreeing_share = row.number("corners_agreeing");
  c.scale = row.number("corner_scale"), c.scale_sigma = row.number("corner_scale_sigma");
  c.change_10 = row.number("corner_change_10"), c.change_10_sigma = row.number("corner_change_10_sigma");
  c.change_50 = row.number("corner_change_50"), c.change_50_sigma = row.number("corner_change_50_sigma");
  c.motion_error = row.number("corner_motion"), c.motion_sigma = row.number("corner_motion_sigma");
  c.motion_error_depths = row.number("corner_motion_depths");
  c.rotation_deg = row.number("corner_rotation_deg"),
  c.rotation_sigma_deg = row.number("corner_rotation_sigma");
  c.direction_deg = row.number("corner_direction_deg");
  c.direction_sigma_deg = row.number("corner_direction_sigma");
  return c;
}

// Of the standard deviations of the pose only the largest is known; only that is read.
FrameEvidence evidence_of(const CsvTable& row) {
  FrameEvidence e;
  e.edges = int(row.number("edges"));
  e.saturated_share = row.number("saturated_share"), e.edge_blur = row.number("edge_blur");
  e.median_depth = row.number("median_depth", true);
  e.visible_points = count_of(row, "visible_points"), e.matched_points = count_of(row, "matched_points");
  e.inlier_share = row.number("inlier_share"), e.residual_px = row.number("residual_px");
  e.pose_sigmas.fill(row.number("pose_sigma"));
  e.step_sigmas = row.number("step_sigmas");
  e.stands = row.number("stands", true) == 1;
  e.known_points = count_of(row, "known_points");
  e.lacking_share = row.number("lacking_share"), e.view_share = row.number("view_share");
  e.focal_error = row.number("focal_error", true),
  e.focal_error_sigma = row.number("focal_error_sigma", true);
  if (count_of(row, "corners")) e.corners = corners_of(row);
  e.moved_by_map = row.number("moved_by_map");
  if (const double sigma = row.number("adjusted_unit_sigma", true); std::isfinite(sigma)) {
    e.adjustment.emplace();
    e.adjustment->unit_variance = sigma * sigma;
  }
  return e;
}

// Frames whose pose a bootstrap found afterwards have no p_right: the trust was not built for them.
void replay(const std::string& folder, TrustRun* run) {
  CsvTable row(folder + "/frames.csv", "make the corpus again");
  MotionConfidence trust;
  MotionHistory history;
  int segment = -1;
  for (ReportedFrame& frame : run->reported) {
    run->doubts.emplace_back();
    run->p_wrong_otherwise.push_back(0);
    if (!row.next()) break;
    const FrameEvidence evidence = evidence_of(row);
    if (std::isfinite(row.number("p_right")) && frame.T_world_cam) {
      if (std::exchange(segment, frame.segment) != frame.segment) history.begin_map(), trust.begin_map();
      history.add({*frame.T_world_cam, {}, 1, evidence.stands});
      const FrameConfidence confidence = trust.add({evidence, history.newest()});
      run->doubts.back() = confidence.doubts;
      run->p_wrong_otherwise.back() =
          1 - (1 - confidence.p_wrong_focal_length) * (1 - confidence.p_wrong_unit);
      frame.state = frame_status(evidence, StatusParams()).state;
    } else {
      history.interrupt();
    }
    if (evidence.adjustment) trust.add_adjustment(*evidence.adjustment);
  }
}

}  // namespace

std::vector<TrustRun> read_trust_runs(const std::string& list) {
  std::vector<TrustRun> runs;
  std::istringstream lines(read_file(list, "make it by trust_corpus.py"));
  for (std::string folder, truth, camera; lines >> folder >> truth >> camera;) {
    TrustRun run;
    run.name = std::filesystem::path(folder).filename().string(), run.camera = camera;
    run.reported = read_reported_frames(folder, PoseSource::kLive);
    run.truth = read_trajectory(truth);
    replay(folder, &run);
    for (ReportedFrame& frame : run.reported) frame.p_right = std::numeric_limits<double>::quiet_NaN();
    run.evaluation = evaluate_frames(run.reported, run.truth);
    runs.push_back(std::move(run));
  }
  if (runs.empty()) throw InputError(list, "names no run", "make it by trust_corpus.py");
  return runs;
}

}  // namespace edgevo::training
