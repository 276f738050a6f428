#pragma once

#include "model/scene_points.h"
#include "vcarve/scene.h"

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

namespace vcarve::bench {

/// The shape of a sample model: a closed surface seen from all around, terrain seen from the air, a
/// hall with columns seen from inside, or the closed surface with wide tracks. The views of wide
/// tracks are far apart, as in unordered photographs, and outliers are on rays.
enum class Shape { surface, terrain, hall, wide };

/// The shape with this name. Throws UsageError if the name is unknown.
Shape shape_named(std::string_view name);
const char* name_of(Shape shape);

/// Parameters of a sample model.
struct SampleKind {
    Shape shape = Shape::surface;
    double noise_along = 0.25;  ///< standard deviation along the mean ray, in point spacings
    double noise_across = 0.25; ///< the same in both directions across it
    double outliers = 0.02;     ///< share of points at random positions, with rays of others
    bool clustered = false;     ///< whether the density varies, by a factor of up to 256
    std::size_t views = 0;      ///< 0 selects the default number

    /// `views`, or by default 300 for a million points or more, else 100.
    std::size_t views_of(std::size_t points) const;
};

/// The name of a sample lists all values that are not defaults: "surface", or
/// "hall_along0.5_across0.25_outliers0.1_clustered_1000views".
std::string name_of(const SampleKind& kind);

/// Points of a sample are made in blocks of this size, each with another seed.
inline constexpr std::size_t kSampleBlock = 16384;

/// A scene like those of COLMAP, the same on every machine. Points are on the shape, plus noise.
/// Each is seen by 2 to 8 unoccluded views (3.7 on average) that face it; they are near each other
/// except for wide shapes. Outliers are anywhere in the box, or for wide shapes shifted by a
/// quarter of the radius along a ray. next() makes points on all threads, in whole blocks; it
/// returns no points if `most` is below a block. A smaller last block counts as a whole one.
/// Cost: half a minute for five million points on two cores, and twice the memory of a part.
std::unique_ptr<SceneParts> sample_parts(const SampleKind& kind, std::size_t points);

/// All points at once. Cost: 200 bytes per point.
Scene make_sample_scene(const SampleKind& kind, std::size_t points);

/// Creates `folder` and writes cameras.bin, images.bin and points3D.bin. As in COLMAP's models,
/// images list their 2D points, and tracks refer to them. All views must use sample_camera().
/// Cost: memory for a quarter of a million points and their 2D points, independent of the total;
/// one second per million points to read them again.
void write_colmap_model(const std::filesystem::path& folder, SceneParts& parts);

/// The same for a scene in memory.
void write_colmap_model(const std::filesystem::path& folder, const Scene& scene);

} // namespace vcarve::bench
