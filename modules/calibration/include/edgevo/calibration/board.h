// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A flat board with known corners: a chessboard, which must be fully in view, or a ChArUco board (a
// chessboard with a marker in each white square), which may be partly in view. OpenCV detects both.
#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "edgevo/core/image.h"

namespace edgevo {

/// Kind and dimensions of a calibration board.
struct Board {
  /// True: a ChArUco board; false: a chessboard.
  bool charuco = false;
  /// Chessboard: INNER corners along its two sides, as OpenCV counts them (a chess board has 7x7). ChArUco:
  /// squares.
  int columns = 0, rows = 0;
  /// Side of a square, metres; does not affect the camera.
  double square_m = 1;
  /// ChArUco: side of a marker, metres, less than that of a square.
  double marker_m = 0;
  /// ChArUco: OpenCV's predefined dictionary without its prefix DICT_, in lower case.
  std::string dictionary = "4x4_50";

  /// Throws InputError, which names the wrong option, for an impossible size or an unknown dictionary.
  void check() const;
};

/// Board of "COLUMNSxROWS", 3 to 100 each. Throws InputError, which names `option`.
Board board_of_size(const std::string& text, bool charuco, const std::string& option);

/// Corners of a board detected in one image.
struct BoardView {
  /// Index of the image in its source.
  int frame = 0;
  /// Index of each corner on the board, row by row.
  std::vector<int> ids;
  /// Position of each corner in the image, distorted pixels.
  std::vector<Eigen::Vector2f> px;
  /// Position of each corner on the board, metres.
  std::vector<Eigen::Vector2f> p_board;
};

/// Detects one board in images. Stateless; any thread.
class BoardFinder {
 public:
  /// Throws InputError as Board::check() does.
  explicit BoardFinder(const Board& board);
  ~BoardFinder();
  /// Corners, accurate to about a tenth of a pixel; nullopt if the board is not found (chessboard:
  /// completely; ChArUco: six corners not on a line). Cost: 20 to 300 ms for 640x480.
  std::optional<BoardView> find(const GrayImage& image) const;

 private:
  struct Charuco;
  Board board_;
  std::unique_ptr<Charuco> charuco_;  // null: a chessboard
};

}  // namespace edgevo
