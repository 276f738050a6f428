#pragma once

#include "base/progress.h"
#include "base/stage_counts.h"
#include "mesh/vertices.h"
#include "model/tet_mesh.h"
#include "model/usual_values.h"
#include "region/region.h"
#include "steps/6_surface/openness.h"
#include "vcarve/options.h"
#include "vcarve/scene.h"
#include "vcarve/tri_mesh.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace vcarve {

/// The reason why a boundary face is not in the mesh.
enum class Removal : std::uint8_t { unseen, closing, outside_region, small_piece, trimmed };

inline constexpr std::array<std::string_view, 5> kRemovalNames = {
    counts::kSurface.unseen.key, counts::kSurface.unsupported.key, counts::kSurface.outside.key,
    "small pieces", counts::kSurface.trimmed.key};

/// The removed faces with reasons. Vertices have only positions, in the frame of the scene.
struct RemovedFaces {
    TriMesh mesh;
    std::vector<Removal> reasons; ///< one per face
};

class HalfEdgeMesh;

/// Records removed faces and reasons. Without a recipient it does and costs nothing.
class Removals {
  public:
    /// `wanted` receives the faces; null disables recording.
    explicit Removals(RemovedFaces* wanted) : wanted_(wanted) {}

    /// Assigns the reason to the boundary faces that lost their flag since the last call. Faces
    /// that got their flag back are no longer removed.
    void note(const FaceFlags& keep, Removal reason);
    /// Adds the noted faces. The flags are those of `boundary`.
    void add_noted(const TriMesh& boundary);
    /// Adds the deleted faces with indices below `end`, as small pieces.
    void add_deleted(const HalfEdgeMesh& mesh, std::size_t end);

  private:
    static constexpr std::uint8_t kKept = 0xff;

    RemovedFaces* wanted_;
    std::vector<std::uint8_t> why_; ///< per boundary face: the reason, or kKept
};

/// Returns the boundary of the inside (Akgunduz, Zetu, Banerjee 2000, section 4.4): every facet
/// between an inside and an outside cell, counter-clockwise seen from outside, with the colors of
/// the scene's points. It is closed, consistently oriented, and may be non-manifold where cells
/// touch in an edge or a vertex. Vertices and faces follow the order of the cells. Throws
/// InputError if the number of faces exceeds the range of indices. Cost: O(cells), in parallel.
TriMesh extract_surface(const TetMesh& cells, const Labels& labels, const Scene& scene);

/// The same for a given boundary: face i is facet i.
TriMesh extract_surface(const TetMesh& cells, const std::vector<CellFacet>& facets,
                        const Scene& scene);

/// The input of carve_surface(), except the labels.
struct SurfaceInput {
    const TetMesh& cells;
    const Scene& scene;
    const Region* region = nullptr; ///< the region to reconstruct; null for all of space
    bool wants_removed = false;     ///< whether CarvedSurface::removed is filled
    UsualValues* usual = nullptr;   ///< measured, unless known
    bool measures_openness = true;  ///< of a surface that is not closed, without a region
};

/// The number of dropped boundary faces, by reason.
struct CarvedCounts {
    std::int64_t unseen = 0;
    std::int64_t closing = 0; ///< unsupported
    std::int64_t trimmed = 0;
    std::int64_t out_of_region = 0;
};

/// The selected faces, before cleanup (cleanup.h).
struct CarvedSurface {
    TriMesh faces; ///< with TriMesh::points
    /// The openness of the faces; empty for a closed surface, or with a region.
    std::optional<Openness> openness;
    RemovedFaces removed;
    CarvedCounts counts;
};

/// Selects the boundary faces that views support (face_rules.h), or all for a closed surface. With
/// a region, all corners of a face must be inside it. Throws InputError if no face remains.
CarvedSurface carve_surface(Labels labels, const SurfaceInput& input, const SurfaceOptions& options,
                            const Progress& progress);

} // namespace vcarve
