// SPDX-License-Identifier: BSD-3-Clause
#include "version.h"

#include "edgevo_build_info.h"

namespace edgevo::app {
namespace {

using namespace build_info;

std::string with(const char* name, const char* version) { return std::string(name) + " " + version; }

}  // namespace

std::string version() { return std::string(kVersion) + " " + kGitHash + " " + kBuildType; }

std::string version_text() {
  return with("edgevo", kVersion) + "\ncommit " + kGitHash + ", " + kBuildType + ", " + kCompiler + "\n" +
         with("MRPT", kMrpt) + ", " + with("OpenCV", kOpenCv) + ", " + with("Ceres", kCeres) + ", " +
         with("OctoMap", kOctomap) + ", " + with("Eigen", kEigen);
}

}  // namespace edgevo::app
