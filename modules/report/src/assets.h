// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Style, scripts and markup of the pages: the files of modules/report/assets, compiled in
// (share/cmake/EdgevoEmbed.cmake).

namespace edgevo::assets {

/// Style sheet of every page.
extern const char* const kPageCss;
/// Script of every page: values under the pointer, pictures that enlarge.
extern const char* const kPageJs;
/// Toolbar and canvas of the map in 3D.
extern const char* const kMapViewHtml;
/// Reads the data of the map in 3D; must come before the two scripts below.
extern const char* const kMapDataJs;
/// Draws points and lines of the map in 3D.
extern const char* const kMapDrawingJs;
/// Moves the map in 3D and picks points.
extern const char* const kMapViewJs;
/// Sorts the table of `edgevo compare`.
extern const char* const kCompareJs;

}  // namespace edgevo::assets
