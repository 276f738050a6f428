#pragma once

#include "base/progress.h"
#include "vcarve/scene.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace vcarve {

/// A scene whose points come part by part, in their order, so that not all of them need to be in
/// memory at a time.
class SceneParts {
  public:
    SceneParts() = default;
    SceneParts(const SceneParts&) = delete;
    SceneParts& operator=(const SceneParts&) = delete;
    virtual ~SceneParts() = default;

    /// How many points there are in all.
    virtual std::size_t num_points() const = 0;
    /// The next points, at most so many, with all cameras and views; none after the last. May throw
    /// InputError, and Cancelled.
    virtual Scene next(std::size_t most, const Progress& progress) = 0;
};

/// The parts of a scene that is in memory, and must stay there.
class PartsOfScene final : public SceneParts {
  public:
    explicit PartsOfScene(const Scene& scene) : scene_(scene) {}

    std::size_t num_points() const override { return scene_.num_points(); }
    Scene next(std::size_t most, const Progress& progress) override;

  private:
    const Scene& scene_;
    std::size_t first_ = 0; ///< point of the next part
};

} // namespace vcarve
