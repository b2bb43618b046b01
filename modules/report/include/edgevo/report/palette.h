#pragma once
// The colours of charts by name: in a page they follow light, dark and print (assets/page.css), in an SVG
// file of its own they are the values after the comma.

namespace edgevo::palette {

constexpr const char* kInk = "var(--ink,#222222)";    ///< ground truth
constexpr const char* kBlue = "var(--blue,#1f5fbf)";  ///< the estimate
constexpr const char* kPaleBlue = "var(--pale-blue,#c3d3ec)";
constexpr const char* kGreen = "var(--green,#2e9e5b)";
constexpr const char* kAmber = "var(--amber,#e0a100)";
constexpr const char* kRed = "var(--red,#d0342c)";
constexpr const char* kPurple = "var(--purple,#a0408a)";
constexpr const char* kOrange = "var(--orange,#d06a2c)";
constexpr const char* kTeal = "var(--teal,#2aa3b8)";
constexpr const char* kViolet = "var(--violet,#7b5fc4)";
constexpr const char* kSlate = "var(--slate,#5b6b80)";
constexpr const char* kPink = "var(--pink,#b8426a)";
constexpr const char* kOlive = "var(--olive,#8c9a3a)";
constexpr const char* kGray = "var(--gray,#8a94a6)";

}  // namespace edgevo::palette
