// Which task of an array of jobs this process is, by the environment variables of the schedulers.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace sahl {

struct ArrayTask {
    uint32_t index = 0;  ///< counted from 0
    uint32_t count = 0;
    std::string variable;  ///< that told the index
};

/// The task by the first scheduler whose variables are set: Slurm, AWS Batch, Kubernetes, MPI.
///   count  number of tasks; then the index is taken as it is. Without it both come from the
///   scheduler,
///          and the first task's index counts as 0
/// Throws a CLI::ValidationError when none is set, a variable holds no number, or the index is no
/// place in an array of that size.
ArrayTask arrayTask(std::optional<uint32_t> count);

}  // namespace sahl
