// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <nlohmann/json.hpp>
#include <string>

namespace edgevo {

/// JSON of a calibration; discarded if it is not complete, or nested deeper than any of them: copies of that
/// would exhaust the stack.
inline nlohmann::json parse_shallow_json(const std::string& text) {
  constexpr int kDeepest = 16;
  const auto is_shallow = [](int depth, nlohmann::json::parse_event_t, nlohmann::json&) {
    return depth < kDeepest;
  };
  return nlohmann::json::parse(text, is_shallow, false);
}

}  // namespace edgevo
