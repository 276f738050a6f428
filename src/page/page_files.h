#pragma once

#include <string_view>

namespace vcarve {

/// The files of a page, which CMake embeds (cmake/embed_files.cmake).
extern const std::string_view kPageHtml;
extern const std::string_view kPageCss;
extern const std::string_view kPageJs;
extern const std::string_view kViewJs;
extern const std::string_view kDistanceJs;
extern const std::string_view kReportJs;
extern const std::string_view kComparisonJs;
extern const std::string_view kThreeJs;
extern const std::string_view kThreeLicence;

} // namespace vcarve
