// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// cv::Mat headers for planes and views, without copying.
#include <opencv2/core.hpp>

#include "edgevo/edges/plane.h"

namespace edgevo {

/// Matrix header that shares the memory of a plane.
template <class T>
cv::Mat as_mat(Plane<T>& plane) {
  return cv::Mat(plane.height(), plane.width(), cv::DataType<T>::type, plane.row(0));
}
/// Matrix header that shares the memory of a constant plane.
template <class T>
const cv::Mat as_mat(const Plane<T>& plane) {
  return cv::Mat(plane.height(), plane.width(), cv::DataType<T>::type, const_cast<T*>(plane.row(0)));
}
/// Matrix header that shares the memory of a view.
template <class T>
const cv::Mat as_mat(const ImageView<T>& view) {
  return cv::Mat(view.height, view.width, cv::DataType<T>::type, const_cast<T*>(view.data),
                 view.stride * sizeof(T));
}

}  // namespace edgevo
