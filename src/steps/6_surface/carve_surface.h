#pragma once

#include "base/progress.h"
#include "mesh/vertices.h"
#include "model/tet_mesh.h"
#include "region/region.h"
#include "steps/6_surface/openness.h"
#include "vcarve/options.h"
#include "vcarve/scene.h"
#include "vcarve/tri_mesh.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace vcarve {

/// Why a face of the boundary is not in the surface.
enum class Removal : std::uint8_t { unseen, closing, outside_region, small_piece, trimmed };

/// What each is called, as the stages count them.
inline constexpr std::array<const char*, 5> kRemovalNames = {
    "unseen", "closing without support", "outside the region", "small pieces", "trimmed"};

/// The faces that were taken away, and why. Vertices have places only, in the frame of the scene.
struct RemovedFaces {
    TriMesh mesh;
    std::vector<Removal> reasons; ///< one a face
};

class HalfEdgeMesh;

/// Keeps account of which faces are taken away and why, where somebody wants to know; otherwise it
/// does nothing and costs nothing.
class Removals {
  public:
    /// `wanted` is what the faces are added to; null where nobody wants them.
    explicit Removals(RemovedFaces* wanted) : wanted_(wanted) {}

    /// Of the faces of a boundary, those that have lost their flag since the last time lost it for
    /// this reason; those that have got it back are not taken away.
    void note(const FaceFlags& keep, Removal reason);
    /// Adds the faces that were noted. `boundary` is what the flags are of.
    void add_noted(const TriMesh& boundary);
    /// Adds the faces before `end` that were deleted: small pieces.
    void add_deleted(const HalfEdgeMesh& mesh, std::size_t end);

  private:
    static constexpr std::uint8_t kKept = 0xff;

    RemovedFaces* wanted_;
    std::vector<std::uint8_t> why_; ///< per face of the boundary: the reason, or kKept
};

/// The boundary of the inside (Akgunduz, Zetu, Banerjee 2000, section 4.4): every facet between an
/// inside and an outside cell, counter-clockwise seen from outside, with the colours of the scene's
/// points. Closed, consistently oriented, possibly non-manifold where cells touch in an edge or a
/// vertex. Vertices and faces follow the order of the cells. Throws InputError where
/// there are more faces than can be numbered. Cost: O(cells), in parallel.
TriMesh extract_surface(const TetMesh& cells, const Labels& labels, const Scene& scene);

/// The same where the boundary is at hand: face i is facet i.
TriMesh extract_surface(const TetMesh& cells, const std::vector<CellFacet>& facets,
                        const Scene& scene);

/// The input of a surface, beside labels of the cells.
struct SurfaceInput {
    const TetMesh& cells;
    const Scene& scene;
    const Region* region = nullptr; ///< the part of space that is wanted; null for all
    bool wants_removed = false;     ///< whether CarvedSurface::removed is filled
};

/// How many faces of the boundary a surface leaves out, by reason.
struct CarvedCounts {
    std::int64_t unseen = 0;
    std::int64_t closing = 0; ///< without support
    std::int64_t trimmed = 0;
    std::int64_t out_of_region = 0;
};

/// The faces that were chosen for a surface, before they are cleaned (cleanup.h).
struct CarvedSurface {
    TriMesh faces; ///< with TriMesh::points
    /// How much they leave open; unknown if all faces are kept, or a region leaves some out.
    std::optional<Openness> openness;
    RemovedFaces removed;
    CarvedCounts counts;
};

/// Of the boundary of the labels (extract_surface) the faces that views support (face_rules.h), or
/// all where the surface is to be closed, and of these, where there is a region, those whose
/// corners all lie within it. Throws InputError where no face is left.
CarvedSurface carve_surface(Labels labels, const SurfaceInput& input, const SurfaceOptions& options,
                            const Progress& progress);

} // namespace vcarve
