#include "stereo/patch_match.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <utility>

namespace vcarve {

namespace {

constexpr double kCoarsestPx = 160.0;   ///< about the longest side at the coarsest level
constexpr float kLeastDeviation = 1.5F; ///< gray levels
constexpr float kMostCost = 0.35F;      ///< maximum cost of a measured pixel
constexpr float kLeastCosine = 0.1F;    ///< between a plane's normal and the ray

/// xorshift64*.
class Random {
  public:
    explicit Random(std::uint64_t seed) : state_(seed * 0x9e3779b97f4a7c15U + 0x1234567U) {}

    /// Returns a random number from -1 to 1.
    float symmetric()
    {
        state_ ^= state_ >> 12U;
        state_ ^= state_ << 25U;
        state_ ^= state_ >> 27U;
        const std::uint64_t bits = (state_ * 0x2545f4914f6cdd1dU) >> 40U;
        return static_cast<float>(bits) * (2.0F / 16777216.0F) - 1.0F;
    }

  private:
    std::uint64_t state_;
};

float cosine(const Eigen::Vector3f& normal, const Eigen::Vector3f& ray)
{
    return -normal.dot(ray) / ray.norm();
}

/// One level of the pyramid.
struct Level {
    GrayImage image;
    Pinhole camera;
};

/// At every working size, matching starts with images of about the same size: smaller ones show too
/// little, and larger ones look alike in too many places.
int num_levels(const GrayImage& image)
{
    const double longest = std::max(image.width_px, image.height_px);
    return 1 + std::max(0, static_cast<int>(std::lround(std::log2(longest / kCoarsestPx))));
}

std::vector<Level> pyramid_of(const StereoView& view, int num_levels)
{
    std::vector<Level> levels = {{view.image, view.camera}};
    for (int i = 1; i < num_levels; ++i) {
        levels.push_back({halved(levels.back().image), halved(levels.back().camera)});
    }
    return levels;
}

class Matcher {
  public:
    static constexpr std::uint32_t kAllSources = 0xffffffffU;

    Matcher(const StereoView& view, const Level& level, std::vector<MatchedView> sources,
            int number)
        : image_(level.image),
          camera_(level.camera),
          sources_(std::move(sources)),
          random_(view.view * std::uint64_t{16} + number),
          map_(empty_depth_map(level.image)),
          chosen_of_(map_.planes.size(), kAllSources)
    {
    }

    const DepthMap& map() const { return map_; }
    Eigen::Vector3f ray(int x, int y) const { return depth_ray(camera_, x, y); }

    /// Evaluates the planes of the prior and of `coarse` (may be null), or a random plane.
    void start(const DepthPrior& prior, const DepthMap* coarse);
    void sweep(int round, const DepthPrior& prior);
    DepthMap take() { return std::move(map_); }

  private:
    /// Sets the patch of a pixel, and the sources that it is matched with.
    bool set_patch(int x, int y)
    {
        chosen_ = chosen_of_[map_.index(x, y)];
        const bool is_inside = patch_.set(image_, x * kDepthStep, y * kDepthStep);
        is_plain_ = is_inside && patch_.deviation() < kLeastDeviation;
        return is_inside && !is_plain_;
    }
    float cost(const Eigen::Vector3f& ray, const PixelPlane& plane, float most) const;
    void choose_sources(std::size_t pixel, const Eigen::Vector3f& ray, const PixelPlane& plane);
    void start_from(const DepthMap& coarse, std::size_t from, std::size_t pixel,
                    const Eigen::Vector3f& towards);
    void attempt(std::size_t pixel, const Eigen::Vector3f& ray, const PixelPlane& plane);
    void spread_from(int x, int y, std::size_t pixel, const Eigen::Vector3f& ray);
    void change(std::size_t pixel, const Eigen::Vector3f& ray, float range);
    PixelPlane random_plane(const Eigen::Vector3f& ray, const DepthPrior& prior);
    Eigen::Vector3f random_normal(const Eigen::Vector3f& ray);

    const GrayImage& image_;
    const Pinhole& camera_;
    std::vector<MatchedView> sources_;
    Random random_;
    DepthMap map_;
    std::vector<std::uint32_t> chosen_of_; ///< sources of each pixel, a bit each
    Patch patch_;
    std::uint32_t chosen_ = kAllSources; ///< sources of the current patch
    bool is_plain_ = false;              ///< whether the current patch has no texture
};

/// Returns the mean of the two best chosen sources, or `most` or more if the plane cannot cost
/// less.
float Matcher::cost(const Eigen::Vector3f& ray, const PixelPlane& plane, float most) const
{
    float best = DepthMap::kNoCost;
    float second = DepthMap::kNoCost;
    std::uint32_t left = chosen_ & ((1U << sources_.size()) - 1U);
    while (left != 0) {
        // The next source may cost nothing, but the one after it cannot replace the best, too.
        if (std::popcount(left) == 1 && 0.5F * best >= most) return most;
        const int next = std::countr_zero(left);
        left &= left - 1;
        const float cost = sources_[next].cost(patch_, ray, camera_.focal_px, plane);
        if (cost < 0.0F) continue;
        if (cost < best) {
            second = best;
            best = cost;
        } else if (cost < second) {
            second = cost;
        }
    }
    return 0.5F * (best + second);
}

void Matcher::attempt(std::size_t pixel, const Eigen::Vector3f& ray, const PixelPlane& plane)
{
    if (!(plane.depth > 0.0F) || cosine(plane.normal, ray) < kLeastCosine) return;
    const float found = cost(ray, plane, map_.costs[pixel]);
    if (found >= map_.costs[pixel]) return;
    map_.costs[pixel] = found;
    map_.planes[pixel] = plane;
}

/// Chooses the three sources in which the plane costs least, unless fewer show the patch.
void Matcher::choose_sources(std::size_t pixel, const Eigen::Vector3f& ray, const PixelPlane& plane)
{
    constexpr std::size_t kMost = 3;
    std::array<std::pair<float, std::uint32_t>, 32> costs;
    std::size_t shown = 0;
    for (std::uint32_t i = 0; i < sources_.size(); ++i) {
        const float cost = sources_[i].cost(patch_, ray, camera_.focal_px, plane);
        if (cost >= 0.0F) costs[shown++] = {cost, i};
    }
    if (shown <= kMost) return;
    std::sort(costs.begin(), costs.begin() + shown);
    chosen_ = 0;
    for (std::size_t i = 0; i < kMost; ++i) {
        chosen_ |= 1U << costs[i].second;
    }
    chosen_of_[pixel] = chosen_;
}

Eigen::Vector3f Matcher::random_normal(const Eigen::Vector3f& ray)
{
    for (;;) {
        Eigen::Vector3f normal(random_.symmetric(), random_.symmetric(), random_.symmetric());
        const float length = normal.norm();
        if (length < 0.1F || length > 1.0F) continue;
        normal /= length;
        const float facing = cosine(normal, ray);
        if (std::abs(facing) < 0.2F) continue;
        return facing > 0.0F ? normal : Eigen::Vector3f(-normal);
    }
}

PixelPlane Matcher::random_plane(const Eigen::Vector3f& ray, const DepthPrior& prior)
{
    const float share = 0.5F + 0.5F * random_.symmetric();
    return {prior.nearest * std::pow(prior.farthest / prior.nearest, share), random_normal(ray)};
}

/// Tries the plane of a pixel of the coarser level, and chooses the sources by it.
void Matcher::start_from(const DepthMap& coarse, std::size_t from, std::size_t pixel,
                         const Eigen::Vector3f& towards)
{
    const PixelPlane& plane = coarse.planes[from];
    if (coarse.costs[from] < kMostCost) choose_sources(pixel, towards, plane);
    attempt(pixel, towards, plane);
}

void Matcher::start(const DepthPrior& prior, const DepthMap* coarse)
{
    for (int y = 0; y < map_.height_px; ++y) {
        for (int x = 0; x < map_.width_px; ++x) {
            const std::size_t pixel = map_.index(x, y);
            if (!set_patch(x, y)) {
                if (is_plain_) map_.costs[pixel] = DepthMap::kPlain;
                continue;
            }
            const Eigen::Vector3f towards = ray(x, y);
            if (coarse != nullptr) {
                const int cx = std::min(x / 2, coarse->width_px - 1);
                const int cy = std::min(y / 2, coarse->height_px - 1);
                start_from(*coarse, coarse->index(cx, cy), pixel, towards);
            }
            if (!prior.surface.empty()) attempt(pixel, towards, prior.surface[pixel]);
            if (!map_.is_measured(pixel)) {
                attempt(pixel, towards, random_plane(towards, prior));
            }
        }
    }
}

/// Tries the plane of pixel (x, y), which the sweep has visited before.
void Matcher::spread_from(int x, int y, std::size_t pixel, const Eigen::Vector3f& towards)
{
    if (!map_.has(x, y)) return;
    const std::size_t from = map_.index(x, y);
    if (!map_.is_measured(from)) return;
    const PixelPlane& plane = map_.planes[from];
    const float distance = plane.depth * plane.normal.dot(ray(x, y));
    attempt(pixel, towards, {distance / plane.normal.dot(towards), plane.normal});
}

void Matcher::change(std::size_t pixel, const Eigen::Vector3f& towards, float range)
{
    constexpr float kDepthRange = 0.03F;
    constexpr float kNormalRange = 0.6F;
    const PixelPlane before = map_.planes[pixel];
    const auto depth = [&] {
        return before.depth * (1.0F + kDepthRange * range * random_.symmetric());
    };
    attempt(pixel, towards, {depth(), before.normal});
    const Eigen::Vector3f turned =
        (before.normal +
         kNormalRange * range *
             Eigen::Vector3f(random_.symmetric(), random_.symmetric(), random_.symmetric()))
            .normalized();
    attempt(pixel, towards, {map_.planes[pixel].depth, turned});
    attempt(pixel, towards, {depth(), turned});
}

void Matcher::sweep(int round, const DepthPrior& prior)
{
    constexpr float kBadCost = 0.3F;
    const bool forward = round % 2 == 0;
    const int behind = forward ? -1 : 1;
    const float range = 1.0F / static_cast<float>(1 << round);
    const int pixels = map_.width_px * map_.height_px;
    for (int i = 0; i < pixels; ++i) {
        const int at = forward ? i : pixels - 1 - i;
        const int x = at % map_.width_px;
        const int y = at / map_.width_px;
        const std::size_t pixel = map_.index(x, y);
        if (!set_patch(x, y)) continue;
        const Eigen::Vector3f towards = ray(x, y);
        for (const int step : {behind, 3 * behind}) {
            spread_from(x + step, y, pixel, towards);
            spread_from(x, y + step, pixel, towards);
        }
        if (map_.is_measured(pixel)) change(pixel, towards, range);
        if (map_.costs[pixel] > kBadCost) {
            PixelPlane plane = random_plane(towards, prior);
            if (!prior.surface.empty() && prior.surface[pixel].depth > 0.0F) {
                plane.depth = prior.surface[pixel].depth * (1.0F + 0.2F * random_.symmetric());
            }
            attempt(pixel, towards, plane);
        }
    }
}

/// The prior at a coarser level.
DepthPrior shrunk(const DepthPrior& prior, int width_px, int height_px, int factor,
                  int prior_width_px)
{
    DepthPrior result = {prior.nearest, prior.farthest, {}};
    if (prior.surface.empty()) return result;
    for (int y = 0; y < height_px; ++y) {
        for (int x = 0; x < width_px; ++x) {
            result.surface.push_back(
                prior.surface[static_cast<std::size_t>(y) * factor * prior_width_px +
                              static_cast<std::size_t>(x) * factor]);
        }
    }
    return result;
}

} // namespace

DepthMap empty_depth_map(const GrayImage& image)
{
    DepthMap map;
    map.width_px = depth_pixels(image.width_px);
    map.height_px = depth_pixels(image.height_px);
    map.planes.resize(static_cast<std::size_t>(map.width_px) * map.height_px);
    map.costs.assign(map.planes.size(), DepthMap::kNoCost);
    return map;
}

DepthMap match_view(const StereoView& view, std::span<const StereoView* const> sources,
                    const DepthPrior& prior)
{
    constexpr int kSweeps = 4;
    const int levels = num_levels(view.image);
    const std::vector<Level> own = pyramid_of(view, levels);
    std::vector<std::vector<Level>> others;
    others.reserve(sources.size());
    for (const StereoView* source : sources) {
        others.push_back(pyramid_of(*source, levels));
    }
    DepthMap coarse;
    const int prior_width = depth_pixels(view.image.width_px);
    for (int level = levels - 1; level >= 0; --level) {
        std::vector<MatchedView> matched;
        for (std::size_t i = 0; i < sources.size(); ++i) {
            matched.emplace_back(view, *sources[i], others[i][level].image,
                                 others[i][level].camera);
        }
        Matcher matcher(view, own[level], std::move(matched), level);
        const DepthMap& map = matcher.map();
        const DepthPrior here = shrunk(prior, map.width_px, map.height_px, 1 << level, prior_width);
        matcher.start(here, coarse.planes.empty() ? nullptr : &coarse);
        // The coarser level has made the first, widest search.
        for (int round = coarse.planes.empty() ? 0 : 1; round < kSweeps; ++round) {
            matcher.sweep(round, here);
        }
        coarse = matcher.take();
    }
    for (float& cost : coarse.costs) {
        if (cost > kMostCost && cost < DepthMap::kPlain) cost = DepthMap::kNoCost;
    }
    return coarse;
}

} // namespace vcarve
