#include "io/camera_models.h"

#include <algorithm>
#include <array>

namespace vcarve {

namespace {

constexpr std::array<CameraModel, 18> kModels{{
    {"SIMPLE_PINHOLE", 3},
    {"PINHOLE", 4},
    {"SIMPLE_RADIAL", 4},
    {"RADIAL", 5},
    {"OPENCV", 8},
    {"OPENCV_FISHEYE", 8},
    {"FULL_OPENCV", 12},
    {"FOV", 5},
    {"SIMPLE_RADIAL_FISHEYE", 4},
    {"RADIAL_FISHEYE", 5},
    {"THIN_PRISM_FISHEYE", 12},
    {"RAD_TAN_THIN_PRISM_FISHEYE", 16},
    {"SIMPLE_DIVISION", 4},
    {"DIVISION", 5},
    {"SIMPLE_FISHEYE", 3},
    {"FISHEYE", 4},
    {"EUCM", 6},
    {"EQUIRECTANGULAR", 2},
}};

} // namespace

std::optional<CameraModel> camera_model(int number)
{
    if (number < 0 || static_cast<std::size_t>(number) >= kModels.size()) return std::nullopt;
    return kModels[static_cast<std::size_t>(number)];
}

std::optional<int> camera_model_number(std::string_view name)
{
    const auto found = std::find_if(kModels.begin(), kModels.end(),
                                    [&](const CameraModel& model) { return model.name == name; });
    if (found == kModels.end()) return std::nullopt;
    return static_cast<int>(found - kModels.begin());
}

} // namespace vcarve
