#pragma once

#include "observed/observe.h"
#include "vcarve/scene.h"

#include <filesystem>

namespace vcarve::observed {

/// Writes cameras.txt, images.txt and points3D.txt into a folder, which is made. Lengths are
/// rounded to a millionth, places in images to a tenth of a pixel.
void write_model(const std::filesystem::path& folder, const ObservedModel& model);

/// Writes truth.ply, its positions rounded alike.
void write_truth(const std::filesystem::path& folder, const ObservedScene& observed);

/// Writes a workspace as stereo_fusion leaves it: fused.ply, fused.ply.vis, and in sparse the model
/// as text, without points, its images in no order of their ids. The scene must have normals.
/// Coordinates in fused.ply are multiples of `step`, or as near as floats come where that is 0.
void write_workspace(const std::filesystem::path& folder, const Scene& scene, double step);

} // namespace vcarve::observed
