#include "paper/place_views.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <set>
#include <stdexcept>

namespace vcarve::paper {

namespace {

using Cell = std::array<std::uint32_t, 4>;

constexpr int kCandidatesARound = 150;
constexpr int kMostRounds = 200;
constexpr std::size_t kLeastViewsOfASample = 6;
constexpr double kLeastAngleDeg = 20.0;

int sign(std::int64_t value)
{
    return (value > 0) - (value < 0);
}

enum class Crossing { none, inside, degenerate };

/// Classifies the segment from p to c and a triangle: the segment crosses its relative interior,
/// misses it, or is degenerate (touches an edge or a corner other than p, or lies in its plane).
Crossing crossing(const Spot& p, const Spot& c, const std::array<Spot, 3>& t)
{
    const int below = sign(volume_6(t[0], t[1], t[2], p));
    const int above = sign(volume_6(t[0], t[1], t[2], c));
    if (below == above && below != 0) return Crossing::none;
    const std::array<int, 3> turns{sign(volume_6(p, c, t[0], t[1])),
                                   sign(volume_6(p, c, t[1], t[2])),
                                   sign(volume_6(p, c, t[2], t[0]))};
    const auto [low, high] = std::minmax_element(turns.begin(), turns.end());
    if (*low < 0 && *high > 0) return Crossing::none;
    return *low == 0 || *high == 0 || below == 0 || above == 0 ? Crossing::degenerate
                                                               : Crossing::inside;
}

/// The rotation whose axis is closest to `way`.
int rotation_towards(const Spot& way)
{
    const auto& rotations = exact_rotations();
    const auto forward = [&](const Eigen::Quaterniond& rotation) {
        return rotation.toRotationMatrix().row(2).dot(way.cast<double>());
    };
    const auto best =
        std::max_element(rotations.begin(), rotations.end(),
                         [&](const auto& a, const auto& b) { return forward(a) < forward(b); });
    return static_cast<int>(best - rotations.begin());
}

bool in_image(const ExactView& view, const Spot& spot)
{
    const Eigen::Matrix3d rotation = exact_rotations()[view.rotation].toRotationMatrix();
    if ((rotation * (spot - view.center).cast<double>()).z() <= 0.0) return false;
    const Eigen::Vector2d pixel = project(view, spot);
    return pixel.minCoeff() >= 0.0 && pixel.maxCoeff() <= kImageSizePx;
}

/// Chooses views greedily: each is the candidate that adds most.
class Placement {
  public:
    Placement(const BoxSolid& solid, const std::vector<Spot>& samples, const Cells& cells,
              std::mt19937_64& random)
        : solid_(solid),
          samples_(samples),
          open_(cells.empty),
          all_(cells.solid),
          random_(random),
          seen_from_(samples.size())
    {
        all_.insert(all_.end(), cells.empty.begin(), cells.empty.end());
        reach_ = static_cast<double>((solid.high() - solid.low()).maxCoeff());
    }

    std::vector<ExactView> run()
    {
        for (int round = 0; round < kMostRounds; ++round) {
            const std::vector<std::uint32_t> weak = weak_samples();
            if (open_.empty() && weak.empty()) return views_;
            if (const auto best = best_candidate(weak)) take(*best);
        }
        throw std::runtime_error("found no views that see into every cell");
    }

  private:
    double uniform(double low, double high)
    {
        return std::uniform_real_distribution<double>(low, high)(random_);
    }

    std::uint32_t pick(std::size_t count)
    {
        return std::uniform_int_distribution<std::uint32_t>(0, count - 1)(random_);
    }

    /// A lattice position with odd coordinates, which is in no plane of the solid.
    static Spot odd_spot(const Eigen::Vector3d& place)
    {
        Spot spot;
        for (int k = 0; k < 3; ++k) {
            spot[k] = 2 * static_cast<std::int64_t>(std::floor(place[k] / 2)) + 1;
        }
        return spot;
    }

    bool is_weak(std::uint32_t sample) const
    {
        const auto& rays = seen_from_[sample];
        double least_cosine = 1.0;
        for (const auto& a : rays) {
            for (const auto& b : rays) {
                least_cosine = std::min(least_cosine, a.dot(b));
            }
        }
        const double wanted = std::cos(kLeastAngleDeg * std::numbers::pi / 180.0);
        return rays.size() < kLeastViewsOfASample || least_cosine > wanted;
    }

    std::vector<std::uint32_t> weak_samples() const
    {
        std::vector<std::uint32_t> result;
        for (std::uint32_t i = 0; i < samples_.size(); ++i) {
            if (is_weak(i)) result.push_back(i);
        }
        return result;
    }

    /// A view of one sample along a direction, as far out as the ray is unoccluded.
    std::optional<ExactView> view_along(std::uint32_t sample, const Eigen::Vector3d& way)
    {
        const Eigen::Vector3d begin = samples_[sample].cast<double>();
        for (double far = uniform(1.2, 2.0) * reach_; far > reach_ / 64; far *= 0.7) {
            const Spot center = odd_spot(begin + far * way.normalized());
            if (!solid_.sees(samples_[sample], center)) continue;
            return ExactView{center, rotation_towards(samples_[sample] - center), {}};
        }
        return std::nullopt;
    }

    /// A view with a ray from a corner through a random open cell, or of a weak sample.
    std::optional<ExactView> candidate(const std::vector<std::uint32_t>& weak)
    {
        if (open_.empty() || (!weak.empty() && uniform(0.0, 1.0) < 0.3)) {
            const Eigen::Vector3d way(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1));
            return view_along(weak[pick(weak.size())], way);
        }
        const Cell& cell = open_[pick(open_.size())];
        const std::uint32_t apex = pick(4);
        Eigen::Vector3d way = Eigen::Vector3d::Zero();
        for (int i = 0; i < 4; ++i) {
            way += uniform(0.1, 1.0) * (samples_[cell[i]] - samples_[cell[apex]]).cast<double>();
        }
        return view_along(cell[apex], way);
    }

    void look(ExactView& view) const
    {
        for (std::uint32_t i = 0; i < samples_.size(); ++i) {
            if (in_image(view, samples_[i]) && solid_.sees(samples_[i], view.center)) {
                view.sees.push_back(i);
            }
        }
    }

    /// The clearest crossing of a view's rays with any facet of a cell, or a degenerate one.
    Crossing meets(const ExactView& view, const Cell& cell) const
    {
        Crossing result = Crossing::none;
        for (const std::uint32_t sample : view.sees) {
            for (int slot = 0; slot < 4; ++slot) {
                const Cell& c = cell;
                const std::array<std::uint32_t, 3> facet{c[(slot + 1) % 4], c[(slot + 2) % 4],
                                                         c[(slot + 3) % 4]};
                if (std::find(facet.begin(), facet.end(), sample) != facet.end()) continue;
                const Crossing found =
                    crossing(samples_[sample], view.center,
                             {samples_[facet[0]], samples_[facet[1]], samples_[facet[2]]});
                if (found == Crossing::degenerate) return found;
                if (found == Crossing::inside) result = found;
            }
        }
        return result;
    }

    std::size_t gain(const ExactView& view, const std::vector<std::uint32_t>& weak) const
    {
        const auto opened = std::count_if(open_.begin(), open_.end(), [&](const Cell& cell) {
            return meets(view, cell) == Crossing::inside;
        });
        std::vector<std::uint32_t> helped;
        std::set_intersection(view.sees.begin(), view.sees.end(), weak.begin(), weak.end(),
                              std::back_inserter(helped));
        return 3 * static_cast<std::size_t>(opened) + helped.size();
    }

    bool is_degenerate(const ExactView& view) const
    {
        return std::any_of(all_.begin(), all_.end(), [&](const Cell& cell) {
            return meets(view, cell) == Crossing::degenerate;
        });
    }

    std::optional<ExactView> best_candidate(const std::vector<std::uint32_t>& weak)
    {
        std::optional<ExactView> best;
        std::size_t best_gain = 0;
        for (int i = 0; i < kCandidatesARound; ++i) {
            auto view = candidate(weak);
            if (!view) continue;
            look(*view);
            const std::size_t found = gain(*view, weak);
            if (found > best_gain && !is_degenerate(*view)) {
                best = view;
                best_gain = found;
            }
        }
        return best;
    }

    void take(const ExactView& view)
    {
        std::erase_if(open_,
                      [&](const Cell& cell) { return meets(view, cell) == Crossing::inside; });
        for (const std::uint32_t sample : view.sees) {
            seen_from_[sample].push_back(
                (view.center - samples_[sample]).cast<double>().normalized());
        }
        views_.push_back(view);
    }

    const BoxSolid& solid_;
    const std::vector<Spot>& samples_;
    std::vector<Cell> open_; ///< empty cells without a crossing ray
    std::vector<Cell> all_;
    std::mt19937_64& random_;
    std::vector<std::vector<Eigen::Vector3d>> seen_from_; ///< for each sample
    std::vector<ExactView> views_;
    double reach_ = 0.0; ///< the longest side of the solid's box
};

} // namespace

const std::vector<Eigen::Quaterniond>& exact_rotations()
{
    static const std::vector<Eigen::Quaterniond> rotations = [] {
        std::vector<Eigen::Quaterniond> result{
            {1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}};
        for (int i = 0; i < 8; ++i) {
            result.emplace_back(0.5, (i & 1) != 0 ? -0.5 : 0.5, (i & 2) != 0 ? -0.5 : 0.5,
                                (i & 4) != 0 ? -0.5 : 0.5);
        }
        return result;
    }();
    return rotations;
}

Eigen::Vector2d project(const ExactView& view, const Spot& spot)
{
    const Eigen::Matrix3d rotation = exact_rotations()[view.rotation].toRotationMatrix();
    const Eigen::Vector3d in_cam = rotation * (spot - view.center).cast<double>();
    return kFocalPx * in_cam.head<2>() / in_cam.z() + Eigen::Vector2d::Constant(kImageSizePx / 2.0);
}

std::vector<ExactView> place_views(const BoxSolid& solid, const std::vector<Spot>& samples,
                                   const Cells& cells, std::mt19937_64& random)
{
    return Placement(solid, samples, cells, random).run();
}

} // namespace vcarve::paper
