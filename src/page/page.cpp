#include "page/page.h"

#include "base/text.h"
#include "page/page_files.h"
#include "vcarve/error.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <map>
#include <string_view>

namespace vcarve {

namespace {

/// Writes a text, replacing each {{NAME}} by its part. Parts are not searched for names.
void fill(std::ostream& out, std::string_view text,
          const std::map<std::string_view, std::string_view>& parts)
{
    while (true) {
        const std::size_t begin = text.find("{{");
        out << text.substr(0, begin);
        if (begin == std::string_view::npos) return;
        const std::size_t end = text.find("}}", begin);
        out << parts.at(text.substr(begin + 2, end - begin - 2));
        text.remove_prefix(end + 2);
    }
}

} // namespace

void require_page_name(const std::filesystem::path& path)
{
    const std::string end = lower_case_end(path);
    if (end == ".html" || end == ".htm") return;
    throw UsageError(fmt::format("cannot write {}: the name of a report must end with .html or "
                                 ".htm",
                                 path.string()));
}

std::string json_for_html(const nlohmann::ordered_json& json)
{
    std::string escaped;
    for (const char letter :
         json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace)) {
        // These characters occur only in strings, where JSON allows escapes for any character.
        if (letter == '<' || letter == '>' || letter == '&') {
            escaped += fmt::format("\\u{:04x}", static_cast<unsigned>(letter));
        } else {
            escaped += letter;
        }
    }
    return escaped;
}

void write_page(std::ostream& out, const nlohmann::ordered_json& record,
                const nlohmann::ordered_json& scene)
{
    const std::string record_text = json_for_html(record);
    const std::string scene_text = json_for_html(scene);
    fill(out, kPageHtml,
         {{"style", kPageCss},
          {"three_licence", kThreeLicence},
          {"record", record_text},
          {"scene", scene_text},
          {"three", kThreeJs},
          {"view", kViewJs},
          {"distance", kDistanceJs},
          {"report", kReportJs},
          {"comparison", kComparisonJs},
          {"page", kPageJs}});
}

} // namespace vcarve
