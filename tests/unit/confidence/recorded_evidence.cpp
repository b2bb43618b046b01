// SPDX-License-Identifier: BSD-3-Clause
#include "recorded_evidence.h"

#include <cmath>
#include <cstdio>
#include <sstream>
#include <utility>

#include "edgevo/core/error.h"
#include "edgevo/core/input_file.h"

namespace edgevo::test {
namespace {

constexpr int kDigitsOfP = 5, kDigitsOfDoubt = 4;  // after the point
constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
constexpr const char* kNoPose = "-";
constexpr std::array<const char*, kConsistencyTests> kDoubtNames{"corners",  "turn",        "step",
                                                                 "residual", "information", "map"};

// A number of a frame, to be written or read.
struct Column {
  const char* name;
  double (*get)(const RecordedFrame& f);
  void (*set)(double value, RecordedFrame* f);
};

std::optional<int> count_of(double value) {
  return std::isfinite(value) ? std::optional<int>(int(value)) : std::nullopt;
}
double number_of(const std::optional<int>& count) { return count ? double(*count) : kUnknown; }

template <int k>
constexpr Column motion_column(const char* name) {
  return {name, [](const RecordedFrame& f) { return f.motion[k]; },
          [](double v, RecordedFrame* f) { f->motion[k] = v; }};
}
template <auto member>
constexpr Column frame_column(const char* name) {
  return {name, [](const RecordedFrame& f) { return double(f.*member); },
          [](double v, RecordedFrame* f) { f->*member = std::decay_t<decltype(f->*member)>(v); }};
}
template <auto member>
constexpr Column evidence_column(const char* name) {
  return {name, [](const RecordedFrame& f) { return double(f.evidence.*member); },
          [](double v, RecordedFrame* f) { f->evidence.*member = v; }};
}
template <auto member>
constexpr Column count_column(const char* name) {
  return {name, [](const RecordedFrame& f) { return number_of(f.evidence.*member); },
          [](double v, RecordedFrame* f) { f->evidence.*member = count_of(v); }};
}
template <auto member>
constexpr Column corner_column(const char* name) {
  return {
      name,
      [](const RecordedFrame& f) { return f.evidence.corners ? (*f.evidence.corners).*member : kUnknown; },
      [](double v, RecordedFrame* f) {
        if (f->evidence.corners) (*f->evidence.corners).*member = v;
      }};
}

using E = FrameEvidence;
using C = CornerEvidence;
// Everything that trust and status read. The number of corners stands before what the corners say.
const std::vector<Column>& columns() {
  static const std::vector<Column> all{
      frame_column<&RecordedFrame::segment>("segment"),
      motion_column<0>("x"),
      motion_column<1>("y"),
      motion_column<2>("z"),
      motion_column<3>("turn_x"),
      motion_column<4>("turn_y"),
      motion_column<5>("turn_z"),
      evidence_column<&E::median_depth>("median_depth"),
      evidence_column<&E::moved_by_map>("moved_by_map"),
      {"stands", [](const RecordedFrame& f) { return double(f.evidence.stands); },
       [](double v, RecordedFrame* f) { f->evidence.stands = v == 1; }},
      count_column<&E::visible_points>("visible_points"),
      evidence_column<&E::inlier_share>("inlier_share"),
      evidence_column<&E::residual_px>("residual_px"),
      {"pose_sigma", [](const RecordedFrame& f) { return f.evidence.pose_sigmas.back(); },
       [](double v, RecordedFrame* f) { f->evidence.pose_sigmas.fill(v); }},
      evidence_column<&E::focal_error>("focal_error"),
      evidence_column<&E::focal_error_sigma>("focal_error_sigma"),
      {"corners",
       [](const RecordedFrame& f) { return f.evidence.corners ? f.evidence.corners->tracks : kUnknown; },
       [](double v, RecordedFrame* f) {
         if (count_of(v)) f->evidence.corners.emplace().tracks = int(v);
       }},
      corner_column<&C::motion_error>("motion_error"),
      corner_column<&C::motion_sigma>("motion_sigma"),
      corner_column<&C::rotation_deg>("rotation_deg"),
      corner_column<&C::rotation_sigma_deg>("rotation_sigma_deg"),
  };
  return all;
}

std::string four_digits(double value) {
  if (!std::isfinite(value)) return "";
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

std::string decimals(double value, int digits) {
  char text[32];
  std::snprintf(text, sizeof text, "%.*f", digits, value);
  return value == 0 ? "0" : text;
}

double number_in(const std::string& field) { return field.empty() ? kUnknown : std::stod(field); }

std::string header() {
  std::string names = "state,p_right";
  for (const char* doubt : kDoubtNames) names += std::string(",doubt_") + doubt;
  for (const Column& c : columns()) names += std::string(",") + c.name;
  return names;
}

std::string row_text(const EvidenceRow& row) {
  if (!row.outcome) return kNoPose;
  const Outcome& o = *row.outcome;
  std::string text = std::string(to_string(o.state)) + "," + decimals(o.p_right, kDigitsOfP);
  for (const double doubt : o.doubts) text += "," + decimals(doubt, kDigitsOfDoubt);
  for (const Column& c : columns()) text += "," + four_digits(c.get(row.frame));
  return text;
}

std::vector<std::string> fields_of(const std::string& line) {
  std::vector<std::string> fields(1);
  for (const char c : line) {
    if (c == ',')
      fields.emplace_back();
    else
      fields.back() += c;
  }
  return fields;
}

TrackingState state_named(const std::string& name, const std::string& where) {
  for (const TrackingState s : {TrackingState::kTracking, TrackingState::kDegraded, TrackingState::kLost})
    if (name == to_string(s)) return s;
  throw InputError(where, "has a frame of state '" + name + "'", "record it again");
}

EvidenceRow row_of(const std::string& line, const std::string& path) {
  EvidenceRow row;
  if (line == kNoPose) return row;
  const std::vector<std::string> fields = fields_of(line);
  if (fields.size() != 2 + kConsistencyTests + columns().size())
    throw InputError(path, "has a row of another length", "record it again");
  size_t next = 0;
  Outcome& o = row.outcome.emplace();
  o.state = state_named(fields[next++], path);
  o.p_right = number_in(fields[next++]);
  for (double& doubt : o.doubts) doubt = number_in(fields[next++]);
  row.frame.has_pose = true;
  for (const Column& c : columns()) c.set(number_in(fields[next++]), &row.frame);
  return row;
}

bool is_same(double value, double recorded, int digits) {
  return std::abs(value - recorded) <= 0.5 * std::pow(10, -digits) + 1e-9;
}

}  // namespace

std::optional<Outcome> EvidenceReplay::add(const RecordedFrame& frame) {
  if (!frame.has_pose) {
    history_.interrupt();
    return std::nullopt;
  }
  T_map_cam_ = T_map_cam_ * SE3::exp(frame.motion);
  if (std::exchange(segment_, frame.segment) != frame.segment) history_.begin_map();
  history_.add({T_map_cam_, {}, 1, frame.evidence.stands});
  const FrameConfidence trust = trust_.add({frame.evidence, history_.newest()});
  return Outcome{trust.doubts, trust.p_right,
                 frame_status(frame_status(frame.evidence, StatusParams()), trust).state};
}

RecordedFrame rounded(const RecordedFrame& frame) {
  RecordedFrame read;
  read.has_pose = frame.has_pose;
  for (const Column& c : columns()) c.set(number_in(four_digits(c.get(frame))), &read);
  return read;
}

std::string to_text(const std::vector<EvidenceRow>& rows) {
  std::string text = header() + "\n";
  for (const EvidenceRow& row : rows) text += row_text(row) + "\n";
  return text;
}

std::vector<EvidenceRow> read_evidence(const std::string& path) {
  const char* kRemedy = "cmake --build build/release --target record_evidence";
  std::istringstream lines(read_file(path, kRemedy));
  std::string line;
  if (!std::getline(lines, line) || line != header())
    throw InputError(path, "has other columns than trust and status read", kRemedy);
  std::vector<EvidenceRow> rows;
  while (std::getline(lines, line)) rows.push_back(row_of(line, path));
  return rows;
}

bool is_same_p(double value, double recorded) { return is_same(value, recorded, kDigitsOfP); }
bool is_same_doubt(double value, double recorded) { return is_same(value, recorded, kDigitsOfDoubt); }
const char* name_of_doubt(size_t doubt) { return kDoubtNames[doubt]; }

}  // namespace edgevo::test
