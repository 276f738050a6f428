#pragma once

#include <nlohmann/json.hpp>

#include <string>

namespace vcarve {

/// The JSON in the script element `name` of a page.
inline nlohmann::ordered_json part_of(const std::string& page, const std::string& name)
{
    const std::string begin = "<script type=\"application/json\" id=\"" + name + "\">";
    const std::size_t from = page.find(begin) + begin.size();
    return nlohmann::ordered_json::parse(page.substr(from, page.find("</script>", from) - from));
}

} // namespace vcarve
