#pragma once

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <ostream>
#include <string>

namespace vcarve {

/// Throws UsageError where the name of a report does not end with .html or .htm.
void require_page_name(const std::filesystem::path& path);

/// JSON as text that may stand between <script> and </script>: whatever strings it holds, none of
/// its characters begins a tag, ends the element or is a character reference. Bytes that are not
/// UTF-8 (in paths) are replaced.
std::string json_for_html(const nlohmann::ordered_json& json);

/// Writes a page that shows a run or a comparison: one HTML file with its style, its scripts and
/// three.js, which requests nothing from the network. Everything it shows comes from `record` and
/// `scene` (see page_scene.h). The record of a run is what --stats writes. The record of a
/// comparison has "program" and "command"; "comparison", which is what --json writes; and "rows",
/// those of the table, each with "title", "place", "better" ("lower", "higher" or null) and
/// "cells".
void write_page(std::ostream& out, const nlohmann::ordered_json& record,
                const nlohmann::ordered_json& scene);

} // namespace vcarve
