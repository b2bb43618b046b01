#include "edgevo/mrpt_bridge/rawlog_import.h"

#include <mrpt/obs/CObservationImage.h>

#include <cctype>
#include <cstdio>
#include <filesystem>

#include "edgevo/core/output_file.h"
#include "edgevo/mrpt_bridge/conversions.h"
#include "edgevo/mrpt_bridge/image_file.h"
#include "edgevo/mrpt_bridge/rawlog_writer.h"

namespace edgevo {
namespace {

constexpr const char* kDefaultLabel = "CAM0";

// A label as part of a file name.
std::string file_label(std::string label) {
  for (char& c : label)
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '-') c = '_';
  return label;
}

std::string image_name(const std::string& label, int index) {
  char number[16];
  std::snprintf(number, sizeof number, "_%06d.png", index);
  return file_label(label) + number;
}

mrpt::obs::CObservationImage make_observation(const ImageSource& source, const std::string& label) {
  mrpt::obs::CObservationImage observation;
  observation.sensorLabel = label;
  observation.cameraParams = to_mrpt(source.camera());
  observation.cameraParams.cameraName = label;
  observation.cameraPose = to_mrpt(source.T_vehicle_cam().value_or(T_vehicle_cam_forward()));
  return observation;
}

}  // namespace

int import_rawlog(ImageSource& source, const std::string& rawlog_path, const ImportProgress& progress) {
  const std::filesystem::path folder = rawlog_stem(rawlog_path) + "_Images";
  make_output_folder(folder.string());
  const std::string label = source.label().empty() ? kDefaultLabel : source.label();
  mrpt::obs::CObservationImage observation = make_observation(source, label);
  RawlogWriter writer(rawlog_path);
  int written = 0;
  while (const auto frame = source.next()) {
    const std::string name = image_name(label, frame->index);
    write_png((folder / name).string(), frame->image);
    observation.timestamp = to_mrpt(frame->time);
    observation.image.setExternalStorage(name);
    writer.write(observation);
    ++written;
    if (progress) progress(written);
  }
  writer.close();
  return written;
}

}  // namespace edgevo
