#include "scene/alias_table.h"

#include <algorithm>
#include <numeric>

namespace sahl {

namespace {

constexpr uint64_t FULL = uint64_t{1} << 32;  ///< what each entry hands out

/// First thing from `i` on whose mass fills an entry (or does not).
size_t nextThat(std::span<const uint64_t> masses, bool fills, size_t i)
{
    while (i < masses.size() && (masses[i] >= FULL) != fills) i++;
    return i;
}

}  // namespace

std::vector<uint64_t> massesOf(std::span<const double> weights)
{
    const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
    const double total = static_cast<double>(weights.size()) * 0x1p32;
    std::vector<uint64_t> masses(weights.size());
    double before = 0;
    uint64_t begin = 0;
    // Rounded sums rather than rounded masses: so they add up, and the last one ends at the total.
    for (size_t i = 0; i < weights.size(); i++) {
        before += weights[i];
        const uint64_t end = std::max(begin, static_cast<uint64_t>(before / sum * total + 0.5));
        masses[i] = end - begin;
        begin = end;
    }
    uint64_t& largest = *std::max_element(masses.begin(), masses.end());
    for (size_t i = 0; i < weights.size(); i++) {
        if (weights[i] <= 0 || masses[i] > 0) continue;
        masses[i] = 1;
        largest--;
    }
    return masses;
}

std::vector<AliasEntry> makeAliasTable(std::span<const uint64_t> masses)
{
    std::vector<AliasEntry> entries(masses.size());
    for (uint i = 0; i < entries.size(); i++) entries[i] = {0xffffffffu, i};

    // A heavy thing fills up the entries of light ones until it has become light itself; then the
    // next heavy one fills up its entry and takes over. As all masses are n times FULL, both end
    // together.
    size_t light = nextThat(masses, false, 0);
    size_t heavy = nextThat(masses, true, 0);
    uint64_t rest = heavy < masses.size() ? masses[heavy] : FULL;  // of the heavy one
    while (light < masses.size() || rest < FULL) {
        if (rest >= FULL) {
            entries[light] = {static_cast<uint>(masses[light]), static_cast<uint>(heavy)};
            rest -= FULL - masses[light];
            light = nextThat(masses, false, light + 1);
        } else {
            const size_t next = nextThat(masses, true, heavy + 1);
            entries[heavy] = {static_cast<uint>(rest), static_cast<uint>(next)};
            rest = masses[next] - (FULL - rest);
            heavy = next;
        }
    }
    return entries;
}

}  // namespace sahl
