// SPDX-License-Identifier: BSD-3-Clause
#include "display.h"

#include <X11/Xlib.h>  // defines macros that break nearly every other header

namespace edgevo {

// The connection stays open: a server without a window manager restarts when its last client leaves, and does
// not answer meanwhile.
bool has_display() {
  static Display* const display = XOpenDisplay(nullptr);
  return display != nullptr;
}

}  // namespace edgevo
