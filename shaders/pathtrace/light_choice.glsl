// One of many by its weight in constant time: reading of alias tables (host/scene/alias_table.h).

// Where a vertex looks for light, and how likely that was.
struct LightChoice
{
    uint light;         // index in `lights`; or TAKE_PROBE, TAKE_TABLE, TAKE_NOTHING
    float chance;       // of what was taken
    float probeChance;  // that of the probe
    float tableChance;  // that of the alias table
};

CONST uint TAKE_PROBE = 0xffffffffu;
CONST uint TAKE_TABLE = 0xfffffffeu;    // one of its lights
CONST uint TAKE_NOTHING = 0xfffffffdu;  // nothing would arrive

/// The product of two 32-bit numbers, as 64 bits.
void wideProduct(uint a, uint b, OUT(uint) high, OUT(uint) low)
{
    uint a0 = a & 0xffffu;
    uint a1 = a >> 16u;
    uint b0 = b & 0xffffu;
    uint b1 = b >> 16u;
    uint lowest = a0 * b0;
    uint middle0 = a0 * b1;
    uint middle1 = a1 * b0;
    uint carried = ((lowest >> 16u) + (middle0 & 0xffffu)) + (middle1 & 0xffffu);
    high = ((a1 * b1 + (middle0 >> 16u)) + (middle1 >> 16u)) + (carried >> 16u);
    low = (lowest & 0xffffu) | (carried << 16u);
}

/// Chooses one of `count` things, with a chance of its mass over count 2^32.
///   first  entry of the table
///   bits   uniform: a number in [0, 1) as a binary fraction
///   finer  24 further bits of it. Without them few numbers would be left for one of very many things
uint chooseByAlias(uint first, uint count, uint bits, uint finer)
{
    uint k;
    uint rest;
    uint more;
    uint lost;
    wideProduct(bits, count, k, rest);
    wideProduct(finer << 8u, count, more, lost);
    uint within = rest + more;
    if (within < rest) k++;
    AliasEntry entry = loadAliasEntry(first + k);
    return within < entry.threshold ? k : entry.alias;
}
