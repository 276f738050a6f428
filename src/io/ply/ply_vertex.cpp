#include "io/ply/ply_vertex.h"

#include <algorithm>
#include <cmath>

namespace vcarve {

namespace {

/// As the benchmark IQmulus/TerraMobilita has them, and as words.
constexpr std::array<PlyNames, 2> kScannersOfVertices = {
    {{"x_origin", "y_origin", "z_origin"}, {"scanner_x", "scanner_y", "scanner_z"}}};

/// A colour of any number type as one of 0 to 255.
std::uint8_t channel(double value, PlyType type)
{
    if (!is_integer(type)) value *= 255.0;
    if (type == PlyType::uint16) value /= 257.0;
    return static_cast<std::uint8_t>(std::isnan(value) ? 0.0
                                                       : std::round(std::clamp(value, 0.0, 255.0)));
}

} // namespace

PlyVertexLayout::PlyVertexLayout(const PlyElement& vertices)
{
    const PlyNames& scanner = names_of_scanner(vertices);
    const std::array<std::string_view, kNowhere> names{"x",    "y",        "z",        "nx",
                                                       "ny",   "nz",       "red",      "green",
                                                       "blue", scanner[0], scanner[1], scanner[2]};
    constexpr std::string_view kDiffuse = "diffuse_";
    for (const PlyProperty& property : vertices.properties) {
        std::string_view name = property.name;
        if (name.starts_with(kDiffuse)) name.remove_prefix(kDiffuse.size());
        const auto* const found =
            property.length_type ? names.end() : std::ranges::find(names, name);
        const auto slot = static_cast<std::size_t>(found - names.begin());
        properties_.push_back({property, slot});
        if (slot >= kColor && slot < kColor + 3) channel_types_[slot - kColor] = property.type;
    }
}

bool PlyVertexLayout::has_three_from(std::size_t first) const
{
    const auto has = [&](std::size_t slot) {
        return std::ranges::find(properties_, slot, &Property::slot) != properties_.end();
    };
    return has(first) && has(first + 1) && has(first + 2);
}

PlyVertex PlyVertexLayout::read(PlyData& data) const
{
    std::array<double, kNowhere + 1> values{};
    for (const Property& property : properties_) {
        if (property.in_file.length_type) {
            data.skip(property.in_file);
        } else {
            values[property.slot] = data.number(property.in_file.type);
        }
    }
    const auto three = [&](std::size_t first) {
        return Eigen::Vector3d(values[first], values[first + 1], values[first + 2]);
    };
    PlyVertex vertex{.position = three(kPosition),
                     .scanner = three(kScanner),
                     .normal = three(kNormal).cast<float>()};
    for (std::size_t i = 0; i < vertex.color.size(); ++i) {
        vertex.color[i] = channel(values[kColor + i], channel_types_[i]);
    }
    return vertex;
}

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
    return *std::ranges::max_element(kScannersOfVertices, {}, [&](const PlyNames& names) {
        return count_names(vertices, names);
    });
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
