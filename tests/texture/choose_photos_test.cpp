#include "support/photographed_wall.h"
#include "texture/choose_photos.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace vcarve::choose_photos_test {
namespace {

/// Two photographs per face with these areas, the larger first.
std::vector<PhotosOfFace> two_photos(const std::vector<std::array<float, 2>>& areas_px2)
{
    std::vector<PhotosOfFace> photos(areas_px2.size());
    for (std::size_t face = 0; face < photos.size(); ++face) {
        photos[face].count = 2;
        photos[face].best[0] = {0, areas_px2[face][0]};
        photos[face].best[1] = {1, areas_px2[face][1]};
        if (areas_px2[face][1] > areas_px2[face][0]) {
            std::swap(photos[face].best[0], photos[face].best[1]);
        }
    }
    return photos;
}

std::vector<std::uint32_t> chosen(const TriMesh& mesh, const std::vector<PhotosOfFace>& photos)
{
    return choose_photos(mesh, {photo_from({0, 0, -1}), photo_from({0, 0, -1})}, photos,
                         find_faces_beside(mesh), {});
}

TEST(FacesBeside, FollowTheOrderOfTheEdges)
{
    const TriMesh mesh = wall_mesh(1);
    const FacesBeside beside = find_faces_beside(mesh);
    EXPECT_EQ(beside[0], (std::array<std::uint32_t, 3>{kNoFace, 1, kNoFace}));
    EXPECT_EQ(beside[1], (std::array<std::uint32_t, 3>{0, kNoFace, kNoFace}));
}

TEST(FacesBeside, EndAtAnEdgeOfThreeFaces)
{
    TriMesh mesh = wall_mesh(1);
    mesh.positions.emplace_back(0, 0, 5);
    mesh.faces.push_back({1, 2, 4});
    const FacesBeside beside = find_faces_beside(mesh);
    EXPECT_EQ(beside[0], (std::array<std::uint32_t, 3>{kNoFace, kNoFace, kNoFace}));
}

TEST(ChoosePhotos, ChoosesTheLargestIfItIsWorthASeam)
{
    const TriMesh mesh = wall_mesh(8);
    std::vector<std::array<float, 2>> areas;
    for (const Face& face : mesh.faces) {
        const bool is_left = mesh.positions[face[0]].x() + mesh.positions[face[1]].x() +
                                 mesh.positions[face[2]].x() <
                             0.0;
        areas.push_back(is_left ? std::array{5000.0F, 2000.0F} : std::array{2000.0F, 5000.0F});
    }
    const auto photos = chosen(mesh, two_photos(areas));
    for (std::size_t face = 0; face < photos.size(); ++face) {
        EXPECT_EQ(photos[face], areas[face][0] > areas[face][1] ? 0U : 1U) << face;
    }
}

TEST(ChoosePhotos, AvoidsSeamsForSmallGains)
{
    const TriMesh mesh = wall_mesh(8);
    std::vector<std::array<float, 2>> areas(mesh.faces.size(), {2000.0F, 1900.0F});
    areas[60] = {1990.0F, 2000.0F};
    areas[61] = {1950.0F, 2000.0F};
    const auto photos = chosen(mesh, two_photos(areas));
    EXPECT_EQ(std::ranges::count(photos, 0U), static_cast<std::ptrdiff_t>(photos.size()));
}

TEST(ChoosePhotos, LeavesNoCheaperChangeOfOneOrTwoFaces)
{
    // Changing one face, or two neighbors, must not lower the cost: an expansion move would have
    // found this.
    const TriMesh mesh = wall_mesh(5);
    std::vector<std::array<float, 2>> areas;
    for (std::size_t face = 0; face < mesh.faces.size(); ++face) {
        areas.push_back({1000.0F + static_cast<float>(face * 7919 % 900),
                         1000.0F + static_cast<float>(face * 104729 % 900)});
    }
    const auto photos_of_faces = two_photos(areas);
    const FacesBeside beside = find_faces_beside(mesh);
    const auto cost = [&](const std::vector<std::uint32_t>& photos) {
        double sum = 0.0;
        for (std::size_t face = 0; face < photos.size(); ++face) {
            const double best = std::max(areas[face][0], areas[face][1]);
            sum += (best - areas[face][photos[face]]) / 1600.0;
            for (int side = 0; side < 3; ++side) {
                const std::uint32_t other = beside[face][side];
                if (other == kNoFace || other < face || photos[other] == photos[face]) continue;
                const double length = (mesh.positions[mesh.faces[face][side]] -
                                       mesh.positions[mesh.faces[face][(side + 1) % 3]])
                                          .norm();
                // All faces have the same area, so pixels per unit are the root of the area ratio.
                const double area = 2.0 / 25.0;
                const double pixels =
                    0.5 * (std::sqrt(best / area) +
                           std::sqrt(std::max(areas[other][0], areas[other][1]) / area));
                sum += 0.6 * length * pixels / 40.0;
            }
        }
        return sum;
    };
    auto photos = chosen(mesh, photos_of_faces);
    const double least = cost(photos);
    for (std::size_t face = 0; face < photos.size(); ++face) {
        photos[face] ^= 1U;
        EXPECT_GE(cost(photos), least - 0.01) << face;
        for (const std::uint32_t other : beside[face]) {
            if (other == kNoFace) continue;
            photos[other] ^= 1U;
            EXPECT_GE(cost(photos), least - 0.01) << face << " and " << other;
            photos[other] ^= 1U;
        }
        photos[face] ^= 1U;
    }
}

TEST(ChoosePhotos, SkipsUnseenFaces)
{
    const TriMesh mesh = wall_mesh(2);
    std::vector<PhotosOfFace> photos =
        two_photos(std::vector<std::array<float, 2>>(mesh.faces.size(), {100.0F, 90.0F}));
    photos[3].count = 0;
    const auto found = chosen(mesh, photos);
    EXPECT_EQ(found[3], kNoPhoto);
    EXPECT_EQ(std::ranges::count(found, kNoPhoto), 1);
}

} // namespace
} // namespace vcarve::choose_photos_test
