#pragma once

#include "mesh/vertex_faces.h"
#include "model/keypoints.h"
#include "steps/4_visibility/face_visibility.h"
#include "steps/5_labels/boundary.h"

#include <Eigen/Core>

#include <cstdint>
#include <optional>
#include <vector>

namespace vcarve {

/// Whether a facet is kept, for facets in ascending order. Keeps references.
class KeptFacets {
  public:
    KeptFacets(const std::vector<CellFacet>& facets, const FaceFlags& keep)
        : facets_(facets), keep_(keep)
    {
    }

    bool operator()(const CellFacet& facet) const { return keep_[place_of(facet, facets_)] != 0; }

  private:
    const std::vector<CellFacet>& facets_;
    const FaceFlags& keep_;
};

/// All views, and what there is of the boundary for them to see. Safe from many threads as long as
/// none changes what is kept.
class Onlookers {
  public:
    Onlookers(const FaceVisibility& visibility, const std::vector<CellFacet>& facets,
              const FaceFlags& keep)
        : visibility_(visibility), is_kept_(facets, keep)
    {
    }

    /// Whether one of them sees a place on a facet, with nothing that is kept in between.
    bool see(const CellFacet& facet, const Eigen::Vector3d& place) const
    {
        return any_that_sees(facet, place, [](std::uint32_t) { return true; });
    }

    /// The same where a graze counts as well.
    bool see_or_graze(const CellFacet& facet, const Eigen::Vector3d& place) const
    {
        return any_that_sees(
            facet, place, [](std::uint32_t) { return true; }, 0.0);
    }

    /// Whether they see less than so large a share of the places on a facet.
    bool see_less_than(double share, const CellFacet& facet) const
    {
        const std::vector<Eigen::Vector3d> places = visibility_.places_on(facet);
        const double enough = share * static_cast<double>(places.size());
        double seen = 0.0;
        for (const Eigen::Vector3d& place : places) {
            if (see(facet, place)) seen += 1.0;
            if (seen >= enough) return false;
        }
        return true;
    }

    /// How densely keypoints lie where the images show a facet, in the mean over the lines on which
    /// they see it (keypoint_density). Nothing where no keypoints are known there.
    std::optional<double> keypoints_on(const CellFacet& facet) const
    {
        constexpr int kToASide = 6;
        const Scene& scene = visibility_.scene();
        double sum = 0.0;
        double lines = 0.0;
        for (const Eigen::Vector3d& place : grid_on(visibility_.corners_of(facet), kToASide)) {
            for (std::uint32_t view = 0; view < scene.views.size(); ++view) {
                if (!visibility_.sees_among(view, facet, place, is_kept_)) continue;
                const View& eye = scene.views[view];
                const auto density = keypoint_density(eye, scene.cameras[eye.camera], place);
                if (!density) continue;
                sum += *density;
                lines += 1.0;
            }
        }
        if (lines == 0.0) return std::nullopt;
        return sum / lines;
    }

    /// Whether one of them would look onto the back of a kept face, were this facet away.
    bool would_see_a_back_behind(const CellFacet& facet) const
    {
        for (const Eigen::Vector3d& place : visibility_.places_on(facet)) {
            const auto sees_a_back = [&](std::uint32_t view) {
                return visibility_.met_behind(view, facet, place, is_kept_) ==
                       FaceVisibility::Meets::back;
            };
            if (any_that_sees(facet, place, sees_a_back)) return true;
        }
        return false;
    }

  private:
    /// Whether for one of those that see a place, by more than a cosine, ask(view) says yes.
    template <typename Ask>
    bool any_that_sees(const CellFacet& facet, const Eigen::Vector3d& place, const Ask& ask,
                       double cosine = kGrazing) const
    {
        return visibility_.any_view(facet, [&](std::uint32_t view) {
            return visibility_.sees_among(view, facet, place, is_kept_, cosine) && ask(view);
        });
    }

    const FaceVisibility& visibility_;
    KeptFacets is_kept_;
};

} // namespace vcarve
