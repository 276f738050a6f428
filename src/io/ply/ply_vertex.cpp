#include "io/ply/ply_vertex.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vcarve {

namespace {

/// The names of the IQmulus/TerraMobilita benchmark, and descriptive names.
constexpr std::array<PlyNames, 2> kScannersOfVertices = {
    {{"x_origin", "y_origin", "z_origin"}, {"scanner_x", "scanner_y", "scanner_z"}}};

constexpr PlyNames kColorNames = {"red", "green", "blue"};
constexpr PlyNames kHarmonics = {"f_dc_0", "f_dc_1", "f_dc_2"};
constexpr std::string_view kImages = "view_indices";

/// Converts a constant term of spherical harmonics to a color from 0 to 1.
double color_of_harmonic(double term)
{
    constexpr double kConstant = 0.28209479177387814; // 1 / (2 sqrt(pi))
    return 0.5 + kConstant * term;
}

/// Appends the images of the list to `images`.
void take_images(PlyData& data, const PlyProperty& list, std::vector<std::uint32_t>& images)
{
    constexpr double kMost = 4294967294.0;
    for (std::size_t n = data.list_length(list); n > 0; --n) {
        const double image = data.number(list.type);
        if (!(image >= 0.0 && image <= kMost) || image != std::floor(image)) {
            throw BadPlyEntry{fmt::format("its list {} has image {}, expected 0 to 4294967294",
                                          list.name, image)};
        }
        images.push_back(static_cast<std::uint32_t>(image));
    }
}

/// Converts a color of any number type to a range from 0 to 255.
std::uint8_t channel(double value, PlyType type)
{
    if (!is_integer(type)) value *= 255.0;
    if (type == PlyType::uint16) value /= 257.0;
    return static_cast<std::uint8_t>(std::isnan(value) ? 0.0
                                                       : std::round(std::clamp(value, 0.0, 255.0)));
}

} // namespace

PlyVertexLayout::PlyVertexLayout(const PlyElement& vertices)
    : are_splats_(count_names(vertices, kHarmonics) == 3),
      colors_are_harmonics_(are_splats_ && count_names(vertices, kColorNames) < 3)
{
    const PlyNames& scanner = names_of_scanner(vertices);
    const PlyNames& color = colors_are_harmonics_ ? kHarmonics : kColorNames;
    const std::array<std::string_view, kNowhere> names{
        "x",      "y",        "z",        "nx",       "ny",      "nz",      color[0],  color[1],
        color[2], scanner[0], scanner[1], scanner[2], "opacity", "scale_0", "scale_1", "scale_2"};
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

bool PlyVertexLayout::has_images() const
{
    return std::ranges::any_of(properties_, [](const Property& property) {
        return property.in_file.name == kImages && property.in_file.length_type;
    });
}

PlyVertex PlyVertexLayout::read(PlyData& data, std::vector<std::uint32_t>* images) const
{
    std::array<double, kNowhere + 1> values{};
    std::fill_n(&values[kAxes], 3, -std::numeric_limits<double>::infinity());
    for (const Property& property : properties_) {
        if (property.in_file.length_type) {
            const bool are_images = images != nullptr && property.in_file.name == kImages;
            are_images ? take_images(data, property.in_file, *images) : data.skip(property.in_file);
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
        const double value = values[kColor + i];
        vertex.color[i] = colors_are_harmonics_
                              ? channel(color_of_harmonic(value), PlyType::float64)
                              : channel(value, channel_types_[i]);
    }
    const double longest = std::max({values[kAxes], values[kAxes + 1], values[kAxes + 2]});
    vertex.splat = {static_cast<float>(values[kOpacity]), static_cast<float>(longest)};
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
