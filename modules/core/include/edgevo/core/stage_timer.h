// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// CPU time of each stage of a run, also in its trace.
#include "edgevo/core/stage_times.h"
#include "edgevo/core/thread_clock.h"
#include "edgevo/core/trace.h"

namespace edgevo {

/// The stages of tracking, followed by those of mapping.
enum class Stage {
  kEdges,
  kAlignment,
  kCorners,
  kFeatureTracking,
  kBootstrap,
  kDepthFilter,
  kAssociation,
  kActivation,
  kBundleAdjustment,
  kWindow,
  kEdgeMap,
  kSelfCalibration,
};

/// Name of a stage in the output files of a run.
const char* name_of(Stage stage);

/// Records the CPU time from its construction to its destruction.
class StageTimer {
 public:
  /// `times` must outlive this; the stage is appended to it.
  StageTimer(Stage stage, StageTimes* times)
      : traced_(name_of(stage)), stage_(stage), times_(times), start_(thread_cpu_ms()) {}
  ~StageTimer() { times_->emplace_back(name_of(stage_), thread_cpu_ms() - start_); }
  StageTimer(const StageTimer&) = delete;
  StageTimer& operator=(const StageTimer&) = delete;

 private:
  TraceScope traced_;
  Stage stage_;
  StageTimes* times_;
  double start_;
};

}  // namespace edgevo
