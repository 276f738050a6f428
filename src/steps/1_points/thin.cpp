#include "steps/1_points/thin.h"

#include "base/parallel.h"
#include "base/statistics.h"
#include "model/camera.h"
#include "model/scene_points.h"
#include "steps/1_points/arrange.h"
#include "steps/1_points/clusters.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace vcarve {

namespace {

using Eigen::Vector3d;

/// The size of `pixels` pixels at a point's distance, in the view that shows it largest; infinite
/// for a point that no view saw.
double footprint(const Scene& scene, std::size_t point, double pixels,
                 const std::vector<double>& focals)
{
    double least = std::numeric_limits<double>::infinity();
    for (const std::uint32_t v : scene.tracks[point]) {
        const View& view = scene.views[v];
        const double distance = (view.center - scene.positions[point]).norm();
        least = std::min(least, pixels * distance / focals[view.camera]);
    }
    return least;
}

/// The result refers to the scene and must not outlive it.
Dots dots_of(const Scene& scene, double merge_px)
{
    const std::vector<double> focals = mean_focals_px(scene.cameras);
    Dots dots{scene.positions, scene.normals, std::vector<double>(scene.num_points()),
              std::vector<std::uint32_t>(scene.num_points())};
    parallel_for(scene.num_points(), [&](std::size_t i) {
        dots.footprints[i] = footprint(scene, i, merge_px, focals);
        dots.num_views[i] = static_cast<std::uint32_t>(scene.tracks[i].size());
    });
    return dots;
}

double median_of_finite(std::vector<double> values)
{
    std::erase_if(values, [](double value) { return !std::isfinite(value); });
    return median_in_place(values);
}

/// Merges the points of consecutive parts.
class Thinning {
  public:
    Thinning(const ThinOptions& options, std::size_t at_once)
        : merge_px_(options.merge_px), most_(4 * at_once)
    {
    }

    void add(Scene part)
    {
        if (num_parts_++ == 0) {
            part = center_points(std::move(part));
        } else {
            move_origin(part, kept_.scene.offset - part.offset);
        }
        const Dots dots = dots_of(part, merge_px_);
        if (!(unit_ > 0.0)) unit_ = median_of_finite(dots.footprints);
        append(kept_, merged_in({std::move(part), {}}, dots, kWholeCubes));
        if (kept_.scene.num_points() > most_) {
            merge_again(kWholeCubes);
            most_ = std::max(most_, 2 * kept_.scene.num_points());
        }
    }

    Scene finish(const Progress& progress)
    {
        if (num_parts_ > 1) merge_again(kWholeCubes);
        progress.report(0.6);
        merge_again(kAcrossBorders);
        progress.report(1.0);
        return std::move(kept_.scene);
    }

  private:
    /// A reach above the diagonal of a cube covers all its dots.
    static constexpr CubesForDots kWholeCubes = {.shift = 0.0, .reach = 2.0};
    static constexpr CubesForDots kAcrossBorders = {.shift = 1.0 / 3.0, .reach = 0.5};

    MergedPoints merged_in(MergedPoints points, const Dots& dots, CubesForDots cubes) const
    {
        if (!(unit_ > 0.0)) return points;
        cubes.unit = unit_;
        return merge_points(points, Clusters(leaders_in_cubes(dots, cubes)));
    }

    void merge_again(const CubesForDots& cubes)
    {
        const Dots dots = dots_of(kept_.scene, merge_px_);
        kept_ = merged_in(std::move(kept_), dots, cubes);
    }

    double merge_px_;
    std::size_t most_; ///< points held before they are merged again
    std::size_t num_parts_ = 0;
    double unit_ = 0.0; ///< the median footprint; 0 until a part has points to merge
    MergedPoints kept_;
};

} // namespace

Scene thin_points(SceneParts& parts, const ThinOptions& options, const Progress& progress,
                  std::size_t at_once)
{
    const Progress merging = progress.part(0.0, 0.8);
    const auto all = static_cast<double>(std::max<std::size_t>(parts.num_points(), 1));
    Thinning thinning(options, at_once);
    std::size_t done = 0;
    do { // runs at least once, so that an empty scene keeps its views
        const std::size_t end = std::min(done + at_once, parts.num_points());
        const Progress part =
            merging.part(static_cast<double>(done) / all, static_cast<double>(end) / all);
        Scene points = parts.next(at_once, part.part(0.0, 0.5));
        thinning.add(std::move(points));
        done = end;
    } while (done < parts.num_points());
    merging.report(1.0);
    return thinning.finish(progress.part(0.8, 1.0));
}

Scene thin_points(const Scene& scene, const ThinOptions& options, const Progress& progress)
{
    PartsOfScene parts(scene);
    return thin_points(parts, options, progress);
}

} // namespace vcarve
