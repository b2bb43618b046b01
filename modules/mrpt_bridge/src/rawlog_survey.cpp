// SPDX-License-Identifier: BSD-3-Clause
#include "rawlog_survey.h"

#include <filesystem>

#include "edgevo/core/error.h"
#include "edgevo/mrpt_bridge/conversions.h"
#include "edgevo/mrpt_bridge/rawlog_image.h"
#include "edgevo/mrpt_bridge/rawlog_reader.h"
#include "gz_archive.h"

namespace edgevo {
namespace {

constexpr int64_t kSurveyLimit = int64_t(256)
                                 << 20;  // bytes of the compressed file, read in one to two seconds

constexpr size_t kSampleStep = 30;  // every 30th image shows what values a camera gives

// A damaged image shows nothing; it is reported when it is played.
void add_values(const mrpt::img::CImage& image, IntensityCount* count) try {
  if (const auto deep = deep_from_mrpt(image, "")) count->add(*deep);
} catch (const InputError&) {
}

void add_sample(const mrpt::img::CImage& image, SurveyedCamera* camera) {
  const size_t index = camera->times.size();
  if (index % kSampleStep != 0) return;
  if (image.isExternallyStored())
    camera->some_files.push_back(image.getExternalStorageFile());
  else if (index == 0 || camera->intensities.images() > 0)
    add_values(image, &camera->intensities);
}

void add_image(const RawlogImage& image, RawlogSurvey* survey) {
  auto* camera = const_cast<SurveyedCamera*>(survey->find(image.label));
  if (!camera) {
    survey->cameras.push_back(
        {image.label, image.kind, {}, *image.camera, image.T_vehicle_cam, image.image->isExternallyStored()});
    camera = &survey->cameras.back();
  }
  add_sample(*image.image, camera);
  camera->times.push_back(image.time);
}

}  // namespace

const SurveyedCamera* RawlogSurvey::find(const std::string& label) const {
  for (const SurveyedCamera& camera : cameras)
    if (camera.label == label) return &camera;
  return nullptr;
}

std::string RawlogSurvey::list() const {
  std::string text;
  for (const SurveyedCamera& camera : cameras)
    text += (text.empty() ? "" : ", ") + (camera.label.empty() ? "''" : camera.label) + " (" +
            std::to_string(camera.times.size()) + " images)";
  return text;
}

RawlogSurvey survey_rawlog(const std::string& path) {
  std::error_code ignored;
  if (std::filesystem::file_size(path, ignored) == 0)
    throw InputError(path, "the file is empty (0 bytes)", "copy the rawlog again");
  const std::string damage = gz_checksum_damage(path, kSurveyLimit);
  if (!damage.empty()) throw InputError(path, damage, "copy the rawlog again");
  RawlogSurvey survey;
  RawlogReader reader(path);
  try {
    while (const auto observation = reader.next()) {
      if (const auto image = find_image(*observation))
        add_image(*image, &survey);
      else
        ++survey.others[observation->GetRuntimeClass()->className];
      if (reader.position() > kSurveyLimit) {
        survey.complete = false;
        break;
      }
    }
  } catch (const InputError& e) {
    survey.damage = e.what();
  }
  return survey;
}

}  // namespace edgevo
