#include "stereo/choose_sources.h"

#include "base/parallel.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace vcarve {

namespace {

constexpr std::uint32_t kNoView = 0xffffffffU;
constexpr double kLeastScore = 5.0;
constexpr std::size_t kMostOfTrack = 64; ///< views that are compared; longer tracks are subsampled

/// The score of a point for two views whose rays to it meet at this angle.
double score_of(double angle_deg)
{
    if (angle_deg < 3.0) return angle_deg / 30.0;
    if (angle_deg < 25.0) return 1.0;
    return angle_deg < 45.0 ? 0.4 : 0.05;
}

double angle_deg(const Eigen::Vector3d& a, const Eigen::Vector3d& b)
{
    return std::atan2(a.cross(b).norm(), a.dot(b)) * 180.0 / std::numbers::pi;
}

/// The points that each view sees.
std::vector<std::vector<std::uint32_t>>
points_of_views(const Scene& scene, const std::vector<std::uint32_t>& slots, std::size_t num_views)
{
    std::vector<std::vector<std::uint32_t>> points(num_views);
    for (std::uint32_t point = 0; point < scene.num_points(); ++point) {
        for (const std::uint32_t view : scene.tracks[point]) {
            if (slots[view] != kNoView) points[slots[view]].push_back(point);
        }
    }
    return points;
}

} // namespace

std::vector<std::vector<std::uint32_t>>
choose_sources(const Scene& scene, const std::vector<StereoView>& views, std::size_t most)
{
    std::vector<std::uint32_t> slots(scene.views.size(), kNoView);
    for (std::uint32_t i = 0; i < views.size(); ++i) {
        slots[views[i].view] = i;
    }
    const auto points = points_of_views(scene, slots, views.size());
    std::vector<std::vector<std::uint32_t>> sources(views.size());
    const auto choose = [&](std::size_t self) {
        std::vector<double> scores(views.size());
        for (const std::uint32_t point : points[self]) {
            const auto track = scene.tracks[point];
            const Eigen::Vector3d& position = scene.positions[point];
            const std::size_t step = track.size() / kMostOfTrack + 1;
            for (std::size_t i = point % step; i < track.size(); i += step) {
                const std::uint32_t other = slots[track[i]];
                if (other == kNoView || other == self) continue;
                scores[other] += score_of(
                    angle_deg(views[self].center - position, views[other].center - position));
            }
        }
        std::vector<std::uint32_t>& chosen = sources[self];
        for (std::uint32_t other = 0; other < views.size(); ++other) {
            if (scores[other] > kLeastScore) chosen.push_back(other);
        }
        std::ranges::stable_sort(chosen, std::ranges::greater(),
                                 [&](std::uint32_t other) { return scores[other]; });
        if (chosen.size() > most) chosen.resize(most);
    };
    parallel_for(views.size(), choose, 1);
    return sources;
}

} // namespace vcarve
