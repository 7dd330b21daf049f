// 64.64 fixed point: sums that are exact, hence the same in any order.
#include "film/film.h"

#include <bit>
#include <cassert>
#include <limits>

namespace sahl {

namespace {
constexpr uint64_t ALL_ONES = std::numeric_limits<uint64_t>::max();
constexpr Fixed64x64 LARGEST = {ALL_ONES, ALL_ONES};
}  // namespace

Fixed64x64 Fixed64x64::fromFloat(float value)
{
    const uint32_t bits = std::bit_cast<uint32_t>(value);
    assert(bits <= 0x7f800000u || bits == 0x80000000u);  // not negative, not NaN
    const uint32_t exponent = bits >> 23 & 0xffu;
    uint64_t mantissa = bits & 0x7fffffu;
    if (exponent > 0) mantissa |= 0x800000u;
    // value = mantissa * 2^(e - 150), with e = 1 for denormals; in units of 2^-64:
    const int shift = static_cast<int>(exponent > 0 ? exponent : 1u) - 150 + 64;
    if (shift <= -24) return {};
    if (shift < 0) return {0, mantissa >> -shift};
    if (shift == 0) return {0, mantissa};
    if (shift < 64) return {mantissa >> (64 - shift), mantissa << shift};
    if (shift <= 64 + 40) return {mantissa << (shift - 64), 0};
    return LARGEST;
}

Fixed64x64 Fixed64x64::fromDouble(double value)
{
    const uint64_t bits = std::bit_cast<uint64_t>(value);
    assert(bits <= 0x7ff0000000000000u || bits == uint64_t{1} << 63);  // not negative, not NaN
    const uint64_t exponent = bits >> 52 & 0x7ffu;
    const uint64_t mantissa = (bits & 0xfffffffffffffu) | (exponent > 0 ? uint64_t{1} << 52 : 0);
    // value = mantissa * 2^(e - 1075), with e = 1 for denormals; in units of 2^-64:
    const int shift = static_cast<int>(exponent > 0 ? exponent : 1u) - 1075 + 64;
    if (shift <= -53) return {};
    if (shift < 0) return {0, mantissa >> -shift};
    if (shift == 0) return {0, mantissa};
    if (shift < 64) return {mantissa >> (64 - shift), mantissa << shift};
    if (shift <= 64 + 11) return {mantissa << (shift - 64), 0};
    return LARGEST;
}

void Fixed64x64::add(Fixed64x64 other)
{
    fraction += other.fraction;
    const uint64_t carry = fraction < other.fraction ? 1 : 0;
    const bool overflow = other.whole > ALL_ONES - whole || whole + other.whole > ALL_ONES - carry;
    whole += other.whole + carry;
    if (overflow) *this = LARGEST;
}

void Fixed64x64::subtract(Fixed64x64 other)
{
    if (*this == LARGEST) return;
    const uint64_t borrow = fraction < other.fraction ? 1 : 0;
    fraction -= other.fraction;
    whole -= other.whole + borrow;
}

double Fixed64x64::toDouble() const
{
    // The upper 64 significant bits, the last one standing for all that follow: the conversion to
    // double then rounds once, to nearest.
    if (whole == 0) return static_cast<double>(fraction) * 0x1p-64;
    const int shift = std::countl_zero(whole);
    const uint64_t top = shift == 0 ? whole : whole << shift | fraction >> (64 - shift);
    const uint64_t rest = fraction << shift;
    const auto scale = std::bit_cast<double>(uint64_t(1023 - shift) << 52);  // 2^-shift
    return static_cast<double>(top | (rest != 0 ? 1u : 0u)) * scale;
}

}  // namespace sahl
