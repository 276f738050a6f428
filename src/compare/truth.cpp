#include "compare/truth.h"

#include "base/numbers.h"
#include "base/parallel.h"
#include "base/statistics.h"
#include "compare/reference.h"
#include "geometry/triangle.h"
#include "model/camera.h"
#include "model/views.h"
#include "vcarve/error.h"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

namespace vcarve {
namespace {

constexpr double kMaxIncidenceDeg = 80.0;
constexpr double kTouchShare = 1e-6; ///< of the truth's diagonal: nearer hits are the sample's face
constexpr double kBlockedShare = 0.01;    ///< of the diagonal
constexpr double kSeenRightShare = 0.005; ///< of the diagonal
constexpr std::size_t kPilotSamples = 20000;
constexpr double kLeastSeenShare = 0.001;

double length_of_box(const std::vector<Eigen::Vector3d>& positions)
{
    Eigen::AlignedBox3d box;
    for (const Eigen::Vector3d& position : positions) {
        box.extend(position);
    }
    return box.isEmpty() ? 0.0 : box.diagonal().norm();
}

/// The number of views that must see a sample of the truth for it to count. One is enough if views
/// measure ranges.
int least_views(const Scene& scene)
{
    constexpr int kOfPhotographs = 3;
    return has_scanners(scene) ? 1 : kOfPhotographs;
}

/// The views that see a sample of the truth.
struct SeeingViews {
    int wanted = 0; ///< sufficient number of views
    int count = 0;
    std::uint32_t first = kNoView;          ///< first view that sees the sample
    std::uint32_t first_in_image = kNoView; ///< first with the sample in its image

    bool enough() const { return wanted > 0 && count >= wanted; }
    bool complete() const { return enough() && first_in_image != kNoView; }
    void add(std::uint32_t view, bool shows)
    {
        ++count;
        if (first == kNoView) first = view;
        if (shows && first_in_image == kNoView) first_in_image = view;
    }
};

/// Decides which views see points of the true surface.
class TruthRay {
  public:
    TruthRay(const MeasuredMesh& surface, const Reference& reference)
        : surface_(surface),
          reference_(reference),
          touch_(kTouchShare * length_of_box(surface.mesh.positions)),
          least_views_(least_views(reference.scene))
    {
    }

    /// Tests views in random order until enough see the sample, and one sees it in its image.
    SeeingViews seeing_views(const SurfaceSamples& samples, std::size_t index) const
    {
        const std::vector<View>& views = reference_.scene.views;
        const Eigen::Vector3d& point = samples.positions[index];
        const TriMesh& mesh = surface_.mesh;
        const Eigen::Vector3d normal =
            face_normal(mesh.positions, mesh.faces[samples.faces[index]]);
        std::vector<std::uint32_t> order(views.size());
        std::iota(order.begin(), order.end(), 0U);
        SeeingViews seeing{.wanted = least_views_};
        for (std::size_t k = 0; k < order.size() && !seeing.complete(); ++k) {
            // Choose the next view of a random order (Fisher and Yates).
            const auto left = static_cast<double>(order.size() - k);
            const double random = random_number(stream_seed(reference_.options, RandomStream::view),
                                                index * order.size() + k);
            std::swap(order[k], order[k + static_cast<std::size_t>(random * left)]);
            const View& view = views[order[k]];
            const auto shows = [&] {
                return view_shows(view, reference_.scene.cameras[view.camera], point);
            };
            // If enough views see the sample, only views with the sample in their image matter.
            if (seeing.enough() && !shows()) continue;
            if (sees(view.center, point, normal)) seeing.add(order[k], shows());
        }
        return seeing;
    }

  private:
    bool sees(const Eigen::Vector3d& center, const Eigen::Vector3d& point,
              const Eigen::Vector3d& normal) const
    {
        static const double least_cos = std::cos(kMaxIncidenceDeg * std::numbers::pi / 180.0);
        const Eigen::Vector3d line = center - point;
        const double length = line.norm();
        if (length <= touch_ || std::abs(normal.dot(line)) <= least_cos * length) return false;
        return !is_hidden(point, center, surface_.tree, touch_);
    }

    const MeasuredMesh& surface_;
    const Reference& reference_;
    double touch_;
    int least_views_;
};

/// Draws `count` samples of the whole surface, and stores the samples that enough views see.
void sample_truth(Truth& truth, const Reference& reference, std::size_t count, RandomStream stream)
{
    const SurfaceSamples all =
        sample_surface(truth.surface.mesh, count, stream_seed(reference.options, stream));
    const TruthRay ray(truth.surface, reference);
    std::vector<SeeingViews> views(count);
    parallel_for(
        count, [&](std::size_t i) { views[i] = ray.seeing_views(all, i); }, 64);
    truth.samples.clear();
    truth.views.clear();
    truth.image_views.clear();
    for (std::size_t i = 0; i < count; ++i) {
        if (!views[i].enough()) continue;
        truth.samples.push_back(all.positions[i]);
        truth.views.push_back(views[i].first);
        truth.image_views.push_back(views[i].first_in_image);
    }
    truth.seen_share = static_cast<double>(truth.samples.size()) / static_cast<double>(count);
}

/// The distances of samples of a mesh to the truth, and the angles between their normals.
struct Deviations {
    std::vector<double> distances;
    std::vector<double> angles_deg;
};

double angle_between_lines_deg(const Eigen::Vector3d& a, const Eigen::Vector3d& b)
{
    return std::atan2(a.cross(b).norm(), std::abs(a.dot(b))) * 180.0 / std::numbers::pi;
}

Deviations deviations(const TriMesh& mesh, const SurfaceSamples& samples, const TriangleTree& truth)
{
    const std::size_t count = samples.positions.size();
    Deviations result{std::vector<double>(count), std::vector<double>(count)};
    parallel_for(
        count,
        [&](std::size_t i) {
            const NearestFace nearest = truth.nearest(samples.positions[i]);
            const Eigen::Vector3d normal =
                face_normal(mesh.positions, mesh.faces[samples.faces[i]]);
            result.distances[i] = nearest.distance;
            result.angles_deg[i] = angle_between_lines_deg(normal, nearest.normal);
        },
        64);
    return result;
}

/// Returns nothing if no sample is near the truth.
std::optional<NormalFigures> normal_figures(const Deviations& deviations, const Truth& truth)
{
    std::vector<double> angles;
    for (std::size_t i = 0; i < deviations.distances.size(); ++i) {
        if (deviations.distances[i] <= kTolerances.back() * truth.diagonal)
            angles.push_back(deviations.angles_deg[i]);
    }
    if (angles.empty()) return std::nullopt;
    return NormalFigures{.median_deg = quantile_in_place(angles, 0.5),
                         .most_deg = quantile_in_place(angles, 0.9)};
}

double share_within(const std::vector<double>& values, double limit)
{
    const auto count = std::ranges::count_if(values, [&](double value) { return value <= limit; });
    return share_of(static_cast<std::size_t>(count), values.size());
}

double mean(const std::vector<double>& values)
{
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double blocked_share(const MeasuredMesh& mesh, const Truth& truth, const std::vector<View>& views)
{
    const auto is_blocked = [&](std::size_t i) {
        return is_hidden(truth.samples[i], views[truth.views[i]].center, mesh.tree,
                         kBlockedShare * truth.diagonal);
    };
    const std::size_t count = truth.samples.size();
    return share_of(parallel_count(count, is_blocked, 64), count);
}

enum class Meeting : char { unseen, open, torn, astray, right };

/// The first hit of the ray from a view through a sample of the truth.
Meeting meeting_of(const MeasuredMesh& mesh, const Truth& truth, const Eigen::Vector3d& center,
                   const Eigen::Vector3d& sample)
{
    const std::optional<FirstHit> hit = mesh.tree.first_hit(center, sample);
    if (!hit) return Meeting::open;
    if (!hit->front) return Meeting::torn;
    const double off = std::abs(hit->along - 1.0) * (sample - center).norm();
    return off <= kSeenRightShare * truth.diagonal ? Meeting::right : Meeting::astray;
}

/// Returns nothing if no sample of the truth is in an image.
std::optional<LineFigures> line_figures(const MeasuredMesh& mesh, const Truth& truth,
                                        const std::vector<View>& views)
{
    std::vector<Meeting> meetings(truth.samples.size(), Meeting::unseen);
    parallel_for(
        meetings.size(),
        [&](std::size_t i) {
            const std::uint32_t view = truth.image_views[i];
            if (view == kNoView) return;
            meetings[i] = meeting_of(mesh, truth, views[view].center, truth.samples[i]);
        },
        64);
    const auto count = [&](Meeting meeting) {
        return static_cast<double>(std::ranges::count(meetings, meeting));
    };
    const double lines = static_cast<double>(meetings.size()) - count(Meeting::unseen);
    if (lines == 0.0) return std::nullopt;
    return LineFigures{.seen_right = count(Meeting::right) / lines,
                       .torn = count(Meeting::torn) / lines,
                       .open = count(Meeting::open) / lines};
}

} // namespace

Truth seen_truth(const NamedMesh& named, const Reference& reference)
{
    Truth truth{
        .surface = place_mesh(named, reference), .samples = {}, .views = {}, .image_views = {}};
    const auto wanted = static_cast<std::size_t>(reference.options.samples);
    sample_truth(truth, reference, kPilotSamples, RandomStream::pilot);
    // Only a part of the area is seen: draw more samples accordingly, and still more if too few
    // remain.
    double surplus = 1.0;
    do {
        surplus *= 1.02;
        if (truth.seen_share < kLeastSeenShare) {
            throw InputError(fmt::format(
                "{}: less than a thousandth of the true surface is visible from "
                "{} or more of the model's {} views, so meshes cannot be "
                "compared with it",
                named.name, least_views(reference.scene), reference.scene.views.size()));
        }
        const double draws = surplus * static_cast<double>(wanted) / truth.seen_share;
        sample_truth(truth, reference, static_cast<std::size_t>(draws), RandomStream::truth);
    } while (truth.samples.size() < wanted);
    truth.diagonal = length_of_box(truth.samples);
    return truth;
}

TruthFigures measure_against_truth(const MeasuredMesh& mesh, const Reference& reference)
{
    const Truth& truth = *reference.truth;
    const auto count = static_cast<std::size_t>(reference.options.samples);
    const SurfaceSamples samples =
        sample_surface(mesh.mesh, count, stream_seed(reference.options, RandomStream::mesh));
    const Deviations from_truth = deviations(mesh.mesh, samples, truth.surface.tree);
    const std::vector<double>& to_truth = from_truth.distances;
    const std::vector<double> to_mesh = distances_to(mesh.tree, truth.samples);

    TruthFigures figures;
    for (std::size_t i = 0; i < kTolerances.size(); ++i) {
        const double limit = kTolerances[i] * truth.diagonal;
        const double precision = share_within(to_truth, limit);
        const double recall = share_within(to_mesh, limit);
        const double sum = precision + recall;
        const double f_score = sum > 0.0 ? 2.0 * precision * recall / sum : 0.0;
        figures.agreements[i] = {kTolerances[i], precision, recall, f_score};
    }
    figures.mean_accuracy = mean(to_truth) / truth.diagonal;
    figures.mean_completeness = mean(to_mesh) / truth.diagonal;
    figures.blocked = blocked_share(mesh, truth, reference.scene.views);
    figures.lines = line_figures(mesh, truth, reference.scene.views);
    figures.normals = normal_figures(from_truth, truth);
    return figures;
}

} // namespace vcarve
