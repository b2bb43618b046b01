// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/visp_bridge/conversions.h"

#include <visp3/core/vpImageConvert.h>

#include <algorithm>
#include <optional>
#include <vector>

#include "edgevo/core/error.h"
#include "edgevo/core/frame_checks.h"

namespace edgevo {
namespace {

// x = x_d (1 + kdu r_d^2), least squares over the image: sum (x - x_d) . x_d r_d^2 = kdu sum |x_d r_d^2|^2.
double fitted_kdu(const Camera& camera) {
  constexpr int kGrid = 24;  // samples in each direction, ample for a smooth lens
  const Pinhole p = camera.pinhole();
  double above = 0, below = 0;
  for (int i = 0; i <= kGrid; ++i)
    for (int j = 0; j <= kGrid; ++j) {
      const Eigen::Vector2d px(double(i) / kGrid * (p.width - 1), double(j) / kGrid * (p.height - 1));
      const Eigen::Vector2d distorted = p.ray(px).head<2>();
      const std::optional<Eigen::Vector3d> ray = camera.unproject(px);
      if (!ray) continue;
      const Eigen::Vector2d cubic = distorted * distorted.squaredNorm();
      above += (ray->hnormalized() - distorted).dot(cubic);
      below += cubic.squaredNorm();
    }
  return below > 0 ? above / below : 0;
}

}  // namespace

vpImage<unsigned char> share_with_visp(GrayImage& image) {
  check_pixels(image, "share_with_visp()");
  return vpImage<unsigned char>(image.pixels.data(), unsigned(image.height), unsigned(image.width), false);
}

vpImage<unsigned char> to_visp(const ImageView<uint8_t>& view) {
  vpImage<unsigned char> image(unsigned(view.height), unsigned(view.width));
  for (int y = 0; y < view.height; ++y) std::copy_n(view.row(y), view.width, image[y]);
  return image;
}

ImageView<uint8_t> view_of(const vpImage<unsigned char>& image) {
  const int width = int(image.getWidth());
  return {image.bitmap, width, int(image.getHeight()), width};
}

GrayImage to_gray_image(const vpImage<unsigned char>& image) {
  return {int(image.getWidth()), int(image.getHeight()), {image.bitmap, image.bitmap + image.getSize()}};
}

GrayImage to_gray_image(const vpImage<vpRGBa>& image) {
  GrayImage gray{int(image.getWidth()), int(image.getHeight()), std::vector<uint8_t>(image.getSize())};
  vpImage<unsigned char> shared = share_with_visp(gray);
  vpImageConvert::convert(image, shared);  // same size: writes in place
  return gray;
}

vpCameraParameters to_visp(const Pinhole& p) { return vpCameraParameters(p.fx, p.fy, p.cx, p.cy); }

vpCameraParameters to_visp(const Camera& camera, const std::string& where) {
  const Pinhole p = camera.pinhole();
  if (const auto* lens = std::get_if<KannalaBrandtModel>(&camera.model)) {
    vpCameraParameters fisheye;
    fisheye.initProjWithKannalaBrandtDistortion(p.fx, p.fy, p.cx, p.cy,
                                                {lens->k1, lens->k2, lens->k3, lens->k4});
    return fisheye;
  }
  const std::optional<Distortion> d = camera.plumb_bob();
  if (!d)
    throw InputError(where, std::string("its lens (") + to_string(camera.model) + ") is none that ViSP knows",
                     "give ViSP rectified images and their pinhole");
  if (d->k2 != 0 || d->p1 != 0 || d->p2 != 0 || d->k3 != 0)
    throw InputError(where, "has more distortion than the one radial coefficient that ViSP knows",
                     "give ViSP undistorted images and their pinhole");
  if (d->k1 == 0) return to_visp(p);
  return vpCameraParameters(p.fx, p.fy, p.cx, p.cy, d->k1, fitted_kdu(camera));
}

Camera to_camera(const vpCameraParameters& camera, int width, int height) {
  const Pinhole pinhole{camera.get_px(), camera.get_py(), camera.get_u0(), camera.get_v0(), width, height};
  const auto model = camera.get_projModel();
  Camera result(pinhole);
  if (model == vpCameraParameters::ProjWithKannalaBrandtDistortion) {
    std::vector<double> k = camera.getKannalaBrandtDistortionCoefficients();
    k.resize(4, 0.0);
    result.model = KannalaBrandtModel{{}, k[0], k[1], k[2], k[3]};
    result.set_pinhole(pinhole);
  } else if (model == vpCameraParameters::perspectiveProjWithDistortion) {
    result.set_distortion({camera.get_kud(), 0, 0, 0, 0});
  }
  result.check("ViSP camera");
  return result;
}

Pinhole to_pinhole(const vpCameraParameters& camera, int width, int height) {
  if (camera.get_projModel() != vpCameraParameters::perspectiveProjWithoutDistortion)
    throw InputError("ViSP camera", "has a distortion model",
                     "use to_camera(), or undistort the images and give the camera of the undistorted ones");
  const Pinhole pinhole{camera.get_px(), camera.get_py(), camera.get_u0(), camera.get_v0(), width, height};
  Camera{pinhole, {}}.check("ViSP camera");
  return pinhole;
}

vpHomogeneousMatrix to_visp(const SE3& T_a_b) {
  const Eigen::Matrix4d T = T_a_b.matrix();
  vpHomogeneousMatrix aMb;
  for (unsigned r = 0; r < 3; ++r)
    for (unsigned c = 0; c < 4; ++c) aMb[r][c] = T(r, c);
  return aMb;
}

SE3 to_se3(const vpHomogeneousMatrix& aMb) {
  Eigen::Matrix3d R;
  Eigen::Vector3d t;
  for (unsigned r = 0; r < 3; ++r) {
    for (unsigned c = 0; c < 3; ++c) R(r, c) = aMb[r][c];
    t[r] = aMb[r][3];
  }
  return {R, t};
}

}  // namespace edgevo
