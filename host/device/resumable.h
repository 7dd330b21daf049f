// A kernel in two forms. One saves what runs out of steps, and it goes on in the next dispatch. In the other it begins again
// there: some drivers run every branch of a kernel, and would load and save for nobody with every dispatch.
#pragma once

#include "vulkan/pipeline.h"

#include <functional>
#include <utility>

namespace sahl {

/// Begins with the form that saves nothing, since hardly anything runs out of steps.
class ResumablePipeline {
public:
    using Make = std::function<ComputePipeline(bool resumes)>;  ///< with SPEC_RESUMES

    ResumablePipeline() = default;
    explicit ResumablePipeline(Make make) : make_(std::move(make)), pipeline_(make_(false)) {}

    ComputePipeline& get() { return pipeline_; }

    /// Goes on with the form that saves. Returns whether that is another pipeline than before, which has to be bound;
    /// the one before must not be in use any more.
    bool resume()
    {
        if (resumes_) return false;
        pipeline_ = make_(true);
        resumes_ = true;
        return true;
    }

private:
    Make make_;
    ComputePipeline pipeline_;
    bool resumes_ = false;
};

}  // namespace sahl
