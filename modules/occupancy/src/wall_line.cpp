#include "wall_line.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace edgevo {
namespace {

// A piece shorter than this many widths may point anywhere.
constexpr double kPoints = 2;

bool continues(const WallLine& line, const WallLine& piece, double width, double gap) {
  const Eigen::Vector3d along = line.direction();
  if (piece.length() > kPoints * width && std::abs(along.dot(piece.direction())) < kParallel) return false;
  const double begin = along.dot(piece.begin - line.begin), end = along.dot(piece.end - line.begin);
  if ((line.begin + begin * along - piece.begin).norm() > width) return false;
  if ((line.begin + end * along - piece.end).norm() > width) return false;
  return std::min(begin, end) < line.length() + gap && std::max(begin, end) > -gap;
}

WallLine with_piece(const WallLine& line, const WallLine& piece) {
  const Eigen::Vector3d along = line.direction();
  WallLine both{line.begin, line.end, std::min(line.first, piece.first), std::max(line.last, piece.last)};
  for (const Eigen::Vector3d& p : {piece.begin, piece.end}) {
    if (along.dot(p - both.begin) < 0) both.begin = p;
    if (along.dot(p - both.end) > 0) both.end = p;
  }
  return both;
}

std::vector<size_t> longest_first(const std::vector<WallLine>& pieces) {
  std::vector<size_t> order(pieces.size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](size_t a, size_t b) { return pieces[a].length() > pieces[b].length(); });
  return order;
}

bool is_earlier(const WallLine& a, const WallLine& b) { return a.first < b.first; }

// Joins pieces to lines, each piece to one.
class Joiner {
 public:
  Joiner(const std::vector<WallLine>& pieces, double width, double gap)
      : pieces_(pieces), width_(width), gap_(gap), is_taken_(pieces.size(), false) {
    for (const WallLine& piece : pieces) longest_sight_ = std::max(longest_sight_, piece.last - piece.first);
  }

  std::vector<WallLine> lines() {
    std::vector<WallLine> lines;
    for (const size_t seed : longest_first(pieces_))
      if (!is_taken_[seed]) lines.push_back(grown(seed));
    std::stable_sort(lines.begin(), lines.end(), is_earlier);
    return lines;
  }

 private:
  WallLine grown(size_t seed) {
    is_taken_[seed] = true;
    WallLine line = pieces_[seed];
    while (grow(&line)) continue;
    return line;
  }

  bool grow(WallLine* line) {
    WallLine earliest;
    earliest.first = line->first - longest_sight_;
    const auto begin = std::lower_bound(pieces_.begin(), pieces_.end(), earliest, is_earlier);
    bool has_grown = false;
    for (auto i = size_t(begin - pieces_.begin()); i < pieces_.size() && pieces_[i].first <= line->last;
         ++i) {
      const bool is_of_its_time = pieces_[i].last >= line->first;
      if (is_taken_[i] || !is_of_its_time || !continues(*line, pieces_[i], width_, gap_)) continue;
      is_taken_[i] = has_grown = true;
      *line = with_piece(*line, pieces_[i]);
    }
    return has_grown;
  }

  const std::vector<WallLine>& pieces_;
  const double width_, gap_;
  std::vector<char> is_taken_;
  int longest_sight_ = 0;  // keyframes
};

}  // namespace

double WallLine::distance(const Eigen::Vector3d& p) const {
  const Eigen::Vector3d span = end - begin;
  const double share = std::clamp(span.dot(p - begin) / span.squaredNorm(), 0.0, 1.0);
  return (begin + share * span - p).norm();
}

std::vector<WallLine> joined(const std::vector<WallLine>& pieces, double width, double gap) {
  return Joiner(pieces, width, gap).lines();
}

}  // namespace edgevo
