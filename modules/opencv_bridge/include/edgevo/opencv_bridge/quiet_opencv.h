#pragma once
// OpenCV's own words kept off stderr: its back ends announce each format that they do not know.

namespace edgevo {

/// Nothing of OpenCV's log while it lives. One at a time: the level is that of the process.
class QuietOpenCv {
 public:
  QuietOpenCv();   ///< silences it
  ~QuietOpenCv();  ///< as it was before
  QuietOpenCv(const QuietOpenCv&) = delete;
  QuietOpenCv& operator=(const QuietOpenCv&) = delete;

 private:
  int before_;  // cv::utils::logging::LogLevel
};

}  // namespace edgevo
