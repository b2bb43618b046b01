#pragma once
// Style, scripts and markup of the pages: the files of modules/report/assets, compiled in
// (share/cmake/EdgevoEmbed.cmake).

namespace edgevo::assets {

extern const char* const kPageCss;       ///< of every page
extern const char* const kPageJs;        ///< of every page: values under the pointer, pictures that enlarge
extern const char* const kMapViewHtml;   ///< the tools and the canvas of the map in 3D
extern const char* const kMapDataJs;     ///< reads its data; before the two below
extern const char* const kMapDrawingJs;  ///< draws points and lines
extern const char* const kMapViewJs;     ///< moves it, and picks
extern const char* const kCompareJs;     ///< sorts the table of `edgevo compare`

}  // namespace edgevo::assets
