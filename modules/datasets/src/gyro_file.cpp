// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/datasets/gyro_file.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <sstream>

#include "edgevo/core/angle.h"
#include "edgevo/core/error.h"
#include "edgevo/core/order_statistics.h"
#include "sequence.h"
#include "text_file.h"
#include "time_unit.h"

namespace edgevo {
namespace {

namespace fs = std::filesystem;

// rad/s: a gyro ends at 2000 or 4000 degrees/s, whose number no gyro reaches in radians.
constexpr double kMostRate = 4500;
// m/s^2 around that of gravity: of a mean over a recording.
constexpr double kLeastGravity = 8, kMostGravity = 12;

// What a header says of the columns.
struct Columns {
  bool is_degrees = false, has_accelerations_first = false, is_stated = false;
};

std::string first_comment(const std::string& text) {
  std::istringstream in(text);
  std::string line;
  std::getline(in, line);
  const size_t begin = line.find_first_not_of(" \t");
  const bool is_header = begin != std::string::npos &&
                         (line[begin] == '#' || std::isalpha(static_cast<unsigned char>(line[begin])));
  if (!is_header) return {};
  std::transform(line.begin(), line.end(), line.begin(), [](unsigned char c) { return std::tolower(c); });
  return line;
}

Columns columns_of(const std::string& header) {
  const auto first_of = [&](std::initializer_list<const char*> names) {
    size_t at = std::string::npos;
    for (const char* name : names) at = std::min(at, header.find(name));
    return at;
  };
  Columns columns;
  columns.is_degrees = header.find("deg") != std::string::npos;
  const size_t rates = first_of({"w_", "w.", "wx", "omega", "gyr", "angular"}),
               accelerations = first_of({"a_", "a.", "ax", "acc", "linear"});
  columns.is_stated = rates != std::string::npos && accelerations != std::string::npos;
  columns.has_accelerations_first = columns.is_stated && accelerations < rates;
  return columns;
}

using Triples = std::vector<Eigen::Vector3d>;

double mean_length(const Triples& triples) {
  double sum = 0;
  for (const Eigen::Vector3d& v : triples) sum += v.norm();
  return sum / double(std::max<size_t>(1, triples.size()));
}

bool is_gravity(const Triples& triples) {
  const double length = mean_length(triples);
  return length > kLeastGravity && length < kMostGravity;
}

struct Rows {
  std::vector<std::string> times;
  std::vector<std::string> where;
  Triples first, second;
};

Rows read_rows(const std::string& text, const std::string& path) {
  Rows rows;
  for (const TextLine& line : split_lines(text, path)) {
    const bool by_commas = line.text.find(',') != std::string::npos;
    const auto fields = split_fields(line.text, by_commas ? ',' : ' ');
    if (rows.times.empty() && !fields[0].empty() && std::isalpha(static_cast<unsigned char>(fields[0][0])))
      continue;  // names of the columns
    if (fields.size() < 4 || (fields.size() > 4 && fields.size() < 7))
      throw InputError(line.where, "has " + std::to_string(fields.size()) + " fields",
                       "write a time, three rates in rad/s and, if there are any, three accelerations");
    const auto triple = [&](size_t from) {
      Eigen::Vector3d v;
      for (size_t i = 0; i < 3; ++i) v[int(i)] = parse_number(fields[from + i], line.where);
      return v;
    };
    rows.times.push_back(fields[0]);
    rows.where.push_back(line.where);
    rows.first.push_back(triple(1));
    if (fields.size() >= 7) rows.second.push_back(triple(4));
  }
  return rows;
}

// The unit in which the median step is that of a gyro: 0.2 to 100 ms, less than a factor of 1000.
std::string unit_of(const Rows& rows, const std::string& path) {
  constexpr double kShortest = 2e-4, kLongest = 0.1;  // seconds
  std::vector<double> times, steps;
  for (size_t i = 0; i < rows.times.size(); ++i) times.push_back(parse_number(rows.times[i], rows.where[i]));
  for (size_t i = 1; i < times.size(); ++i) steps.push_back(times[i] - times[i - 1]);
  const double step = median(std::move(steps));
  const std::pair<const char*, double> units[] = {{"s", 1}, {"ms", 1e-3}, {"us", 1e-6}, {"ns", 1e-9}};
  for (const auto& [symbol, seconds] : units)
    if (step * seconds >= kShortest && step * seconds <= kLongest) return symbol;
  throw InputError(path,
                   "its times are not those of a gyro: most are " + quote(std::to_string(step)) + " apart",
                   "write 10 to 5000 samples a second, in seconds or nanoseconds");
}

std::vector<Timestamp> times_of(const Rows& rows, const std::string& path) {
  std::vector<Timestamp> times;
  UnitOfTimes unit;
  size_t bad = 0;
  if (!parse_times(rows.times, unit_of(rows, path), &times, &unit, &bad))
    throw InputError(rows.where[bad], quote(rows.times[bad]) + " is not a time", "write one number");
  return times;
}

void check_order(const std::vector<Timestamp>& times, const Rows& rows) {
  for (size_t i = 1; i < times.size(); ++i)
    if (times[i] < times[i - 1])
      throw InputError(rows.where[i], "its time is before that of the line before", "sort the lines by time");
}

void check_rates(const Triples& rates, const Rows& rows) {
  for (size_t i = 0; i < rates.size(); ++i)
    if (!(rates[i].cwiseAbs().maxCoeff() < kMostRate))
      throw InputError(rows.where[i], "holds a rate that no gyro measures",
                       "write rates in rad/s behind the time");
}

}  // namespace

GyroFile read_gyro_file(const std::string& path) {
  const std::string text = read_text_file(path);
  const Columns columns = columns_of(first_comment(text));
  Rows rows = read_rows(text, path);
  if (rows.times.size() < 2)
    throw InputError(path, "holds fewer than two samples of a gyro", "give another, or --gyro off");
  const bool has_both = rows.second.size() == rows.first.size();
  bool is_second = has_both && columns.has_accelerations_first;
  GyroFile file;
  if (has_both && !columns.is_stated && is_gravity(rows.first) && !is_gravity(rows.second)) {
    is_second = true;
    file.decided = "the first three columns are as long as gravity, the rates are the others";
  }
  const Triples& rates = is_second ? rows.second : rows.first;
  check_rates(rates, rows);
  const std::vector<Timestamp> times = times_of(rows, path);
  check_order(times, rows);
  if (columns.is_degrees) file.decided = "in degrees a second, as its header says";
  const Triples& accelerations = is_second ? rows.first : rows.second;
  const double unit = columns.is_degrees ? rad(1) : 1;
  for (size_t i = 0; i < times.size(); ++i)
    file.samples.push_back(
        {times[i], unit * rates[i], has_both ? accelerations[i] : Eigen::Vector3d(Eigen::Vector3d::Zero())});
  return file;
}

std::string find_gyro_file(const std::string& source) {
  const fs::path folder = source;
  std::error_code ignored;
  if (!fs::is_directory(folder, ignored)) return {};
  for (const char* name : {"mav0/imu0/data.csv", "imu0/data.csv", "imu.txt", "../imu.txt"})
    if (const std::string file = existing((folder / name).string()); !file.empty()) return file;
  return {};
}

}  // namespace edgevo
