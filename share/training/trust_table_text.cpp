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
    {"kMotion", "motion", "share of length / 0.25 and median depths / 0.02, or degrees / 3"},
    {"kFocalLength", "focal_length", "degrees / 3"},
    {"kCornerAgreement", "corner_agreement", "2 x share of the corners"},
    {"kNoCrossCheck", "no_witness", "1: the motion cannot be checked"},
    {"kTurn", "turn", "median depths / 0.02 and share of length / 0.25"},
    {"kStep", "step", "log ratio to the usual"},
    {"kResidual", "residual", "log of pixels / 0.6"},
    {"kAdjustment", "adjustment", "log of squared sigmas"},
    {"kStarvation", "starvation", "shares"},
    {"kImage", "image", "blur / 0.1 + saturated share / 0.3, above the usual"},
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
      "/// What a doubt adds to the sum, per unit of the doubt: at least 0, since all of them speak against "
      "the\n"
      "/// motion. 0: the other doubts say as much.\n"
      "struct Term {\n  ConsistencyTest doubt;\n  const char* name;\n  const char* unit;\n  double weight;\n};\n"
      "constexpr std::array<Term, kConsistencyTests> kTerms{{\n";
  for (size_t k = 0; k < kConsistencyTests; ++k) {
    const Description& d = kDescriptions[k];
    text += std::string("    {ConsistencyTest::") + d.constant + ", \"" + d.name + "\", \"" + d.unit + "\"," +
            (k == 0 ? "\n     " : " ") + fixed(fitted.sum.weights[k], 4) + "},\n";
  }
  text +=
      "}};\n\n/// Probability of a right motion at a sum of weighted doubts; linear in between, constant "
      "outside.\n"
      "constexpr std::array<CalibrationKnot, " +
      std::to_string(fitted.knots.size()) + "> kKnots{{\n";
  for (const Knot& knot : fitted.knots)
    text += "    {" + fixed(knot.sum, 4) + ", " + fixed(knot.p_right, 4) + "},\n";
  return text +
         "}};\n\n/// Value of p_right below which a frame is doubtful.\nconstexpr double kDoubtfulBelow = " +
         fixed(fitted.bound, 4) + ";\n\n}  // namespace edgevo::trust_table\n";
}

}  // namespace edgevo::training
