#pragma once

#include "geometry/triangle.h"
#include "model/extent.h"
#include "steps/6_surface/face_evidence.h"
#include "steps/6_surface/face_rules.h"
#include "steps/6_surface/trim.h"
#include "support/made_cells.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

namespace vcarve {

/// Three corners of a base at height 0, which faces down, and an apex above it. The first two
/// corners are the ends of the longest edge.
inline const std::array<Eigen::Vector3d, 4> kTent = {
    Eigen::Vector3d(-4, -3, 0), Eigen::Vector3d(5, -2, 0), Eigen::Vector3d(-1, 4, 0),
    Eigen::Vector3d(0.1, -0.2, 3)};
inline const double kLongest = std::sqrt(82.0); ///< the longest edge of a tent
inline const Eigen::Vector3d kAside{40, 3, 0};  ///< position of the second tent

/// A view that looks straight up. At focal length 500 the image reaches 0.64 times the distance to
/// the left and right, and 0.48 times up and down.
struct Eye {
    Eigen::Vector3d center;
    double focal = 500.0;
};

/// Two tents far from each other, and optionally a smaller one below the first. View 0, above, sees
/// all sides of both tents, and is the only view that saw their points. So only the images of the
/// other views show the bases. No view saw a point of the third tent.
inline Scene tents(const std::vector<Eye>& eyes, bool has_third)
{
    std::vector<MadePoint> points;
    for (const Eigen::Vector3d& place : {Eigen::Vector3d(0, 0, 0), kAside}) {
        for (const Eigen::Vector3d& corner : kTent) {
            points.push_back({corner + place, {0}});
        }
    }
    if (has_third) {
        for (const Eigen::Vector3d& corner : kTent) {
            points.push_back({0.4 * corner + Eigen::Vector3d(0.2, -0.6, -10), {}});
        }
    }
    for (const double x : {-60.0, 100.0}) {
        for (const double y : {-61.0, 70.0}) {
            points.push_back({{x, y, -80.0}, {}});
            points.push_back({{x, y, 85.0}, {}});
        }
    }
    std::vector<Eigen::Vector3d> centers = {{20, 1, 60}};
    for (const Eye& eye : eyes) {
        centers.push_back(eye.center);
    }
    Scene scene = make_scene(centers, points);
    scene.cameras[0].params = {60.0, 60.0, 320.0, 240.0};
    testing::aim(scene.views[0], {20, 1, 0});
    for (std::size_t i = 0; i < eyes.size(); ++i) {
        scene.cameras.push_back(scene.cameras[0]);
        scene.cameras.back().params = {eyes[i].focal, eyes[i].focal, 320.0, 240.0};
        scene.views[i + 1].camera = static_cast<std::uint32_t>(i + 1);
    }
    return scene;
}

/// A part of a face after trimming.
struct Piece {
    std::size_t origin;
    std::array<Eigen::Vector3d, 3> corners;
    bool is_kept;
};

/// Whether a position in the plane of a triangle is on the triangle, up to rounding.
inline bool lies_on(const std::array<Eigen::Vector3d, 3>& corners, const Eigen::Vector3d& place,
                    double slack = 1e-9)
{
    const Eigen::Vector3d normal = scaled_normal(corners[0], corners[1], corners[2]);
    if (std::abs(normal.normalized().dot(place - corners[0])) > 1e-9) return false;
    for (std::size_t i = 0; i < 3; ++i) {
        const Eigen::Vector3d& a = corners[i];
        const Eigen::Vector3d& b = corners[(i + 1) % 3];
        if (scaled_normal(a, b, place).dot(normal) < -slack * normal.squaredNorm()) return false;
    }
    return true;
}

inline Eigen::Vector3d middle_of(const std::array<Eigen::Vector3d, 3>& corners)
{
    return (corners[0] + corners[1] + corners[2]) / 3.0;
}

/// Tents as the only inside cells, their visibility, and the result of trimming.
struct Tents {
    explicit Tents(const std::vector<Eye>& eyes, bool has_third = false)
        : Tents(tents(eyes, has_third), has_third)
    {
    }
    Tents(Scene scene, bool has_third)
        : made(std::move(scene),
               [&](const TetMesh& mesh) {
                   Labels labels(mesh.cells.size(), Label::outside);
                   labels.at(testing::cell_of(mesh, {0, 1, 2, 3})) = Label::inside;
                   labels.at(testing::cell_of(mesh, {4, 5, 6, 7})) = Label::inside;
                   if (has_third) {
                       labels.at(testing::cell_of(mesh, {8, 9, 10, 11})) = Label::inside;
                   }
                   return labels;
               }),
          boundary(made.surface),
          keep(made.facets.size(), 1),
          seen(made.facets.size(), 1)
    {
    }

    /// The face with these points of the scene as corners.
    std::size_t face_of(const std::array<Index, 3>& points) const
    {
        const auto face = std::ranges::find_if(made.corners, [&](const Face& corners) {
            return std::ranges::is_permutation(corners, points);
        });
        EXPECT_NE(face, made.corners.end());
        return static_cast<std::size_t>(face - made.corners.begin());
    }
    std::size_t base() const { return face_of({0, 1, 2}); }
    std::size_t base_aside() const { return face_of({4, 5, 6}); }

    /// Trims with `max_closing` set so that faces with an edge above `long_edge` are long.
    std::int64_t trim(double long_edge)
    {
        FaceRules rules;
        rules.max_closing = long_edge / 2.0 / region_of_interest(made.scene).radius;
        kept_before = keep;
        ChosenFaces chosen{.keep = keep, .seen = seen};
        const std::int64_t count =
            trim_faces(boundary, {boundary, made.facets, made.visibility}, rules, chosen);
        keep = chosen.keep;
        return count;
    }
    bool is_as_before() const
    {
        return boundary.faces == made.surface.faces && keep == kept_before;
    }

    std::array<Eigen::Vector3d, 3> whole(std::size_t face) const
    {
        return made.visibility.corners_of(made.facets[face]);
    }
    TriMesh kept() const { return with_faces(boundary, keep); }
    /// All parts of faces, with the faces that they come from.
    std::vector<Piece> pieces() const
    {
        std::vector<Piece> found;
        for (std::size_t i = 0; i < boundary.faces.size(); ++i) {
            const auto corners = corners_of(boundary.positions, boundary.faces[i]);
            for (std::size_t origin = 0; origin < made.facets.size(); ++origin) {
                if (lies_on(whole(origin), middle_of(corners)))
                    found.push_back({origin, corners, keep[i] != 0});
            }
        }
        return found;
    }
    double area(std::size_t face, std::optional<bool> is_kept = {}) const
    {
        double sum = 0.0;
        for (const Piece& piece : pieces()) {
            const auto& [a, b, c] = piece.corners;
            if (piece.origin == face && (!is_kept || piece.is_kept == *is_kept))
                sum += triangle_area(a, b, c);
        }
        return sum;
    }
    double whole_area(std::size_t face) const
    {
        const auto [a, b, c] = whole(face);
        return triangle_area(a, b, c);
    }
    /// Whether a view sees a position on a face; the faces kept before trimming occlude.
    bool is_seen(std::size_t face, const Eigen::Vector3d& place) const
    {
        return vcarve::is_seen({made.surface, made.facets, made.visibility}, kept_before,
                               made.facets[face], place, 0.0);
    }
    /// The fraction of a part that views see.
    double share_seen(const Piece& piece) const
    {
        const std::vector<Eigen::Vector3d> places = grid_on(piece.corners, 20);
        const auto count = std::ranges::count_if(
            places, [&](const Eigen::Vector3d& place) { return is_seen(piece.origin, place); });
        return static_cast<double>(count) / static_cast<double>(places.size());
    }

    testing::LabeledScene made;
    TriMesh boundary;
    FaceFlags keep;
    FaceFlags seen;
    FaceFlags kept_before;
};

} // namespace vcarve
