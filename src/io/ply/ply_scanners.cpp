#include "io/ply/ply_scanners.h"

#include <algorithm>

namespace vcarve {

namespace {

/// As the benchmark IQmulus/TerraMobilita has them, and as words.
constexpr std::array<PlyNames, 2> kOfVertices = {
    {{"x_origin", "y_origin", "z_origin"}, {"scanner_x", "scanner_y", "scanner_z"}}};

} // namespace

int count_names(const PlyElement& element, const PlyNames& names)
{
    return static_cast<int>(std::ranges::count_if(names, [&](std::string_view name) {
        return std::ranges::any_of(element.properties, [&](const PlyProperty& property) {
            return property.name == name && !property.length_type;
        });
    }));
}

const PlyNames& names_of_scanner(const PlyElement& vertices)
{
    return *std::ranges::max_element(
        kOfVertices, {}, [&](const PlyNames& names) { return count_names(vertices, names); });
}

PlyScanners scanners_in(const PlyHeader& header)
{
    const PlyElement* const vertices = header.find("vertex");
    if (vertices != nullptr && count_names(*vertices, names_of_scanner(*vertices)) > 0) {
        return PlyScanners::each;
    }
    const PlyElement* const camera = header.find(kPlyCamera);
    const bool has_place = camera != nullptr && count_names(*camera, kPlyCameraPlace) > 0;
    return has_place ? PlyScanners::one_for_all : PlyScanners::none;
}

} // namespace vcarve
