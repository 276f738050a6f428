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

/// Ranks of a run without MPI, in one process. Each does its share after rank 0. They communicate
/// through the work folder only.
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
        const std::string kind(task.starts_with(kBlocksTask) ? kBlocksTask : kRaysTask);
        tasks.push_back(kind);
        files.push_back(task);
        own();
        Log silent;
        for (const auto& other : others_) {
            other->work(task, silent);
        }
        after_share(kind);
    }

    std::vector<std::string> tasks; ///< kinds of the shared tasks
    std::vector<std::string> files; ///< names of the shared tasks
    std::function<void(const std::string& kind)> after_share = [](const std::string&) {};

  private:
    WorkFolder folder_;
    std::vector<std::unique_ptr<RankShares>> others_;
};

} // namespace vcarve
