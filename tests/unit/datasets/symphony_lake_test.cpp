// SPDX-License-Identifier: BSD-3-Clause
// Symphony Lake: surveys are read back as written, in both naming schemes; defects of old, damaged and odd
// surveys are reported.
#include <cmath>

#include "edgevo/datasets/describe.h"
#include "edgevo/datasets/ground_truth.h"
#include "edgevo/datasets/open_source.h"
#include "edgevo/evaluation/trajectory.h"
#include "support/pose_matchers.h"
#include "unit/datasets/symphony_lake_folder.h"

namespace edgevo {
namespace {

namespace fs = std::filesystem;
using test::error_of;
using test::read_all;
using test::read_text;
using test::survey_pose;
using test::survey_time;
using test::TempFolder;
using test::write_survey;
using test::write_text;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

SourceOptions lake_source(const std::string& path) {
  SourceOptions options;
  options.path = path;
  return options;
}

std::string detail(const ImageSource& source, const std::string& name) {
  for (const auto& [key, value] : source.details())
    if (key == name) return value;
  return {};
}

std::string truth_of(const std::string& path) {
  const SourceOptions options = lake_source(path);
  return ground_truth_tum(options, *open_source(options));
}

std::vector<StampedPose> poses_of(const std::string& path) {
  return parse_trajectory(truth_of(path), "truth").poses;
}

// `text` in the file instead of what `what` is there.
void edit(const std::string& path, const std::string& what, const std::string& text) {
  std::string all = read_text(path);
  const size_t at = all.find(what);
  ASSERT_NE(at, std::string::npos) << what;
  write_text(path, all.replace(at, what.size(), text));
}

// A list of rows `time, number, rest` with that many columns, and images of them all.
void write_rows(const std::string& folder, const std::vector<std::string>& rows) {
  std::string text = "% an old survey\n";
  for (const std::string& row : rows) text += row + "\n";
  write_text(folder + "/image_auxilliary.csv", text);
  for (int i = 0; i < int(rows.size()); ++i) {
    fs::create_directories(folder + "/0000");
    char name[32];
    std::snprintf(name, sizeof name, "/0000/%04d.png", i + 1);
    write_png(folder + name, test::make_image(i));
    fs::rename(folder + name, (folder + name).substr(0, (folder + name).size() - 3) + "jpg");
  }
}

constexpr const char* kView = "0, 0, 0, 1.5, 0.2, 20, 21, 12, 8, 24, 16";  // x to height

TEST(SymphonyLake, BothNamingSchemesAreReadBack) {
  for (const bool newer : {false, true}) {
    const TempFolder folder;
    const SurveyLocation place = write_survey(folder.path(), "141107", 5, newer);
    EXPECT_TRUE(fs::exists(place.folder() + (newer ? "/0001/01002.jpg" : "/0001/0002.jpg")));
    const auto s = open_source(lake_source(place.folder()));
    EXPECT_EQ(s->kind(), "Symphony Lake");
    EXPECT_EQ(s->camera().pinhole().fy, 21);
    EXPECT_FALSE(s->camera().has_distortion());
    const auto frames = read_all(*s);
    ASSERT_EQ(frames.size(), 5u);
    EXPECT_EQ(frames[4].time, survey_time(4));
    EXPECT_EQ(frames[4].image.width, 24);
  }
}

// In the plane everything written is read back, to the digits of the file.
TEST(SymphonyLake, PosesAgreeToThePrecisionOfTheFile) {
  const TempFolder folder;
  const auto poses = poses_of(write_survey(folder.path(), "141107", 9).folder());
  ASSERT_EQ(poses.size(), 9u);
  for (int i = 0; i < 9; ++i) {
    const SE3 expected = survey_pose(0).inverse() * survey_pose(i);
    const SE3 read = poses[0].T_world_cam.inverse() * poses[size_t(i)].T_world_cam;
    EXPECT_THAT(read, test::SE3Near(expected, 3e-6, 1e-8)) << i;
    EXPECT_LT((survey_pose(i).R() - poses[size_t(i)].T_world_cam.R()).norm(), 1e-8) << "z up, x east";
  }
}

TEST(SymphonyLake, MountIsThatOfTheView) {
  const TempFolder folder;
  const auto mount =
      open_source(lake_source(write_survey(folder.path(), "141107", 5).folder()))->T_vehicle_cam();
  ASSERT_TRUE(mount.has_value());
  EXPECT_LT((mount->translation() - Eigen::Vector3d(-0.420, 0, 0.255)).norm(), 1e-12);
  EXPECT_LT(mount->R()(1, 2), -0.95) << "looks to the right";
  EXPECT_NEAR(mount->R()(2, 2), std::sin(0.2), 1e-6) << "and up";
}

// The direction of view is thetag - pan, and the lever arm turns with the boat.
TEST(SymphonyLake, GroundTruthIsTheBoatsPoseMovedToTheCamera) {
  const TempFolder folder;
  const std::string survey = folder / "VBags/150101";
  write_rows(survey, {"10.0, 1.0, 0, 0, 0, 1.0, 0, 20, 21, 12, 8, 24, 16",
                      "10.1, 2.0, 0, 0, 0, 1.0, 0, 20, 21, 12, 8, 24, 16"});
  write_text(folder / "Maps/150101/optposes.csv",
             "% kf, t, x, y, theta, xg, yg, thetag\n0, 10.0, 9, 9, 9, 100, 200, 1.5707963267948966\n1, 10.1, "
             "9, 9, 9, 100, 201, 1.5707963267948966\n");
  const auto poses = poses_of(survey);
  ASSERT_EQ(poses.size(), 2u);
  // Heading north: the camera 0.42 m south of the boat, a metre on from the first.
  const SE3& T = poses[1].T_world_cam;
  EXPECT_LT((T.translation() - Eigen::Vector3d(0, 1 - 0.42, 0.255)).norm(), 1e-8);
  EXPECT_LT((T.R().col(2) - Eigen::Vector3d(std::cos(M_PI / 2 - 1), std::sin(M_PI / 2 - 1), 0)).norm(), 1e-8);
  EXPECT_LT((T.R().col(1) - Eigen::Vector3d(0, 0, -1)).norm(), 1e-8) << "y down";
}

TEST(SymphonyLake, GroundTruthIsInterpolatedWithinATenthOfASecond) {
  const TempFolder folder;
  const std::string survey = folder / "VBags/150101";
  std::vector<std::string> rows;
  for (const char* t : {"10.05", "10.2", "10.5", "11.95"})
    rows.push_back(std::string(t) + ", " + std::to_string(rows.size() + 1) + ".0, " + kView);
  write_rows(survey, rows);
  write_text(folder / "Maps/150101/optposes.csv",
             "0, 10.0, 0,0,0, 0, 0, 3.1\n1, 10.2, 0,0,0, 2, 0, -3.1\n2, 11.0, 0,0,0, 4, 0, 0\n3, 12.0, "
             "0,0,0, 4, 10, 0\n");
  const auto poses = poses_of(survey);
  ASSERT_EQ(poses.size(), 3u) << "at 10.5 s no pose is within 0.1 s";
  const Eigen::Vector3d arm = poses[1].T_world_cam.translation();
  EXPECT_NEAR((poses[0].T_world_cam.translation() - arm).x(), -1.5, 0.02)
      << "a quarter of the distance, lever arms rotated";
  EXPECT_EQ(to_string(poses[2].time), "11.9500000");
  // Headings are interpolated along the shorter arc: 3.1 and -3.1 rad are 0.083 apart, not 6.2.
  EXPECT_LT((poses[0].T_world_cam.inverse() * poses[1].T_world_cam).angle(), 0.07);
}

TEST(SymphonyLake, WithoutMapsGroundTruthIsCoarseAndLabelledSo) {
  const TempFolder folder;
  const SurveyLocation place = write_survey(folder.path(), "141107", 5);
  const auto exact = poses_of(place.folder());
  EXPECT_THAT(detail(*open_source(lake_source(place.folder())), "ground truth"),
              HasSubstr("optposes.csv (poses of the boat"));
  fs::remove_all(folder / "Maps");
  const auto s = open_source(lake_source(place.folder()));
  EXPECT_THAT(detail(*s, "ground truth"),
              AllOf(HasSubstr("coarse, by GPS and compass"), HasSubstr("no Maps/141107/optposes.csv")));
  EXPECT_THAT(truth_of(place.folder()), HasSubstr("coarse"));
  const auto coarse = poses_of(place.folder());
  ASSERT_EQ(coarse.size(), exact.size());
  for (size_t i = 0; i < exact.size();
       ++i)  // the writer's GPS is exact: what differs would be the antenna's lever arm
    EXPECT_LT((coarse[i].T_world_cam.translation() - exact[i].T_world_cam.translation()).norm(), 3e-6);
}

TEST(SymphonyLake, GpsIsAvailableForTheScale) {
  const TempFolder folder;
  const auto s = open_source(lake_source(write_survey(folder.path(), "141107", 3).folder()));
  const VehicleTrack gps = s->vehicle_track(VehicleSensor::kGps);
  ASSERT_EQ(gps.positions.size(), 3u);
  EXPECT_EQ(gps.positions[2].time, survey_time(2));
  EXPECT_TRUE(s->vehicle_track(VehicleSensor::kOdometry).positions.empty());
}

TEST(SymphonyLake, RowsBeforeTheUsualTiltAreSkipped) {
  const TempFolder folder;
  const std::string before = "0, 0, 0, 1.5, -0.3, 20, 21, 12, 8, 24, 16";
  std::vector<std::string> rows;
  for (int i = 0; i < 7; ++i)
    rows.push_back(std::to_string(10 + i) + ", " + std::to_string(i + 1) + ".0, " + (i < 2 ? before : kView));
  rows[4] = "14, 5.0, " + before;  // it moves again: that is motion, and stays
  write_rows(folder.path(), rows);
  const auto s = open_source(lake_source(folder.path()));
  EXPECT_EQ(s->size(), 5);
  EXPECT_EQ(s->times().front().seconds(), 12);
  EXPECT_THAT(detail(*s, "rows"), HasSubstr("the first 2 are skipped"));
  EXPECT_FALSE(s->T_vehicle_cam().has_value()) << "the camera turned on the boat";
}

TEST(SymphonyLake, MissingNumbersAreReported) {
  const TempFolder folder;
  const SurveyLocation place = write_survey(folder.path(), "141107", 5);
  std::string text = read_text(place.folder() + "/image_auxilliary.csv");
  const size_t begin = text.find("\n", text.find(", 999.")) + 1, end = text.find("\n", begin) + 1;
  write_text(place.folder() + "/image_auxilliary.csv", text.erase(begin, end - begin));
  const auto s = open_source(lake_source(place.folder()));
  EXPECT_EQ(read_all(*s).size(), 4u);
  EXPECT_EQ(detail(*s, "missing numbers"), "1 images have no row");
}

TEST(SymphonyLake, OldSurveysWithFewerColumns) {
  const TempFolder folder;
  write_rows(folder.path(), {std::string("10, 1.0, ") + kView, std::string("11, 2.0, ") + kView});
  EXPECT_THAT(detail(*open_source(lake_source(folder.path())), "rows"),
              HasSubstr("2 of 13 columns (newer surveys have 16)"));
  write_rows(folder.path(), {"10, 1.0, 5, 6, 0.1, 1.5, 0.2", "11, 2.0, 6, 6, 0.1, 1.5, 0.2"});
  EXPECT_THAT(error_of([&] { open_source(lake_source(folder.path())); }),
              HasSubstr("7 columns are fewer than the 13 that include the camera; give the camera's file"));
  write_text(folder / "camera.txt", "20 21 12 8 0.1 0 0 0 24 16");
  SourceOptions options = lake_source(folder.path());
  options.camera_file = folder / "camera.txt";
  const auto s = open_source(options);
  EXPECT_EQ(s->camera().distortion().k1, 0.1);
  EXPECT_EQ(parse_trajectory(ground_truth_tum(options, *s), "truth").poses.size(), 2u);
}

TEST(SymphonyLake, TwoColumnsPlayWithACameraAndHaveNoGroundTruth) {
  const TempFolder folder;
  write_rows(folder.path(), {"10, 1.0", "11, 2.0"});
  write_text(folder / "camera.txt", "20 21 12 8 0 0 0 0 24 16");
  SourceOptions options = lake_source(folder.path());
  options.camera_file = folder / "camera.txt";
  const auto s = open_source(options);
  EXPECT_EQ(read_all(*s).size(), 2u);
  EXPECT_THAT(detail(*s, "ground truth"), HasSubstr("none"));
  EXPECT_THAT(ground_truth_tum(options, *s), IsEmpty());
}

TEST(SymphonyLake, ColumnsGoByTheNamesOfTheHeader) {
  const TempFolder folder;
  write_rows(folder.path(), {"1.0, 10, 24, 16, 20, 21, 12, 8"});
  edit(folder / "image_auxilliary.csv", "% an old survey", "% seq, t_sec, width, height, fx, fy, cx, cy");
  const auto s = open_source(lake_source(folder.path()));
  EXPECT_EQ(s->camera().pinhole().fy, 21);
  EXPECT_EQ(read_all(*s).at(0).time.seconds(), 10);
}

TEST(SymphonyLake, LensByTheZoom) {
  const TempFolder folder;
  const auto lens = [&](const char* camera) {
    write_rows(folder.path(), {std::string("10, 1.0, 0, 0, 0, 1.5, 0.2, ") + camera});
    return open_source(lake_source(folder.path()));
  };
  auto s = lens("760.1, 691.2, 370.9, 250.9, 704, 480");
  EXPECT_EQ(s->camera().distortion().k1, -0.302805);
  EXPECT_EQ(s->camera().pinhole().fx, 760.1) << "of the row";
  EXPECT_THAT(detail(*s, "lens"), HasSubstr("as a user calibrated it"));
  s = lens("780.17, 708.38, 317.75, 246.80, 700, 480");
  EXPECT_FALSE(s->camera().has_distortion());
  EXPECT_THAT(detail(*s, "lens"), HasSubstr("rectified"));
  s = lens("1500, 1400, 350, 240, 704, 480");
  EXPECT_FALSE(s->camera().has_distortion());
  EXPECT_THAT(detail(*s, "lens"), HasSubstr("another zoom"));
}

TEST(SymphonyLake, AZoomDuringRecordingIsReportedWithThePlayableRows) {
  const TempFolder folder;
  write_rows(folder.path(), {std::string("10, 1.0, ") + kView, std::string("11, 2.0, ") + kView,
                             "12, 3.0, 0, 0, 0, 1.5, 0.2, 40, 42, 12, 8, 24, 16"});
  SourceOptions options = lake_source(folder.path());
  EXPECT_THAT(error_of([&] { open_source(options); }),
              AllOf(HasSubstr("line 4: the camera differs"), HasSubstr("--frames 0:2")));
  options.last = 2;
  EXPECT_EQ(read_all(*open_source(options)).size(), 2u);
}

TEST(SymphonyArchive, SurveysGoByTheirName) {
  const TempFolder folder;
  write_survey(folder.path(), "141107", 2);
  EXPECT_EQ(open_source(lake_source(folder.path()))->size(), 2) << "an archive with one survey";
  write_survey(folder.path(), "160808f", 3, true);
  EXPECT_EQ(open_source(lake_source(folder / "160808f"))->size(), 3);
  EXPECT_EQ(open_source(lake_source(folder / "141107/"))->size(), 2);
  EXPECT_EQ(poses_of(folder / "160808f").size(), 3u);
  EXPECT_THAT(error_of([&] { open_source(lake_source(folder.path())); }),
              AllOf(HasSubstr("holds 2 surveys: 141107, 160808f"),
                    HasSubstr("name one of them, such as " + (folder / "141107"))));
  EXPECT_THAT(error_of([&] { open_source(lake_source(folder / "160808")); }),
              HasSubstr("no survey '160808'; did you mean 160808f?"));
}

TEST(SymphonyArchive, TwoSurveysOfOneName) {
  const TempFolder folder;
  const SurveyLocation old = write_survey(folder.path(), "141107", 2),
                       copy = write_survey(folder.path(), "141107", 3, true);
  EXPECT_THAT(
      error_of([&] { open_source(lake_source(folder / "141107")); }),
      AllOf(HasSubstr("two surveys named 141107"), HasSubstr(old.folder()), HasSubstr(copy.folder())));
  EXPECT_THAT(error_of([&] { open_source(lake_source(folder.path())); }),
              HasSubstr("two surveys named 141107"));
  EXPECT_EQ(open_source(lake_source(copy.folder()))->size(), 3);
}

class BadSurvey : public ::testing::Test {
 protected:
  std::string list() const { return place_.folder() + "/image_auxilliary.csv"; }
  std::string map() const { return place_.map_folder() + "/optposes.csv"; }
  std::string open_error() const {
    return error_of([&] { open_source(lake_source(place_.folder())); });
  }
  std::string truth_error() const {
    return error_of([&] { truth_of(place_.folder()); });
  }
  TempFolder folder_;
  SurveyLocation place_ = write_survey(folder_.path(), "141107", 5);
};

TEST_F(BadSurvey, FewerColumnsThanNeeded) {
  write_text(list(), "1.5\n2.5\n");
  EXPECT_THAT(open_error(),
              AllOf(HasSubstr("image_auxilliary.csv, line 1: has 1 column, fewer than a time and a number"),
                    HasSubstr("restore")));
}

TEST_F(BadSurvey, ARowThatIsCutShort) {
  std::string text = read_text(list());
  write_text(list(), text.substr(0, text.size() - 30));
  EXPECT_THAT(open_error(), HasSubstr("line 6: has 1"));
}

TEST_F(BadSurvey, ARowThatIsNoNumber) {
  edit(list(), ", 0.200000000,", ", east,");
  EXPECT_THAT(open_error(), HasSubstr("line 2: 'east' is not a number"));
  edit(list(), ", 998.000000,", ", 998.5,");
  EXPECT_THAT(open_error(), HasSubstr("line 2: '998.5' is not the number of an image"));
  edit(list(), "\n" + to_string(survey_time(0)), "\nnow");
  EXPECT_THAT(open_error(), HasSubstr("line 2: 'now' is not a time in seconds"));
}

TEST_F(BadSurvey, Empty) {
  write_text(list(), "% t_sec, seq\n%\n");
  EXPECT_THAT(open_error(), HasSubstr("the survey is empty"));
}

TEST_F(BadSurvey, ATimeThatGoesBackIsABadFrame) {
  edit(list(), to_string(survey_time(3)), to_string(survey_time(1)));
  EXPECT_EQ(
      test::frames_before_error(*open_source(lake_source(place_.folder())), "is not after the frame before"),
      3);
}

TEST_F(BadSurvey, AnImageThatIsMissingIsABadFrame) {
  fs::remove(place_.folder() + "/0001/0000.jpg");
  const auto s = open_source(lake_source(place_.folder()));
  EXPECT_EQ(test::frames_before_error(*s, "0001/0000.jpg: the image is missing"), 2);
  EXPECT_TRUE(s->next().has_value()) << "the next one is delivered";
  fs::remove_all(place_.folder() + "/0000");
  fs::remove_all(place_.folder() + "/0001");
  EXPECT_THAT(open_error(),
              HasSubstr("none of its 5 images is there, neither as 0000/0998.jpg nor as 0000/00998.jpg"));
}

TEST_F(BadSurvey, Maps) {
  const std::string good = read_text(map());
  edit(map(), to_string(survey_time(3)), to_string(survey_time(1)));
  EXPECT_THAT(truth_error(), HasSubstr("optposes.csv, line 5: its time"));
  write_text(map(), "0, 1, 2, 3, 4\n");
  EXPECT_THAT(truth_error(), HasSubstr("line 1: has 5 columns instead of 8"));
  write_text(map(), "0, 1, 2, 3, 4, nan, 6, 7\n");
  EXPECT_THAT(truth_error(), HasSubstr("'nan' is not a finite number"));
  write_text(map(), "% kf\n");
  EXPECT_THAT(truth_error(), HasSubstr("contains no pose"));
  write_text(map(), good);
  EXPECT_THAT(truth_error(), IsEmpty());
}

TEST(SurveyWriter, RefusesWhatTheLayoutCannotHold) {
  const TempFolder folder;
  EXPECT_THAT(error_of([&] {
                SurveyWriter({folder.path(), "winter", false}, test::survey_camera());
              }),
              HasSubstr("YYMMDD"));
  Camera lens = test::survey_camera();
  lens.set_distortion({0.1, 0, 0, 0, 0});
  EXPECT_THAT(error_of([&] {
                SurveyWriter({folder.path(), "141107", false}, lens);
              }),
              HasSubstr("no place for this camera's lens"));
  const SurveyWriter writer({folder.path(), "141107", false}, test::survey_camera());
  EXPECT_THAT(error_of([&] { writer.finish({}, ""); }), HasSubstr("no frame to write"));
}

TEST(SurveyWriter, WritesOverItsOwn) {
  const TempFolder folder;
  write_survey(folder.path(), "141107", 5);
  EXPECT_EQ(open_source(lake_source(write_survey(folder.path(), "141107", 2).folder()))->size(), 2);
  EXPECT_FALSE(fs::exists(folder / "VBags/141107/0001/0002.jpg"));
}

}  // namespace
}  // namespace edgevo
