// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Colours of charts by name. In a page they adapt to light, dark and print (assets/page.css); in a separate
// SVG file they are the values after the comma.

namespace edgevo::palette {

/// Colour of the ground truth.
constexpr const char* kInk = "var(--ink,#222222)";
/// Colour of the estimate.
constexpr const char* kBlue = "var(--blue,#1f5fbf)";
/// Lighter blue, for areas.
constexpr const char* kPaleBlue = "var(--pale-blue,#c3d3ec)";
/// Colour of state TRACKING.
constexpr const char* kGreen = "var(--green,#2e9e5b)";
/// Colour of state DEGRADED.
constexpr const char* kAmber = "var(--amber,#e0a100)";
/// Colour of state LOST.
constexpr const char* kRed = "var(--red,#d0342c)";
/// Colour for one of several curves.
constexpr const char* kPurple = "var(--purple,#a0408a)";
/// Colour for one of several curves.
constexpr const char* kOrange = "var(--orange,#d06a2c)";
/// Colour for one of several curves.
constexpr const char* kTeal = "var(--teal,#2aa3b8)";
/// Colour for one of several curves.
constexpr const char* kViolet = "var(--violet,#7b5fc4)";
/// Colour for one of several curves.
constexpr const char* kSlate = "var(--slate,#5b6b80)";
/// Colour for one of several curves.
constexpr const char* kPink = "var(--pink,#b8426a)";
/// Colour for one of several curves.
constexpr const char* kOlive = "var(--olive,#8c9a3a)";
/// Colour of state BOOTSTRAPPING, and of backgrounds.
constexpr const char* kGray = "var(--gray,#8a94a6)";

}  // namespace edgevo::palette
