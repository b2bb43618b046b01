// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/mrpt_bridge/conversions.h"

#include <mrpt/math/CQuaternion.h>

#include <cstring>
#include <opencv2/core.hpp>

#include "edgevo/core/closest_lens.h"
#include "edgevo/core/error.h"
#include "edgevo/core/frame_checks.h"
#include "edgevo/core/output_file.h"
#include "gray_conversion.h"

namespace edgevo {
namespace {

// From 1601-01-01, where MRPT's clock starts, to the Unix epoch, in 100 ns ticks.
constexpr int64_t kUnixEpochInMrptTicks = 116'444'736'000'000'000;

}  // namespace

mrpt::poses::CPose3D to_mrpt(const SE3& T_a_b) {
  const Eigen::Quaterniond& q = T_a_b.rotation();
  const Eigen::Vector3d& t = T_a_b.translation();
  return mrpt::poses::CPose3D(mrpt::math::CQuaternionDouble(q.w(), q.x(), q.y(), q.z()), t.x(), t.y(), t.z());
}

SE3 from_mrpt(const mrpt::poses::CPose3D& T_a_b) {
  Eigen::Matrix3d R;
  for (int row = 0; row < 3; ++row)
    for (int col = 0; col < 3; ++col) R(row, col) = T_a_b.getRotationMatrix()(row, col);
  return {R, Eigen::Vector3d(T_a_b.x(), T_a_b.y(), T_a_b.z())};
}

mrpt::Clock::time_point to_mrpt(Timestamp t) {
  return mrpt::Clock::time_point(mrpt::Clock::duration(t.ticks + kUnixEpochInMrptTicks));
}

Timestamp from_mrpt(mrpt::Clock::time_point t) {
  return {t.time_since_epoch().count() - kUnixEpochInMrptTicks};
}

ClosestMrptCamera closest_mrpt(const Camera& camera) {
  ClosestMrptCamera closest;
  mrpt::img::TCamera& c = closest.camera;
  const Pinhole p = camera.pinhole();
  c.ncols = uint32_t(p.width);
  c.nrows = uint32_t(p.height);
  c.setIntrinsicParamsFromValues(p.fx, p.fy, p.cx, p.cy);
  if (const auto d = camera.plumb_bob()) {
    c.setDistortionPlumbBob(d->k1, d->k2, d->p1, d->p2, d->k3);
    return closest;
  }
  const ClosestLens lens = closest_kannala_brandt(camera);
  const auto& k = std::get<KannalaBrandtModel>(lens.camera.model);
  c.setDistortionKannalaBrandt(k.k1, k.k2, k.k3, k.k4);
  closest.max_error_px = lens.max_error_px;
  return closest;
}

mrpt::img::TCamera to_mrpt(const Camera& camera) {
  constexpr double kSame = 0.5;  // pixels: less than a calibration leaves in the corners
  const ClosestMrptCamera closest = closest_mrpt(camera);
  if (closest.max_error_px <= kSame) return closest.camera;
  throw InputError(
      "camera",
      std::string("MRPT knows the lenses plumb_bob and kannala_brandt; the closest to this one (") +
          to_string(camera.model) + ") is up to " + fixed(closest.max_error_px, 1) + " px off",
      "rectify the images first, or calibrate as kannala_brandt (edgevo calibrate --model fisheye)");
}

Camera from_mrpt(const mrpt::img::TCamera& camera, const std::string& where) {
  using mrpt::img::DistortionModel;
  Camera result;
  const Distortion d{camera.k1(), camera.k2(), camera.p1(), camera.p2(), camera.k3()};
  if (camera.distortion == DistortionModel::kannala_brandt)
    result.model = KannalaBrandtModel{{}, camera.k1(), camera.k2(), camera.k3(), camera.k4()};
  else if (camera.distortion == DistortionModel::plumb_bob &&
           (camera.k4() != 0 || camera.k5() != 0 || camera.k6() != 0))
    result.model = RationalModel{{}, {d, camera.k4(), camera.k5(), camera.k6(), 0, 0, 0, 0}};
  result.set_pinhole(
      {camera.fx(), camera.fy(), camera.cx(), camera.cy(), int(camera.ncols), int(camera.nrows)});
  if (camera.distortion == DistortionModel::plumb_bob && result.plumb_bob()) result.set_distortion(d);
  result.check(where);
  return result;
}

mrpt::img::CImage to_mrpt(const GrayImage& image) {
  check_pixels(image, "to_mrpt()");
  const cv::Mat pixels(image.height, image.width, CV_8UC1, const_cast<uint8_t*>(image.pixels.data()));
  return mrpt::img::CImage(pixels, mrpt::img::DEEP_COPY);
}

GrayImage from_mrpt(const mrpt::img::CImage& image, const std::optional<IntensityScale>& scale,
                    const std::string& where) {
  return to_gray(image.isEmpty() ? cv::Mat() : image.asCvMatRef(), scale, where);
}

std::optional<DeepImage> deep_from_mrpt(const mrpt::img::CImage& image, const std::string& where) {
  return to_deep(image.isEmpty() ? cv::Mat() : image.asCvMatRef(), where);
}

SE3 T_vehicle_cam_forward() {
  Eigen::Matrix3d R;
  R << 0, 0, 1, -1, 0, 0, 0, -1, 0;  // x_vehicle = z_cam, y_vehicle = -x_cam, z_vehicle = -y_cam
  return {R, Eigen::Vector3d::Zero()};
}

}  // namespace edgevo
