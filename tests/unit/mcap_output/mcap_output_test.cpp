// SPDX-License-Identifier: BSD-3-Clause
// run.mcap of a made-up run, as a strict reader reads it: against the records of the run.
#include "edgevo/mcap_output/mcap_output.h"

#include <gmock/gmock.h>

#include "edgevo/core/error.h"
#include "edgevo/core/input_file.h"
#include "strict_reader.h"
#include "support/made_events.h"
#include "support/temp_folder.h"

namespace edgevo {
namespace {

using test::numbers_of;
using test::read_strictly;
using test::table_of;
using ::testing::HasSubstr;

// From the camera to a vehicle that it looks ahead of.
const Eigen::Matrix4d kAhead =
    (Eigen::Matrix4d() << 0, 0, 1, 0, -1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 0, 1).finished();

std::string numbered(const std::string& name, int first, int last) {
  std::string fields;
  for (int i = first; i <= last; ++i) fields += name + "." + std::to_string(i) + " ";
  return fields;
}

std::string pose_fields(const std::string& of) {
  std::string fields;
  for (const char* part : {"position.x", "position.y", "position.z", "orientation.x", "orientation.y",
                           "orientation.z", "orientation.w"})
    fields += of + part + " ";
  return fields;
}

Eigen::Matrix4d matrix_of(const std::vector<double>& row, size_t first) {
  const double* v = row.data() + first;
  return SE3(Eigen::Quaterniond(v[6], v[3], v[4], v[5]), {v[0], v[1], v[2]}).matrix();
}

class McapOutputTest : public ::testing::Test {
 protected:
  McapOutputTest() : made_(test::synthetic_run()), events_(made_) {
    run_.library = "a test";
    run_.pinhole = made_.run.pinhole;
    made_.run.scale_source = "none";
  }
  // Writes the whole run; returns the path.
  std::string write(const std::string& name = "run.mcap", const OccupancyGrid* grid = nullptr) const {
    const std::string path = folder_.path() + "/" + name;
    McapOutput output(path, run_);
    for (const test::FrameEvents& events : events_.frames()) output.apply(events);
    output.finish(made_.run, grid);
    return path;
  }
  // The live pose as a matrix: of frames that are placed late their final one.
  static Eigen::Matrix4d live(const FrameRecord& frame) {
    return (frame.T_world_cam_live ? *frame.T_world_cam_live : *frame.T_world_cam).matrix();
  }
  // The pose of the vehicle; lengths times `metres`.
  static Eigen::Matrix4d vehicle(const FrameRecord& frame, double metres = 1) {
    Eigen::Matrix4d T = live(frame);
    T.topRightCorner<3, 1>() *= metres;
    return kAhead * T * kAhead.inverse();
  }
  const FrameRecord& frame_at(double sec, double nanosec) const {
    const int64_t ticks = int64_t(sec) * Timestamp::kTicksPerSecond + int64_t(nanosec) / 100;
    for (const FrameRecord& f : made_.run.frames)
      if (f.time.ticks == ticks) return f;
    throw std::runtime_error("no frame of that time");
  }

  test::TempFolder folder_;
  test::SyntheticRun made_;
  const test::MadeEvents events_;
  McapRun run_;
};

TEST_F(McapOutputTest, IsReadStrictly) {
  OccupancyGrid grid{3, 2, 0.5, -1, 2, {}, ""};
  grid.cells = {GridCell::kUnknown,  GridCell::kFree, GridCell::kOccupied,
                GridCell::kOccupied, GridCell::kFree, GridCell::kUnknown};
  const std::string path = write("run.mcap", &grid);
  const auto reading = read_strictly("check " + path);
  EXPECT_EQ(reading.code, 0) << reading.text;
  for (const char* topic : {"40 /edgevo/pose ", " /tf ", " /edgevo/points ", " /edgevo/edges ",
                            " /edgevo/edge_points ", "1 /edgevo/path ", "1 /map ", "1 /tf_static "})
    EXPECT_THAT(reading.text, HasSubstr(topic));
  EXPECT_EQ(table_of(path, "/map", "data")[0][0], R"(b'\xff\x00dd\x00\xff')");
  EXPECT_EQ(numbers_of(path, "/map", "info.width info.height info.origin.position.x")[0],
            (std::vector<double>{3, 2, -1}));
}

// Every field of ten frames and more: those of odometry.
TEST_F(McapOutputTest, OdometryIsThatOfTheRecords) {
  const auto rows = numbers_of(write(), "/edgevo/odometry",
                               "header.stamp.sec header.stamp.nanosec " + pose_fields("pose.pose.") +
                                   numbered("pose.covariance", 0, 35) +
                                   "twist.twist.linear.x twist.twist.linear.y twist.twist.linear.z "
                                   "twist.twist.angular.x twist.twist.angular.y twist.twist.angular.z " +
                                   numbered("twist.covariance", 0, 35));
  ASSERT_GE(rows.size(), 30u);
  for (const std::vector<double>& row : rows) {
    const FrameRecord& frame = frame_at(row[0], row[1]);
    const FrameRecord& before = made_.run.frames[size_t(frame.index) - 1];
    const Eigen::Matrix4d T = vehicle(frame), step = vehicle(before).inverse() * T;
    EXPECT_TRUE(matrix_of(row, 2).isApprox(T, 1e-12));
    // The covariance of the record is that of a ball: any axes show it, in the unit of the world.
    const double length = test::T_world_map_of(frame.segment).scale, dt = 0.1;
    for (int i = 0; i < 36; ++i) {
      const double diagonal = (i < 18 ? length * length : 1) * 1e-5;
      EXPECT_NEAR(row[size_t(9 + i)], i % 7 == 0 ? diagonal : 0, 1e-12);
    }
    const Eigen::Map<const Eigen::Vector3d> v(&row[45]), w(&row[48]);
    const SE3 moved = SE3::exp((Vector6d() << v * dt, w * dt).finished());
    EXPECT_TRUE(moved.matrix().isApprox(step, 1e-9));
    EXPECT_NEAR(row[size_t(51 + 35)], 2 * 1e-5 / (dt * dt), 1e-9);
    for (int i = 0; i < 6; ++i)
      for (int j = 0; j < 6; ++j) EXPECT_EQ(row[size_t(51 + 6 * i + j)], row[size_t(51 + 6 * j + i)]);
  }
}

TEST_F(McapOutputTest, PosesAndTransformsAgree) {
  const std::string path = write();
  const auto poses =
      numbers_of(path, "/edgevo/pose", "header.stamp.sec header.stamp.nanosec " + pose_fields("pose."));
  const auto names = table_of(path, "/tf",
                              "transforms.0.header.frame_id transforms.0.child_frame_id "
                              "transforms.1.header.frame_id transforms.1.child_frame_id");
  const auto tf = numbers_of(path, "/tf",
                             "transforms.1.transform.translation.x transforms.1.transform.translation.y "
                             "transforms.1.transform.translation.z transforms.1.transform.rotation.x "
                             "transforms.1.transform.rotation.y transforms.1.transform.rotation.z "
                             "transforms.1.transform.rotation.w");
  ASSERT_EQ(poses.size(), 40u);  // five of 45 are lost
  ASSERT_GE(tf.size(), poses.size());
  for (size_t i = 0; i < poses.size(); ++i) {
    EXPECT_EQ(names[i], (std::vector<std::string>{"'map'", "'odom'", "'odom'", "'base_link'"}));
    EXPECT_TRUE(matrix_of(poses[i], 2).isApprox(vehicle(frame_at(poses[i][0], poses[i][1])), 1e-12));
    EXPECT_TRUE(matrix_of(tf[i], 0).isApprox(matrix_of(poses[i], 2), 1e-12));
  }
}

TEST_F(McapOutputTest, PathIsFinalAndTheLastTransformLeadsToIt) {
  const std::string path = write();
  const auto last = numbers_of(path, "/edgevo/path", pose_fields("poses.39.pose."))[0];
  const Eigen::Matrix4d want = kAhead * made_.run.frames.back().T_world_cam->matrix() * kAhead.inverse();
  EXPECT_TRUE(matrix_of(last, 0).isApprox(want, 1e-9));
  EXPECT_EQ(numbers_of(path, "/edgevo/map_changes", "data"), (std::vector<std::vector<double>>{{0}, {1}}));
  std::string fields;
  for (const char* number : {"0", "1"})
    for (const char* part : {"translation.x", "translation.y", "translation.z", "rotation.x", "rotation.y",
                             "rotation.z", "rotation.w"})
      fields += std::string("transforms.") + number + ".transform." + part + " ";
  const auto tf = numbers_of(path, "/tf", fields).back();
  EXPECT_TRUE((matrix_of(tf, 0) * matrix_of(tf, 7)).isApprox(want, 1e-9));
}

TEST_F(McapOutputTest, StatesAreLoggedWithTheirReasons) {
  const auto log = read_strictly("table " + write() + " /rosout level msg").text;
  EXPECT_THAT(log, HasSubstr("30 'frame 0: BOOTSTRAPPING'"));
  EXPECT_THAT(log, HasSubstr("40 'frame 20: TRACKING -> LOST: lost: 3 of 400 points aligned, 120 needed'"));
  EXPECT_THAT(log, HasSubstr("20 'frame 25: LOST -> TRACKING'"));
}

TEST_F(McapOutputTest, AGivenFactorMakesMetres) {
  run_.scale = parse_scale_sources("factor=3");
  const std::string path = write();
  EXPECT_EQ(table_of(path, "/edgevo/is_metric", "data")[0][0], "True");
  for (const auto& row :
       numbers_of(path, "/edgevo/pose", "header.stamp.sec header.stamp.nanosec " + pose_fields("pose.")))
    EXPECT_TRUE(matrix_of(row, 2).isApprox(vehicle(frame_at(row[0], row[1]), 3), 1e-12));
  // The records of this run are not in metres: what would not fit is not written, and that is said.
  EXPECT_TRUE(table_of(path, "/edgevo/path", "header.frame_id").empty());
  EXPECT_THAT(read_strictly("table " + path + " /rosout msg").text, HasSubstr("have another unit"));
}

// Until a scale is known, nothing is written in a unit that the rest would not have.
TEST_F(McapOutputTest, AScaleThatComesAtTheEndHoldsForAll) {
  run_.scale = parse_scale_sources("camera_height=1.5");
  made_.run.scale_source = "camera_height=1.5";
  made_.run.scale.factor = 2;
  const std::string path = write();
  EXPECT_EQ(table_of(path, "/edgevo/is_metric", "data")[0][0], "True");
  const auto rows =
      numbers_of(path, "/edgevo/pose", "header.stamp.sec header.stamp.nanosec " + pose_fields("pose."));
  ASSERT_EQ(rows.size(), 40u);
  EXPECT_TRUE(matrix_of(rows[20], 2).isApprox(vehicle(frame_at(rows[20][0], rows[20][1]), 2), 1e-12));
  EXPECT_EQ(read_strictly("check " + path).code, 0);
}

// Without one for two thousand frames the unit is arbitrary, which is said.
TEST_F(McapOutputTest, AScaleThatComesTooLateIsSaid) {
  run_.scale = parse_scale_sources("odometry");
  const std::string path = folder_ / "run.mcap";
  McapOutput output(path, run_);
  FrameAnchored frame;
  for (frame.frame.index = 0; frame.frame.index <= 2000; ++frame.frame.index) {
    frame.frame.time.ticks += Timestamp::kTicksPerSecond;
    EXPECT_EQ(output.note(), "");
    output.apply({std::make_shared<const MapEvent>(MapEvent(frame))});
  }
  EXPECT_EQ(output.note(),
            "lengths in run.mcap are in an arbitrary unit: no scale was found in the first 2000 frames");
  edgevo::Run finished;
  finished.scale_source = "odometry";
  output.finish(finished, nullptr);
  EXPECT_THAT(output.note(), HasSubstr("are not in it: the scale came too late"));
  EXPECT_EQ(table_of(path, "/edgevo/is_metric", "data")[0][0], "False");
  EXPECT_THAT(read_strictly("table " + path + " /rosout msg").text, HasSubstr(output.note().substr(0, 60)));
}

TEST_F(McapOutputTest, PointsLieWhereTheRecordsHaveThem) {
  const std::string path = write();
  const auto rows = numbers_of(path, "/edgevo/points", "header.stamp.sec width point_step");
  ASSERT_GE(rows.size(), 5u);
  double points = 0;
  for (const auto& row : rows) points += row[1];
  EXPECT_GT(points, 100);
  // The corridor is 4 wide and 3 high; its walls stay where they are to a quarter of their uncertainty.
  const auto data = read_strictly("cloud " + path + " /edgevo/points").text;
  std::istringstream lines(data);
  int near_wall = 0, all = 0;
  for (double x, y, z, gray, sigma; lines >> x >> y >> z >> gray >> sigma; ++all) {
    const double off = std::min(std::abs(std::abs(y) - 2), std::abs(std::abs(z) - 1.5));
    near_wall += off < 0.3 * sigma + 1e-3;
  }
  EXPECT_EQ(all, int(points));
  // Those of the keyframes that the past's move (MadeEvents) has not touched yet: all that were written.
  EXPECT_GT(near_wall, 0.95 * all);
}

TEST_F(McapOutputTest, EqualRunsGiveEqualBytes) {
  EXPECT_EQ(read_file(write("a.mcap"), ""), read_file(write("b.mcap"), ""));
}

TEST_F(McapOutputTest, CutAnywhereHasTheChunksBefore) {
  const auto reading = read_strictly("cut " + write() + " 100");
  EXPECT_EQ(reading.code, 0) << reading.text;
}

TEST_F(McapOutputTest, WithoutAFrameIsReadStrictly) {
  const std::string path = folder_.path() + "/none.mcap";
  McapOutput(path, run_).finish({}, nullptr);
  EXPECT_EQ(read_strictly("check " + path).code, 0);
}

TEST(McapContentTest, OthersAreRefused) {
  EXPECT_EQ(parse_mcap_content("images", "x"), McapContent::kImages);
  EXPECT_THROW(parse_mcap_content("all", "--mcap all"), InputError);
}

}  // namespace
}  // namespace edgevo
