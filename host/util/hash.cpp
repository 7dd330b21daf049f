#include "util/hash.h"

#include <fmt/format.h>

#include <xxhash.h>

#include <new>

namespace sahl {

struct Hash::State {
    XXH3_state_t* xxh = XXH3_createState();  // which wants an alignment of its own
    State()
    {
        if (xxh == nullptr) throw std::bad_alloc();
        XXH3_64bits_reset(xxh);
    }
    ~State() { XXH3_freeState(xxh); }
    State(const State&) = delete;
    State& operator=(const State&) = delete;
};

Hash::Hash() : state_(std::make_unique<State>()) {}

Hash::~Hash() = default;

void Hash::add(std::span<const std::byte> bytes)
{
    XXH3_64bits_update(state_->xxh, bytes.data(), bytes.size());
}

uint64_t Hash::value() const
{
    return XXH3_64bits_digest(state_->xxh);
}

uint64_t hashOfBytes(std::span<const std::byte> bytes)
{
    return XXH3_64bits(bytes.data(), bytes.size());
}

std::string hashText(uint64_t hash)
{
    return fmt::format("{:016x}", hash);
}

}  // namespace sahl
