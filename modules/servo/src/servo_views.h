#pragma once
// The three views of a servo run with the fed points: where they truly are (crosses) and where they are
// wanted (circles).
#include <cstdint>
#include <string>
#include <vector>

#include "edgevo/servo/loop_result.h"

namespace edgevo {

struct ServoView {
  std::string name;  ///< start, taught or final
  std::vector<uint8_t> png;
};

/// As many as the run came to.
std::vector<ServoView> views_of(const ServoResult& r);

}  // namespace edgevo
