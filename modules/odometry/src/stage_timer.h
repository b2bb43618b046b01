#pragma once
// What each stage of a run costs, in CPU time.
#include "edgevo/core/thread_clock.h"
#include "edgevo/odometry/mapper.h"

namespace edgevo {

/// The stages of tracking, then those of mapping.
enum class Stage {
  kEdges,
  kAlignment,
  kCorners,
  kBootstrap,
  kDepthFilter,
  kAssociation,
  kActivation,
  kBundleAdjustment,
  kWindow,
  kEdgeMap,
  kSelfCalibration,
};

/// The name of a stage in the files of a run.
const char* name_of(Stage stage);

/// Notes the CPU time from its construction to its end.
class StageTimer {
 public:
  StageTimer(Stage stage, StageTimes* times) : stage_(stage), times_(times), start_(thread_cpu_ms()) {}
  ~StageTimer() { times_->emplace_back(name_of(stage_), thread_cpu_ms() - start_); }
  StageTimer(const StageTimer&) = delete;
  StageTimer& operator=(const StageTimer&) = delete;

 private:
  Stage stage_;
  StageTimes* times_;
  double start_;
};

}  // namespace edgevo
