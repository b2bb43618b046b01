// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Parts of summary.yaml, each a key with its content.
#include "edgevo/results/yaml_writer.h"
#include "summary.h"

namespace edgevo {

// camera_part.cpp
/// Writes the camera as it was given to the run.
void write_camera(const Camera& camera, YamlWriter* y);
/// Writes the result of self-calibration, in numbers and in words.
void write_self_calibration(const CameraPosterior& c, YamlWriter* y);

// map_part.cpp
/// Writes the counts of points, lines, voxels and grid cells.
void write_map(const Run& run, const MapReport& report, YamlWriter* y);

// timing_part.cpp
/// Writes wall-clock time, CPU time, times of the stages, and memory.
void write_timing(const SummaryInput& input, YamlWriter* y);
/// Writes pace and latency; nothing for a synchronous run.
void write_realtime(const Run& run, YamlWriter* y);

}  // namespace edgevo
