#pragma once
// A flat board whose corners are known: a chessboard, all of which has to be in view, or a ChArUco board (a
// chessboard with a marker in each white square), of which a part is enough. Both are found by OpenCV.
#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "edgevo/core/image.h"

namespace edgevo {

/// What the board looks like.
struct Board {
  bool charuco = false;  ///< else a chessboard
  /// Chessboard: INNER corners along its two sides, as OpenCV counts (a game's board has 7x7). ChArUco:
  /// squares.
  int columns = 0, rows = 0;
  double square_m = 1;                ///< side of a square; of no consequence for the camera
  double marker_m = 0;                ///< ChArUco: side of a marker, less than that of a square
  std::string dictionary = "4x4_50";  ///< ChArUco: OpenCV's predefined ones, DICT_4X4_50 and so on

  /// Throws InputError: a size or dictionary that no board has. The option that is wrong is named.
  void check() const;
};

/// A chessboard or ChArUco board of "COLUMNSxROWS", 3 to 100 each; `option` opens the message of an
/// InputError.
Board board_of_size(const std::string& text, bool charuco, const std::string& option);

/// What one image shows of a board.
struct BoardView {
  int frame = 0;                         ///< of the image in its source
  std::vector<int> ids;                  ///< which corner, row by row
  std::vector<Eigen::Vector2f> px;       ///< where it is in the image, lens included
  std::vector<Eigen::Vector2f> p_board;  ///< where it is on the board, metres
};

/// Finds one board in images. Stateless; any thread.
class BoardFinder {
 public:
  /// Throws InputError as Board::check().
  explicit BoardFinder(const Board& board);
  ~BoardFinder();
  /// Corners to about a tenth of a pixel; nullopt where the board is not seen (a chessboard: as a whole;
  /// ChArUco: six corners that are not on a line). Cost: 20 to 300 ms for 640x480.
  std::optional<BoardView> find(const GrayImage& image) const;

 private:
  struct Charuco;
  Board board_;
  std::unique_ptr<Charuco> charuco_;  // null: a chessboard
};

}  // namespace edgevo
