#include "texture/seam_blends.h"

#include "mesh/vertices.h"

#include <algorithm>
#include <map>
#include <queue>
#include <set>
#include <tuple>

namespace vcarve {

namespace {

using Eigen::Array3f;

constexpr double kWidthPx = 16.0; ///< of a blend on one side of a seam, in texels

/// A vertex within the faces of a photograph, and another photograph that shows through there.
using Through = std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>; ///< vertex, photo, other

/// How far it is to the seam, and what is added to the other's colours there.
struct Near {
    double distance_px;
    Array3f level;
};

struct Waiting {
    double distance_px;
    Through through;
    Array3f level;

    /// The nearest first; which of equally far ones comes first must not be left to chance.
    bool operator<(const Waiting& other) const
    {
        return std::tie(distance_px, through) > std::tie(other.distance_px, other.through);
    }
};

class SeamDistances {
  public:
    SeamDistances(const TriMesh& mesh, const std::vector<std::uint32_t>& photo_of_face,
                  const Atlas& atlas)
        : mesh_(mesh),
          photo_of_face_(photo_of_face),
          atlas_(atlas),
          faces_at_(mesh.faces, mesh.positions.size())
    {
    }

    /// Every vertex at which two photographs meet is zero texels from their seam, on both sides.
    void start(const CornerLevels& levels)
    {
        for (std::uint32_t vertex = 0; vertex < mesh_.positions.size(); ++vertex) {
            std::map<std::uint32_t, Array3f> level_of_photo;
            for (const std::uint32_t face : faces_at_[vertex]) {
                if (photo_of_face_[face] == kNoPhoto) continue;
                level_of_photo[photo_of_face_[face]] =
                    levels[face][corner_of(mesh_.faces[face], vertex)];
            }
            for (const auto& [photo, level] : level_of_photo) {
                for (const auto& [other, other_level] : level_of_photo) {
                    if (other != photo) queue_.push({0.0, {vertex, photo, other}, other_level});
                }
            }
        }
    }

    std::map<Through, Near> spread()
    {
        std::map<Through, Near> found;
        while (!queue_.empty()) {
            const Waiting next = queue_.top();
            queue_.pop();
            if (!found.try_emplace(next.through, Near{next.distance_px, next.level}).second)
                continue;
            const auto& [vertex, photo, other] = next.through;
            for (const std::uint32_t face : faces_at_[vertex]) {
                if (photo_of_face_[face] == photo) go_on(face, next);
            }
        }
        return found;
    }

    const VertexFaces& faces_at() const { return faces_at_; }

  private:
    void go_on(std::uint32_t face, const Waiting& from)
    {
        const auto& [vertex, photo, other] = from.through;
        const std::size_t corner = corner_of(mesh_.faces[face], vertex);
        for (std::size_t i = 0; i < 3; ++i) {
            if (i == corner) continue;
            const double distance =
                from.distance_px + (atlas_.corners[face][i] - atlas_.corners[face][corner]).norm();
            if (distance < kWidthPx) {
                queue_.push({distance, {mesh_.faces[face][i], photo, other}, from.level});
            }
        }
    }

    const TriMesh& mesh_;
    const std::vector<std::uint32_t>& photo_of_face_;
    const Atlas& atlas_;
    VertexFaces faces_at_;
    std::priority_queue<Waiting> queue_;
};

/// How another photograph shows through in a face of which some corners are near its seam.
Blend blend_of(const TriMesh& mesh, const std::map<Through, Near>& near, const Atlas& atlas,
               std::uint32_t face, const Through& through)
{
    const auto& [vertex, photo, other] = through;
    Blend blend{face, other, {1.0F, 1.0F, 1.0F}, {}};
    std::array<const Near*, 3> found{};
    Array3f mean = Array3f::Zero();
    float count = 0.0F;
    for (int i = 0; i < 3; ++i) {
        const auto at = near.find({mesh.faces[face][i], photo, other});
        if (at == near.end()) continue;
        found[i] = &at->second;
        mean += at->second.level;
        count += 1.0F;
    }
    for (int i = 0; i < 3; ++i) {
        blend.levels[i] = found[i] != nullptr ? found[i]->level : Array3f(mean / count);
        if (found[i] != nullptr) {
            blend.far[i] = static_cast<float>(found[i]->distance_px / kWidthPx);
            continue;
        }
        // Farther than the blend is wide, so the distance is that along the edge.
        double distance = 1e30;
        for (int k = 0; k < 3; ++k) {
            if (found[k] == nullptr) continue;
            distance =
                std::min(distance, found[k]->distance_px +
                                       (atlas.corners[face][i] - atlas.corners[face][k]).norm());
        }
        blend.far[i] = static_cast<float>(distance / kWidthPx);
    }
    return blend;
}

} // namespace

std::vector<std::vector<Blend>> find_blends(const TriMesh& mesh,
                                            const std::vector<PhotosOfFace>& photos_of_faces,
                                            const std::vector<std::uint32_t>& photo_of_face,
                                            const Atlas& atlas, const CornerLevels& levels)
{
    SeamDistances distances(mesh, photo_of_face, atlas);
    distances.start(levels);
    const std::map<Through, Near> near = distances.spread();
    std::set<std::pair<std::uint32_t, std::uint32_t>> done; // other photograph, face
    std::vector<std::vector<Blend>> blends;
    for (const auto& [through, unused] : near) {
        const auto& [vertex, photo, other] = through;
        for (const std::uint32_t face : distances.faces_at()[vertex]) {
            if (photo_of_face[face] != photo || place_of(photos_of_faces[face], other) < 0 ||
                !done.insert({other, face}).second) {
                continue;
            }
            blends.resize(std::max<std::size_t>(blends.size(), other + 1));
            blends[other].push_back(blend_of(mesh, near, atlas, face, through));
        }
    }
    return blends;
}

} // namespace vcarve
