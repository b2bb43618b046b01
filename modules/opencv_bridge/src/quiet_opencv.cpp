// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/opencv_bridge/quiet_opencv.h"

#include <opencv2/core/utils/logger.hpp>

namespace edgevo {

namespace logging = cv::utils::logging;

QuietOpenCv::QuietOpenCv() : before_(logging::setLogLevel(logging::LOG_LEVEL_SILENT)) {}
QuietOpenCv::~QuietOpenCv() { logging::setLogLevel(logging::LogLevel(before_)); }

}  // namespace edgevo
