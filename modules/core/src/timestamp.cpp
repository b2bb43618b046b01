// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/core/timestamp.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cinttypes>
#include <cmath>
#include <cstdio>

namespace edgevo {
namespace {

constexpr int kTickDigits = 7;                // decimals of a tick in seconds
constexpr int64_t kNanosecondsPerTick = 100;  // timestamp.h
constexpr double kMaxSeconds = 9e11;          // more ticks do not fit 64 bits

// "-12.345" without exponent: whole digits, then at most seven decimals, the eighth rounds.
bool parse_plain(std::string_view text, Timestamp* t) {
  const bool negative = !text.empty() && text.front() == '-';
  if (negative) text.remove_prefix(1);
  int64_t ticks = 0;
  int decimals = -1, digits = 0;
  bool round_up = false;
  for (char c : text) {
    if (c == '.' && decimals < 0) {
      decimals = 0;
      continue;
    }
    if (!std::isdigit(static_cast<unsigned char>(c))) return false;
    ++digits;
    if (decimals >= 0 && ++decimals > kTickDigits) {
      if (decimals == kTickDigits + 1) round_up = c >= '5';
      continue;
    }
    if (ticks > (INT64_MAX - 9) / 10) return false;
    ticks = ticks * 10 + (c - '0');
  }
  if (digits == 0) return false;
  for (int d = std::max(decimals, 0); d < kTickDigits; ++d) {
    if (ticks > INT64_MAX / 10) return false;
    ticks *= 10;
  }
  ticks += round_up;
  t->ticks = negative ? -ticks : ticks;
  return true;
}

}  // namespace

Timestamp Timestamp::from_seconds(double s) { return {std::llround(s * double(kTicksPerSecond))}; }

Timestamp Timestamp::from_nanoseconds(int64_t ns) {
  const int64_t half = ns >= 0 ? kNanosecondsPerTick / 2 : -kNanosecondsPerTick / 2;
  return {(ns + half) / kNanosecondsPerTick};
}

std::string to_string(Timestamp t) {
  const bool negative = t.ticks < 0;
  const int64_t a = negative ? -t.ticks : t.ticks;
  char buffer[40];
  std::snprintf(buffer, sizeof buffer, "%s%" PRId64 ".%07" PRId64, negative ? "-" : "",
                a / Timestamp::kTicksPerSecond, a % Timestamp::kTicksPerSecond);
  return buffer;
}

bool parse_seconds(std::string_view text, Timestamp* t) {
  if (text.find_first_of("eE") == std::string_view::npos) return parse_plain(text, t);
  double seconds = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), seconds);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(seconds)) return false;
  if (std::abs(seconds) > kMaxSeconds) return false;
  *t = Timestamp::from_seconds(seconds);
  return true;
}

}  // namespace edgevo
