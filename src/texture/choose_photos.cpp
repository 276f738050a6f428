#include "texture/choose_photos.h"

#include "base/parallel.h"
#include "geometry/triangle.h"
#include "mesh/edge_table.h"
#include "model/tet_mesh.h"
#include "model/visibility_energy.h"
#include "steps/5_labels/max_flow/max_flow.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace vcarve {

namespace {

constexpr double kSidePx = 40.0;    ///< side of a square, the unit of cost
constexpr double kCostOfSeam = 0.6; ///< of a seam of kSidePx, in squares
constexpr double kUnit = 10000.0;   ///< integer cost of one square
constexpr double kMost = 1e6;

/// The costs of faces and of seams.
class Energy {
  public:
    Energy(const TriMesh& mesh, const std::vector<PhotosOfFace>& photos_of_faces,
           const FacesBeside& beside)
        : photos_of_faces_(photos_of_faces), seams_(mesh.faces.size())
    {
        parallel_for(seams_.size(), [&](std::size_t face) {
            if (photos_of_faces[face].count == 0) return;
            for (int i = 0; i < 3; ++i) {
                const std::uint32_t other = beside[face][i];
                if (other == kNoFace || photos_of_faces[other].count == 0) continue;
                const Face& corners = mesh.faces[face];
                const double length =
                    (mesh.positions[corners[i]] - mesh.positions[corners[(i + 1) % 3]]).norm();
                const double length_px =
                    length * 0.5 * (pixels_a_unit(mesh, face) + pixels_a_unit(mesh, other));
                seams_[face][i] = whole(kCostOfSeam * length_px / kSidePx);
            }
        });
    }

    /// The cost of a face with photograph number `place` of its list.
    std::int32_t of_face(std::uint32_t face, std::size_t place) const
    {
        const auto shown = photos_of_faces_[face].shown();
        const double lost = shown.front().area_px2 - shown[place].area_px2;
        return whole(lost / (kSidePx * kSidePx));
    }

    std::int32_t of_seam(std::uint32_t face, int side) const { return seams_[face][side]; }

  private:
    static std::int32_t whole(double squares)
    {
        return static_cast<std::int32_t>(std::min(kUnit * squares, kMost));
    }

    /// Pixels per unit of length in the photograph that shows the face largest.
    double pixels_a_unit(const TriMesh& mesh, std::size_t face) const
    {
        const double area = face_area(mesh.positions, mesh.faces[face]);
        const double area_px2 = photos_of_faces_[face].shown().front().area_px2;
        return area > 0.0 ? std::sqrt(area_px2 / area) : 0.0;
    }

    const std::vector<PhotosOfFace>& photos_of_faces_;
    std::vector<std::array<std::int32_t, 3>> seams_;
};

/// An edge of a face, and the node of the face in the cut.
struct Side {
    Index node;
    std::uint32_t face;
    int side;
};

/// The current photograph of each face. expand() improves it.
class Covering {
  public:
    Covering(const Energy& energy, const std::vector<PhotosOfFace>& photos_of_faces,
             const FacesBeside& beside)
        : energy_(energy),
          beside_(beside),
          photos_(photos_of_faces.size(), kNoPhoto),
          places_(photos_of_faces.size()),
          node_of_(photos_of_faces.size(), kNoFace)
    {
        for (std::size_t face = 0; face < photos_.size(); ++face) {
            if (photos_of_faces[face].count > 0) {
                photos_[face] = photos_of_faces[face].best[0].photo;
            }
        }
    }

    /// Assigns `photo` to the subset of `shown` that minimizes the total cost. Returns whether any
    /// face changed.
    bool expand(std::uint32_t photo, const std::vector<FaceOfPhoto>& shown)
    {
        for (Index node = 0; node < shown.size(); ++node) {
            node_of_[shown[node].face] = node;
        }
        const auto count = static_cast<Index>(shown.size());
        TetMesh graph;
        graph.cells.resize(count);
        graph.mirrors.resize(count);
        FlowNetwork network;
        network.arc_capacities.assign(count, {});
        network.terminal_capacities.assign(count, 0);
        for (Index node = 0; node < count; ++node) {
            const auto [face, place] = shown[node];
            network.terminal_capacities[node] +=
                energy_.of_face(face, place) - energy_.of_face(face, places_[face]);
            Cell& cell = graph.cells[node];
            cell = {{0, 0, 0, 0}, {node, node, node, node}};
            graph.mirrors[node] = 0b11100100; // slot i mirrors slot i
            for (int side = 0; side < 3; ++side) {
                add_seam(photo, {node, face, side}, graph, network);
            }
        }
        const Labels labels = minimum_cut(graph, std::move(network));
        bool is_changed = false;
        for (Index node = 0; node < count; ++node) {
            const auto [face, place] = shown[node];
            node_of_[face] = kNoFace;
            if (labels[node] == Label::outside || photos_[face] == photo) continue;
            photos_[face] = photo;
            places_[face] = place;
            is_changed = true;
        }
        return is_changed;
    }

    std::vector<std::uint32_t> take() { return std::move(photos_); }

  private:
    /// Adds the cost of the seam along an edge; the label inside means that a face gets `photo`. If
    /// the neighbor is a node, too, the lower node adds the cost.
    void add_seam(std::uint32_t photo, const Side& of, TetMesh& graph, FlowNetwork& network) const
    {
        const Index node = of.node;
        const std::uint32_t face = of.face;
        const int side = of.side;
        const std::uint32_t other = beside_[face][side];
        if (other == kNoFace || photos_[other] == kNoPhoto) return;
        const std::int32_t cost = energy_.of_seam(face, side);
        const auto seam = [&](std::uint32_t a, std::uint32_t b) { return a == b ? 0 : cost; };
        const Index other_node = node_of_[other];
        if (other_node == kNoFace) {
            network.terminal_capacities[node] +=
                seam(photo, photos_[other]) - seam(photos_[face], photos_[other]);
            return;
        }
        graph.cells[node].neighbors[side] = other_node;
        const int mirror =
            static_cast<int>(std::ranges::find(beside_[other], face) - beside_[other].begin());
        graph.mirrors[node] = static_cast<std::uint8_t>((graph.mirrors[node] & ~(3 << (2 * side))) |
                                                        (mirror << (2 * side)));
        if (node > other_node) return;
        // The costs if neither face or only one changes. If both change, there is no seam.
        const std::int32_t neither = seam(photos_[face], photos_[other]);
        const std::int32_t only_other = seam(photos_[face], photo);
        const std::int32_t only_face = seam(photo, photos_[other]);
        network.terminal_capacities[node] += only_face - neither;
        network.terminal_capacities[other_node] -= only_face;
        network.arc_capacities[node][side] = only_other + only_face - neither;
    }

    const Energy& energy_;
    const FacesBeside& beside_;
    std::vector<std::uint32_t> photos_;
    std::vector<std::uint32_t> places_; ///< index of the photograph in the face's list
    std::vector<Index> node_of_;        ///< node of each face in the current cut
};

} // namespace

FacesBeside find_faces_beside(const TriMesh& mesh)
{
    FacesBeside beside(mesh.faces.size(), {kNoFace, kNoFace, kNoFace});
    const EdgeTable edges = gather_edges(mesh.faces, mesh.positions.size());
    parallel_for(edges.size(), [&](std::size_t edge) {
        const auto half_edges = edges[edge];
        if (half_edges.size() != 2 ||
            tail(mesh.faces, half_edges[0]) == tail(mesh.faces, half_edges[1])) {
            return;
        }
        beside[half_edges[0] / 3][half_edges[0] % 3] = half_edges[1] / 3;
        beside[half_edges[1] / 3][half_edges[1] % 3] = half_edges[0] / 3;
    });
    // List a neighbor that shares two edges only once.
    parallel_for(beside.size(), [&](std::size_t face) {
        auto& [first, second, third] = beside[face];
        if (second == first) second = kNoFace;
        if (third == first || third == second) third = kNoFace;
    });
    return beside;
}

std::vector<std::uint32_t> choose_photos(const TriMesh& mesh,
                                         const std::vector<CalibratedPhoto>& photos,
                                         const std::vector<PhotosOfFace>& photos_of_faces,
                                         const FacesBeside& beside, const Progress& progress)
{
    const auto shown = faces_of_photos(photos.size(), photos_of_faces);
    const Energy energy(mesh, photos_of_faces, beside);
    Covering covering(energy, photos_of_faces, beside);
    constexpr std::size_t kRounds = 2;
    for (std::size_t round = 0; round < kRounds; ++round) {
        bool is_changed = false;
        for (std::uint32_t photo = 0; photo < photos.size(); ++photo) {
            if (!shown[photo].empty()) is_changed |= covering.expand(photo, shown[photo]);
            progress.report(static_cast<double>(round * photos.size() + photo + 1),
                            static_cast<double>(kRounds * photos.size()));
        }
        if (!is_changed) break;
    }
    return covering.take();
}

} // namespace vcarve
