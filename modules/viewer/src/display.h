#pragma once

namespace edgevo {

/// An X display answers. GTK, below MRPT's windows, would end the program where it does not.
bool has_display();

}  // namespace edgevo
