// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/calibration/board.h"

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <map>
#include <opencv2/aruco/charuco.hpp>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include "edgevo/core/error.h"
#include "edgevo/core/frame_checks.h"

namespace edgevo {
namespace {

constexpr int kMinSide = 3, kMaxSide = 100;
constexpr int kMinCorners = 6;  // of a ChArUco board: a homography (4) and some redundancy

const std::map<std::string, int>& dictionaries() {
  using namespace cv::aruco;
  static const std::map<std::string, int> known{
      {"4x4_50", DICT_4X4_50},     {"4x4_100", DICT_4X4_100},        {"4x4_250", DICT_4X4_250},
      {"4x4_1000", DICT_4X4_1000}, {"5x5_50", DICT_5X5_50},          {"5x5_100", DICT_5X5_100},
      {"5x5_250", DICT_5X5_250},   {"5x5_1000", DICT_5X5_1000},      {"6x6_50", DICT_6X6_50},
      {"6x6_100", DICT_6X6_100},   {"6x6_250", DICT_6X6_250},        {"6x6_1000", DICT_6X6_1000},
      {"7x7_50", DICT_7X7_50},     {"7x7_100", DICT_7X7_100},        {"7x7_250", DICT_7X7_250},
      {"7x7_1000", DICT_7X7_1000}, {"original", DICT_ARUCO_ORIGINAL}};
  return known;
}

void check_dictionary(const std::string& name) {
  if (dictionaries().count(name)) return;
  std::vector<std::string> names;
  for (const auto& entry : dictionaries()) names.push_back(entry.first);
  throw InputError("--dictionary " + name, "is unknown", "did you mean " + nearest_name(name, names) + "?");
}

cv::Mat pixels_of(const GrayImage& image) {
  return cv::Mat(image.height, image.width, CV_8UC1, const_cast<uint8_t*>(image.pixels.data()));
}

using Quads = std::vector<std::vector<cv::Point2f>>;

// Radius around a corner in which only its own edges are seen: the nearest corner of a marker would attract
// it, and that corner's blur reaches a pixel farther. OpenCV's own window shrinks to nothing, ours to 5x5.
int half_window(const cv::Point2f& corner, const Quads& markers) {
  constexpr float kBlurPx = 1;
  constexpr int kMin = 2, kMax = 5;
  float nearest = kMax + kBlurPx;
  for (const auto& marker : markers)
    for (const cv::Point2f& p : marker)
      nearest = std::min(nearest, std::max(std::abs(p.x - corner.x), std::abs(p.y - corner.y)));
  return std::max(kMin, int(nearest - kBlurPx));
}

// The point at which the gradients around each corner intersect.
void refine(const cv::Mat& pixels, const Quads& markers, std::vector<cv::Point2f>* corners) {
  const cv::TermCriteria until(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 30, 0.01);
  for (cv::Point2f& corner : *corners) {
    const int half = half_window(corner, markers);
    std::vector<cv::Point2f> one{corner};
    cv::cornerSubPix(pixels, one, {half, half}, {-1, -1}, until);
    corner = one.front();
  }
}

void add(BoardView* view, int id, const cv::Point2f& px, const Eigen::Vector2f& p_board) {
  view->ids.push_back(id);
  view->px.push_back({px.x, px.y});
  view->p_board.push_back(p_board);
}

std::optional<BoardView> find_chessboard(const GrayImage& image, const Board& board) {
  std::vector<cv::Point2f> corners;
  if (!cv::findChessboardCornersSB(pixels_of(image), {board.columns, board.rows}, corners,
                                   cv::CALIB_CB_NORMALIZE_IMAGE | cv::CALIB_CB_ACCURACY))
    return std::nullopt;
  BoardView view;
  for (int i = 0; i < int(corners.size()); ++i) {
    const int column = i % board.columns, row = i / board.columns;
    add(&view, i, corners[size_t(i)], float(board.square_m) * Eigen::Vector2f(float(column), float(row)));
  }
  return view;
}

}  // namespace

struct BoardFinder::Charuco {
  cv::Ptr<cv::aruco::Dictionary> dictionary;
  cv::Ptr<cv::aruco::CharucoBoard> board;

  explicit Charuco(const Board& b)
      : dictionary(cv::aruco::getPredefinedDictionary(dictionaries().at(b.dictionary))),
        board(cv::aruco::CharucoBoard::create(b.columns, b.rows, float(b.square_m), float(b.marker_m),
                                              dictionary)) {}

  std::optional<BoardView> find(const GrayImage& image) const {
    Quads markers;
    std::vector<int> marker_ids;
    cv::aruco::detectMarkers(pixels_of(image), dictionary, markers, marker_ids);
    if (marker_ids.empty()) return std::nullopt;
    std::vector<cv::Point2f> corners;
    std::vector<int> ids;
    cv::aruco::interpolateCornersCharuco(markers, marker_ids, pixels_of(image), board, corners, ids);
    refine(pixels_of(image), markers, &corners);
    if (int(ids.size()) < kMinCorners || cv::aruco::testCharucoCornersCollinear(board, ids))
      return std::nullopt;
    BoardView view;
    for (size_t i = 0; i < ids.size(); ++i) {
      const cv::Point3f& p = board->chessboardCorners[size_t(ids[i])];
      add(&view, ids[i], corners[i], {p.x, p.y});
    }
    return view;
  }
};

void Board::check() const {
  const std::string option = charuco ? "--charuco" : "--chessboard";
  if (std::min(columns, rows) < kMinSide || std::max(columns, rows) > kMaxSide)
    throw InputError(option, "a side is out of range", "give COLUMNSxROWS of 3 to 100 each, for example 9x6");
  if (!(square_m > 0))
    throw InputError("--square", "is not larger than 0", "give the side of a square in metres");
  if (!charuco) return;
  if (!(marker_m > 0 && marker_m < square_m))
    throw InputError("--marker", "is not between 0 and --square",
                     "give the sides of a marker and of a square in metres");
  check_dictionary(dictionary);
}

Board board_of_size(const std::string& text, bool charuco, const std::string& option) {
  Board board;
  board.charuco = charuco;
  char rest = 0;
  if (std::sscanf(text.c_str(), "%4dx%4d%c", &board.columns, &board.rows, &rest) != 2)
    throw InputError(option + " " + text, "is not COLUMNSxROWS", "give for example " + option + " 9x6");
  return board;
}

BoardFinder::BoardFinder(const Board& board) : board_(board) {
  board_.check();
  if (board_.charuco) charuco_ = std::make_unique<Charuco>(board_);
}

BoardFinder::~BoardFinder() = default;

std::optional<BoardView> BoardFinder::find(const GrayImage& image) const {
  check_pixels(image, "BoardFinder::find()");
  return charuco_ ? charuco_->find(image) : find_chessboard(image, board_);
}

}  // namespace edgevo
