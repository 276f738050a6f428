#include "steps/4_visibility/view_tree.h"
#include "support/made_cells.h"
#include "support/point_sets.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

#include <numbers>
#include <random>
#include <vector>

namespace vcarve {
namespace {

using Eigen::Vector3d;
using testing::aim;
using testing::LabelledScene;
using testing::labels_where;
using testing::middle;

/// A bumpy ball that nobody saw, and so many views around it at any distance, some of them within:
/// always four next to each other, as in a video, that look at the same place in or beside it.
Scene ball_and_views(std::size_t num_views, std::uint32_t seed)
{
    Scene scene = bumpy_sphere(200, seed);
    for (std::uint64_t& begin : scene.tracks.begins) {
        begin = 0;
    }
    scene.tracks.views.clear();
    const View pattern = scene.views.front();
    scene.views.assign(num_views, pattern);
    std::mt19937_64 random(seed);
    const auto within = [&](double half) -> Vector3d {
        const auto coordinate = [&] {
            return half * (static_cast<double>(pick(random, 2001)) / 1000.0 - 1.0);
        };
        return {coordinate(), coordinate(), coordinate()};
    };
    Vector3d together = Vector3d::Zero();
    Vector3d target = Vector3d::Zero();
    for (std::size_t i = 0; i < num_views; ++i) {
        if (i % 4 == 0) {
            together = within(4.0);
            target = within(2.0);
        }
        scene.views[i].center = together + within(0.02);
        aim(scene.views[i], target);
    }
    return scene;
}

struct Asked {
    std::size_t asked = 0;
    std::size_t of = 0;
    std::size_t seen = 0;
};

/// How often each view is asked about a place, if all say no.
std::vector<int> asked_about(const ViewTree& tree, const LabelledScene& made,
                             const CellFacet& facet, const Vector3d& place)
{
    std::vector<int> asked(made.scene.views.size(), 0);
    const auto goes_on = [&](const CellFacet& ahead) {
        return made.labels[made.mesh.other_side(ahead).cell] == Label::outside;
    };
    EXPECT_FALSE(tree.any_view(made.mesh, facet, place, goes_on, [&](std::uint32_t view) {
        ++asked[view];
        return false;
    }));
    return asked;
}

/// Asks of every place on a boundary; each view that sees it must be asked, once as all others.
Asked ask_everywhere(const LabelledScene& made)
{
    const ViewTree tree(made.scene);
    Asked sum;
    const auto ask = [&](const CellFacet& facet, const Vector3d& place) {
        const std::vector<int> asked = asked_about(tree, made, facet, place);
        for (std::uint32_t view = 0; view < asked.size(); ++view) {
            const int seen = made.visibility.sees(view, facet, place) ? 1 : 0;
            EXPECT_GE(asked[view], seen) << "view " << view;
            EXPECT_LE(asked[view], 1);
            sum.seen += static_cast<std::size_t>(seen);
            sum.asked += static_cast<std::size_t>(asked[view]);
        }
        sum.of += asked.size();
    };
    for (const CellFacet& facet : made.facets) {
        for (const Vector3d& place : made.visibility.places_on(facet)) {
            ask(facet, place);
        }
    }
    return sum;
}

LabelledScene labelled(Scene scene, std::uint64_t flipped_percent)
{
    std::mt19937_64 random(7);
    return {std::move(scene), [&](const TetMesh& mesh) {
                return labels_where(mesh, [&](Index cell) {
                    const bool is_deep = middle(mesh, cell).norm() < 0.8;
                    return is_deep != (pick(random, 100) < flipped_percent);
                });
            }};
}

TEST(ViewTree, AsksEveryViewThatSeesAPlaceAndFewOthers)
{
    for (const std::uint64_t flipped : {0U, 15U, 45U}) {
        const Asked sum = ask_everywhere(labelled(ball_and_views(128, 3), flipped));
        EXPECT_GT(sum.seen, 0U);
        EXPECT_LT(5 * sum.asked, 2 * sum.of);
    }
}

TEST(ViewTree, AsksFewerOfManyViewsThatAFacetHides)
{
    const auto asked_of_unseen = [](std::size_t num_views) {
        const Asked sum = ask_everywhere(labelled(ball_and_views(num_views, 5), 45));
        return static_cast<double>(sum.asked - sum.seen) / static_cast<double>(sum.of - sum.seen);
    };
    EXPECT_LT(asked_of_unseen(1000), 0.7 * asked_of_unseen(60));
}

TEST(ViewTree, AsksAllViewsBeforeAFacetWhoseLensIsNotKnown)
{
    Scene scene = ball_and_views(50, 9);
    for (Camera& camera : scene.cameras) {
        camera.model = -1;
    }
    const Asked sum = ask_everywhere(labelled(std::move(scene), 15));
    EXPECT_GT(sum.seen, 0U);
}

TEST(ViewTree, StopsAtTheFirstYesAndAsksNobodyWhereThereAreNoViews)
{
    LabelledScene made = labelled(ball_and_views(50, 11), 0);
    const auto always = [](const CellFacet&) { return true; };
    const CellFacet& facet = made.facets.front();
    const Vector3d place = made.visibility.places_on(facet).front();
    int asked = 0;
    const auto yes = [&](std::uint32_t) { return ++asked > 0; };
    EXPECT_TRUE(ViewTree(made.scene).any_view(made.mesh, facet, place, always, yes));
    EXPECT_EQ(asked, 1);
    Scene nobody = made.scene;
    nobody.views.clear();
    EXPECT_FALSE(ViewTree(nobody).any_view(made.mesh, facet, place, always, yes));
    EXPECT_EQ(asked, 1);
}

} // namespace
} // namespace vcarve
