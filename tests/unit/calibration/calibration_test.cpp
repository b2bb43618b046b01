// SPDX-License-Identifier: BSD-3-Clause
// The camera from a board: from drawn images, and from synthetic corners with noise.
#include <gmock/gmock.h>

#include <opencv2/aruco/charuco.hpp>
#include <opencv2/imgcodecs.hpp>

#include "edgevo/calibration/board_views.h"
#include "edgevo/calibration/calibrate_camera.h"
#include "edgevo/calibration/calibration_picture.h"
#include "edgevo/core/error.h"
#include "unit/calibration/drawn_board.h"

namespace edgevo {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr double kSquare = 0.03;
constexpr int kSquarePx = 30;  // of the texture: a millimetre each, so that markers of 22 and 24 mm are exact
const Eigen::Vector3d kCentre(6 * kSquare, 4.5 * kSquare, 0);  // of the chessboard's texture

Board chessboard() {
  Board board = board_of_size("9x6", false, "--chessboard");
  board.square_m = kSquare;
  return board;
}

Board charuco(double marker_m) {
  Board board = board_of_size("8x6", true, "--charuco");
  board.square_m = kSquare;
  board.marker_m = marker_m;
  return board;
}

cv::Mat chessboard_texture() {
  constexpr int kColumns = 12, kRows = 9;  // squares, the white border included
  cv::Mat texture(kRows * kSquarePx, kColumns * kSquarePx, CV_8UC1, cv::Scalar(230));
  for (int y = 1; y < kRows - 1; ++y)
    for (int x = 1; x < kColumns - 1; ++x)
      if ((x + y) % 2 == 0) texture(cv::Rect(x * kSquarePx, y * kSquarePx, kSquarePx, kSquarePx)).setTo(25);
  return texture;
}

cv::Mat charuco_texture(const Board& b) {
  cv::Mat texture;
  cv::aruco::CharucoBoard::create(b.columns, b.rows, float(b.square_m), float(b.marker_m),
                                  cv::aruco::getPredefinedDictionary(cv::aruco::DICT_4X4_50))
      ->draw({b.columns * kSquarePx, b.rows * kSquarePx}, texture);
  return texture;
}

// Board poses near and far, in all parts of the image, tilted to all sides.
std::vector<SE3> poses(const Eigen::Vector3d& centre) {
  std::vector<SE3> all;
  for (const double turn : {-32.0, 3.0, 30.0})
    for (const double tip : {-30.0, -2.0, 28.0})
      all.push_back(test::board_pose(centre, turn, tip, {0.003 * turn, 0.002 * tip, 0.42}));
  for (const double x : {-0.17, 0.15})
    for (const double y : {-0.11, 0.12})
      all.push_back(test::board_pose(centre, 100 * x, 150 * y, {x, y, 0.5}));
  return all;
}

// The corners of a 9x6 board as detected with 0.1 px of noise.
BoardView made_up_view(int frame, const SE3& T_cam_board, const Camera& camera) {
  BoardView view;
  view.frame = frame;
  Random random(uint64_t(frame) + 1);
  for (int i = 0; i < 54; ++i) {
    const Eigen::Vector2f p = float(kSquare) * Eigen::Vector2f(float(i % 9 + 2), float(i / 9 + 2));
    const Eigen::Vector3d at = T_cam_board * Eigen::Vector3d(p.x(), p.y(), 0);
    const Eigen::Vector2d px = camera.project(at).value();
    view.ids.push_back(i);
    view.p_board.push_back(p);
    view.px.push_back(
        Eigen::Vector2d(px.x() + 0.1 * random.normal(), px.y() + 0.1 * random.normal()).cast<float>());
  }
  return view;
}

class CalibrateCamera : public ::testing::Test {
 protected:
  BoardViews views(const std::vector<SE3>& T_cam_board) const {
    BoardViews all{480, 360, int(T_cam_board.size()), int(T_cam_board.size()), {}};
    for (const SE3& T : T_cam_board) all.views.push_back(made_up_view(int(all.views.size()), T, camera_));
    return all;
  }
  static std::string why_refused(const BoardViews& all) {
    try {
      calibrate_camera(all, "board");
    } catch (const InputError& e) {
      return e.what();
    }
    return "not refused";
  }
  const Camera camera_ = test::known_camera();
};

// A source of frames from a vector.
class Played : public ImageSource {
 public:
  explicit Played(std::vector<GrayImage> images) : images_(std::move(images)) {}
  const Camera& camera() const override { return camera_; }
  std::optional<int> size() const override { return int(images_.size()); }
  std::string kind() const override { return "test"; }
  std::optional<Frame> next() override {
    if (next_ == images_.size()) return std::nullopt;
    const int i = int(next_++);
    return Frame{i, Timestamp{i}, images_[size_t(i)]};
  }

 private:
  Camera camera_;
  std::vector<GrayImage> images_;
  size_t next_ = 0;
};

CameraCalibration calibrated_from(const test::DrawnBoard& drawn, const Board& board) {
  std::vector<GrayImage> images;
  for (const SE3& T : poses(drawn.centre())) images.push_back(drawn.seen_from(T));
  Played source(std::move(images));
  return calibrate_camera(collect_views(source, BoardFinder(board), [] { return true; }), "board");
}

// Largest distance between the projections by the estimated and the true camera, where there were corners;
// pixels.
double largest_difference(const Camera& a, const Camera& b) {
  double most = 0;
  for (double y = -0.3; y <= 0.3; y += 0.1)
    for (double x = -0.4; x <= 0.4; x += 0.1) {
      const Eigen::Vector3d ray(x, y, 1);
      most = std::max(most, (a.project(ray).value() - b.project(ray).value()).norm());
    }
  return most;
}

void expect_known_camera(const CameraCalibration& c, double px) {
  const Camera truth = test::known_camera();
  EXPECT_NEAR(c.camera.pinhole().fx, truth.pinhole().fx, px);
  EXPECT_NEAR(c.camera.pinhole().fy, truth.pinhole().fy, px);
  EXPECT_NEAR(c.camera.pinhole().cx, truth.pinhole().cx, px);
  EXPECT_NEAR(c.camera.pinhole().cy, truth.pinhole().cy, px);
  EXPECT_NEAR(c.camera.distortion().k1, truth.distortion().k1, 0.02);
  EXPECT_LT(largest_difference(c.camera, truth), px);
  EXPECT_LT(c.rms_px, 0.25);
}

TEST(Calibration, RecoversTheCameraFromDrawnChessboards) {
  const test::DrawnBoard drawn(test::known_camera(), chessboard_texture(), kSquarePx / kSquare);
  const CameraCalibration c = calibrated_from(drawn, chessboard());
  EXPECT_GE(c.views.size(), 10u);
  expect_known_camera(c, 2);
}

// Parts of it are enough: at least three views lack some of its corners.
TEST(Calibration, RecoversTheCameraFromDrawnCharucoBoards) {
  const Board board = charuco(0.022);
  const test::DrawnBoard drawn(test::known_camera(), charuco_texture(board), kSquarePx / kSquare);
  const CameraCalibration c = calibrated_from(drawn, board);
  const auto partial = std::count_if(c.views.begin(), c.views.end(),
                                     [](const ViewFit& view) { return view.px.size() < 7 * 5; });
  EXPECT_GE(partial, 3);
  expect_known_camera(c, 1);
}

// Three pixels of white around the markers. A window of 9x9 pixels overestimated the focal length by 8 px.
TEST(Calibration, MarkersNearTheCornersDoNotAttractThem) {
  const Board board = charuco(0.024);
  const test::DrawnBoard drawn(test::known_camera(), charuco_texture(board), kSquarePx / kSquare);
  expect_known_camera(calibrated_from(drawn, board), 1);
}

TEST_F(CalibrateCamera, ReportsItsUncertainty) {
  const CameraCalibration c = calibrate_camera(views(poses(kCentre)), "board");
  EXPECT_NEAR(c.rms_px, 0.1 * M_SQRT2, 0.02);
  EXPECT_GT(c.sigma_f_px, 0.05);
  EXPECT_NEAR(c.camera.pinhole().fx, camera_.pinhole().fx, 4 * c.sigma_f_px);
  EXPECT_NEAR(c.camera.pinhole().cx, camera_.pinhole().cx, 4 * c.sigma_c_px);
  EXPECT_EQ(c.camera.distortion().k3, 0);  // indistinguishable from 0
  EXPECT_THAT(c.lacking, IsEmpty());
  EXPECT_THAT(c.skipped, IsEmpty());
}

TEST_F(CalibrateCamera, RejectsAnOutlierView) {
  BoardViews all = views(poses(kCentre));
  Random random(3);
  for (Eigen::Vector2f& px : all.views[4].px) px.x() += float(random.normal());
  const CameraCalibration c = calibrate_camera(all, "board");
  EXPECT_THAT(c.skipped, ::testing::ElementsAre(4));
  EXPECT_NEAR(c.camera.pinhole().fx, camera_.pinhole().fx, 4 * c.sigma_f_px);
}

TEST_F(CalibrateCamera, ReportsMissingViews) {
  std::vector<SE3> left;
  for (int i = 0; i < 12; ++i)
    left.push_back(test::board_pose(kCentre, i % 2 ? 42 : -40, 4 - i % 5,
                                    {-0.1 - 0.004 * i, 0.01 * (i % 4), 0.4 + 0.01 * i}));
  const CameraCalibration c = calibrate_camera(views(left), "board");
  EXPECT_THAT(c.lacking, Contains(HasSubstr("near the border (right")));
  EXPECT_THAT(c.lacking, Contains(HasSubstr("tipped forward or backward")));
  EXPECT_THAT(c.lacking, ::testing::Not(Contains(HasSubstr("to the left or right"))));
}

TEST_F(CalibrateCamera, RefusesDegenerateViews) {
  std::vector<SE3> straight;
  for (int i = 0; i < 12; ++i)
    straight.push_back(test::board_pose(kCentre, 0, 0, {0.02 * (i % 4) - 0.03, 0.02 * (i / 4) - 0.02, 0.5}));
  EXPECT_THAT(why_refused(views(straight)), HasSubstr("do not determine the focal length"));
  std::vector<SE3> few = poses(kCentre);
  few.resize(7);
  EXPECT_THAT(why_refused(views(few)), HasSubstr("7 different view(s); give at least 8"));
  EXPECT_THAT(why_refused({480, 360, 5, 0, {}}), HasSubstr("in none of 5 images; check its size"));
}

// Every second corner from the wrong row: impossible for any camera.
TEST_F(CalibrateCamera, RefusesResidualsTooLargeForTheLensModel) {
  BoardViews all = views(poses(kCentre));
  for (BoardView& view : all.views)
    for (size_t i = 0; i < view.px.size(); i += 2) view.px[i].y() += 4;
  EXPECT_THAT(why_refused(all), HasSubstr("check the board's size"));
}

TEST_F(CalibrateCamera, KeepsOnlyDistinctViews) {
  const test::DrawnBoard drawn(camera_, chessboard_texture(), kSquarePx / kSquare);
  const GrayImage once = drawn.seen_from(test::board_pose(kCentre, 20, 10, {0, 0, 0.42}));
  const GrayImage near = drawn.seen_from(test::board_pose(kCentre, 20.2, 10, {0.001, 0, 0.42}));
  const GrayImage other = drawn.seen_from(test::board_pose(kCentre, -20, 10, {0.03, 0, 0.42}));
  Played source({once, near, GrayImage{480, 360, std::vector<uint8_t>(480 * 360, 100)}, other, once});
  int looked_at = 0;
  const BoardViews found = collect_views(source, BoardFinder(chessboard()), [&] { return ++looked_at < 5; });
  EXPECT_EQ(found.images, 5);
  EXPECT_EQ(found.seen, 4);
  ASSERT_EQ(found.views.size(), 2u);
  EXPECT_EQ(found.views[1].frame, 3);
}

TEST_F(CalibrateCamera, PictureShowsTheCornersWhereTheyAre) {
  const CameraCalibration c = calibrate_camera(views(poses(kCentre)), "board");
  const std::string png = calibration_picture(c);
  const cv::Mat picture = cv::imdecode(std::vector<uint8_t>(png.begin(), png.end()), cv::IMREAD_COLOR);
  ASSERT_EQ(picture.cols, 1000);
  ASSERT_GT(picture.rows, 750);  // and a line of text below
  const double scale = 1000.0 / 480;
  for (const Eigen::Vector2f& px : c.views[0].px) {
    const cv::Vec3b at = picture.at<cv::Vec3b>(int(scale * double(px.y())), int(scale * double(px.x())));
    EXPECT_LT(std::min({at[0], at[1], at[2]}), 200);
  }
}

TEST(BoardText, RefusesInvalidSizes) {
  const auto why = [](const Board& board) -> std::string {
    try {
      BoardFinder finder(board);
    } catch (const InputError& e) {
      return e.what();
    }
    return "not refused";
  };
  EXPECT_THROW(board_of_size("9", false, "--chessboard"), InputError);
  EXPECT_THROW(board_of_size("9x6m", false, "--chessboard"), InputError);
  EXPECT_THAT(why(board_of_size("9x2", false, "--chessboard")),
              HasSubstr("--chessboard: a side is out of range"));
  Board board = charuco(0.022);
  board.marker_m = 0.04;
  EXPECT_THAT(why(board), HasSubstr("--marker: is not between 0 and --square"));
  board = charuco(0.022);
  board.dictionary = "4x4_5";
  EXPECT_THAT(why(board), HasSubstr("did you mean 4x4_50?"));
}

TEST(BoardFinder, AnImageWithFewerPixelsThanItsSizeIsRefused) {
  EXPECT_THROW(BoardFinder(chessboard()).find({640, 480, std::vector<uint8_t>(1000)}), InputError);
}

TEST_F(CalibrateCamera, SkipsImagesOfAnotherSizeThanMost) {
  const test::DrawnBoard drawn(camera_, chessboard_texture(), kSquarePx / kSquare);
  const GrayImage one = drawn.seen_from(test::board_pose(kCentre, 20, 10, {0, 0, 0.42}));
  const GrayImage two = drawn.seen_from(test::board_pose(kCentre, -20, 10, {0.03, 0, 0.42}));
  const GrayImage wider{one.width + 1, one.height,
                        std::vector<uint8_t>(size_t(one.width + 1) * size_t(one.height), 100)};
  Played source({wider, one, two});
  const BoardViews found = collect_views(source, BoardFinder(chessboard()), [] { return true; });
  EXPECT_EQ(found.width, one.width);
  EXPECT_EQ(found.images, 2);
  EXPECT_EQ(found.views.size(), 2u);
  EXPECT_THAT(found.of_other_size, ::testing::ElementsAre(HasSubstr("image 0 (")));
  Played half({wider, one});
  EXPECT_THROW(collect_views(half, BoardFinder(chessboard()), [] { return true; }), InputError);
}

}  // namespace
}  // namespace edgevo
