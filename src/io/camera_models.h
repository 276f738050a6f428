#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

namespace vcarve {

/// One of COLMAP's camera models. Its number in binary files is its place in COLMAP's list.
struct CameraModel {
    std::string_view name; ///< as in cameras.txt
    std::size_t num_params = 0;
};

/// The model with this number, or none where COLMAP (up to 4.2) has no such model.
std::optional<CameraModel> camera_model(int number);

/// The number of the model with this name, or none.
std::optional<int> camera_model_number(std::string_view name);

} // namespace vcarve
