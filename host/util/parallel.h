// Loops over all cores.
#pragma once

#include <cstddef>
#include <functional>

namespace sahl {

/// Number of threads to use when the user named none.
unsigned defaultThreadCount();

/// Calls body(i) for every i in [0, count) on up to `threads` threads, in no particular order.
/// The first exception thrown by a body is thrown again here, after all threads have ended.
void parallelFor(size_t count, unsigned threads, const std::function<void(size_t)>& body);

}  // namespace sahl
