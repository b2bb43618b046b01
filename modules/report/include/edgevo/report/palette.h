#pragma once
// The colours of charts by name: in a page they follow light, dark and print (assets/page.css), in an SVG
// file of its own they are the values after the comma.

namespace edgevo::palette {

constexpr const char* kInk = "var(--ink,#222222)";    ///< ground truth
constexpr const char* kBlue = "var(--blue,#1f5fbf)";  ///< the estimate
constexpr const char* kPaleBlue = "var(--pale-blue,#c3d3ec)";  ///< a lighter blue, for areas
constexpr const char* kGreen = "var(--green,#2e9e5b)";  ///< TRACKING
constexpr const char* kAmber = "var(--amber,#e0a100)";  ///< DEGRADED
constexpr const char* kRed = "var(--red,#d0342c)";  ///< LOST
constexpr const char* kPurple = "var(--purple,#a0408a)";  ///< one of several curves
constexpr const char* kOrange = "var(--orange,#d06a2c)";  ///< one of several curves
constexpr const char* kTeal = "var(--teal,#2aa3b8)";  ///< one of several curves
constexpr const char* kViolet = "var(--violet,#7b5fc4)";  ///< one of several curves
constexpr const char* kSlate = "var(--slate,#5b6b80)";  ///< one of several curves
constexpr const char* kPink = "var(--pink,#b8426a)";  ///< one of several curves
constexpr const char* kOlive = "var(--olive,#8c9a3a)";  ///< one of several curves
constexpr const char* kGray = "var(--gray,#8a94a6)";  ///< BOOTSTRAPPING, and backgrounds

}  // namespace edgevo::palette
