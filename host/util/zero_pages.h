// Large arrays of zeros that cost nothing until they are touched.
#pragma once

#include <cstddef>
#include <cstdlib>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

namespace sahl {

/// Leaves new elements as the system gives memory out: all bits 0, each page made when somebody first touches it, by
/// whichever thread that is.
template <typename T>
struct ZeroPages {
    static_assert(std::is_trivially_copyable_v<T> && alignof(T) <= alignof(std::max_align_t));
    using value_type = T;

    ZeroPages() = default;
    template <typename U>
    ZeroPages(const ZeroPages<U>&)
    {
    }

    T* allocate(size_t count)
    {
        void* memory = std::calloc(count, sizeof(T));
        if (memory == nullptr) throw std::bad_alloc();
        return static_cast<T*>(memory);
    }
    void deallocate(T* memory, size_t) { std::free(memory); }

    void construct(T*) {}  // it is zero already
    template <typename... Arguments>
    void construct(T* at, Arguments&&... arguments)
    {
        ::new (static_cast<void*>(at)) T(std::forward<Arguments>(arguments)...);
    }

    bool operator==(const ZeroPages&) const = default;
};

/// A vector that gets its size once and never shrinks: elements that are made anew where others were would not be zero.
/// Zero bits must be what T{} is.
template <typename T>
using ZeroedVector = std::vector<T, ZeroPages<T>>;

}  // namespace sahl
