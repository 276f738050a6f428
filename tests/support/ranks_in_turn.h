#pragma once

#include "run/work_folder.h"
#include "support/temporary_folder.h"
#include "tiles/reconstruct_tiles.h"

#include <functional>
#include <string>
#include <vector>

namespace vcarve {

/// Ranks of a run without MPI, in one process. The others do their shares before rank 0, each at
/// most `most` tiles. They communicate through the work folder only.
class RanksInTurn final : public Ranks {
  public:
    RanksInTurn(const WorkFolder& work, const Options& options, std::size_t count)
        : folder_(work.path(), work.job()), options_(options), count_(count)
    {
    }

    std::size_t count() const override { return count_; }
    void share(const std::string& task, const std::function<void()>& own) override
    {
        tasks.push_back(task);
        Log silent;
        for (std::size_t rank = 1; rank < count_; ++rank) {
            TiledRun(folder_, options_, silent).work(task, 2);
        }
        own();
        after_share(task);
    }

    std::vector<std::string> tasks;
    std::function<void(const std::string& task)> after_share = [](const std::string&) {};

  private:
    WorkFolder folder_;
    const Options& options_;
    std::size_t count_;
};

} // namespace vcarve
