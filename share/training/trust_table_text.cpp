// SPDX-License-Identifier: BSD-3-Clause
#include "trust_table_text.h"

#include <array>

#include "edgevo/core/output_file.h"

namespace edgevo::training {
namespace {

struct Description {
  const char* constant;
  const char* name;
  const char* unit;
};
constexpr std::array<Description, kConsistencyTests> kDescriptions{{
    {"kCorners", "corners", "log odds"},
    {"kTurn", "turn", "log odds"},
    {"kStep", "step", "log ratio"},
    {"kResidual", "residual", "log of pixels"},
    {"kInformation", "information", "decades"},
    {"kMap", "map", "log of tolerances"},
}};

}  // namespace

const char* name_of(ConsistencyTest doubt) { return kDescriptions[size_t(doubt)].name; }

std::string trust_table_text(const FittedTrust& fitted, size_t runs, size_t cameras) {
  std::string text =
      "// SPDX-License-Identifier: BSD-3-Clause\n#pragma once\n"
      "// Written by `edgevo_fit_trust RUNS.txt modules/confidence/src/trust_table.h REPORT.md`\n"
      "// (share/training/README.md) from " +
      std::to_string(runs) + " runs of " + std::to_string(cameras) +
      " cameras: not to be edited.\n"
      "#include <array>\n\n#include \"edgevo/confidence/motion_confidence.h\"\n\nnamespace edgevo::trust_table {\n\n"
      "/// What a test adds to the log odds of a wrong motion: weight (value - usual). The weight is at least 0, "
      "since\n"
      "/// all of them speak against the motion; `usual` is the mean of right motions.\n"
      "struct Term {\n  ConsistencyTest doubt;\n  const char* name;\n  const char* unit;\n"
      "  double weight, usual;\n};\n"
      "constexpr std::array<Term, kConsistencyTests> kTerms{{\n";
  for (size_t k = 0; k < kConsistencyTests; ++k) {
    const Description& d = kDescriptions[k];
    text += std::string("    {ConsistencyTest::") + d.constant + ", \"" + d.name + "\", \"" + d.unit + "\", " +
            fixed(fitted.sum.weights[k], 4) + ", " + fixed(fitted.sum.usual[k], 4) + "},\n";
  }
  return text + "}};\n/// Log odds of a wrong motion where all is as usual.\nconstexpr double kBias = " +
         fixed(fitted.sum.bias, 4) +
         ";\n\n/// Value of p_right below which a frame is doubtful.\nconstexpr double kDoubtfulBelow = " +
         fixed(fitted.bound, 4) + ";\n\n}  // namespace edgevo::trust_table\n";
}

}  // namespace edgevo::training
