// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Synthetic rawlogs for the tests of reader and source.
#include <mrpt/obs/CObservationImage.h>
#include <zlib.h>

#include <string>

#include "edgevo/mrpt_bridge/conversions.h"
#include "edgevo/mrpt_bridge/rawlog_source.h"
#include "edgevo/mrpt_bridge/rawlog_writer.h"
#include "unit/datasets/temp_sequence.h"

namespace edgevo::test {

constexpr int64_t kFirstTick = 13050311021753041;

inline Camera small_camera() { return {{20, 21, 12, 8, 24, 16}, {0.1, -0.02, 0.001, 0.002, 0.003}}; }

inline Timestamp frame_time(int i) { return {kFirstTick + 333333 * int64_t(i)}; }

/// Frame `i` with its image inside.
inline mrpt::obs::CObservationImage embedded(int i, const std::string& label = "CAM0") {
  mrpt::obs::CObservationImage o;
  o.sensorLabel = label;
  o.timestamp = to_mrpt(frame_time(i));
  o.cameraParams = to_mrpt(small_camera());
  o.cameraPose = to_mrpt(T_vehicle_cam_forward());
  o.image = to_mrpt(make_image(i));
  return o;
}

inline mrpt::obs::CObservationImage external(int i, const std::string& file) {
  mrpt::obs::CObservationImage o = embedded(i);
  o.image.setExternalStorage(file);
  return o;
}

inline void write_embedded(const std::string& path, int count) {
  RawlogWriter writer(path);
  for (int i = 0; i < count; ++i) writer.write(embedded(i));
  writer.close();
}

inline std::string inflate(const std::string& path) {
  std::string bytes(1 << 20, '\0');
  const gzFile file = gzopen(path.c_str(), "rb");
  bytes.resize(size_t(gzread(file, bytes.data(), unsigned(bytes.size()))));
  gzclose(file);
  return bytes;
}

inline void write_gz(const std::string& path, const std::string& bytes) {
  const gzFile file = gzopen(path.c_str(), "wb");
  gzwrite(file, bytes.data(), unsigned(bytes.size()));
  gzclose(file);
}

/// An object of an unregistered class: name, version, a few bytes, end mark.
inline std::string unknown_object() {
  const std::string name = "ns::CObservationOfTomorrow";
  return std::string(1, char(0x80 | name.size())) + name + std::string("\x00\x01\x02\x03", 4) + "\x88";
}

inline std::unique_ptr<ImageSource> open(const std::string& path, const std::string& label = "") {
  return open_rawlog({path, label, std::nullopt});
}

inline void expect_frames(ImageSource& source, int count) {
  const auto frames = read_all(source);
  ASSERT_EQ(int(frames.size()), count);
  for (int i = 0; i < count; ++i) {
    EXPECT_EQ(frames[size_t(i)].index, i);
    EXPECT_EQ(frames[size_t(i)].time, frame_time(i));
    EXPECT_TRUE(same_pixels(frames[size_t(i)].image, make_image(i))) << "frame " << i;
  }
}

}  // namespace edgevo::test
