#include "texture/face_photos.h"

#include "base/arrays.h"
#include "base/parallel.h"
#include "geometry/triangle.h"
#include "mesh/edge_halving.h"
#include "texture/occlusion.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace vcarve {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Corners = std::array<Vector3d, 3>;

constexpr double kLeastCosine = 0.1;
/// Maximum number of photographs that are tested per face, in order of decreasing area.
constexpr std::size_t kMostAsked = 48;
constexpr int kMostRounds = 9;
constexpr double kShortestPx = 24.0; ///< partly visible faces with shorter edges stay whole

double area_px2(const std::array<Vector2d, 3>& pixels)
{
    const Vector2d ab = pixels[1] - pixels[0];
    const Vector2d ac = pixels[2] - pixels[0];
    return 0.5 * std::abs(ab.x() * ac.y() - ab.y() * ac.x());
}

double longest_px(const std::array<Vector2d, 3>& pixels)
{
    return std::max({(pixels[1] - pixels[0]).norm(), (pixels[2] - pixels[1]).norm(),
                     (pixels[0] - pixels[2]).norm()});
}

struct Asked {
    std::uint32_t photo;
    double area_px2; ///< 0 if the photograph shows only a part of the face
    double longest_px;
};

/// Estimates the length of the longest edge if the photograph does not show all corners.
double guessed_px(const CalibratedPhoto& photo, const Corners& corners, double distance)
{
    return photo.focal_px * longest_edge(corners) / distance;
}

bool shows_part(const CalibratedPhoto& photo, const Corners& corners)
{
    return std::ranges::any_of(face_samples(corners), [&](const Vector3d& place) {
        return pixel_of(photo, place).has_value();
    });
}

/// Finds the photographs that have a face in view from its front, in order of decreasing area.
void photos_before(const std::vector<CalibratedPhoto>& photos, const Corners& corners,
                   std::vector<Asked>& asked)
{
    const Vector3d normal = scaled_normal(corners[0], corners[1], corners[2]).normalized();
    const Vector3d middle = (corners[0] + corners[1] + corners[2]) / 3.0;
    for (std::uint32_t i = 0; i < photos.size(); ++i) {
        const Vector3d back = photos[i].pose.center - middle;
        if (!(normal.dot(back) >= kLeastCosine * back.norm()) || back.isZero(0.0)) continue;
        const auto pixels = corner_pixels(photos[i], corners);
        if (pixels) {
            asked.push_back({i, area_px2(*pixels), longest_px(*pixels)});
        } else if (shows_part(photos[i], corners)) {
            asked.push_back({i, 0.0, guessed_px(photos[i], corners, back.norm())});
        }
    }
    std::ranges::sort(asked, [](const Asked& a, const Asked& b) {
        return a.area_px2 > b.area_px2 || (a.area_px2 == b.area_px2 && a.photo < b.photo);
    });
    if (asked.size() > kMostAsked) asked.resize(kMostAsked);
}

/// The photographs of a face, and whether it is too large.
struct Looked {
    PhotosOfFace photos;
    bool is_large = false; ///< in the first photograph that sees a part of it
};

Looked look_at_face(const std::vector<CalibratedPhoto>& photos, const Occlusion& occlusion,
                    const Corners& corners, std::uint32_t whole, std::vector<Asked>& asked)
{
    photos_before(photos, corners, asked);
    Looked looked;
    PhotosOfFace clear;
    PhotosOfFace edge;
    double longest = 0.0;
    int side = 0;
    for (const Asked& one : asked) {
        if (clear.count == PhotosOfFace::kMost) break;
        const int seen = occlusion.seen_places(photos[one.photo], corners, whole);
        if (seen == 0) continue;
        if (longest == 0.0) {
            longest = one.longest_px;
            side = std::max(photos[one.photo].size.width_px, photos[one.photo].size.height_px);
        }
        if (seen == 7 && one.area_px2 > 0.0) {
            PhotosOfFace& list =
                occlusion.is_near_silhouette(photos[one.photo], corners) ? edge : clear;
            if (list.count == PhotosOfFace::kMost) continue;
            list.best[list.count++] = {one.photo, static_cast<float>(one.area_px2)};
        }
    }
    looked.photos = clear.count > 0 ? clear : edge;
    looked.photos.is_partly_shown = looked.photos.count == 0 && longest > kShortestPx;
    looked.is_large = longest > 0.125 * side;
    return looked;
}

/// Bisects faces, and records the input face of each part.
class Splitter {
  public:
    explicit Splitter(TriMesh& mesh)
        : mesh_(mesh),
          normals_(std::move(mesh.normals)),
          halving_(mesh, {}),
          whole_(mesh.faces.size())
    {
        mesh.normals.clear();
        for (std::uint32_t face = 0; face < whole_.size(); ++face) {
            whole_[face] = face;
        }
    }

    std::uint32_t whole(std::uint32_t face) const { return whole_[face]; }

    /// Appends the faces that changed to `changed`.
    void halve(std::uint32_t face, std::vector<std::uint32_t>& changed)
    {
        const auto [a, b] = longest_edge_of(mesh_.positions, mesh_.faces[face]);
        for (const auto& [half, other_half] : halving_.halve(a, b)) {
            whole_.resize(std::max<std::size_t>(whole_.size(), other_half + 1));
            whole_[other_half] = whole_[half];
            changed.insert(changed.end(), {half, other_half});
        }
        if (!normals_.empty()) normals_.push_back((normals_[a] + normals_[b]).normalized());
    }

    /// Bisects the faces with a flag, except faces that this call has already changed. Returns all
    /// changed faces.
    std::vector<std::uint32_t> halve_all(std::span<const std::uint32_t> faces,
                                         std::span<const std::uint8_t> is_split)
    {
        std::vector<std::uint32_t> changed;
        std::vector<std::uint8_t> is_changed(mesh_.faces.size());
        for (std::size_t i = 0; i < faces.size(); ++i) {
            if (is_split[i] == 0 || is_changed[faces[i]] != 0) continue;
            const std::size_t before = changed.size();
            halve(faces[i], changed);
            is_changed.resize(mesh_.faces.size());
            for (std::size_t k = before; k < changed.size(); ++k) {
                is_changed[changed[k]] = 1;
            }
        }
        sort_unique(changed);
        return changed;
    }

    void end() { mesh_.normals = std::move(normals_); }

  private:
    TriMesh& mesh_;
    std::vector<Eigen::Vector3f> normals_;
    EdgeHalving halving_;
    std::vector<std::uint32_t> whole_;
};

} // namespace

std::vector<std::vector<FaceOfPhoto>>
faces_of_photos(std::size_t num_photos, const std::vector<PhotosOfFace>& photos_of_faces)
{
    std::vector<std::vector<FaceOfPhoto>> faces(num_photos);
    for (std::uint32_t face = 0; face < photos_of_faces.size(); ++face) {
        const auto shown = photos_of_faces[face].shown();
        for (std::uint32_t place = 0; place < shown.size(); ++place) {
            faces[shown[place].photo].push_back({face, place});
        }
    }
    return faces;
}

std::optional<std::array<Vector2d, 3>> corner_pixels(const CalibratedPhoto& photo,
                                                     const Corners& corners)
{
    std::array<Vector2d, 3> pixels;
    for (int i = 0; i < 3; ++i) {
        const std::optional<Vector2d> pixel = pixel_of(photo, corners[i]);
        if (!pixel) return std::nullopt;
        pixels[i] = *pixel;
    }
    const auto middle = pixel_of(photo, (corners[0] + corners[1] + corners[2]) / 3.0);
    const Vector2d mean = (pixels[0] + pixels[1] + pixels[2]) / 3.0;
    constexpr double kBent = 0.25; // of the longest edge, maximum offset of the centroid
    if (!middle || (*middle - mean).norm() > kBent * longest_px(pixels)) return std::nullopt;
    return pixels;
}

std::vector<PhotosOfFace> find_photos_of_faces(TriMesh& mesh,
                                               const std::vector<CalibratedPhoto>& photos,
                                               const Progress& progress)
{
    const Occlusion occlusion(mesh);
    const std::size_t most_faces = 4 * mesh.faces.size() + 10000;
    Splitter splitter(mesh);
    std::vector<PhotosOfFace> found(mesh.faces.size());
    std::vector<std::uint32_t> waiting(mesh.faces.size());
    for (std::uint32_t face = 0; face < waiting.size(); ++face) {
        waiting[face] = face;
    }
    for (int round = 0; !waiting.empty(); ++round) {
        std::vector<std::uint8_t> is_split(waiting.size());
        ProgressCount done(progress.part(round == 0 ? 0.0 : 0.7, round == 0 ? 0.7 : 1.0),
                           waiting.size());
        parallel_for_ranges(
            waiting.size(),
            [&](std::size_t first, std::size_t last) {
                std::vector<Asked> asked;
                for (std::size_t i = first; i < last; ++i) {
                    asked.clear();
                    const std::uint32_t face = waiting[i];
                    const Looked looked = look_at_face(photos, occlusion,
                                                       corners_of(mesh.positions, mesh.faces[face]),
                                                       splitter.whole(face), asked);
                    found[face] = looked.photos;
                    is_split[i] = looked.photos.is_partly_shown || looked.is_large ? 1 : 0;
                }
                done.add(last - first);
            },
            64);
        if (round == kMostRounds || mesh.faces.size() > most_faces) break;
        std::vector<std::uint32_t> changed = splitter.halve_all(waiting, is_split);
        found.resize(mesh.faces.size());
        waiting = std::move(changed);
    }
    splitter.end();
    return found;
}

} // namespace vcarve
