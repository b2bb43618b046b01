// SPDX-License-Identifier: BSD-3-Clause
// resample_lens SEQUENCE OUT LENS: a sequence of images as another lens (kannala_brandt, double_sphere,
// rational) would have taken it, with the camera file of Kalibr or ROS. To be run by hand; it shares no code
// with edgevo, so that an error of its lenses shows as a worse trajectory.
//
// The new lens has the focal length of the old one on its axis, and shows as much along its row and column.
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iostream>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <sstream>
#include <vector>

namespace fs = std::filesystem;

namespace {

struct Old {
  double fx, fy, cx, cy;
  int width, height;
  cv::Mat K, distortion;
};

// Distance from the principal point, over the focal length, at an angle from the axis.
using Radius = std::function<double(double)>;

struct Lens {
  Radius radius;
  std::string text;  // of the camera file, with the names of what is to be filled in
};

struct New {
  double fx, fy, cx, cy;
  int width, height;
};

Old read_camera(const fs::path& path) {
  std::ifstream in(path);
  std::string line;
  while (std::getline(in, line) && line[0] == '#') {
  }
  std::istringstream numbers(line);
  Old c{};
  double k1 = 0, k2 = 0, p1 = 0, p2 = 0, k3 = 0;
  numbers >> c.fx >> c.fy >> c.cx >> c.cy >> k1 >> k2 >> p1 >> p2 >> c.width >> c.height >> k3;
  c.K = (cv::Mat_<double>(3, 3) << c.fx, 0, c.cx, 0, c.fy, c.cy, 0, 0, 1);
  c.distortion = (cv::Mat_<double>(1, 5) << k1, k2, p1, p2, k3);
  return c;
}

// R = f (theta + k1 theta^3 + ...), Kalibr's pinhole-equi.
Lens kannala_brandt() {
  const double k[] = {-0.031, 0.0062, -0.0049, 0.0011};
  const auto radius = [k](double t) {
    const double t2 = t * t;
    return t * (1 + t2 * (k[0] + t2 * (k[1] + t2 * (k[2] + t2 * k[3]))));
  };
  return {radius,
          "cam0:\n  camera_model: pinhole\n  intrinsics: [FX, FY, CX, CY]\n  distortion_model: equidistant\n"
          "  distortion_coeffs: [-0.031, 0.0062, -0.0049, 0.0011]\n  resolution: [WIDTH, HEIGHT]\n"};
}

// Kalibr's ds-none: its focal length is (1 + xi) of that on the axis.
Lens double_sphere() {
  const double xi = -0.21, alpha = 0.58;
  const auto radius = [=](double t) {
    const double z = xi + std::cos(t), d = std::hypot(std::sin(t), z);
    return (1 + xi) * std::sin(t) / (alpha * d + (1 - alpha) * z);
  };
  return {radius,
          "cam0:\n  camera_model: ds\n  intrinsics: [-0.21, 0.58, DS_FX, DS_FY, CX, CY]\n"
          "  distortion_model: none\n  distortion_coeffs: []\n  resolution: [WIDTH, HEIGHT]\n"};
}

// ROS's rational_polynomial.
Lens rational() {
  const auto radius = [](double t) {
    const double r = std::tan(t), r2 = r * r;
    return r * (1 + r2 * (0.92 + r2 * (0.21 + r2 * 0.01))) / (1 + r2 * (1.24 + r2 * (0.42 + r2 * 0.035)));
  };
  return {
      radius,
      "image_width: WIDTH\nimage_height: HEIGHT\ncamera_name: narrow\ncamera_matrix:\n  rows: 3\n  cols: 3\n"
      "  data: [FX, 0, CX, 0, FY, CY, 0, 0, 1]\ndistortion_model: rational_polynomial\n"
      "distortion_coefficients:\n  rows: 1\n  cols: 8\n"
      "  data: [0.92, 0.21, 0, 0, 0.01, 1.24, 0.42, 0.035]\n"};
}

// The angle whose radius is `r`.
double angle_of(const Radius& radius, double r) {
  double low = 0, high = 1.4;
  for (int i = 0; i < 50; ++i) {
    const double middle = 0.5 * (low + high);
    (radius(middle) < r ? low : high) = middle;
  }
  return low;
}

// The pinhole coordinate of the middle of a side, as the lens shows it.
double shown(const Radius& radius, double tangent) { return radius(std::atan(tangent)); }

New new_camera(const Old& old, const Radius& radius) {
  New c{old.fx, old.fy, 0, 0, 0, 0};
  const double left = old.fx * shown(radius, (old.cx + 0.5) / old.fx),
               right = old.fx * shown(radius, (old.width - 0.5 - old.cx) / old.fx),
               up = old.fy * shown(radius, (old.cy + 0.5) / old.fy),
               down = old.fy * shown(radius, (old.height - 0.5 - old.cy) / old.fy);
  c.cx = left - 0.5, c.cy = up - 0.5;
  c.width = int(left + right), c.height = int(up + down);
  return c;
}

// Where each new pixel lies in the old image.
void make_maps(const Old& old, const New& now, const Radius& radius, cv::Mat* x, cv::Mat* y) {
  std::vector<cv::Point3d> rays;
  for (int v = 0; v < now.height; ++v)
    for (int u = 0; u < now.width; ++u) {
      const double a = (u - now.cx) / now.fx, b = (v - now.cy) / now.fy, r = std::hypot(a, b);
      const double t = r > 0 ? std::tan(angle_of(radius, r)) / r : 1;
      rays.emplace_back(a * t, b * t, 1);
    }
  std::vector<cv::Point2d> px;
  cv::projectPoints(rays, cv::Vec3d(0, 0, 0), cv::Vec3d(0, 0, 0), old.K, old.distortion, px);
  *x = cv::Mat(now.height, now.width, CV_32F), *y = x->clone();
  for (size_t i = 0; i < px.size(); ++i) {
    x->at<float>(int(i) / now.width, int(i) % now.width) = float(px[i].x);
    y->at<float>(int(i) / now.width, int(i) % now.width) = float(px[i].y);
  }
}

std::string filled(std::string text, const New& c) {
  const auto fill = [&](const std::string& name, double value) {
    std::ostringstream digits;
    digits.precision(15);
    digits << value;
    for (size_t at = text.find(name); at != std::string::npos; at = text.find(name))
      text.replace(at, name.size(), digits.str());
  };
  const double ds = 1 - 0.21;
  fill("DS_FX", ds * c.fx), fill("DS_FY", ds * c.fy), fill("FX", c.fx), fill("FY", c.fy);
  fill("CX", c.cx), fill("CY", c.cy), fill("WIDTH", c.width), fill("HEIGHT", c.height);
  return text;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) {
    std::cerr << "usage: resample_lens SEQUENCE OUT kannala_brandt|double_sphere|rational\n";
    return 2;
  }
  const fs::path from = argv[1], to = argv[2];
  const std::string name = argv[3];
  const Lens lens = name == "rational"        ? rational()
                    : name == "double_sphere" ? double_sphere()
                                              : kannala_brandt();
  const Old old = read_camera(from / "camera.txt");
  const New now = new_camera(old, lens.radius);
  cv::Mat x, y;
  make_maps(old, now, lens.radius, &x, &y);
  fs::create_directories(to / "images");
  for (const char* file : {"times.txt", "groundtruth_tum.txt"})
    fs::copy_file(from / file, to / file, fs::copy_options::overwrite_existing);
  std::ofstream(to / "camera.txt") << filled(lens.text, now);
  for (const auto& entry : fs::directory_iterator(from / "images")) {
    const cv::Mat image = cv::imread(entry.path().string(), cv::IMREAD_GRAYSCALE);
    cv::Mat out;
    cv::remap(image, out, x, y, cv::INTER_CUBIC, cv::BORDER_REPLICATE);
    cv::imwrite((to / "images" / entry.path().stem()).string() + ".png", out);
  }
  std::printf("%s: %dx%d\n", to.c_str(), now.width, now.height);
  return 0;
}
