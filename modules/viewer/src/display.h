// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace edgevo {

/// Whether an X display answers. Without one, GTK (used by MRPT's windows) would end the program.
bool has_display();

}  // namespace edgevo
