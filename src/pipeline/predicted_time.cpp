#include "pipeline/predicted_time.h"

#include <algorithm>
#include <cmath>

namespace vcarve {

namespace {

/// CPU seconds of a thing, and the share of them that is spread over threads. Measured on one
/// thread on models of 20 thousand to 1 million points, shares on clouds of 5 million on two.
struct Cost {
    double seconds;
    double parallel;
};

constexpr Cost kReadPoint{0.1e-6, 0.0};
constexpr Cost kReadDensePoint{0.95e-6, 0.75}; // merging it, too
constexpr Cost kFilterPoint{0.65e-6, 0.8};
constexpr Cost kCreasePoint{7.0e-6, 0.84};
constexpr Cost kCropPoint{0.3e-6, 0.8};
constexpr Cost kDenoisePoint{1.9e-6, 0.95};
constexpr Cost kTriangulatePoint{5e-6, 0.98};
constexpr Cost kWalkSight{1.3e-6, 0.99};        // of a million points
constexpr Cost kWalkBundledSight{0.8e-6, 0.99}; // of a dense cloud, before points are merged
constexpr Cost kCutPoint{2.2e-6, 0.94};
constexpr Cost kCarvePoint{0.07e-6, 0.9};
constexpr Cost kVirtualView{4e-3, 0.95};
constexpr Cost kVirtualSightsOfView{0.4e-3, 0.95};
constexpr Cost kSurfacePoint{0.5e-6, 0.7};
constexpr Cost kStrictSurfacePoint{45e-6, 0.9}; // more of it is seen by no sight of its own
constexpr Cost kSurfaceView{0.7e-3, 0.9};       // looks at faces that may be sheets
constexpr Cost kOpen{40e-3, 0.9};
constexpr Cost kCleanPoint{0.47e-6, 0.6};
constexpr Cost kSettlePoint{2.8e-6, 0.7};
constexpr Cost kGuardSight{13e-6, 0.95};
constexpr Cost kSmoothPoint{150e-6, 0.95}; // an iteration
constexpr Cost kSimplifyFace{0.5e-3, 0.0}; // that goes
constexpr Cost kOrientPoint{0.19e-6, 0.6};
constexpr Cost kWritePoint{0.1e-6, 0.5};

/// From here on the triangulation is parallel.
constexpr double kParallelTriangulation = 50'000.0;

/// A sight crosses more cells where these are smaller.
double cells_on_sight(double points)
{
    return std::pow(std::max(points, 1.0) / 1e6, 0.1);
}

/// Counts of a run.
struct Sizes {
    double read_points;
    double points; ///< that are left
    double sights;
    double views;
    bool is_dense;
};

Sizes sizes_of(const SceneSize& read, const Options& options)
{
    // A cloud of stereo holds each place about twice.
    constexpr double kLeftOfCloud = 0.5;
    const bool is_thinned = read.is_dense && options.thin.merge_px > 0.0;
    const auto points = static_cast<double>(read.points);
    return {.read_points = points,
            .points = is_thinned ? kLeftOfCloud * points : points,
            .sights = static_cast<double>(read.sights),
            .views = static_cast<double>(read.views),
            .is_dense = read.is_dense};
}

/// Adds up stages.
class Stages {
  public:
    explicit Stages(int threads) : threads_(threads) {}

    void add(const char* stage, const Cost& cost, double count)
    {
        stages_.push_back({stage, seconds(cost, count)});
    }
    /// More for the stage added last.
    void add_more(const Cost& cost, double count)
    {
        stages_.back().seconds += seconds(cost, count);
    }
    std::vector<StageTime> take() { return std::move(stages_); }

  private:
    double seconds(const Cost& cost, double count) const
    {
        return cost.seconds * count * (1.0 - cost.parallel + cost.parallel / threads_);
    }

    double threads_;
    std::vector<StageTime> stages_;
};

void add_points(Stages& stages, const Sizes& n, const Options& options)
{
    const bool is_thinned = n.is_dense && options.thin.merge_px > 0.0;
    stages.add("read", is_thinned ? kReadDensePoint : kReadPoint, n.read_points);
    stages.add("filter", kFilterPoint, n.points);
    if (!n.is_dense && options.creases.add_any() && options.labels.method != Method::strict) {
        stages.add("creases", kCreasePoint, n.points);
    }
    if (options.crop.region.kind != RegionChoice::Kind::everything) {
        stages.add("crop", kCropPoint, n.points);
    }
    if (n.is_dense && options.denoise.denoise > 0.0) {
        stages.add("denoise", kDenoisePoint, n.points);
    }
    Cost point = kTriangulatePoint;
    if (n.points < kParallelTriangulation) point.parallel = 0.0;
    stages.add("triangulate", point, n.points);
}

void add_walks(Stages& stages, const char* stage, const Sizes& n)
{
    if (n.is_dense) {
        stages.add(stage, kWalkBundledSight, n.sights);
    } else {
        stages.add(stage, kWalkSight, n.sights * cells_on_sight(n.points));
    }
}

void add_labels(Stages& stages, const Sizes& n, const LabelOptions& options)
{
    const auto label = [&] {
        if (options.method == Method::strict) {
            stages.add("carve", kCarvePoint, n.points);
        } else {
            stages.add("cut", kCutPoint, n.points);
        }
    };
    add_walks(stages, "sights", n);
    label();
    if (options.virtual_views.count == 0) return;
    add_walks(stages, "virtual", n);
    stages.add_more(kVirtualView, options.virtual_views.count);
    stages.add("sights", kVirtualSightsOfView, options.virtual_views.count);
    label();
}

void add_surface(Stages& stages, const Sizes& n, const Options& options)
{
    stages.add("surface", kSurfacePoint, n.points);
    if (!options.surface.closed) {
        constexpr double kMostViews = 1024; // of a scanner that moves, about as many places count
        stages.add_more(kSurfaceView, std::min(n.views, kMostViews));
        if (options.labels.method == Method::strict) {
            stages.add_more(kStrictSurfacePoint, n.points);
        }
    }
    stages.add("clean", kCleanPoint, n.points);
    const bool is_cropped = options.crop.region.kind != RegionChoice::Kind::everything;
    if (!options.surface.closed && !is_cropped) stages.add("open", kOpen, 1.0);
}

void add_settling(Stages& stages, const Sizes& n, const Options& options)
{
    if (n.is_dense || options.denoise.denoise == 0.0) return;
    if (options.labels.method != Method::strict) stages.add("settle", kSettlePoint, n.points);
}

void add_refining(Stages& stages, const Sizes& n, const RefineOptions& options)
{
    constexpr double kFacesPerPoint = 1.8;
    const double iterations = options.smooth.iterations;
    const double fewer = std::max(kFacesPerPoint * n.points - options.simplify.faces, 0.0);
    if (iterations == 0.0 && options.simplify.faces == 0) return;
    stages.add("guard", kGuardSight, n.sights);
    if (iterations > 0.0) stages.add("smooth", kSmoothPoint, iterations * n.points);
    if (options.simplify.faces > 0) stages.add("simplify", kSimplifyFace, fewer);
}

} // namespace

PredictedTimes predicted_times(const SceneSize& read, const Options& options, int threads)
{
    const Sizes n = sizes_of(read, options);
    Stages stages(threads);
    add_points(stages, n, options);
    add_labels(stages, n, options.labels);
    add_surface(stages, n, options);
    add_settling(stages, n, options);
    add_refining(stages, n, options.refine);
    stages.add("orient", kOrientPoint, n.points);
    stages.add("write", kWritePoint, n.points);
    return {.stages = stages.take(), .points = n.points};
}

} // namespace vcarve
