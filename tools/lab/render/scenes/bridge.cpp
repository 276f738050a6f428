#include "render/scenes/scenes.h"
#include "render/shapes.h"
#include "render/stands.h"

#include <cmath>
#include <numbers>

namespace vcarve::render {

namespace {

constexpr double kHalfLength = 3.0;
constexpr double kHalfWidth = 0.5;
constexpr double kDeck = 1.1; ///< height of its top
constexpr double kTruss = 0.9;
constexpr int kPanels = 10; ///< between the verticals of a truss
constexpr double kStep = 2.0 * kHalfLength / kPanels;

const Eigen::Array3f kSteel(0.80F, 0.62F, 0.54F);

/// Places and radii.
const std::vector<Eigen::Vector3d> kRocks{
    {-2.1, -0.7, 0.22}, {-0.4, -1.2, 0.30}, {0.3, 0.6, 0.26},  {1.9, -1.4, 0.20}, {2.3, 0.9, 0.34},
    {-0.2, -0.3, 0.15}, {-2.3, 1.3, 0.28},  {0.5, -2.0, 0.18}, {-1.5, -1.9, 0.2}};

/// Two chords with verticals between, and diagonals that fall towards the middle.
void add_truss(PartBuilder& builder, double y)
{
    const double low = kDeck;
    const double high = kDeck + kTruss;
    for (const double z : {low, high}) {
        add_bar(builder, {{-kHalfLength, y, z}, {kHalfLength, y, z}, 0.07}, {kSteel});
    }
    for (int i = 0; i <= kPanels; ++i) {
        const double x = -kHalfLength + kStep * i;
        add_bar(builder, {{x, y, low}, {x, y, high}, 0.045}, {kSteel});
        if (i == kPanels) continue;
        const double outer = i < kPanels / 2 ? x : x + kStep;
        const double inner = i < kPanels / 2 ? x + kStep : x;
        add_bar(builder, {{outer, y, high}, {inner, y, low}, 0.035}, {kSteel});
    }
}

/// Planks with gaps on two beams, and between the upper chords crosses of thin bars.
void add_deck(PartBuilder& builder)
{
    for (const double y : {-0.3, 0.3}) {
        add_bar(builder, {{-kHalfLength, y, kDeck - 0.1}, {kHalfLength, y, kDeck - 0.1}, 0.08},
                {kSteel});
    }
    constexpr int kPlanks = 40;
    for (int i = 0; i < kPlanks; ++i) {
        const double x = -kHalfLength + 2.0 * kHalfLength * (i + 0.5) / kPlanks;
        add_box(builder, {{x, 0.0, kDeck - 0.06}, {0.13, 2.0 * kHalfWidth + 0.1, 0.03}},
                {{0.74F, 0.62F, 0.46F}});
    }
    const double z = kDeck + kTruss;
    for (int i = 0; i < kPanels; i += 2) {
        const double x = -kHalfLength + kStep * i;
        for (const double side : {-kHalfWidth, kHalfWidth}) {
            add_bar(builder, {{x, side, z}, {x + 2.0 * kStep, -side, z}, 0.03}, {kSteel});
        }
    }
}

/// On thin posts, inside of the trusses.
void add_railings(PartBuilder& builder)
{
    const Paint paint{{0.70F, 0.78F, 0.82F}};
    for (const double y : {-0.40, 0.40}) {
        for (const double z : {kDeck + 0.22, kDeck + 0.40}) {
            add_bar(builder, {{-kHalfLength, y, z}, {kHalfLength, y, z}, 0.025}, paint);
        }
        for (int i = 0; i <= kPanels; ++i) {
            const double x = -kHalfLength + 0.3 * kStep + 0.94 * kStep * i;
            add_bar(builder, {{x, y, kDeck - 0.04}, {x, y, kDeck + 0.40}, 0.025}, paint);
        }
    }
}

/// Towers of four legs with crosses between, and solid ends.
void add_piers(PartBuilder& builder)
{
    const double top = kDeck - 0.1;
    for (const double middle : {-1.2, 1.2}) {
        for (const double x : {middle - 0.3, middle + 0.3}) {
            for (const double y : {-0.35, 0.35}) {
                add_bar(builder, {{x, 1.3 * y, -0.05}, {x, y, top}, 0.06}, {kSteel});
                add_bar(builder, {{x, 1.2 * y, 0.3}, {x, -y, top - 0.1}, 0.03}, {kSteel});
                const double other = 2.0 * middle - x;
                add_bar(builder, {{x, 1.2 * y, 0.3}, {other, 1.03 * y, top - 0.1}, 0.03}, {kSteel});
            }
        }
        add_box(builder, {{middle, 0.0, 0.0}, {0.9, 1.2, 0.12}}, {{0.78F, 0.78F, 0.76F}});
    }
    for (const double x : {-3.5, 3.5}) {
        add_box(builder, {{x, 0.0, 0.0}, {1.1, 1.6, kDeck - 0.03}}, {{0.76F, 0.72F, 0.66F}});
    }
}

void add_rock(PartBuilder& builder, const Eigen::Vector2d& place, double size)
{
    const double own = 10.0 * place.x();
    const auto reach = [&](const Eigen::Vector3d& way) {
        return size * (1.0 + 0.2 * std::sin(4.0 * way.x() + own) * std::cos(5.0 * way.y()) +
                       0.1 * std::sin(7.0 * way.z() + own));
    };
    add_blob(builder, {place.x(), place.y(), 0.3 * size}, reach, {{0.74F, 0.72F, 0.70F}});
}

/// Rocks between the piers, then ground that grows coarser towards the hills.
void add_valley(PartBuilder& builder)
{
    add_box(builder, {{0.0, 0.0, -0.3}, {11.0, 11.0, 0.3}}, {{0.70F, 0.68F, 0.60F}});
    add_box(builder, {{0.0, 25.0, -1.3}, {90.0, 42.0, 1.0}}, {{0.62F, 0.70F, 0.52F}, 1.0, 6.0});
    add_box(builder, {{0.0, 70.0, -2.0}, {240.0, 60.0, 1.0}}, {{0.60F, 0.68F, 0.52F}, 1.0, 16.0});
    for (const Eigen::Vector3d& rock : kRocks) {
        add_rock(builder, rock.head<2>(), rock.z());
    }
}

/// Sixteen to twenty-eight times as far from the cameras as the bridge.
void add_hills(PartBuilder& builder)
{
    constexpr int kHills = 11;
    for (int i = 0; i < kHills; ++i) {
        const double turn_rad = (-75.0 + 15.0 * i) * std::numbers::pi / 180.0;
        const double distance = i % 2 == 0 ? 80.0 : 105.0;
        const double size = 14.0 + 4.0 * (i % 3);
        const auto reach = [&](const Eigen::Vector3d& way) {
            return size * (1.0 + 0.15 * std::sin(5.0 * way.x() + i) * std::cos(4.0 * way.z()) +
                           0.06 * std::sin(13.0 * way.y() + 11.0 * way.x()));
        };
        add_blob(builder,
                 {distance * std::sin(turn_rad), distance * std::cos(turn_rad), -0.3 * size}, reach,
                 {{0.52F, 0.66F, 0.50F + 0.03F * static_cast<float>(i % 4)}, 1.0, 18.0});
    }
}

} // namespace

PhotoScene bridge()
{
    PartBuilder builder;
    add_valley(builder);
    add_hills(builder);
    add_piers(builder);
    add_deck(builder);
    add_railings(builder);
    for (const double y : {-kHalfWidth, kHalfWidth}) {
        add_truss(builder, y);
    }
    PhotoScene scene;
    scene.parts = builder.take();
    const Lens lens{960, 720, 740.0};
    add_arc(scene.views, lens, {{0.0, 0.0, 1.25}, 3.9, 1.5, -57.0, 6.0, 20});
    add_arc(scene.views, lens, {{0.0, 0.0, 1.25}, 4.3, 2.5, -54.0, 6.0, 20});
    scene.frame = {
        5.0,
        Eigen::Quaterniond(Eigen::AngleAxisd(1.3, Eigen::Vector3d(0.6, 0.7, 0.1).normalized())),
        {70.0, 20.0, -50.0}};
    return scene;
}

} // namespace vcarve::render
