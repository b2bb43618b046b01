// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Samples of a gyro in a text file: a time, three rates and, where there is an accelerometer, three
// accelerations a line, separated by commas or blanks.
//
//   EuRoC, TUM-VI  mav0/imu0/data.csv, nanoseconds
//   DM-VIO         imu.txt, nanoseconds or seconds
//
// The unit of the times is that in which the steps are those of a gyro. A header (#) that names degrees, or
// accelerations first, is believed; without one, a triple as long as gravity is the acceleration. A file in
// degrees a second that does not say so is found by the images (gyro/gyro_aid.h).
#include <string>
#include <vector>

#include "edgevo/core/gyro_sample.h"
#include "edgevo/core/input_decision.h"

namespace edgevo {

/// Contents of a file.
struct GyroFile {
  /// Samples in the order of their times.
  std::vector<GyroSample> samples;
  /// What was taken from what the file does not state: the unit, the order of its columns.
  std::string decided;
};

/// Reads a file. Throws InputError that names file and line: another number of fields, no number, a time
/// before that of the line before, times or rates that no gyro has, fewer than two samples.
GyroFile read_gyro_file(const std::string& path);

/// The file of a gyro in the folder of a source, or next to it; empty if there is none.
std::string find_gyro_file(const std::string& source);

/// What is to be said of a gyro, as name and value: rate, gaps, its rates where it was calmest. Reads all.
std::vector<std::pair<std::string, std::string>> describe_gyro(const GyroReadings& readings);

}  // namespace edgevo
