// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Parts of calibration files in YAML.
#include <string>
#include <vector>

namespace edgevo {

/// The fewest digits that are read back as the same double, with a decimal point, without which OpenCV reads
/// an integer.
std::string yaml_real(double value);

/// "[1.0, 2.0]"
std::string yaml_list(const std::vector<double>& values);

/// Each line as a comment.
std::string yaml_comment(const std::string& comment);

}  // namespace edgevo
