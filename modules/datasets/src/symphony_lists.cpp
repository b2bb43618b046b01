// SPDX-License-Identifier: BSD-3-Clause
#include "symphony_lists.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "edgevo/core/error.h"
#include "text_file.h"

namespace edgevo {
namespace {

constexpr int kColumns = int(SurveyColumn::kCount);
constexpr const char* kNames[kColumns] = {"t_sec", "seq", "x",  "y",  "theta", "pan",   "tilt",
                                          "fx",    "fy",  "cx", "cy", "width", "height"};
constexpr double kLargestNumber = 9'999'999;  // 130 surveys have 5 million images together
constexpr double kMapStep_s = 0.1;            // largest distance in time of a pose from its image

// Which field of a row each column is; -1: it has none.
using Fields = std::array<int, kColumns>;

Fields usual_fields() {
  Fields fields;
  for (int i = 0; i < kColumns; ++i) fields[size_t(i)] = i;
  return fields;
}

// "% t_sec, seq, x, ...": false for a comment that is no header.
bool parse_header(const std::string& comment, Fields* fields) {
  const std::vector<std::string> names = split_fields(comment.substr(comment.find_first_not_of("% \t")), ',');
  Fields found;
  for (int i = 0; i < kColumns; ++i) {
    const auto it = std::find(names.begin(), names.end(), kNames[i]);
    found[size_t(i)] = it == names.end() ? -1 : int(it - names.begin());
  }
  if (found[0] < 0 || found[1] < 0) return false;
  *fields = found;
  return true;
}

bool is_comment(const TextLine& line) { return line.text.front() == '%'; }

int line_number(const TextLine& line) { return std::stoi(line.where.substr(line.where.rfind(' ') + 1)); }

Timestamp parse_survey_time(const std::string& text, const std::string& where) {
  Timestamp t;
  if (!parse_seconds(text, &t))
    throw InputError(where, quote(text) + " is not a time in seconds", "restore the file");
  return t;
}

int parse_image_number(const std::string& text, const std::string& where) {
  const double value = parse_number(text, where);
  if (!(value >= 0 && value <= kLargestNumber) || value != std::floor(value))
    throw InputError(where, quote(text) + " is not the number of an image", "restore the file");
  return int(value);
}

class RowReader {
 public:
  explicit RowReader(std::string path) { rows_.path = std::move(path); }

  void read(const TextLine& line) {
    if (is_comment(line)) {
      if (rows_.rows.empty() && line.text.find_first_not_of("% \t") != std::string::npos)
        parse_header(line.text, &fields_);
      return;
    }
    const std::vector<std::string> fields = split_fields(line.text, ',');
    if (rows_.rows.empty()) begin(int(fields.size()), line.where);
    if (int(fields.size()) != rows_.columns)
      throw InputError(
          line.where,
          "has " + std::to_string(fields.size()) + " columns instead of " + std::to_string(rows_.columns),
          "restore the file, or take the line out");
    add(fields, line);
  }
  SurveyRows finish() { return std::move(rows_); }

 private:
  bool has(SurveyColumn first, SurveyColumn last) const {
    for (int i = int(first); i <= int(last); ++i)
      if (fields_[size_t(i)] < 0 || fields_[size_t(i)] >= rows_.columns) return false;
    return true;
  }
  void begin(int columns, const std::string& where) {
    rows_.columns = columns;
    if (!has(SurveyColumn::kTime, SurveyColumn::kNumber))
      throw InputError(
          where,
          "has " + std::to_string(columns) + " column" + (columns == 1 ? "" : "s") +
              ", fewer than a time and a number",
          "restore the file: t_sec, seq, x, y, theta, pan, tilt, fx, fy, cx, cy, width, height, ...");
    rows_.has_position = has(SurveyColumn::kX, SurveyColumn::kTheta);
    rows_.has_view = has(SurveyColumn::kPan, SurveyColumn::kTilt);
    rows_.has_camera = has(SurveyColumn::kFx, SurveyColumn::kHeight);
  }
  void add(const std::vector<std::string>& fields, const TextLine& line) {
    const auto text = [&](SurveyColumn c) { return fields[size_t(fields_[size_t(c)])]; };
    const auto number = [&](SurveyColumn c) { return has(c, c) ? parse_number(text(c), line.where) : 0.0; };
    SurveyRow row;
    row.line = line_number(line);
    row.time = parse_survey_time(text(SurveyColumn::kTime), line.where);
    row.number = parse_image_number(text(SurveyColumn::kNumber), line.where);
    row.x = number(SurveyColumn::kX), row.y = number(SurveyColumn::kY),
    row.theta = number(SurveyColumn::kTheta);
    row.pan = number(SurveyColumn::kPan), row.tilt = number(SurveyColumn::kTilt);
    row.fx = number(SurveyColumn::kFx), row.fy = number(SurveyColumn::kFy);
    row.cx = number(SurveyColumn::kCx), row.cy = number(SurveyColumn::kCy);
    row.width = number(SurveyColumn::kWidth), row.height = number(SurveyColumn::kHeight);
    rows_.rows.push_back(row);
  }

  SurveyRows rows_;
  Fields fields_ = usual_fields();
};

// The heading between two headings, along the shorter arc.
double mix_headings(double a, double b, double share) { return a + share * std::remainder(b - a, 2 * M_PI); }

}  // namespace

SurveyRows read_survey_rows(const std::string& path) {
  RowReader reader(path);
  for (const TextLine& line : split_lines(read_text_file(path), path)) reader.read(line);
  SurveyRows rows = reader.finish();
  if (rows.rows.empty())
    throw InputError(path, "the survey is empty: no row names an image", "restore the file");
  return rows;
}

std::vector<BoatPose> read_boat_poses(const std::string& path) {
  constexpr size_t kPoseColumns = 8;  // kf, t, x, y, theta, xg, yg, thetag
  std::vector<BoatPose> poses;
  for (const TextLine& line : split_lines(read_text_file(path), path)) {
    if (is_comment(line)) continue;
    const std::vector<std::string> fields = split_fields(line.text, ',');
    if (fields.size() < kPoseColumns)
      throw InputError(line.where, "has " + std::to_string(fields.size()) + " columns instead of 8",
                       "restore the file: kf, t, x, y, theta, xg, yg, thetag");
    const auto number = [&](size_t i) { return parse_number(fields[i], line.where); };
    const BoatPose pose{parse_survey_time(fields[1], line.where), {number(5), number(6)}, number(7)};
    if (!poses.empty() && pose.time <= poses.back().time)
      throw InputError(line.where,
                       "its time " + to_string(pose.time) + " s is not after that of the pose before",
                       "restore the file");
    poses.push_back(pose);
  }
  if (poses.empty()) throw InputError(path, "contains no pose", "restore the file");
  return poses;
}

std::optional<BoatPose> boat_at(const std::vector<BoatPose>& poses, Timestamp time) {
  const auto after = std::lower_bound(poses.begin(), poses.end(), time,
                                      [](const BoatPose& p, Timestamp t) { return p.time < t; });
  const auto near = [&](const BoatPose& p) { return std::abs(seconds_between(p.time, time)) <= kMapStep_s; };
  if (after != poses.end() && after->time == time) return *after;
  if (after == poses.begin() || after == poses.end()) return std::nullopt;  // no extrapolation
  const BoatPose &a = *std::prev(after), &b = *after;
  if (!near(a) && !near(b)) return std::nullopt;
  const double share = seconds_between(a.time, time) / seconds_between(a.time, b.time);
  return BoatPose{time, a.position + share * (b.position - a.position),
                  mix_headings(a.heading, b.heading, share)};
}

}  // namespace edgevo
