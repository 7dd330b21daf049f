// Hashes that tell whether two pieces of data are the same: not for secrets.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

namespace sahl {

/// XXH3 (64 bits) of everything that is added, as if it were one piece.
class Hash {
public:
    Hash();
    ~Hash();
    Hash(const Hash&) = delete;
    Hash& operator=(const Hash&) = delete;

    void add(std::span<const std::byte> bytes);
    uint64_t value() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

/// XXH3 (64 bits) of one piece.
uint64_t hashOfBytes(std::span<const std::byte> bytes);

/// 16 hexadecimal digits.
std::string hashText(uint64_t hash);

}  // namespace sahl
