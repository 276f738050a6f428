#include "render/photo_scene.h"

#include "render/scenes/scenes.h"
#include "vcarve/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace vcarve::render {

namespace {

struct NamedScene {
    const char* name;
    PhotoScene (*make)();
};

constexpr std::array kScenes{
    NamedScene{"still_life", fixture_scene},
    NamedScene{"panels", panels},
    NamedScene{"clutter", clutter},
    NamedScene{"facade", facade},
    NamedScene{"organic", organic},
    NamedScene{"low_texture", low_texture},
    NamedScene{"noisy", noisy},
    NamedScene{"few_views", few_views},
    NamedScene{"room", room},
    NamedScene{"city", city},
    NamedScene{"hall", hall},
    NamedScene{"cubicles", cubicles},
    NamedScene{"smooth", smooth},
};

} // namespace

std::vector<std::string> photo_scene_names()
{
    std::vector<std::string> names;
    names.reserve(kScenes.size());
    for (const NamedScene& scene : kScenes) {
        names.emplace_back(scene.name);
    }
    return names;
}

PhotoScene photo_scene(std::string_view name)
{
    const auto* found = std::find_if(kScenes.begin(), kScenes.end(),
                                     [&](const NamedScene& scene) { return scene.name == name; });
    if (found == kScenes.end()) {
        throw UsageError(fmt::format("unknown scene {}; expected one of {}", name,
                                     fmt::join(photo_scene_names(), ", ")));
    }
    return found->make();
}

} // namespace vcarve::render
