#pragma once

#include "pipeline/rank_shares.h"
#include "run/work_folder.h"
#include "support/temporary_folder.h"
#include "vcarve/error.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace vcarve {

/// Ranks of a run without MPI: each does its share when rank 0 has done its own, in this process,
/// and knows of the others what is in the work folder.
class RanksInTurn final : public Ranks {
  public:
    RanksInTurn(const WorkFolder& work, const Options& options, std::size_t count)
        : folder_(work.path(), work.job())
    {
        for (std::size_t number = 1; number < count; ++number) {
            others_.push_back(std::make_unique<RankShares>(folder_, options, Rank{number, count}));
        }
    }

    std::size_t count() const override { return others_.size() + 1; }
    void share(const std::string& task, const std::function<void()>& own) override
    {
        const std::string kind(task.starts_with(kBlocksTask) ? kBlocksTask : kSightsTask);
        tasks.push_back(kind);
        files.push_back(task);
        own();
        Log silent;
        for (const auto& other : others_) {
            other->work(task, silent);
        }
        after_share(kind);
    }

    std::vector<std::string> tasks; ///< of what kind they were
    std::vector<std::string> files; ///< what they were called
    std::function<void(const std::string& kind)> after_share = [](const std::string&) {};

  private:
    WorkFolder folder_;
    std::vector<std::unique_ptr<RankShares>> others_;
};

} // namespace vcarve
