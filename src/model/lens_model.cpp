#include "model/lens_model.h"

#include <algorithm>
#include <array>

namespace vcarve {
namespace {

using enum LensGeometry;

constexpr std::array<LensModel, 20> kLenses{{
    {0, "SIMPLE_PINHOLE", 3, 1, perspective, false},
    {1, "PINHOLE", 4, 2, perspective, false},
    {2, "SIMPLE_RADIAL", 4, 1, perspective, true},
    {3, "RADIAL", 5, 1, perspective, true},
    {4, "OPENCV", 8, 2, perspective, true},
    {5, "OPENCV_FISHEYE", 8, 2, fisheye, true},
    {6, "FULL_OPENCV", 12, 2, perspective, true},
    {7, "FOV", 5, 2, fov, false},
    {8, "SIMPLE_RADIAL_FISHEYE", 4, 1, fisheye, true},
    {9, "RADIAL_FISHEYE", 5, 1, fisheye, true},
    {10, "THIN_PRISM_FISHEYE", 12, 2, fisheye, true},
    {11, "RAD_TAN_THIN_PRISM_FISHEYE", 16, 2, fisheye, true},
    {12, "SIMPLE_DIVISION", 4, 1, division, false},
    {13, "DIVISION", 5, 2, division, false},
    {14, "SIMPLE_FISHEYE", 3, 1, fisheye, false},
    {15, "FISHEYE", 4, 2, fisheye, false},
    {16, "EUCM", 6, 2, unified, false},
    {17, "EQUIRECTANGULAR", 2, 0, equirectangular, false},
    {18, "SKEWED_PINHOLE", 5, 2, perspective, false},
    {19, "BROWN_CONRADY", 8, 1, perspective, true},
}};

constexpr bool numbered_by_place()
{
    for (std::size_t i = 0; i < kLenses.size(); ++i) {
        if (kLenses[i].number != static_cast<int>(i)) return false;
    }
    return true;
}
static_assert(numbered_by_place());

} // namespace

const LensModel* lens_model(int number)
{
    if (number < 0 || static_cast<std::size_t>(number) >= kLenses.size()) return nullptr;
    return &kLenses[static_cast<std::size_t>(number)];
}

const LensModel* lens_model(std::string_view name)
{
    const auto found = std::ranges::find(kLenses, name, &LensModel::name);
    return found == kLenses.end() ? nullptr : &*found;
}

} // namespace vcarve
