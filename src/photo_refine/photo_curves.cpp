#include "photo_refine/photo_curves.h"

#include "base/arrays.h"
#include "stereo/gray_weights.h"
#include "stereo/vectorized.h"

#include <algorithm>
#include <atomic>
#include <cmath>

namespace vcarve {

namespace {

constexpr int kRadius = 3; ///< of a window, in pixels
constexpr int kSide = 2 * kRadius + 1;
constexpr int kWindow = kSide * kSide; ///< pixels
constexpr int kRows = 8;               ///< warped rows in memory: those of a window, and one more
constexpr int kLanes = 8;              ///< the shifts, padded

using Lanes = std::array<float, kLanes>;

constexpr float kUnit = 65536.0F; ///< of the sums

constexpr Lanes kShiftOfLane = {-2.0F, -1.0F, 0.0F, 1.0F, 2.0F, 0.0F, 0.0F, 0.0F};

/// The rays of a reference's pixels as a source sees them.
struct Relative {
    Relative(const StereoView& reference, const StereoView& source)
        : turn((source.cam_from_world * reference.cam_from_world.transpose()).cast<float>()),
          center((source.cam_from_world * (reference.center - source.center)).cast<float>())
    {
    }

    Eigen::Matrix3f turn;
    Eigen::Vector3f center; ///< of the reference's camera
};

/// Where a ray of the reference is in the source: (center + z ray) projects to the pixel.
struct SourceRay {
    Eigen::Vector3f center;
    Eigen::Vector3f ray;
};

/// A depth of the surface, and its change by a step.
struct DepthStep {
    float depth = 0.0F;
    float step = 0.0F;
};

VCARVE_VECTORIZED
void sample_shifts(const StereoView& source, const SourceRay& at, const DepthStep& surface,
                   float* values)
{
    const Pinhole& camera = source.camera;
    const GrayImage& image = source.image;
    const float* const pixels = image.pixels.data();
    const int width = image.width_px;
    for (int k = 0; k < kLanes; ++k) {
        const float z = surface.depth - kShiftOfLane[k] * surface.step;
        const float inverse = camera.focal_px / (at.center.z() + z * at.ray.z());
        const float x = (at.center.x() + z * at.ray.x()) * inverse + camera.principal_px.x();
        const float y = (at.center.y() + z * at.ray.y()) * inverse + camera.principal_px.y();
        const int column = static_cast<int>(x);
        const int row = static_cast<int>(y);
        const float right = x - static_cast<float>(column);
        const float down = y - static_cast<float>(row);
        const int index = row * width + column;
        const float upper = pixels[index] + right * (pixels[index + 1] - pixels[index]);
        const float lower =
            pixels[index + width] + right * (pixels[index + width + 1] - pixels[index + width]);
        values[k] = upper + down * (lower - upper);
    }
}

/// The last rows of a source, warped into the reference through the shifted surface.
class WarpedRows {
  public:
    WarpedRows(const ViewOfMesh& reference, const ViewOfMesh& source)
        : reference_(reference),
          source_(source),
          relative_(*reference.view, *source.view),
          width_(reference.view->image.width_px),
          values_(static_cast<std::size_t>(kRows) * width_ * kLanes),
          shown_(static_cast<std::size_t>(kRows) * width_)
    {
    }

    std::size_t photo() const { return source_.photo; }

    /// Warps a row, and forgets the row kRows before.
    void warp(int y)
    {
        for (int x = 0; x < width_; ++x) {
            shown_[place(x, y)] = warp(x, y) ? 1.0F : 0.0F;
        }
    }

    /// The gray levels of a pixel for each shift, if shown() is 1.
    const float* values(int x, int y) const { return &values_[place(x, y) * kLanes]; }
    /// Whether the source shows the pixel: 1 or 0.
    const float& shown(int x, int y) const { return shown_[place(x, y)]; }

  private:
    std::size_t place(int x, int y) const
    {
        return static_cast<std::size_t>(y % kRows) * width_ + x;
    }

    bool warp(int x, int y)
    {
        constexpr float kMostScale = 2.0F; // pixels of the source per pixel, or the inverse
        const StereoView& own = *reference_.view;
        const StereoView& other = *source_.view;
        const std::size_t pixel = static_cast<std::size_t>(y) * width_ + x;
        const float depth = reference_.shown->depth[pixel];
        const float step = reference_.shown->step[pixel];
        if (!std::isfinite(depth) || !(step > 0.0F)) return false;
        const Eigen::Vector3f ray =
            relative_.turn * own.camera.ray(static_cast<float>(x), static_cast<float>(y));
        const SourceRay at = {relative_.center, ray};
        const float z = at.center.z() + depth * ray.z();
        if (!(z > 0.0F)) return false;
        const float scale = z / depth * own.camera.focal_px / other.camera.focal_px;
        if (scale > kMostScale || scale * kMostScale < 1.0F) return false;
        // A line: if both ends are inside, all of it is.
        if (!is_inside(at, depth - kMostShift * step) || !is_inside(at, depth + kMostShift * step))
            return false;
        if (!is_first(at, depth, z, step)) return false;
        float* const values = &values_[place(x, y) * kLanes];
        sample_shifts(other, at, {depth, step}, values);
        float sum = 0.0F;
        for (int k = 0; k < kShifts; ++k) {
            sum += values[k];
        }
        return !std::isnan(sum);
    }

    Eigen::Vector2f pixel_at(const SourceRay& at, float depth) const
    {
        const Eigen::Vector3f position = at.center + depth * at.ray;
        return source_.view->camera.focal_px / position.z() * position.head<2>() +
               source_.view->camera.principal_px;
    }

    bool is_inside(const SourceRay& at, float depth) const
    {
        const GrayImage& image = source_.view->image;
        if (!(at.center.z() + depth * at.ray.z() > 0.0F)) return false;
        const Eigen::Vector2f pixel = pixel_at(at, depth);
        return pixel.x() >= 0.5F && pixel.y() >= 0.5F &&
               pixel.x() < static_cast<float>(image.width_px) - 1.5F &&
               pixel.y() < static_cast<float>(image.height_px) - 1.5F;
    }

    /// Whether no face hides the position in the source.
    bool is_first(const SourceRay& at, float depth, float z, float step) const
    {
        constexpr float kTolerancePx = 4.0F;
        const Eigen::Vector2f pixel = pixel_at(at, depth);
        const auto column = static_cast<std::size_t>(std::lround(pixel.x()));
        const auto row = static_cast<std::size_t>(std::lround(pixel.y()));
        const float first = source_.shown->depth[row * source_.view->image.width_px + column];
        return z <= first + kTolerancePx * z / source_.view->camera.focal_px +
                        kMostShift * std::abs(step);
    }

    ViewOfMesh reference_;
    ViewOfMesh source_;
    Relative relative_;
    int width_;
    std::vector<float> values_;
    std::vector<float> shown_;
};

/// A vertex in the reference.
struct SeenVertex {
    std::uint32_t vertex = 0;
    int x = 0;
    int y = 0;
    float footprint = 0.0F; ///< in this view
    float weight = 0.0F;    ///< smaller for oblique and distant views
};

/// The vertices that the reference sees well.
std::vector<SeenVertex> seen_vertices(const ShiftedSurface& surface, const ViewOfMesh& reference)
{
    constexpr float kLeastDetail = 0.4F; // footprint in the third best view per that in this one
    constexpr float kTolerancePx = 3.0F;
    const StereoView& view = *reference.view;
    std::vector<SeenVertex> seen;
    for (std::uint32_t vertex = 0; vertex < surface.mesh.positions.size(); ++vertex) {
        if (!(surface.steps[vertex] > 0.0F)) continue;
        const Eigen::Vector3d& position = surface.mesh.positions[vertex];
        const PixelDepth at = pixel_depth(view, position);
        if (!(at.z > 0.0F && at.x > kRadius && at.y > kRadius)) continue;
        if (!(at.x < static_cast<float>(view.image.width_px - kRadius - 1) &&
              at.y < static_cast<float>(view.image.height_px - kRadius - 1)))
            continue;
        const Eigen::Vector3d towards = (view.center - position).normalized();
        const auto cosine = static_cast<float>(surface.normals[vertex].dot(towards));
        if (cosine < kLeastCosine) continue;
        const int x = static_cast<int>(std::lround(at.x));
        const int y = static_cast<int>(std::lround(at.y));
        const std::size_t pixel = static_cast<std::size_t>(y) * view.image.width_px + x;
        const float footprint = at.z / view.camera.focal_px;
        const float tolerance =
            kTolerancePx * footprint / cosine + kMostShift * reference.shown->step[pixel];
        if (!(std::abs(at.z - reference.shown->depth[pixel]) <= tolerance)) continue;
        const float detail = std::min(1.0F, surface.footprints[vertex] / footprint);
        if (detail < kLeastDetail) continue;
        seen.push_back({vertex, x, y, footprint, cosine * detail * detail});
    }
    return seen;
}

/// Weighted sums over the pixels of a window.
struct WindowSums {
    float weight = 0.0F;
    float value = 0.0F;
    float square = 0.0F;
    alignas(32) Lanes other{}; ///< of the source, for each shift
    alignas(32) Lanes other_square{};
    alignas(32) Lanes product{};
};

/// A row of a window.
struct WindowRow {
    const float* weights;
    const float* own;    ///< gray levels of the reference, relative to the center's
    const float* shown;  ///< whether the source shows the pixels: 1 or 0
    const float* values; ///< gray levels of the source, for each shift
};

/// Adds a row of a window whose center has this gray level.
VCARVE_VECTORIZED
void add_row(const WindowRow& row, float center, WindowSums& sums)
{
    const float* const own = row.own;
    const float* const values = row.values;
    for (int i = 0; i < kSide; ++i) {
        const float weight = row.weights[i] * row.shown[i];
        if (weight == 0.0F) continue;
        sums.weight += weight;
        sums.value += weight * own[i];
        sums.square += weight * own[i] * own[i];
        for (int k = 0; k < kLanes; ++k) {
            const float level = values[i * kLanes + k] - center;
            const float weighted = weight * level;
            sums.other[k] += weighted;
            sums.other_square[k] += weighted * level;
            sums.product[k] += weighted * own[i];
        }
    }
}

/// A window of the reference around a vertex, and its correlation with warped sources.
class Window {
  public:
    explicit Window(const ViewOfMesh& reference) : reference_(reference)
    {
        constexpr float kSigmaPx = 2.0F;
        for (int i = 0; i < kWindow; ++i) {
            const auto right = static_cast<float>(i % kSide - kRadius);
            const int row = i / kSide;
            const auto down = static_cast<float>(row - kRadius);
            near_[i] = std::exp(-(right * right + down * down) / (2.0F * kSigmaPx * kSigmaPx));
            all_ += near_[i];
        }
    }

    void set(const SeenVertex& at)
    {
        constexpr float kSameSurfacePx = 10.0F; // depth difference in footprints
        const GrayImage& image = reference_.view->image;
        center_ = image.at(at.x, at.y);
        const float depth = depth_at(at.x, at.y);
        for (int i = 0; i < kWindow; ++i) {
            const int x = at.x + i % kSide - kRadius;
            const int y = at.y + i / kSide - kRadius;
            const float difference = image.at(x, y) - center_;
            const bool is_near = std::abs(depth_at(x, y) - depth) <= kSameSurfacePx * at.footprint;
            differences_[i] = std::isnan(difference) ? 0.0F : difference;
            weights_[i] =
                is_near && !std::isnan(difference) ? near_[i] * gray_weights_.of(difference) : 0.0F;
        }
        at_ = at;
    }

    /// The curve of a source; without weight if it does not show most of the window, or differs.
    PhotoCurve curve(const WarpedRows& source) const
    {
        constexpr float kLeastShare = 0.25F;
        constexpr float kLeastVariance = 0.5F; // gray levels squared
        constexpr float kLeastCorrelation = 0.1F;
        if (source.shown(at_.x, at_.y) == 0.0F) return {};
        WindowSums sums;
        for (int row = 0; row < kSide; ++row) {
            const int x = at_.x - kRadius;
            const int y = at_.y + row - kRadius;
            const std::size_t first = std::size_t{kSide} * row;
            add_row(
                {&weights_[first], &differences_[first], &source.shown(x, y), source.values(x, y)},
                center_, sums);
        }
        if (!(sums.weight >= kLeastShare * all_)) return {};
        const float inverse = 1.0F / sums.weight;
        const float mean = sums.value * inverse;
        const float variance = sums.square * inverse - mean * mean;
        if (variance < kLeastVariance) return {};
        PhotoCurve curve;
        float best = 2.0F;
        for (int k = 0; k < kShifts; ++k) {
            const float other = sums.other[k] * inverse;
            const float other_variance = sums.other_square[k] * inverse - other * other;
            const float product = sums.product[k] * inverse - mean * other;
            curve.costs[k] =
                1.0F - product / std::sqrt(variance * std::max(other_variance, kLeastVariance));
            best = std::min(best, curve.costs[k]);
        }
        const float agreement = 1.0F - best - kLeastCorrelation;
        curve.weight = agreement > 0.0F ? at_.weight * agreement * agreement : 0.0F;
        curve.pairs = 1;
        return curve;
    }

  private:
    float depth_at(int x, int y) const
    {
        return reference_.shown
            ->depth[static_cast<std::size_t>(y) * reference_.view->image.width_px + x];
    }

    ViewOfMesh reference_;
    std::array<float, kWindow> near_{}; ///< Gaussian weights
    float all_ = 0.0F;
    GrayWeights gray_weights_{20.0F};
    SeenVertex at_;
    float center_ = 0.0F;
    std::array<float, kWindow> weights_{};
    std::array<float, kWindow> differences_{};
};

/// Adds the curves of all sources at a vertex.
void add_curves(Window& window, const SeenVertex& at, std::size_t reference,
                const std::vector<WarpedRows>& sources, CurveSums& sums)
{
    window.set(at);
    std::array<PhotoCurve, kPairGroups> groups;
    for (const WarpedRows& source : sources) {
        const PhotoCurve curve = window.curve(source);
        if (curve.weight <= 0.0F) continue;
        PhotoCurve& sum = groups[static_cast<std::size_t>(group_of(reference, source.photo()))];
        for (int k = 0; k < kShifts; ++k) {
            sum.costs[k] += curve.weight * curve.costs[k];
        }
        sum.weight += curve.weight;
        ++sum.pairs;
    }
    for (std::size_t group = 0; group < kPairGroups; ++group) {
        if (groups[group].pairs > 0) {
            sums.add(at.vertex, static_cast<PairGroup>(group), groups[group]);
        }
    }
}

} // namespace

PairGroup group_of(std::size_t reference, std::size_t source)
{
    if (reference % 2 != source % 2) return PairGroup::mixed;
    return reference % 2 == 0 ? PairGroup::even : PairGroup::odd;
}

void CurveSums::add(std::uint32_t vertex, PairGroup group, const PhotoCurve& curve)
{
    Sum& sum = sums_[vertex][static_cast<std::size_t>(group)];
    constexpr auto kRelaxed = std::memory_order_relaxed;
    const auto add_to = [](std::int32_t& total, std::int32_t value) {
        std::atomic_ref(total).fetch_add(value, kRelaxed);
    };
    const auto rounded = [](float value) {
        return static_cast<std::int32_t>(std::lround(kUnit * value));
    };
    for (int k = 0; k < kShifts; ++k) {
        add_to(sum.costs[k], rounded(curve.costs[k]));
    }
    add_to(sum.weight, rounded(curve.weight));
    add_to(sum.pairs, curve.pairs);
}

PhotoCurve CurveSums::mean(const Sum& sum)
{
    PhotoCurve curve;
    curve.pairs = sum.pairs;
    if (sum.weight <= 0) return curve;
    curve.weight = static_cast<float>(sum.weight) / kUnit;
    for (int k = 0; k < kShifts; ++k) {
        curve.costs[k] =
            static_cast<float>(static_cast<double>(sum.costs[k]) / static_cast<double>(sum.weight));
    }
    return curve;
}

PhotoCurve CurveSums::curve(std::size_t vertex, PairGroup group) const
{
    return mean(sums_[vertex][static_cast<std::size_t>(group)]);
}

PhotoCurve CurveSums::curve(std::size_t vertex) const
{
    Sum all;
    for (const Sum& sum : sums_[vertex]) {
        for (int k = 0; k < kShifts; ++k) {
            all.costs[k] += sum.costs[k];
        }
        all.weight += sum.weight;
        all.pairs += sum.pairs;
    }
    return mean(all);
}

void add_photo_curves(const ShiftedSurface& surface, const ViewOfMesh& reference,
                      std::span<const ViewOfMesh> sources, CurveSums& sums)
{
    const std::vector<SeenVertex> seen = seen_vertices(surface, reference);
    const int height = reference.view->image.height_px;
    std::vector<std::vector<SeenVertex>> rows(height);
    for (const SeenVertex& vertex : seen) {
        rows[vertex.y].push_back(vertex);
    }
    std::vector<WarpedRows> warped;
    for (const ViewOfMesh& source : sources) {
        warped.emplace_back(reference, source);
    }
    Window window(reference);
    for (int y = 0; y < height; ++y) {
        for (WarpedRows& source : warped) {
            source.warp(y);
        }
        const int center = y - kRadius;
        if (center < kRadius) continue;
        for (const SeenVertex& vertex : rows[center]) {
            add_curves(window, vertex, reference.photo, warped, sums);
        }
    }
}

} // namespace vcarve
