#pragma once

#include "observed/observe.h"

#include <filesystem>

namespace vcarve::observed {

/// Writes cameras.txt, images.txt and points3D.txt into a folder, which is made. Lengths are
/// rounded to a millionth, places in images to a tenth of a pixel.
void write_model(const std::filesystem::path& folder, const ObservedModel& model);

/// Writes truth.ply, its positions rounded alike.
void write_truth(const std::filesystem::path& folder, const ObservedScene& observed);

} // namespace vcarve::observed
