#include "io/ply/ply_vertex.h"

#include <algorithm>
#include <cmath>
#include <string_view>

namespace vcarve {

namespace {

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
    for (const PlyProperty& property : vertices.properties) {
        const Slot slot = slot_of(property, scanner);
        properties_.push_back({property, slot});
        if (slot >= Slot::red && slot <= Slot::blue) {
            channel_types_[static_cast<std::size_t>(slot) - static_cast<std::size_t>(Slot::red)] =
                property.type;
        }
    }
}

PlyVertexLayout::Slot PlyVertexLayout::slot_of(const PlyProperty& property, const PlyNames& scanner)
{
    if (property.length_type) return Slot::none;
    const auto* const place = std::ranges::find(scanner, property.name);
    if (place != scanner.end()) {
        return static_cast<Slot>(static_cast<int>(Slot::scanner_x) + (place - scanner.begin()));
    }
    constexpr std::array<std::string_view, 9> kNames{"x",  "y",   "z",     "nx",  "ny",
                                                     "nz", "red", "green", "blue"};
    constexpr std::string_view kDiffuse = "diffuse_";
    std::string_view name = property.name;
    if (name.starts_with(kDiffuse)) name.remove_prefix(kDiffuse.size());
    const auto* const found = std::ranges::find(kNames, name);
    return found == kNames.end() ? Slot::none : static_cast<Slot>(found - kNames.begin());
}

bool PlyVertexLayout::has_three_from(Slot first) const
{
    const auto has = [&](int i) {
        const auto slot = static_cast<Slot>(static_cast<int>(first) + i);
        return std::ranges::find(properties_, slot, &Property::slot) != properties_.end();
    };
    return has(0) && has(1) && has(2);
}

PlyVertex PlyVertexLayout::vertex_of(const Values& values) const
{
    PlyVertex vertex;
    vertex.position = {values[0], values[1], values[2]};
    vertex.scanner = {values[9], values[10], values[11]};
    vertex.normal = Eigen::Vector3d(values[3], values[4], values[5]).cast<float>();
    for (std::size_t i = 0; i < vertex.color.size(); ++i) {
        vertex.color[i] = channel(values[6 + i], channel_types_[i]);
    }
    return vertex;
}

} // namespace vcarve
