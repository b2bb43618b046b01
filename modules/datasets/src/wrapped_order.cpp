// SPDX-License-Identifier: BSD-3-Clause
#include "wrapped_order.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <numeric>
#include <opencv2/imgproc.hpp>

#include "edgevo/core/error.h"
#include "edgevo/mrpt_bridge/image_file.h"
#include "name_times.h"

namespace edgevo {
namespace {

std::string name_of(const std::string& path) { return std::filesystem::path(path).filename().string(); }

template <typename T>
void permute(const std::vector<size_t>& order, std::vector<T>* values) {
  if (values->size() != order.size()) return;
  std::vector<T> moved;
  for (const size_t i : order) moved.push_back(std::move((*values)[i]));
  *values = std::move(moved);
}

// Whether the order was another one.
bool sort_by_times(Sequence* sequence) {
  std::vector<size_t> order(sequence->times.size());
  std::iota(order.begin(), order.end(), size_t(0));
  const auto& t = sequence->times;
  const auto earlier = [&](size_t a, size_t b) { return t[a] < t[b]; };
  if (std::is_sorted(order.begin(), order.end(), earlier)) return false;
  std::stable_sort(order.begin(), order.end(), earlier);
  permute(order, &sequence->images);
  permute(order, &sequence->times);
  return true;
}

template <typename T>
void begin_at(size_t first, std::vector<T>* values) {
  std::rotate(values->begin(), values->begin() + std::ptrdiff_t(first), values->end());
}

// The order may have been decided before: some files were skipped.
void decide_order(const std::string& value, const std::string& reason, Sequence* sequence) {
  for (InputDecision& d : sequence->decisions) {
    if (d.subject != "order") continue;
    d.value += ", " + value;
    d.reason += "; " + reason;
    return;
  }
  sequence->decisions.push_back({"order", value, reason, ""});
}

// Images from `first` on come first.
void move_to_the_front(size_t first, const std::string& reason, Sequence* sequence) {
  const std::string begin = name_of(sequence->images[first]), next = name_of(sequence->images.front());
  const std::string before = name_of(sequence->images.back());
  begin_at(first, &sequence->images);
  decide_order("from " + begin + ", and on with " + next + " after " + before, reason, sequence);
}

// Mean difference of two images, seen small, where shifts by a step of the camera matter little; nullopt if
// one cannot be read.
std::optional<double> difference(const std::string& a, const std::string& b) {
  const cv::Size small(32, 24);
  const auto read = [&](const std::string& path) {
    GrayImage image = read_gray_image(path);
    cv::Mat seen;
    cv::resize(cv::Mat(image.height, image.width, CV_8UC1, image.pixels.data()), seen, small, 0, 0,
               cv::INTER_AREA);
    return seen;
  };
  try {
    return cv::norm(read(a), read(b), cv::NORM_L1) / small.area();
  } catch (const InputError&) {
    return std::nullopt;
  }
}

bool follow_when_exchanged(const std::vector<std::string>& images, size_t first) {
  const auto exchanged = difference(images.back(), images.front());
  const auto as_sorted = difference(images[first - 1], images[first]);
  return exchanged && as_sorted && *exchanged < *as_sorted;
}

}  // namespace

std::optional<size_t> begin_before_wrap(const std::vector<double>& numbers, double period) {
  constexpr double kSkipped = 2;  // steps: a counter may begin at 1, and a clock lose an image
  if (numbers.size() < 3) return std::nullopt;
  size_t jump = 1;
  for (size_t i = 2; i < numbers.size(); ++i)
    if (numbers[i] - numbers[i - 1] > numbers[jump] - numbers[jump - 1]) jump = i;
  double usual = 0;  // longest of the other steps
  for (size_t i = 1; i < numbers.size(); ++i)
    if (i != jump) usual = std::max(usual, numbers[i] - numbers[i - 1]);
  const double across = period + numbers.front() - numbers.back();
  const bool follows = across > 0 && across <= kSkipped * usual;
  return follows && numbers[jump] - numbers[jump - 1] > across ? std::make_optional(jump) : std::nullopt;
}

void order_by_times(double period_s, Sequence* sequence) {
  if (sort_by_times(sequence))
    decide_order("by the times in the names", "sorted as text they are not", sequence);
  if (period_s <= 0) return;
  std::vector<double> seconds;
  for (const Timestamp t : sequence->times) seconds.push_back(seconds_between(sequence->times.front(), t));
  const auto first = begin_before_wrap(seconds, period_s);
  if (!first) return;
  const Timestamp period = Timestamp::from_seconds(period_s);
  for (size_t i = 0; i < *first; ++i) sequence->times[i].ticks += period.ticks;
  begin_at(*first, &sequence->times);
  move_to_the_front(*first, "the clock in the names begins again", sequence);
}

void order_by_counter(Sequence* sequence) {
  std::vector<std::string> stems;
  for (const std::string& image : sequence->images)
    stems.push_back(std::filesystem::path(image).stem().string());
  std::vector<double> numbers;
  double period = 1;  // the power of ten above the largest: names may have a zero before (DSC09999, DSC00001)
  for (const std::string& number : last_numbers(stems)) {
    numbers.push_back(std::strtod(number.c_str(), nullptr));
    while (std::isfinite(period) && period <= numbers.back()) period *= 10;
  }
  const auto first = begin_before_wrap(numbers, period);
  if (first && follow_when_exchanged(sequence->images, *first))
    move_to_the_front(*first, "the counter in the names begins again, and the images there are alike",
                      sequence);
}

}  // namespace edgevo
