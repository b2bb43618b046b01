// SPDX-License-Identifier: BSD-3-Clause
// The evaluation as JSON, with units in the keys.
#include <nlohmann/json.hpp>

#include "edgevo/evaluation/evaluate.h"

namespace edgevo {
namespace {

using Json = nlohmann::ordered_json;

Json facts(const TrajectoryFacts& t) { return {{"path", t.path}, {"format", t.format}, {"poses", t.poses}}; }

Json absolute(const AbsoluteError& e, const std::string& alignment) {
  return {{"alignment", alignment}, {"poses", e.poses},     {"scale", e.scale}, {"rmse_m", e.rmse},
          {"mean_m", e.mean},       {"median_m", e.median}, {"max_m", e.max}};
}

Json drift_json(const std::optional<Drift>& d, int block_frames) {
  if (!d) return nullptr;
  return {{"scale", "re-corrected every " + std::to_string(block_frames) + " input frames"},
          {"mean_cm_per_m", d->mean_cm_per_m},
          {"median_cm_per_m", d->median_cm_per_m},
          {"stretches", d->intervals},
          {"capped", d->capped},
          {"without_poses", d->without_poses},
          {"lengths_m", d->lengths_m},
          {"path_m", d->path_m}};
}

Json kitti_json(const std::optional<KittiRelative>& k) {
  if (!k) return nullptr;
  return {{"scale", "one Sim(3) scale"},
          {"t_rel_percent", k->t_rel_percent},
          {"r_rel_deg_per_100m", k->r_rel_deg_per_100m},
          {"stretches", k->intervals}};
}

Json scale_json(const TrajectoryEvaluation& e) {
  if (e.scale_curve.empty()) return nullptr;
  Json curve = Json::array();
  for (const ScalePoint& p : e.scale_curve)
    curve.push_back(
        {{"first_frame", p.first_frame}, {"last_frame", p.last_frame}, {"relative", p.relative_scale}});
  const double first = e.scale_curve.front().relative_scale, last = e.scale_curve.back().relative_scale;
  return {{"window_frames", e.scale_window_frames},
          {"first", first},
          {"last", last},
          {"last_over_first", last / first},
          {"curve", curve}};
}

Json coverage_json(const Coverage& c) {
  return {{"input_frames", c.input_frames},
          {"input_frames_source", c.source},
          {"with_pose", c.with_pose},
          {"before_first_pose", c.before_first_pose},
          {"lost", c.lost},
          {"completion_percent", c.completion_percent},
          {"failure_percent", c.failure_percent}};
}

}  // namespace

std::string to_json(const TrajectoryEvaluation& e, const std::vector<JsonMember>& more) {
  const std::string blocks = std::to_string(e.block_frames);
  Json out;
  out["trajectory"] = facts(e.estimate);
  out["ground_truth"] = facts(e.ground_truth);
  out["matched_poses"] = e.matched;
  out["poses_without_ground_truth"] = e.without_ground_truth;
  out["ate_sim3"] = absolute(e.ate_sim3, "Sim(3), Umeyama");
  out["ate_se3"] = absolute(e.ate_se3, "SE(3), Umeyama");
  out["ate" + blocks] =
      absolute(e.ate_blocks, "scale re-corrected every " + blocks + " input frames, then SE(3)");
  out["drift"] = drift_json(e.drift, e.block_frames);
  out["kitti"] = kitti_json(e.kitti);
  out["local_scale"] = scale_json(e);
  out["coverage"] = coverage_json(e.coverage);
  for (const JsonMember& member : more) out[member.name] = Json::parse(member.value);
  // Paths need not be UTF-8: invalid bytes are replaced rather than refused.
  return out.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace edgevo
