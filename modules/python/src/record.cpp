// SPDX-License-Identifier: BSD-3-Clause
#include "record.h"

#include <limits>

#include "classes.h"
#include "edgevo/core/formatted.h"

namespace edgevo::python {
namespace {

std::string record_in_words(const FrameRecord& r) {
  return formatted("Record(%d, time=%s, %s, segment=%d%s)", r.index, to_string(r.time).c_str(),
                   std::string(to_string(r.state)).c_str(), r.segment,
                   r.note.empty() ? "" : (", " + r.note).c_str());
}

}  // namespace

int64_t nanoseconds(Timestamp time) {
  constexpr int64_t kPerTick = 1'000'000'000 / Timestamp::kTicksPerSecond;
  return time.ticks * kPerTick;
}

py::array covariance_array(const Matrix6d& covariance) {
  if (!covariance.isZero(0)) return to_array(Eigen::MatrixXd(covariance));
  return to_array(Eigen::MatrixXd(Eigen::MatrixXd::Constant(6, 6, std::numeric_limits<double>::quiet_NaN())));
}

void add_record(py::module_& module) {
  py::class_<FrameRecord> record(module, "Record", "What is known of a frame once it is processed; a value.");
  record.def_readonly("index", &FrameRecord::index, "Number of the frame.");
  record.def_property_readonly(
      "time", [](const FrameRecord& r) { return r.time.seconds(); }, "Time of exposure, seconds.");
  record.def_property_readonly(
      "time_ns", [](const FrameRecord& r) { return nanoseconds(r.time); }, "The same in nanoseconds: exact.");
  record.def_property_readonly(
      "state", [](const FrameRecord& r) { return to_python(r.state); }, "State of the tracking.");
  record.def_property_readonly(
      "ok",
      [](const FrameRecord& r) {
        return r.state == TrackingState::kTracking && r.T_world_cam_live.has_value();
      },
      "Whether there is a pose and nothing speaks against it.");
  record.def_readonly("segment", &FrameRecord::segment,
                      "Number of the connected part of the trajectory, from 0; -1: none.");
  record.def_readonly("p_right", &FrameRecord::p_right,
                      "Probability that the motion around this frame is right, 0 to 1; NaN: unknown.");
  record.def_readonly("note", &FrameRecord::note, "Why there is no pose, or a doubtful one; else empty.");
  record.def_readonly("is_keyframe", &FrameRecord::is_keyframe, "Whether the frame became a keyframe.");
  record.def_property_readonly(
      "T_world_cam", [](const FrameRecord& r) { return to_array(r.T_world_cam_live); },
      "Pose as known now, 4 x 4: p_world = T p_cam; camera x right, y down, z forward; the world has the\n"
      "axes of the first camera. The unit is arbitrary. None while there is no pose.");
  record.def_property_readonly(
      "covariance", [](const FrameRecord& r) { return covariance_array(r.covariance); },
      "Covariance of the pose relative to its keyframe, 6 x 6: translation, then rotation (radians), in the\n"
      "axes of the camera. NaN: unknown.");
  record.def("__repr__", record_in_words);
}

}  // namespace edgevo::python
