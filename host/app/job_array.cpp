#include "app/job_array.h"

#include "app/option_kinds.h"
#include "film/sample_ranges.h"

#include <cstdlib>

namespace sahl {

namespace {

/// Variables of a scheduler; "" where it has none.
struct Scheduler {
    const char* index;
    const char* count;
    const char* first;  ///< smallest index of the array
    const char* step;   ///< between two indices
};

constexpr Scheduler SCHEDULERS[] = {
    {"SLURM_ARRAY_TASK_ID", "SLURM_ARRAY_TASK_COUNT", "SLURM_ARRAY_TASK_MIN",
     "SLURM_ARRAY_TASK_STEP"},
    {"AWS_BATCH_JOB_ARRAY_INDEX", "AWS_BATCH_JOB_ARRAY_SIZE", "", ""},
    {"JOB_COMPLETION_INDEX", "", "", ""},
    {"OMPI_COMM_WORLD_RANK", "OMPI_COMM_WORLD_SIZE", "", ""},
    {"PMI_RANK", "PMI_SIZE", "", ""},
};

bool isSet(const char* variable)
{
    const char* value = std::getenv(variable);
    return *variable != '\0' && value != nullptr && *value != '\0';
}

uint32_t numberIn(const char* variable, uint32_t standard, uint32_t least)
{
    return isSet(variable) ? parseNumber(variable, std::getenv(variable), {least, MAX_SAMPLES})
                           : standard;
}

}  // namespace

ArrayTask arrayTask(std::optional<uint32_t> count)
{
    std::vector<std::string> known;
    for (const Scheduler& scheduler : SCHEDULERS) {
        known.push_back(scheduler.index);
        if (!isSet(scheduler.index)) continue;
        ArrayTask task = {numberIn(scheduler.index, 0, 0), count.value_or(0), scheduler.index};
        if (!count) {
            if (!isSet(scheduler.count)) {
                throw CLI::ValidationError(fmt::format(
                    "--shard auto: {} is {}, but nothing tells the number of shards; give it as "
                    "--shard auto/n",
                    scheduler.index, task.index));
            }
            task.count = numberIn(scheduler.count, 1, 1);
            const uint32_t first = numberIn(scheduler.first, 0, 0);
            const uint32_t step = numberIn(scheduler.step, 1, 1);
            const bool inStep = task.index >= first && (task.index - first) % step == 0;
            task.index = inStep ? (task.index - first) / step : task.count;
        }
        if (task.index < task.count) return task;
        throw CLI::ValidationError(fmt::format("--shard auto: {} is {}, which is no place among {} "
                                               "shards; number the tasks from 0 on without "
                                               "gaps",
                                               scheduler.index, std::getenv(scheduler.index),
                                               task.count));
    }
    throw CLI::ValidationError(
        fmt::format("--shard auto: none of {} is set; give --shard i/n", enumeration(known)));
}

}  // namespace sahl
