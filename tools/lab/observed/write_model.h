#pragma once

#include "observed/observe.h"
#include "vcarve/scene.h"

#include <filesystem>

namespace vcarve::observed {

/// Creates a folder and writes cameras.txt, images.txt and points3D.txt. Lengths are rounded to
/// 1e-6, image positions to a tenth of a pixel.
void write_model(const std::filesystem::path& folder, const ObservedModel& model);

/// Writes truth.ply, with positions rounded in the same way.
void write_truth(const std::filesystem::path& folder, const ObservedScene& observed);

/// Writes a workspace like stereo_fusion: fused.ply, fused.ply.vis, and the text model in sparse,
/// without points and with images not sorted by id. The scene must have normals. Coordinates in
/// fused.ply are rounded to multiples of `step`; 0 disables this.
void write_workspace(const std::filesystem::path& folder, const Scene& scene, double step);

} // namespace vcarve::observed
