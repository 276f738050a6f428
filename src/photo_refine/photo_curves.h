#pragma once

#include "photo_refine/mesh_depth.h"
#include "stereo/stereo_view.h"
#include "vcarve/tri_mesh.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace vcarve {

inline constexpr int kShifts = 5;    ///< positions of the surface: shifted by -2 to 2 steps
inline constexpr int kMostShift = 2; ///< steps, outwards or inwards

/// Pairs of photographs in groups. Pairs of the first two groups have no photograph in common, so
/// their noise is independent.
enum class PairGroup { even, odd, mixed };
inline constexpr std::size_t kPairGroups = 3;

PairGroup group_of(std::size_t reference, std::size_t source);

/// The photo-consistency of a vertex: its mean 1 - ZNCC for each shift of the surface.
struct PhotoCurve {
    std::array<float, kShifts> costs{};
    float weight = 0.0F;
    int pairs = 0; ///< pairs of photographs
};

/// Adds the curves of many pairs, fewer than 20,000 per vertex. The sums are integers, so they do
/// not depend on the order.
class CurveSums {
  public:
    explicit CurveSums(std::size_t vertices) : sums_(vertices) {}

    /// Adds a curve. `weight` is at most 1. Thread-safe.
    void add(std::uint32_t vertex, PairGroup group, const PhotoCurve& curve);

    /// The weighted mean of a group of pairs.
    PhotoCurve curve(std::size_t vertex, PairGroup group) const;
    /// The weighted mean of all pairs.
    PhotoCurve curve(std::size_t vertex) const;

  private:
    struct Sum {
        std::array<std::int32_t, kShifts> costs{};
        std::int32_t weight = 0;
        std::int32_t pairs = 0;
    };
    static PhotoCurve mean(const Sum& sum);

    std::vector<std::array<Sum, kPairGroups>> sums_;
};

/// The surface that is shifted. All arrays have an entry per vertex.
struct ShiftedSurface {
    const TriMesh& mesh;
    std::span<const Eigen::Vector3d> normals;
    std::span<const float> footprints; ///< pixel size at the vertex; infinite: not measured
    std::span<const float> steps;      ///< along the normal, in scene units; 0: not measured
};

/// A view with what it shows of the mesh.
struct ViewOfMesh {
    std::size_t photo = 0;
    const StereoView* view = nullptr;
    const MeshDepth* shown = nullptr; ///< a reference has steps
};

/// Measures how consistent a reference view is with its sources at each vertex that it sees. Each
/// source is warped into the reference through the surface shifted by -2 to 2 steps along its
/// normals (after H.-H. Vu, P. Labatut, J.-P. Pons and R. Keriven, "High accuracy and
/// visibility-consistent dense multiview stereo", PAMI 2012, with a search instead of a gradient).
/// The cost is 1 - ZNCC in a window of 7 x 7 pixels with bilateral weights. Pixels that the source
/// does not see do not count, and pairs without agreement have no weight. Cost: 5 samples per pixel
/// and source; 250 products per visible vertex and source.
void add_photo_curves(const ShiftedSurface& surface, const ViewOfMesh& reference,
                      std::span<const ViewOfMesh> sources, CurveSums& sums);

} // namespace vcarve
