#pragma once

#include "vcarve/scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <functional>

namespace vcarve {

/// Fails the test if two scenes are not equal to the last bit.
inline void expect_equal_scenes(const Scene& a, const Scene& b)
{
    ASSERT_EQ(a.cameras.size(), b.cameras.size());
    for (std::size_t i = 0; i < a.cameras.size(); ++i) {
        EXPECT_EQ(a.cameras[i].id, b.cameras[i].id);
        EXPECT_EQ(a.cameras[i].model, b.cameras[i].model);
        EXPECT_EQ(a.cameras[i].width_px, b.cameras[i].width_px);
        EXPECT_EQ(a.cameras[i].height_px, b.cameras[i].height_px);
        EXPECT_EQ(a.cameras[i].params, b.cameras[i].params);
        EXPECT_EQ(a.cameras[i].measures_range, b.cameras[i].measures_range);
    }
    ASSERT_EQ(a.views.size(), b.views.size());
    for (std::size_t i = 0; i < a.views.size(); ++i) {
        EXPECT_EQ(a.views[i].id, b.views[i].id);
        EXPECT_EQ(a.views[i].camera, b.views[i].camera);
        EXPECT_EQ(a.views[i].name, b.views[i].name);
        EXPECT_EQ(a.views[i].cam_from_world.coeffs(), b.views[i].cam_from_world.coeffs());
        EXPECT_EQ(a.views[i].center, b.views[i].center);
    }
    EXPECT_EQ(a.positions, b.positions);
    EXPECT_EQ(a.colors, b.colors);
    EXPECT_EQ(a.errors_px, b.errors_px);
    EXPECT_EQ(a.point_ids, b.point_ids);
    EXPECT_EQ(a.normals, b.normals);
    EXPECT_EQ(a.kinds, b.kinds);
    EXPECT_EQ(a.is_dense, b.is_dense);
    EXPECT_EQ(a.tracks.begins, b.tracks.begins);
    EXPECT_EQ(a.tracks.views, b.tracks.views);
    EXPECT_EQ(a.offset, b.offset);
}

/// Fails the test if a scene violates a guarantee of model/scene.h.
inline void expect_well_formed(const Scene& scene)
{
    for (const View& view : scene.views) {
        EXPECT_LT(view.camera, scene.cameras.size());
        EXPECT_NEAR(view.cam_from_world.norm(), 1.0, 1e-15);
        EXPECT_TRUE(view.center.allFinite());
    }
    ASSERT_EQ(scene.colors.size(), scene.num_points());
    ASSERT_EQ(scene.errors_px.size(), scene.num_points());
    ASSERT_EQ(scene.point_ids.size(), scene.num_points());
    ASSERT_TRUE(scene.normals.empty() || scene.normals.size() == scene.num_points());
    ASSERT_TRUE(scene.kinds.empty() || scene.kinds.size() == scene.num_points());
    ASSERT_EQ(scene.tracks.size(), scene.num_points());
    ASSERT_EQ(scene.tracks.begins.back(), scene.tracks.views.size());
    for (std::size_t i = 0; i < scene.num_points(); ++i) {
        const auto track = scene.tracks[i];
        EXPECT_TRUE(std::is_sorted(track.begin(), track.end(), std::less_equal<>()));
        EXPECT_TRUE(track.empty() || track.back() < scene.views.size());
    }
}

} // namespace vcarve
