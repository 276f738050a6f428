#pragma once

#include "geometry/triangle_tree.h"
#include "vcarve/compare.h"
#include "vcarve/scene.h"
#include "vcarve/tri_mesh.h"

#include <Eigen/Core>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace vcarve {

/// A mesh in the frame of a reference, with its search tree.
struct MeasuredMesh {
    TriMesh mesh; ///< offset is the reference's origin
    TriangleTree tree;
};

inline constexpr std::uint32_t kNoView = 0xffffffffU;

/// The true surface. The part that at least 3 views see counts; 1 is enough if scanners are views.
struct Truth {
    MeasuredMesh surface;
    /// Area samples of the part that counts. A view sees a sample if the truth does not occlude it
    /// and the line meets the surface at less than 80 degrees from its normal, from either side.
    /// The image need not contain the sample.
    std::vector<Eigen::Vector3d> samples;
    std::vector<std::uint32_t> views; ///< per sample: a random view that sees it
    std::vector<std::uint32_t>
        image_views;         ///< per sample: a random one with it in its image; or kNoView
    double diagonal = 0.0;   ///< of the samples' bounding box
    double seen_share = 0.0; ///< the samples' fraction of the truth's area

    /// The number of samples with an image view.
    std::int64_t image_samples() const
    {
        return std::ssize(image_views) - std::ranges::count(image_views, kNoView);
    }
};

/// The ray of a pixel: from the view's center through `towards` and beyond.
struct ViewRay {
    std::uint32_t view;
    Eigen::Vector3d towards;
};

/// The reference for measurements: points and views of a model, and the truth if known. All are in
/// one frame, world minus `origin`, so that no precision is lost far from zero.
struct Reference {
    CompareOptions options;
    Eigen::Vector3d origin = Eigen::Vector3d::Zero();
    Scene scene;                  ///< finite points with two views or a range; offset: `origin`
    std::vector<double> spacings; ///< per point, see point_spacings()
    double median_spacing = 0.0;
    std::vector<ViewRay> rays; ///< see view_rays()
    /// Per ray: 1 if it hits the closed surface of the model, see add_closed_surface().
    std::optional<std::vector<char>> closed_hits;
    std::optional<Truth> truth;
};

/// Prepares a model and the truth, unless it is null; the closed surface is added later. Throws
/// InputError if the model has fewer than two points with two views. Throws InputError if the truth
/// has no faces, is in another frame than the model, or is hardly visible. Cost with a truth: about
/// samples / seen_share, times the segment queries until 3 views are found (all views if unseen).
Reference make_reference(const Scene& model, const NamedMesh* truth, const CompareOptions& options);

/// The uses of random numbers. Each use has a separate sequence.
enum class RandomStream { pilot = 1, truth, mesh, view, ray, area, place };
std::uint64_t stream_seed(const CompareOptions& options, RandomStream stream);

/// some / all; 0 if `all` is 0.
inline double share_of(std::size_t some, std::size_t all)
{
    return all == 0 ? 0.0 : static_cast<double>(some) / static_cast<double>(all);
}

/// Whether a surface occludes a position from an eye, farther than `skip` from the position.
bool is_hidden(const Eigen::Vector3d& place, const Eigen::Vector3d& eye, const TriangleTree& by,
               double skip);

/// Distances from positions to a surface. Cost: one query per position, parallel.
std::vector<double> distances_to(const TriangleTree& surface,
                                 std::span<const Eigen::Vector3d> places);

/// Returns the mesh with its offset changed to `origin`.
TriMesh in_frame(TriMesh mesh, const Eigen::Vector3d& origin);

/// Moves a mesh to the reference's frame. Throws InputError if no face has an area, or if the mesh
/// is in another frame than the model. It is if its box is more than a diagonal away from the box
/// of the central 90 % of the points, or if the sizes differ by a factor above 50.
MeasuredMesh place_mesh(const NamedMesh& named, const Reference& reference);

/// Returns the spacing at each point: the distance to its 6th nearest other point, or to the
/// farthest if there are fewer. It is at least a hundredth of the median, because points may
/// coincide. Precondition: at least two points, all finite. Cost: O(n log n), parallel.
std::vector<double> point_spacings(const std::vector<Eigen::Vector3d>& points);

/// Samples of a surface and their faces, as parallel arrays.
struct SurfaceSamples {
    std::vector<Eigen::Vector3d> positions; ///< in the frame of the mesh's positions
    std::vector<std::uint32_t> faces;       ///< ascending
};

/// Takes `count` samples by area: one random sample in each of `count` equal parts of the area. So
/// a face with a fraction s of the area gets s x count samples, plus or minus one. Returns no
/// samples if no face has an area. Cost: O(faces + count).
SurfaceSamples sample_surface(const TriMesh& mesh, std::size_t count, std::uint64_t seed);

} // namespace vcarve
