// Arrays of zeros that cost nothing until they are touched.
#include "util/zero_pages.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>

namespace sahl::testing {
namespace {

TEST(ZeroPages, areZeroAlsoWhereMemoryWasUsedBefore)
{
    for (size_t count : {10u, 1000u, 1000000u}) {
        {
            std::vector<uint64_t> used(count, ~uint64_t{0});
            EXPECT_EQ(used.back(), ~uint64_t{0});
        }
        const ZeroedVector<uint64_t> zeros(count);
        EXPECT_EQ(std::count(zeros.begin(), zeros.end(), 0u), static_cast<std::ptrdiff_t>(count));
    }
}

TEST(ZeroPages, areCopiedWithWhatWasPutIn)
{
    ZeroedVector<uint64_t> first(1000);
    first[7] = 42;
    const ZeroedVector<uint64_t> second = first;
    EXPECT_EQ(second[7], 42u);
    EXPECT_EQ(second, first);
    first[8] = 1;
    EXPECT_NE(second, first);
}

}  // namespace
}  // namespace sahl::testing
