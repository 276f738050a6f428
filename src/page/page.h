#pragma once

#include <nlohmann/json.hpp>

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

/// Writes a page that shows a run: one file of HTML with its style, its scripts and three.js in it,
/// which asks the network for nothing. Its script reads everything it shows from `record` (what
/// --stats writes) and `scene` (see page_scene.h).
void write_page(std::ostream& out, const nlohmann::ordered_json& record,
                const nlohmann::ordered_json& scene);

/// Writes a page that shows a comparison, in the same way. `record` has "program" and "command";
/// "comparison", which is what --json writes; and "rows", those of the table, each with "title",
/// "place", "better" ("lower", "higher" or null) and "cells". `scene` is comparison_scene().
void write_comparison_page(std::ostream& out, const nlohmann::ordered_json& record,
                           const nlohmann::ordered_json& scene);

} // namespace vcarve
