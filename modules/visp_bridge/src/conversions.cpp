#include "edgevo/visp_bridge/conversions.h"

#include <algorithm>

#include "edgevo/core/error.h"

namespace edgevo {

vpImage<unsigned char> share_with_visp(GrayImage& image) {
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

vpCameraParameters to_visp(const Pinhole& p) { return vpCameraParameters(p.fx, p.fy, p.cx, p.cy); }

Pinhole to_pinhole(const vpCameraParameters& camera, int width, int height) {
  if (camera.get_projModel() != vpCameraParameters::perspectiveProjWithoutDistortion)
    throw InputError("ViSP camera", "has a distortion model",
                     "undistort the images and give the camera of the undistorted ones");
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
