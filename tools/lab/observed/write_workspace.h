#pragma once

#include "vcarve/scene.h"

#include <filesystem>

namespace vcarve::observed {

/// Writes a workspace as stereo_fusion leaves it: fused.ply, fused.ply.vis, and in sparse the model
/// as text, without points, its images in no order of their ids. The scene must have normals.
/// Coordinates in fused.ply are multiples of `step`, or as near as floats come where that is 0.
void write_workspace(const std::filesystem::path& folder, const Scene& scene, double step);

} // namespace vcarve::observed
