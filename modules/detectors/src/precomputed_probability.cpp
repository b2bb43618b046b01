// SPDX-License-Identifier: BSD-3-Clause
// Probabilities from files, as written by `edgevo edges` or any other program: NAME.png for the image NAME.*
#include <filesystem>
#include <opencv2/imgcodecs.hpp>

#include "detector_list.h"
#include "edgevo/core/error.h"
#include "edgevo/core/input_file.h"
#include "edgevo/edges/opencv_view.h"
#include "edgevo/files/image_integrity.h"

namespace edgevo {
namespace {

namespace fs = std::filesystem;

constexpr const char* kImagesRemedy =
    "make it again with `edgevo edges SOURCE -o FOLDER` and the same source options as the run";

cv::Mat decode(const std::string& path) try {
  const std::string bytes = read_file(path, kImagesRemedy);
  const std::string damage = image_damage(bytes);
  if (!damage.empty()) throw InputError(path, "the image does not decode: " + damage, kImagesRemedy);
  return cv::imdecode(cv::Mat(1, int(bytes.size()), CV_8UC1, const_cast<char*>(bytes.data())),
                      cv::IMREAD_UNCHANGED);
} catch (const cv::Exception&) {
  return {};
}

class PrecomputedProbability : public EdgeProbability {
 public:
  explicit PrecomputedProbability(const std::string& folder) : folder_(folder) {
    if (folder.empty())
      throw InputError("edges.folder", "is not given",
                       "give the output folder of `edgevo edges` with --edge-folder FOLDER");
    std::error_code ignored;
    if (!fs::is_directory(folder, ignored)) throw InputError(folder, "is not a folder", kImagesRemedy);
  }

  Plane<uint8_t> estimate(const ImageView<uint8_t>& gray, const std::string& name) override {
    const std::string path = (fs::path(folder_) / (name + ".png")).string();
    const cv::Mat image = decode(path);
    if (image.empty()) throw InputError(path, "is not a valid image", kImagesRemedy);
    if (image.type() != CV_8UC1 && image.type() != CV_16UC1)
      throw InputError(path, "is not an image of 8 or 16 bits and one channel", kImagesRemedy);
    if (image.cols != gray.width || image.rows != gray.height)
      throw InputError(path,
                       "is " + std::to_string(image.cols) + "x" + std::to_string(image.rows) +
                           ", the image " + std::to_string(gray.width) + "x" + std::to_string(gray.height),
                       kImagesRemedy);
    Plane<uint8_t> probability(gray.width, gray.height);
    image.convertTo(as_mat(probability), CV_8U, image.depth() == CV_16U ? 255.0 / 65535.0 : 1.0);
    return probability;
  }

  std::string description() const override { return folder_; }

 private:
  std::string folder_;
};

}  // namespace

std::unique_ptr<EdgeProbability> make_precomputed_probability(const EdgeParams& params) {
  return std::make_unique<PrecomputedProbability>(params.folder);
}

}  // namespace edgevo
