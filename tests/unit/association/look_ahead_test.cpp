#include "edgevo/association/look_ahead.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/plane_scene.h"

namespace edgevo {
namespace {

// It asks for memory only; an address sanitizer sees it read beyond an image.
TEST(LookAhead, TakesMorePlacesThanItHoldsAnywhere) {
  const test::PlaneScene scene;
  const auto frame = scene.pyramid(SE3());
  const auto blank = PyramidBuilder(scene.camera, EdgeParams()).build(test::make_image(320, 240, [](double, double) { return 90; }));
  const AssociationParams params;
  LookAhead look_ahead(params);
  for (double y : {-1e9, -3.0, 0.0, 0.4, 120.0, 239.0, 239.4, 1e9})
    for (double x : {-1e9, -3.0, 0.0, 0.4, 160.0, 319.0, 319.4, 1e9, std::nan("")}) {
      look_ahead.add(*frame, {x, y});
      look_ahead.add(*blank, {x, y});
    }
  look_ahead.run();
  look_ahead.run();
}

}  // namespace
}  // namespace edgevo
