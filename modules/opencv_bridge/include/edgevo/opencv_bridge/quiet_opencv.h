// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Keeps OpenCV's log off stderr: its back ends announce every format they do not support.

namespace edgevo {

/// Silences OpenCV's log during its lifetime. One instance at a time: the log level is that of the process.
class QuietOpenCv {
 public:
  /// Silences the log.
  QuietOpenCv();
  /// Restores the previous log level.
  ~QuietOpenCv();
  QuietOpenCv(const QuietOpenCv&) = delete;
  QuietOpenCv& operator=(const QuietOpenCv&) = delete;

 private:
  int before_;  // cv::utils::logging::LogLevel
};

}  // namespace edgevo
