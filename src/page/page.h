#pragma once

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <ostream>
#include <string>

namespace vcarve {

/// Throws UsageError if the name of a report does not end with .html or .htm.
void require_page_name(const std::filesystem::path& path);

/// Returns JSON as text that is safe between <script> and </script>: no string in it begins a tag,
/// ends the element or is a character reference. Replaces bytes that are not UTF-8 (in paths).
std::string json_for_html(const nlohmann::ordered_json& json);

/// Writes the page of a run or a comparison: one HTML file with styles, scripts and three.js. It
/// requests nothing from the network. All data are in `record` and `scene` (see page_scene.h). The
/// record of a run is the output of --stats. The record of a comparison has "program", "command",
/// "comparison" (the output of --json) and "rows". A row of the table has "title", "place",
/// "better" ("lower", "higher" or null) and "cells".
void write_page(std::ostream& out, const nlohmann::ordered_json& record,
                const nlohmann::ordered_json& scene);

} // namespace vcarve
