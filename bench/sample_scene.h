#pragma once

#include "model/scene_points.h"
#include "vcarve/scene.h"

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

namespace vcarve::bench {

/// What a sample model shows: a closed surface seen from around, a ground seen from the air, a hall
/// with columns seen from inside, or the closed surface seen by views of a track that stand far
/// apart, as in unordered photographs, with outliers that lie along the sights.
enum class Shape { surface, terrain, hall, wide };

/// By its name; throws UsageError for another word.
Shape shape_named(std::string_view name);
const char* name_of(Shape shape);

/// What a sample model is like.
struct SampleKind {
    Shape shape = Shape::surface;
    double noise_along = 0.25;  ///< along the mean sight, in spacings of the points (deviation)
    double noise_across = 0.25; ///< in the two directions across it
    double outliers = 0.02;     ///< share of the points that lie anywhere, with sights of others
    bool clustered = false;     ///< up to 256 times denser here than there
    std::size_t views = 0;      ///< 0: as many as usual

    /// As many as a model of so many points would have: 300 from a million points on, else 100.
    std::size_t views_of(std::size_t points) const;
};

/// "surface", or "hall_along0.5_across0.25_outliers0.1_clustered_1000views": names what is not as
/// usual.
std::string name_of(const SampleKind& kind);

/// Points of a sample are made in blocks of so many, each from a seed of its own.
inline constexpr std::size_t kSampleBlock = 16384;

/// A scene as COLMAP would reconstruct it, the same on every machine: points on the shape, off it
/// by the noise, each seen by 2 to 8 nearby views (3.7 on average; of a wide shape any) that truly
/// face it, nothing in between; outliers lie anywhere in the box, those of a wide shape a quarter
/// of its radius along a sight from where they should be. Its points are made as they are asked
/// for, on all threads: next() gives whole blocks, and none where not even one is asked for; a last
/// one that is smaller counts for one. Cost: five million points take half a minute on two cores;
/// memory for the points of a part twice.
std::unique_ptr<SceneParts> sample_parts(const SampleKind& kind, std::size_t points);

/// All points of it at once. Cost: 200 bytes a point.
Scene make_sample_scene(const SampleKind& kind, std::size_t points);

/// Writes cameras.bin, images.bin and points3D.bin into `folder`, which is made; each image lists
/// its 2D points, and tracks name them, as COLMAP has it. All views must be of sample_camera().
/// Cost: memory for parts of a quarter of a million points and for their 2D points, however many
/// points there are in all; a second to read again what was written of a million.
void write_colmap_model(const std::filesystem::path& folder, SceneParts& parts);

/// The same of a scene that is in memory.
void write_colmap_model(const std::filesystem::path& folder, const Scene& scene);

} // namespace vcarve::bench
