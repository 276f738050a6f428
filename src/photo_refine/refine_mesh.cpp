#include "photo_refine/refine_mesh.h"

#include "base/parallel.h"
#include "base/statistics.h"
#include "photo_refine/divide_faces.h"
#include "photo_refine/mesh_depth.h"
#include "photo_refine/photo_curves.h"
#include "photo_refine/recently_used.h"
#include "photo_refine/shift_noise.h"
#include "photo_refine/vertex_moves.h"
#include "stereo/choose_sources.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <memory>
#include <mutex>

namespace vcarve {

namespace {

using Eigen::Vector3d;

constexpr std::size_t kSources = 5;
constexpr float kSineOfAngle = 0.208F; ///< 12 degrees between the rays of usual neighbors
constexpr double kMostBytes = 256.0 * (1U << 20U); ///< of undistorted photographs

using Sources = std::vector<std::vector<std::uint32_t>>;

Sources sources_of(const Scene& scene, const std::vector<CalibratedPhoto>& photos)
{
    std::vector<StereoView> views(photos.size());
    for (std::size_t i = 0; i < photos.size(); ++i) {
        views[i].view = photos[i].view;
        views[i].center = photos[i].pose.center;
    }
    return choose_sources(scene, views, kSources);
}

/// The order in which the photographs are references: each shares most photographs with the last
/// ones, so that few have to be read twice.
std::vector<std::uint32_t> order_of(const Sources& sources)
{
    constexpr std::size_t kRecent = 8;
    std::vector<std::uint32_t> order;
    std::vector<char> is_done(sources.size(), 0);
    std::vector<std::uint32_t> recent;
    while (order.size() < sources.size()) {
        const auto shared = [&](std::size_t i) {
            const auto is_recent = [&](std::uint32_t other) {
                return std::ranges::count(recent, other) > 0;
            };
            return std::ranges::count_if(sources[i], is_recent) +
                   (is_recent(static_cast<std::uint32_t>(i)) ? 1 : 0);
        };
        std::size_t best = sources.size();
        for (std::size_t i = 0; i < sources.size(); ++i) {
            if (is_done[i] == 0 && (best == sources.size() || shared(i) > shared(best))) best = i;
        }
        is_done[best] = 1;
        order.push_back(static_cast<std::uint32_t>(best));
        recent.push_back(order.back());
        recent.insert(recent.end(), sources[best].begin(), sources[best].end());
        if (recent.size() > kRecent) recent.erase(recent.begin(), recent.end() - kRecent);
    }
    return order;
}

/// The number of views in memory: those of each thread, and some that the next ones need.
std::size_t num_kept()
{
    return num_threads() + kSources + 1;
}

/// An undistorted photograph in bytes: gray levels from 1 to 255; 0: shows nothing.
using Bytes = std::vector<std::uint8_t>;

Bytes to_bytes(const GrayImage& image)
{
    Bytes bytes;
    bytes.reserve(image.pixels.size());
    for (const float gray : image.pixels) {
        bytes.push_back(std::isnan(gray)
                            ? 0
                            : static_cast<std::uint8_t>(std::clamp(gray + 0.5F, 1.0F, 255.0F)));
    }
    return bytes;
}

/// The photographs. Undistorted ones are kept as bytes, as many as fit into a quarter of a
/// gigabyte.
class Photos {
  public:
    Photos(const Scene& scene, const std::vector<CalibratedPhoto>& photos, int size_px)
        : sources(sources_of(scene, photos)),
          order(order_of(sources)),
          bytes_(photos.size(), num_in_bytes(photos, size_px), [&photos, size_px](std::size_t i) {
              return to_bytes(stereo_view(photos[i], size_px).image);
          })
    {
        views_.reserve(photos.size());
        for (const CalibratedPhoto& photo : photos) {
            views_.push_back(view_without_pixels(photo, size_px));
        }
    }

    std::size_t size() const { return views_.size(); }

    /// The view without its pixels.
    StereoView view(std::size_t photo, bool is_half) const
    {
        StereoView view = views_[photo];
        if (is_half) {
            view.camera = halved(view.camera);
            view.image.width_px /= 2;
            view.image.height_px /= 2;
        }
        return view;
    }

    StereoView image(std::size_t photo, bool is_half) const
    {
        StereoView view = views_[photo];
        const std::shared_ptr<const Bytes> bytes = bytes_.get(photo);
        view.image.pixels.reserve(bytes->size());
        for (const std::uint8_t gray : *bytes) {
            view.image.pixels.push_back(gray == 0 ? kNoGray : static_cast<float>(gray));
        }
        if (is_half) {
            view.image = halved(view.image);
            view.camera = halved(view.camera);
        }
        return view;
    }

    const Sources sources;
    const std::vector<std::uint32_t> order;

  private:
    static std::size_t num_in_bytes(const std::vector<CalibratedPhoto>& photos, int size_px)
    {
        double largest = 1.0;
        for (const CalibratedPhoto& photo : photos) {
            const GrayImage image = view_without_pixels(photo, size_px).image;
            largest = std::max(largest, static_cast<double>(image.width_px) * image.height_px);
        }
        return std::max(num_kept(), static_cast<std::size_t>(kMostBytes / largest));
    }

    std::vector<StereoView> views_;
    RecentlyUsed<Bytes> bytes_;
};

/// The photographs at their size or half of it.
struct Level {
    const Photos& photos;
    bool is_half = false;
    RecentlyUsed<StereoView> images{photos.size(), num_kept(), [this](std::size_t photo) {
                                        return photos.image(photo, is_half);
                                    }};
};

/// Calls visit(photo) for all photographs: all threads take the next one in order.
template <typename Visit>
void visit_photos(const Photos& photos, const Progress& progress, const Visit& visit)
{
    std::atomic<std::size_t> next = 0;
    ProgressCount done(progress, photos.size());
    parallel_for(
        num_threads(),
        [&](std::size_t) {
            for (std::size_t i = next++; i < photos.size(); i = next++) {
                visit(photos.order[i]);
                done.add(1);
            }
        },
        1);
}

/// The pixel sizes of a vertex in the three views that see it largest.
struct Footprints {
    std::array<float, 3> best = {kUnseen, kUnseen, kUnseen};
    static constexpr float kUnseen = std::numeric_limits<float>::infinity();

    void add(float footprint)
    {
        for (float& each : best) {
            if (footprint < each) std::swap(footprint, each);
        }
    }
};

/// The pixel size at each vertex in the third best view; infinite if fewer see it.
std::vector<float> footprints_of(const TriMesh& mesh, const Level& level, const Progress& progress)
{
    constexpr float kSameDepth = 0.01F;
    const std::vector<Vector3d> normals = normals_of_vertices(mesh);
    std::vector<Footprints> all(mesh.positions.size());
    std::mutex mutex;
    const auto look = [&](std::size_t photo) {
        const StereoView view = level.photos.view(photo, level.is_half);
        const MeshDepth shown = mesh_depth(mesh, view, {});
        std::vector<std::pair<std::uint32_t, float>> seen;
        for (std::uint32_t v = 0; v < normals.size(); ++v) {
            const PixelDepth at = pixel_depth(view, mesh.positions[v]);
            const Vector3d towards = view.center - mesh.positions[v];
            if (!(at.z > 0.0F) || normals[v].dot(towards) < kLeastCosine * towards.norm()) continue;
            if (!(at.x >= 0.0F && at.x <= static_cast<float>(view.image.width_px - 1) &&
                  at.y >= 0.0F && at.y <= static_cast<float>(view.image.height_px - 1)))
                continue;
            const std::size_t pixel =
                static_cast<std::size_t>(std::lround(at.y)) * view.image.width_px +
                static_cast<std::size_t>(std::lround(at.x));
            if (at.z > (1.0F + kSameDepth) * shown.depth[pixel]) continue;
            seen.emplace_back(v, at.z / view.camera.focal_px);
        }
        const std::lock_guard lock(mutex);
        for (const auto& [vertex, footprint] : seen) {
            all[vertex].add(footprint);
        }
    };
    visit_photos(level.photos, progress, look);
    std::vector<float> footprints;
    std::vector<WantedShift> wanted;
    footprints.reserve(all.size());
    for (const Footprints& each : all) {
        footprints.push_back(each.best.back());
    }
    return footprints;
}

/// Half a pixel of disparity between usual neighbors, along the normal.
std::vector<float> steps_of(const std::vector<float>& footprints)
{
    constexpr float kStepPx = 0.5F;
    std::vector<float> steps;
    steps.reserve(footprints.size());
    for (const float footprint : footprints) {
        steps.push_back(std::isfinite(footprint) ? kStepPx / kSineOfAngle * footprint : 0.0F);
    }
    return steps;
}

/// The curves of all pairs of photographs.
CurveSums photo_curves(const ShiftedSurface& surface, const Level& level, const Progress& progress)
{
    CurveSums sums(surface.mesh.positions.size());
    const RecentlyUsed<MeshDepth> shown(level.photos.size(), num_kept(), [&](std::size_t photo) {
        return mesh_depth(surface.mesh, *level.images.get(photo), surface.steps);
    });
    const auto add = [&](std::size_t photo) {
        std::vector<std::shared_ptr<const StereoView>> images = {level.images.get(photo)};
        std::vector<std::shared_ptr<const MeshDepth>> depths = {shown.get(photo)};
        std::vector<ViewOfMesh> sources;
        for (const std::uint32_t source : level.photos.sources[photo]) {
            images.push_back(level.images.get(source));
            depths.push_back(shown.get(source));
            sources.push_back({source, images.back().get(), depths.back().get()});
        }
        add_photo_curves(surface, {photo, images[0].get(), depths[0].get()}, sources, sums);
    };
    visit_photos(level.photos, progress, add);
    return sums;
}

/// Moves the vertices. Returns where the photographs wanted them.
std::vector<WantedShift> move_vertices(TriMesh& mesh, const std::vector<float>& footprints,
                                       const Level& level, const Progress& progress)
{
    // In steps, the surface of photographs that agree bends by about a third of a step.
    constexpr double kStiffness = 8.0;
    const std::vector<Vector3d> normals = normals_of_vertices(mesh);
    const std::vector<float> steps = steps_of(footprints);
    const RowTable neighbors = neighbors_of(mesh);
    std::vector<WantedShift> wanted;
    {
        const CurveSums sums = photo_curves({mesh, normals, footprints, steps}, level, progress);
        std::vector<GroupShifts> shifts(steps.size());
        parallel_for(shifts.size(), [&](std::size_t v) {
            shifts[v] = {wanted_shift(sums.curve(v)), wanted_shift(sums.curve(v, PairGroup::even)),
                         wanted_shift(sums.curve(v, PairGroup::odd))};
        });
        wanted = trusted_shifts(shifts, neighbors);
    }
    const ShiftSolver solver(mesh, normals, steps, neighbors);
    mesh.positions = solver.moved(solver.shifts(wanted, kStiffness));
    return wanted;
}

/// Divides faces until their edges have about this length in pixels of the third best view.
void divide_to(TriMesh& mesh, std::vector<float>& footprints, float spacing_px)
{
    constexpr std::size_t kMostVertices = std::size_t{1} << 27U;
    for (float& each : footprints) {
        each *= spacing_px;
    }
    divide_faces(mesh, footprints, kMostVertices);
    for (float& each : footprints) {
        each /= spacing_px;
    }
}

/// The length along the normal that shifts the surface by a pixel between usual neighbors, at the
/// median vertex; 0 if there is none.
double median_pixel(const std::vector<float>& footprints)
{
    std::vector<double> pixels;
    for (const float footprint : footprints) {
        if (std::isfinite(footprint)) pixels.push_back(footprint / kSineOfAngle);
    }
    return pixels.empty() ? 0.0 : median_in_place(pixels);
}

} // namespace

double refine_bytes(std::span<const PhotographSize> photos, int size_px, double threads)
{
    constexpr double kPixel = sizeof(float) + 2 * sizeof(float); // an image, a depth and a step
    double largest = 0.0;
    for (const PhotographSize& photo : photos) {
        const double scale = working_scale(photo, size_px);
        largest = std::max(largest,
                           scale * scale * static_cast<double>(photo.width_px) * photo.height_px);
    }
    const double kept = std::min(threads + kSources + 1, static_cast<double>(photos.size()));
    return kept * kPixel * largest;
}

RefinedCounts refine_mesh(TriMesh& mesh, const Scene& scene,
                          const std::vector<CalibratedPhoto>& photos, int size_px,
                          const Progress& progress)
{
    constexpr float kHalfSpacingPx = 3.5F; // of vertices; finer ones follow noise
    constexpr float kSpacingPx = 5.0F;
    const Photos all_photos(scene, photos, size_px);
    std::vector<float> footprints;
    std::vector<WantedShift> wanted;
    for (const bool is_half : {true, false}) {
        const Progress pass = is_half ? progress.part(0.0, 0.3) : progress.part(0.3, 1.0);
        const Level level = {all_photos, is_half};
        footprints = footprints_of(mesh, level, pass.part(0.0, 0.2));
        // What half the size does not show, the full size does not show either.
        for (std::size_t v = 0; v < wanted.size(); ++v) {
            if (wanted[v].weight <= 0.0F) footprints[v] = Footprints::kUnseen;
        }
        divide_to(mesh, footprints, is_half ? kHalfSpacingPx : kSpacingPx);
        if (is_half) move_vertices(mesh, footprints, level, pass.part(0.2, 0.6));
        wanted = move_vertices(mesh, footprints, level, pass.part(is_half ? 0.6 : 0.2, 1.0));
    }
    return {.vertices = size_of(mesh.positions.size()),
            .measured = std::ranges::count_if(
                wanted, [](const WantedShift& each) { return each.weight > 0.0F; }),
            .pixel = median_pixel(footprints)};
}

} // namespace vcarve
