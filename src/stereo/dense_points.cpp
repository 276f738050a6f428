#include "stereo/dense_points.h"

#include "base/parallel.h"
#include "mesh/first_faces.h"
#include "mesh/vertices.h"
#include "stereo/choose_sources.h"
#include "stereo/filter_depth.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace vcarve {

namespace {

using Eigen::Vector3d;

constexpr std::size_t kNeighbors = 10; ///< views that fusion compares with
constexpr std::size_t kFewestSources = 2;
constexpr std::size_t kSources = 5; ///< views that are matched, of the neighbors

/// The pixels of a depth map in the smallest region of a surface: 40 for images of 640 pixels.
int smallest_region(const GrayImage& image)
{
    const double size = std::max(image.width_px, image.height_px) / 640.0;
    return static_cast<int>(std::lround(40.0 * size * size));
}

/// Looks up the sparse surface along rays.
class SurfaceDepth {
  public:
    explicit SurfaceDepth(const TriMesh& mesh) : mesh_(mesh), faces_(mesh, box_center(mesh)) {}

    PixelPlane plane(const StereoView& view, int x, int y) const
    {
        constexpr float kLeastFacing = 0.1F;
        const Eigen::Vector3f ray = depth_ray(view.camera, x, y);
        const Vector3d direction =
            (view.cam_from_world.transpose() * ray.cast<double>()).normalized();
        const FirstFace hit = faces_.from(view.center, direction);
        if (hit.face == FirstFace::kNone) return {};
        const auto& [a, b, c] = mesh_.faces[hit.face];
        const Vector3d& first = mesh_.positions[a];
        const Vector3d right = mesh_.positions[b] - first;
        const Vector3d left = mesh_.positions[c] - first;
        const Vector3d position = first + hit.second * right + hit.third * left;
        PixelPlane plane;
        plane.depth = static_cast<float>(view.cam_from_world.row(2).dot(position - view.center));
        Eigen::Vector3f normal =
            (view.cam_from_world * right.cross(left).normalized()).cast<float>();
        if (normal.dot(ray) > 0.0F) normal = -normal;
        if (-normal.dot(ray) >= kLeastFacing * ray.norm()) plane.normal = normal;
        return plane;
    }

  private:
    const TriMesh& mesh_;
    FirstFaces faces_;
};

/// The depths of the points that each view sees.
std::vector<std::vector<float>> depths_of_points(const Scene& scene)
{
    std::vector<std::vector<float>> depths(scene.views.size());
    for (std::size_t point = 0; point < scene.num_points(); ++point) {
        for (const std::uint32_t index : scene.tracks[point]) {
            const View& view = scene.views[index];
            const Vector3d in_cam = view.cam_from_world * (scene.positions[point] - view.center);
            if (in_cam.z() > 0.0) depths[index].push_back(static_cast<float>(in_cam.z()));
        }
    }
    return depths;
}

DepthPrior prior_of(const StereoView& view, std::vector<float> depths, const SurfaceDepth& surface)
{
    DepthPrior prior;
    std::ranges::sort(depths);
    const std::size_t tail = depths.size() / 50;
    prior.nearest = 0.8F * depths[tail];
    prior.farthest = 1.3F * depths[depths.size() - 1 - tail];
    for (int y = 0; y < depth_pixels(view.image.height_px); ++y) {
        for (int x = 0; x < depth_pixels(view.image.width_px); ++x) {
            prior.surface.push_back(surface.plane(view, x, y));
        }
    }
    return prior;
}

/// Matches views with their neighbors.
class ViewMatcher {
  public:
    /// `stereo` has views and neighbors.
    ViewMatcher(const Scene& sparse, const TriMesh& surface, const DenseStereo& stereo)
        : stereo_(stereo), depths_(depths_of_points(sparse)), surface_(surface)
    {
    }

    DepthMap match(std::size_t number) const
    {
        const StereoView& view = stereo_.views[number];
        const auto& neighbors = stereo_.neighbors[number];
        const std::vector<float>& depths = depths_[view.view];
        if (neighbors.size() < kFewestSources || depths.empty()) return empty_depth_map(view.image);
        std::vector<const StereoView*> sources;
        for (std::size_t i = 0; i < std::min(neighbors.size(), kSources); ++i) {
            sources.push_back(&stereo_.views[neighbors[i]]);
        }
        const DepthPrior prior = prior_of(view, depths, surface_);
        DepthMap map = match_view(view, sources, prior);
        drop_speckles(map, view.camera, smallest_region(view.image));
        fill_plain_regions(map, view.camera, prior.surface);
        return map;
    }

  private:
    const DenseStereo& stereo_;
    std::vector<std::vector<float>> depths_; ///< depths of the points that each view sees
    SurfaceDepth surface_;
};

} // namespace

double stereo_bytes(std::span<const PhotographSize> photos, const DenseOptions& options,
                    double threads)
{
    constexpr double kViewBytes = sizeof(float) + (sizeof(PixelPlane) + sizeof(float) + 4) / 4.0;
    constexpr double kMatchBytes = 6 * sizeof(float) * 4.0 / 3.0; // pyramids
    constexpr double kPhotographBytes = 2 * 3 * 4.0 / 3.0;        // during decoding
    double views = 0.0;
    double largest = 0.0;
    double largest_photo = 0.0;
    for (const PhotographSize& photo : photos) {
        const double pixels = static_cast<double>(photo.width_px) * photo.height_px;
        const double scale = pixels > 0.0 ? working_scale(photo, options.size_px) : 0.0;
        views += kViewBytes * scale * scale * pixels;
        largest = std::max(largest, scale * scale * pixels);
        largest_photo = std::max(largest_photo, pixels);
    }
    return views + threads * std::max(kMatchBytes * largest, kPhotographBytes * largest_photo);
}

std::vector<StereoView> undistort_photos(const std::vector<CalibratedPhoto>& photos,
                                         const DenseOptions& options, const Progress& progress)
{
    std::vector<StereoView> views(photos.size());
    parallel_for(
        photos.size(), progress,
        [&](std::size_t i) { views[i] = stereo_view(photos[i], options.size_px); }, 1);
    return views;
}

void match_views(const Scene& sparse, const TriMesh& surface, const KeepDepthMap& keep,
                 DenseStereo& stereo, const Progress& progress)
{
    stereo.maps.resize(stereo.views.size());
    stereo.neighbors = choose_sources(sparse, stereo.views, kNeighbors);
    const ViewMatcher matcher(sparse, surface, stereo);
    parallel_for(
        stereo.views.size(), progress,
        [&](std::size_t i) { stereo.maps[i] = keep(i, [&] { return matcher.match(i); }); }, 1);
}

void add_measured(const Scene& sparse, Scene& dense)
{
    for (std::size_t point = 0; point < sparse.num_points(); ++point) {
        if (sparse.kind_of(point) != PointKind::measured) continue;
        dense.positions.push_back(sparse.positions[point]);
        dense.colors.push_back(sparse.colors[point]);
        dense.errors_px.push_back(-1.0);
        dense.normals.push_back(Eigen::Vector3f::Zero());
        dense.point_ids.push_back(dense.point_ids.size());
        dense.tracks.push_back(sparse.tracks[point]);
    }
}

} // namespace vcarve
