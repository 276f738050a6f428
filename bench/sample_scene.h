#pragma once

#include "vcarve/scene.h"

#include <cstddef>
#include <filesystem>
#include <string_view>

namespace vcarve::bench {

/// What a sample model shows.
enum class Shape { surface, terrain };

/// "surface" or "terrain"; throws UsageError for another word.
Shape shape_named(std::string_view name);
const char* name_of(Shape shape);

/// As many views as a model of so many points would have: 300 from a million points on, else 100.
std::size_t usual_views(std::size_t points);

/// A scene as COLMAP would reconstruct it, the same on every machine: points on the shape, off it
/// by a quarter of their spacing, each seen by 2 to 8 nearby views (3.7 on average) that truly face
/// it, nothing in between; one in fifty lies anywhere in the box, with the sights of others.
/// Cost: 100 bytes a point; five million points take half a minute on two cores.
Scene make_sample_scene(Shape shape, std::size_t points, std::size_t views);

/// Writes cameras.bin, images.bin and points3D.bin into `folder`, which is made; each image lists
/// its 2D points, and tracks name them, as COLMAP has it. All views must be of sample_camera().
void write_colmap_model(const std::filesystem::path& folder, const Scene& scene);

} // namespace vcarve::bench
