// SPDX-License-Identifier: BSD-3-Clause
// Every rule that share/bench/ablation.yaml switches off can be switched off: a run over a short rendered
// walk keeps its poses. What each contributes is measured by `edgevo bench` with that list; this shows
// breakdowns.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

#include "edgevo/core/block_yaml.h"
#include "edgevo/core/input_file.h"
#include "edgevo/core/params.h"
#include "edgevo/simulation/scene_renderer.h"
#include "rendered_sequences.h"
#include "run_figures.h"

namespace edgevo::test {
namespace {

struct Ablation {
  std::string name;
  std::string assignment;  // "GROUP.KEY=VALUE"
  std::string key() const { return assignment.substr(0, assignment.find('=')); }
};

std::vector<Ablation> ablations() {
  const std::string file = EDGEVO_SOURCE_DIR "/share/bench/ablation.yaml", prefix = "set.";
  std::vector<Ablation> found;
  for (const YamlEntry& entry : parse_block_yaml(read_file(file, "it belongs to the sources"), file))
    if (entry.key.rfind(prefix, 0) == 0) found.push_back({entry.key.substr(prefix.size()), entry.value});
  return found;
}

OdometryParams params_with(const std::string& assignment) {
  OdometryParams params;
  const VisitParams visit = [&](ParamVisitor& v) { params.visit(v); };
  set_param("edge_map.mode=off", visit);  // changes no pose
  if (!assignment.empty()) set_param(assignment, visit);
  return params;
}

// Every second image of a walk with the camera in the hand: 14 degrees an image, where corners are needed.
const RenderedSequence& short_walk() {
  static const RenderedSequence walk = [] {
    constexpr int kEnd = 100, kEvery = 2;
    const SceneRenderer renderer(load_scene("office_walk"));
    const Trajectory truth = truth_of(renderer.scene(), 0, kEnd);
    auto clip = std::make_shared<Clip>(Clip{renderer.camera(), "rendered", {}});
    RenderedSequence some{clip, truth};
    some.truth.poses.clear();
    for (int i = 0; i < kEnd; i += kEvery) {
      RenderedFrame frame = renderer.render(i);
      clip->frames.push_back({i, frame.time, std::move(frame.image), {}});
      some.truth.poses.push_back(truth.poses[size_t(i)]);
    }
    return some;
  }();
  return walk;
}

RunAccuracy walk_with(const std::string& assignment) {
  ClipSource source(short_walk().clip);
  return measure(run_source(source, params_with(assignment)), short_walk().truth);
}

// A threshold that switches a rule off may have other uses, and be advanced.
TEST(Ablation, EachSwitchIsAnExperimentalParameterAndNoneIsBasic) {
  OdometryParams params;
  const std::vector<ParamDescription> known = describe_params([&](ParamVisitor& v) { params.visit(v); });
  ASSERT_GT(ablations().size(), 12u);
  for (const Ablation& a : ablations()) {
    const auto found =
        std::find_if(known.begin(), known.end(), [&](const auto& p) { return p.key == a.key(); });
    ASSERT_NE(found, known.end()) << a.name << ": no parameter " << a.key();
    const bool is_switch = found->value == "true" || found->value == "false";
    EXPECT_NE(found->level, ParamLevel::kBasic) << a.key();
    if (is_switch) {
      EXPECT_EQ(found->level, ParamLevel::kExperimental) << a.key();
    }
  }
}

void print(const std::string& name, const RunAccuracy& run) {
  std::printf("%-26s ATE %6.3f %%, %5.1f %% with a pose, %3.0f ms a frame\n", name.c_str(), run.ate_percent,
              100 * run.completion, run.mean_cpu_ms);
}

int broken_poses(const edgevo::Run& run) {
  return int(std::count_if(run.frames.begin(), run.frames.end(), [](const FrameRecord& f) {
    return f.T_world_cam && !f.T_world_cam->is_finite();
  }));
}

// Measured, seed 1: 0.015 % with all rules, 0.6 % without points of guessed depth, 3.8 % without corners,
// which lose a frame of a longer walk; 0.018 % at most without another.
TEST(Ablation, ARunWithoutAnyOneRuleKeepsItsPoses) {
  const RunAccuracy all = walk_with("");
  print("all rules", all);
  EXPECT_EQ(all.completion, 1);
  EXPECT_LT(all.ate_percent, 0.1);
  for (const Ablation& a : ablations()) {
    const RunAccuracy without = walk_with(a.assignment);
    print(a.name, without);
    EXPECT_GE(without.completion, 0.96) << a.name;  // two frames
    EXPECT_LE(without.first_posed, 3) << a.name;
    EXPECT_LT(without.ate_percent, 10) << a.name;
    EXPECT_EQ(broken_poses(without.run), 0) << a.name;
  }
}

}  // namespace
}  // namespace edgevo::test
