// SPDX-License-Identifier: BSD-3-Clause
// Recordings of ROS as sources: frames, camera, mount, times, other sensors, and what is refused.
#include <cmath>

#include "camera_change.h"
#include "edgevo/datasets/describe.h"
#include "edgevo/datasets/open_source.h"
#include "edgevo/mrpt_bridge/conversions.h"
#include "edgevo/mrpt_bridge/rawlog_import.h"
#include "edgevo/mrpt_bridge/rawlog_reader.h"
#include "recorded_camera.h"
#include "support/recording_files.h"
#include "support/recording_messages.h"
#include "temp_sequence.h"

namespace edgevo::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr int64_t kFirstNs = 1'600'000'000'123'456'700;
constexpr int64_t kStepNs = 100'000'000;
constexpr int kFrames = 4;

TestImage test_image(int i, const std::string& encoding = "mono8", int bytes = 1) {
  const GrayImage gray = make_image(i);
  std::string data;
  for (const uint8_t pixel : gray.pixels) data += std::string(size_t(bytes), char(pixel));
  return {gray.width, gray.height, encoding, data, uint32_t(bytes * gray.width)};
}

TestCameraInfo test_info() {
  TestCameraInfo info{24, 16, "plumb_bob", {0.1, -0.02, 0.001, 0.002, 0.003}};
  info.K = {20, 0, 12, 0, 21, 8, 0, 0, 1};
  return info;
}

// A ROS 1 bag of messages that are added.
class Bag {
 public:
  size_t topic(const std::string& name, const std::string& type) {
    topics_.push_back({name, type});
    return topics_.size() - 1;
  }
  void add(size_t topic, int64_t ns, const std::string& bytes) { messages_.push_back({topic, ns, bytes}); }
  // Images of a topic, each recorded `late_ns` after its stamp.
  void add_images(const std::string& name, const std::string& encoding = "mono8", int bytes = 1,
                  int64_t late_ns = 1000, bool has_stamps = true) {
    const size_t images = topic(name, "sensor_msgs/Image");
    for (int i = 0; i < kFrames; ++i) {
      const int64_t ns = kFirstNs + i * kStepNs;
      add(images, ns + late_ns,
          image_message(Wire::kRos1, has_stamps ? ns : 0, test_image(i, encoding, bytes)));
    }
  }
  void add_info(const std::string& name, const TestCameraInfo& info) {
    add(topic(name, "sensor_msgs/CameraInfo"), kFirstNs, camera_info_message(Wire::kRos1, kFirstNs, info));
  }
  void add_static(const std::vector<TestTransform>& transforms) {
    add(topic("/tf_static", "tf2_msgs/TFMessage"), kFirstNs, transforms_message(Wire::kRos1, transforms));
  }
  SourceOptions written() const {
    SourceOptions options;
    options.path = folder_ / "x.bag";
    write_text(options.path, ros1_bag(topics_, messages_));
    return options;
  }
  const TempFolder& folder() const { return folder_; }

 private:
  TempFolder folder_;
  std::vector<TestTopic> topics_;
  std::vector<TestMessage> messages_;
};

std::string decision(const ImageSource& source, const std::string& subject) {
  for (const InputDecision& d : source.decisions())
    if (d.subject == subject) return to_string(d);
  return {};
}

TEST(RecordingSource, FramesAreThoseOfTheImages) {
  for (const auto& [encoding, bytes] :
       std::vector<std::pair<std::string, int>>{{"mono8", 1}, {"bgr8", 3}, {"rgba8", 4}, {"yuv422", 2}}) {
    Bag bag;
    bag.add_images("/cam/image_raw", encoding, bytes);
    bag.add_info("/cam/camera_info", test_info());
    const auto source = open_source(bag.written());
    EXPECT_EQ(source->kind(), "ROS 1 bag");
    EXPECT_EQ(source->size(), kFrames);
    EXPECT_EQ(source->times().size(), size_t(kFrames));
    EXPECT_EQ(source->camera().pinhole(), (Pinhole{20, 21, 12, 8, 24, 16}));
    EXPECT_EQ(source->camera().distortion().k3, 0.003);
    const auto frames = read_all(*source);
    ASSERT_EQ(frames.size(), size_t(kFrames));
    for (int i = 0; i < kFrames; ++i) {
      EXPECT_EQ(frames[size_t(i)].time.ticks, (kFirstNs + i * kStepNs) / 100);
      EXPECT_TRUE(same_pixels(frames[size_t(i)].image, make_image(i))) << encoding;
    }
    EXPECT_THAT(decision(*source, "times"), IsEmpty());
  }
}

TEST(RecordingSource, CompressedImagesAreTheFiles) {
  Bag bag;
  write_images(bag.folder().path(), kFrames);
  const size_t images = bag.topic("/cam/image_raw/compressed", "sensor_msgs/CompressedImage");
  for (int i = 0; i < kFrames; ++i)
    bag.add(images, kFirstNs + i * kStepNs,
            compressed_message(Wire::kRos1, kFirstNs + i * kStepNs, "png",
                               read_text(bag.folder() / ("00000" + std::to_string(i) + ".png"))));
  bag.add_info("/cam/camera_info", test_info());
  const auto frames = read_all(*open_source(bag.written()));
  ASSERT_EQ(frames.size(), size_t(kFrames));
  for (int i = 0; i < kFrames; ++i) EXPECT_TRUE(same_pixels(frames[size_t(i)].image, make_image(i)));
}

TEST(RecordingSource, SixteenBitsAreScaled) {
  Bag bag;
  const size_t images = bag.topic("/thermal/image_raw", "sensor_msgs/Image");
  for (int i = 0; i < kFrames; ++i) {
    TestImage image = test_image(i, "mono16", 2);
    for (size_t k = 1; k < image.data.size(); k += 2)
      image.data[k] = char(uint8_t(image.data[k]) >> 4);  // 12 bits
    bag.add(images, kFirstNs + i * kStepNs, image_message(Wire::kRos1, kFirstNs + i * kStepNs, image));
  }
  bag.add_info("/thermal/camera_info", test_info());
  const auto source = open_source(bag.written());
  EXPECT_THAT(decision(*source, "intensities"), HasSubstr("12 bits in 16-bit images"));
  const auto frame = source->next();
  ASSERT_TRUE(frame);
  EXPECT_TRUE(frame->image.is_deep());
  EXPECT_EQ(frame->image.pixels.size(), frame->image.values.size());
}

TEST(RecordingSource, OfSeveralTopicsOneIsChosen) {
  Bag bag;
  bag.add_images("/left/image_raw");
  bag.add_images("/right/image_raw", "bgr8", 3);
  bag.add_images("/depth/image", "32FC1", 4);
  bag.add_info("/left/camera_info", test_info());
  bag.add_info("/right/camera_info", test_info());
  SourceOptions options = bag.written();
  EXPECT_THAT(
      error_of([&] { open_source(options); }),
      AllOf(HasSubstr("3 topics with images: /depth/image (4 at 10.0 Hz, images of the encoding '32FC1' are "
                      "not read"),
            HasSubstr(
                "/left/image_raw (4 at 10.0 Hz, 24x16 mono8), /right/image_raw (4 at 10.0 Hz, 24x16 bgr8)"),
            HasSubstr("choose one with --topic /left/image_raw")));
  options.topic = "/right/image_raw";
  EXPECT_EQ(open_source(options)->label(), "/right/image_raw");
  options.topic = "left/image_raw";
  EXPECT_EQ(open_source(options)->label(), "/left/image_raw");
  options.topic = "/depth/image";
  EXPECT_THAT(error_of([&] { open_source(options); }),
              HasSubstr("/depth/image: images of the encoding '32FC1'"));
  options.topic = "/left/image_row";
  EXPECT_THAT(error_of([&] { open_source(options); }), HasSubstr("did you mean --topic /left/image_raw?"));
  options.topic = "/left/camera_info";
  EXPECT_THAT(error_of([&] { open_source(options); }),
              HasSubstr("/left/camera_info holds sensor_msgs/CameraInfo"));
}

TEST(RecordingSource, TheOnlyTopicThatCanBeReadIsTaken) {
  Bag bag;
  bag.add_images("/color/image_raw");
  bag.add_images("/depth/image", "32FC1", 4);
  bag.add_info("/color/camera_info", test_info());
  EXPECT_EQ(open_source(bag.written())->label(), "/color/image_raw");
}

TEST(RecordingSource, WithoutImagesItsTopicsAreNamed) {
  Bag bag;
  bag.add_info("/cam/camera_info", test_info());
  EXPECT_THAT(error_of([&] { open_source(bag.written()); }),
              HasSubstr("no images in it; its topics are /cam/camera_info (sensor_msgs/CameraInfo, 1)"));
}

TEST(RecordingSource, WithoutCalibrationOneIsRequired) {
  Bag bag;
  bag.add_images("/cam/image_raw");
  TestCameraInfo uncalibrated;
  uncalibrated.width = 24, uncalibrated.height = 16;
  bag.add_info("/cam/camera_info", uncalibrated);
  SourceOptions options = bag.written();
  EXPECT_THAT(error_of([&] { open_source(options); }),
              AllOf(HasSubstr("/cam/camera_info says that the camera is not calibrated (K is zero)"),
                    HasSubstr("--camera auto")));
  options.any_camera = true;
  EXPECT_THAT(decision(*open_source(options), "camera"),
              AllOf(HasSubstr("not known"), HasSubstr("K is zero")));
  options.any_camera = false;
  options.fov_deg = 60;
  EXPECT_THAT(decision(*open_source(options), "camera"), HasSubstr("assumed"));
  options.fov_deg.reset();
  options.camera_file = bag.folder().write("camera.txt", kCameraLine);
  EXPECT_EQ(open_source(options)->camera().pinhole().fy, 21);
}

TEST(RecordingSource, TheStampsOfTheHeadersCount) {
  Bag late;
  late.add_images("/cam/image_raw", "mono8", 1, 250'000'000);
  late.add_info("/cam/camera_info", test_info());
  const auto source = open_source(late.written());
  EXPECT_THAT(decision(*source, "times"),
              HasSubstr("the stamps of the headers (recorded 0.250 s later, 2.5 frames)"));
  EXPECT_EQ(source->next()->time.ticks, kFirstNs / 100);
  Bag without;
  without.add_images("/cam/image_raw", "mono8", 1, 0, false);
  without.add_info("/cam/camera_info", test_info());
  const auto unstamped = open_source(without.written());
  EXPECT_THAT(decision(*unstamped, "times"), HasSubstr("as recorded (the headers have no stamps)"));
  EXPECT_EQ(unstamped->next()->time.ticks, kFirstNs / 100);
}

TEST(RecordingSource, TheMountIsThatOfStaticFrames) {
  Bag bag;
  bag.add_images("/cam/image_raw");
  bag.add_info("/cam/camera_info", test_info());
  bag.add_static({{"base_link", "mast", {1, 0, 2}, {0, 0, 0, 1}},
                  {"mast", "cam0_optical", {0.5, 0, 0}, {-0.5, 0.5, -0.5, 0.5}}});
  const auto source = open_source(bag.written());
  ASSERT_TRUE(source->T_vehicle_cam());
  EXPECT_EQ(source->T_vehicle_cam()->translation(), Eigen::Vector3d(1.5, 0, 2));
  EXPECT_NEAR(source->T_vehicle_cam()->R()(0, 2), 1, 1e-12) << "looks ahead";
  EXPECT_THAT(decision(*source, "frames"), IsEmpty());
  Bag body;
  body.add_images("/cam/image_raw");
  body.add_info("/cam/camera_info", test_info());
  body.add_static({{"base_link", "cam0_optical", {1, 0, 2}, {0, 0, 0, 1}}});
  EXPECT_THAT(decision(*open_source(body.written()), "frames"), HasSubstr("the camera looks up"));
}

// Odometry, fixes, poses and an IMU next to the images.
void add_sensors(Bag* bag) {
  const size_t odometry = bag->topic("/odom", "nav_msgs/Odometry"),
               fix = bag->topic("/fix", "sensor_msgs/NavSatFix");
  const size_t pose = bag->topic("/pose", "geometry_msgs/PoseStamped"),
               imu = bag->topic("/imu", "sensor_msgs/Imu");
  for (int i = 0; i < kFrames; ++i) {
    const int64_t ns = kFirstNs + i * kStepNs + kStepNs / 2;
    bag->add(odometry, ns, odometry_message(Wire::kRos1, ns, {5.0 + i, 1, 0}, {0, 0, 0, 1}));
    bag->add(fix, ns, nav_sat_fix_message(Wire::kRos1, ns, i == 0 ? -1 : 0, {0, 0, double(10 * i)}));
    bag->add(pose, ns, pose_message(Wire::kRos1, ns, {0, 2.0 * i, 0}, {0, 0, 0, 1}));
    bag->add(imu, ns, imu_message(Wire::kRos1, ns, {0, 0, 0, 1}));
  }
}

int gyro_samples(const ImageSource& source) {
  const GyroReadings readings = source.gyro_readings();
  int count = 0;
  for (; const auto sample = readings ? readings() : std::nullopt; ++count) {
    EXPECT_EQ(sample->rate, Eigen::Vector3d(0.1, 0.2, 0.3));
    EXPECT_EQ(sample->time.ticks, (kFirstNs + count * kStepNs + kStepNs / 2) / 100);
  }
  return count;
}

TEST(RecordingSource, OtherSensorsGiveTracks) {
  Bag bag;
  bag.add_images("/cam/image_raw");
  bag.add_info("/cam/camera_info", test_info());
  bag.add_static({{"base_link", "cam0_optical", {0, 0, 0}, {-0.5, 0.5, -0.5, 0.5}},
                  {"base_link", "gps", {-1, 0, 3}, {0, 0, 0, 1}}});
  add_sensors(&bag);
  const auto source = open_source(bag.written());
  const VehicleTrack wheels = source->vehicle_track(VehicleSensor::kOdometry);
  ASSERT_EQ(wheels.positions.size(), size_t(kFrames));
  EXPECT_EQ(wheels.positions[1].position, Eigen::Vector3d(1, 0, 0));
  EXPECT_EQ(wheels.positions[1].time.ticks, (kFirstNs + kStepNs * 3 / 2) / 100);
  const VehicleTrack gps = source->vehicle_track(VehicleSensor::kGps);
  ASSERT_EQ(gps.positions.size(), size_t(kFrames - 1));
  EXPECT_NEAR(gps.positions[1].position.norm(), 10, 1e-6);
  EXPECT_EQ(gps.sensor_on_vehicle, Eigen::Vector3d(-1, 0, 3));
  EXPECT_EQ(source->vehicle_track(VehicleSensor::kRobotPose).positions[2].position.y(), 4);
  EXPECT_EQ(gyro_samples(*source), kFrames);
}

TEST(RecordingSource, ImportKeepsTheSensors) {
  Bag bag;
  bag.add_images("/cam/image_raw");
  bag.add_info("/cam/camera_info", test_info());
  add_sensors(&bag);
  const auto source = open_source(bag.written());
  const std::string rawlog = bag.folder() / "x.rawlog";
  EXPECT_EQ(import_rawlog(*source, rawlog), kFrames);
  std::map<std::string, int> count;
  RawlogReader reader(rawlog);
  Timestamp last;
  while (const auto observation = reader.next()) {
    const std::string name = observation->GetRuntimeClass()->className;
    ++count[name.substr(name.rfind(':') + 1)];
    const Timestamp time = from_mrpt(observation->timestamp);
    EXPECT_LE(last, time);
    last = time;
  }
  EXPECT_EQ(count["CObservationImage"], kFrames);
  EXPECT_EQ(count["CObservationOdometry"], kFrames);
  EXPECT_EQ(count["CObservationGPS"], kFrames - 1);
  EXPECT_EQ(count["CObservationIMU"], kFrames);
  EXPECT_EQ(count["CObservationRobotPose"], kFrames);
  const VehicleTrack wheels = open_source(rawlog)->vehicle_track(VehicleSensor::kOdometry);
  EXPECT_EQ(wheels.positions.size(), size_t(kFrames));
  EXPECT_EQ(gyro_samples(*open_source(rawlog)), kFrames);
}

TEST(RecordingSource, OptionsOfOtherSourcesAreRefused) {
  Bag bag;
  bag.add_images("/cam/image_raw");
  bag.add_info("/cam/camera_info", test_info());
  SourceOptions options = bag.written();
  options.sensor_label = "CAM0";
  EXPECT_THAT(error_of([&] { open_source(options); }), HasSubstr("choose one with --topic"));
  options.sensor_label.clear();
  options.fps = 10;
  EXPECT_THAT(error_of([&] { open_source(options); }), HasSubstr("--fps: is of no use"));
  SourceOptions folder;
  write_edgevo_layout(bag.folder() / "images_folder", 2);
  folder.path = bag.folder() / "images_folder";
  folder.topic = "/cam";
  EXPECT_THAT(error_of([&] { open_source(folder); }), HasSubstr("is not a recording of ROS"));
}

TEST(RecordingSource, ADamagedMessageIsABadFrame) {
  Bag bag;
  bag.add_images("/cam/image_raw");
  bag.add_info("/cam/camera_info", test_info());
  TestImage small = test_image(0);
  small.data.resize(10);
  bag.add(0, kFirstNs + kFrames * kStepNs, image_message(Wire::kRos1, kFirstNs + kFrames * kStepNs, small));
  const auto source = open_source(bag.written());
  EXPECT_EQ(frames_before_error(*source, "the image has 10 bytes, but its size needs 384"), kFrames);
}

CameraInfoMessage info_message(const TestCameraInfo& info) {
  return decode_camera_info(camera_info_message(Wire::kRos1, 0, info), Serialization::kRos1, "x");
}

TEST(RecordedCamera, LensesOfRos) {
  std::vector<InputDecision> decisions;
  const auto camera = [&](const std::string& model, const std::vector<double>& D) {
    TestCameraInfo info = test_info();
    info.model = model, info.D = D;
    return camera_of_info(info_message(info), false, 24, 16, "x", &decisions);
  };
  EXPECT_STREQ(to_string(camera("plumb_bob", {0.1, 0.2, 0, 0, 0})->model), "plumb_bob");
  EXPECT_STREQ(to_string(camera("plumb_bob", {0, 0, 0, 0, 0})->model), "pinhole");
  EXPECT_STREQ(to_string(camera("", {})->model), "pinhole");
  EXPECT_STREQ(to_string(camera("rational_polynomial", {0.1, 0.1, 0, 0, 0.1, 0.1, 0.1, 0.1})->model),
               "rational");
  EXPECT_STREQ(to_string(camera("equidistant", {0.1, 0.1, 0, 0})->model), "kannala_brandt");
  EXPECT_THAT(error_of([&] { camera("magic", {1}); }), HasSubstr("its distortion model 'magic' is not read"));
  EXPECT_TRUE(decisions.empty());
}

TEST(RecordedCamera, RoiAndBinning) {
  std::vector<InputDecision> decisions;
  TestCameraInfo info = test_info();
  info.width = 100, info.height = 80;
  info.K[2] = 34, info.K[5] = 36;
  info.roi_x = 10, info.roi_y = 20, info.roi_width = 48, info.roi_height = 32, info.binning_x = 2,
  info.binning_y = 2;
  const auto camera = camera_of_info(info_message(info), false, 24, 16, "x", &decisions);
  // The first pixel of the image adds up pixels 10 and 11 of the sensor: its centre is at 10.5.
  EXPECT_EQ(camera->pinhole(), (Pinhole{10, 10.5, (34 - 10.5) / 2, (36 - 20.5) / 2, 24, 16}));
  EXPECT_TRUE(decisions.empty());
  EXPECT_EQ(camera_of_info(info_message(info), false, 100, 80, "x", &decisions)->pinhole().cx, 34);
  ASSERT_EQ(decisions.size(), 1u);
  EXPECT_THAT(to_string(decisions[0]), HasSubstr("for the full image"));
}

TEST(RecordedCamera, OtherSizes) {
  std::vector<InputDecision> decisions;
  TestCameraInfo info = test_info();
  info.width = 48, info.height = 32;
  EXPECT_EQ(camera_of_info(info_message(info), false, 24, 16, "x", &decisions)->pinhole().fx, 10);
  ASSERT_EQ(decisions.size(), 1u);
  EXPECT_THAT(to_string(decisions[0]), HasSubstr("scaled from 48x32 to 24x16"));
  EXPECT_THAT(error_of([&] { camera_of_info(info_message(info), false, 24, 30, "x", &decisions); }),
              HasSubstr("is for images of 48x32, but these have 24x30"));
  info.width = info.height = 0;
  EXPECT_EQ(camera_of_info(info_message(info), false, 24, 16, "x", &decisions)->pinhole().width, 24);
}

TEST(RecordedCamera, OfRectifiedImages) {
  EXPECT_TRUE(names_rectified("/cam/image_rect_color"));
  EXPECT_FALSE(names_rectified("/cam/image_raw"));
  std::vector<InputDecision> decisions;
  TestCameraInfo info = test_info();
  info.P = {19, 0, 11, 0, 0, 18, 7, 0, 0, 0, 1, 0};
  const auto camera = camera_of_info(info_message(info), true, 24, 16, "x", &decisions);
  EXPECT_EQ(camera->pinhole(), (Pinhole{19, 18, 11, 7, 24, 16}));
  EXPECT_FALSE(camera->has_distortion());
}

}  // namespace
}  // namespace edgevo::test
