#pragma once
// The parts of summary.yaml, each a key with what stands below it.
#include "edgevo/results/yaml_writer.h"
#include "summary.h"

namespace edgevo {

// camera_part.cpp
/// As the run was given it.
void write_camera(const Camera& camera, YamlWriter* y);
/// What self-calibration found, in numbers and in words.
void write_self_calibration(const CameraRefinement& c, YamlWriter* y);

// map_part.cpp
void write_map(const Run& run, const MapReport& report, YamlWriter* y);

// timing_part.cpp
/// Time by the clock and of the CPU, stage by stage, and memory.
void write_timing(const SummaryInput& input, YamlWriter* y);
/// Pace and latency; nothing for a synchronous run.
void write_realtime(const Run& run, YamlWriter* y);

}  // namespace edgevo
