// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <vector>

#include "monotone_fit.h"

namespace edgevo::training {

/// The fitted trust in a frame.
struct FittedTrust {
  /// Log odds of a wrong motion.
  LogisticSum sum;
  /// p_right below which a frame is doubtful.
  double bound = 0;
};

/// Name of a doubt in the table.
const char* name_of(ConsistencyTest doubt);
/// Text of modules/confidence/src/trust_table.h.
std::string trust_table_text(const FittedTrust& fitted, size_t runs, size_t cameras);

}  // namespace edgevo::training
