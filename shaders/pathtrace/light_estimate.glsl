// Where a vertex looks for light: chosen by what would arrive if nothing were in the way.
//
// It is a choice among the probe, each of the single lights, and the alias table of all others. Whatever
// the estimates are worth, the picture's mean does not depend on them: they only have to be more than 0
// where light may arrive. The chances of probe and table go along with the path, as what its next ray
// finds is weighted by them.

// Of all that would arrive together, each part that is not 0 gets so much more: something may be in the
// way of the others.
CONST float LEAST_SHARE = 0.03125f;

/// Whether there is anything to choose among.
bool anyLightIsSampled()
{
    return UNIFORM(choiceCount) != 0u || UNIFORM(singleCount) != 0u || UNIFORM(probeMean) > 0.0f;
}

/// An estimate as a number between 1e-30 and 1e25, or 0.
float boundedEstimate(float x) { return min2(flushed(x), 1e25f); }

/// Irradiance by a point, spot or directional light [W m^-2]: luminance.
///   through  light from behind the surface counts
float arrivingFromLight(READ(Light) light, READ(SurfaceInteraction) isect, bool through)
{
    LightSample ls = illuminate(light, isect.p);
    float cosine = 1.0f;
    if (!through) cosine = dot3(ls.wi, isect.ng) > 0.0f ? max2(dot3(ls.wi, isect.ns), 0.05f) : 0.0f;
    return boundedEstimate(luminance(ls.Li) * cosine);
}

/// About the irradiance by the lights of a cluster [W m^-2]: luminance.
float arrivingFromCluster(READ(Light) cluster, READ(SurfaceInteraction) isect, bool through)
{
    vec3 way = cluster.position - isect.p;
    float d2 = max2(dot3(way, way) + cluster.cosOuter, 1e-20f);
    float perDistance = quotient(1.0f, root(d2));
    float cosine = 1.0f;
    if (!through) {
        // As much higher above the horizon as the cluster is large
        float height = dot3(way, isect.ns) + root(cluster.cosOuter);
        cosine = min2(max2(height * perDistance, 0.05f), 1.0f);
    }
    return cluster.intensity.x * (cosine * (perDistance * perDistance)) + cluster.cosInner;
}

float arrivingFromTable(READ(SurfaceInteraction) isect, bool through)
{
    float sum = 0.0f;
    uint first = UNIFORM(singleCount) + UNIFORM(choiceCount);
    for (uint i = 0u; i < UNIFORM(clusterCount); i++) {
        sum += arrivingFromCluster(loadLight(first + i), isect, through);
    }
    return boundedEstimate(sum);
}

/// Irradiance by the probe, as far as its luminance is linear in the direction [W m^-2].
float arrivingFromProbe(READ(SurfaceInteraction) isect, bool through)
{
    float even = 3.14159274f * UNIFORM(probeMean);
    if (through) return boundedEstimate(even);
    float slope = 2.09439516f * dot3(UNIFORM(probeSlope), isect.ns);
    return boundedEstimate(max2(even + slope, 0.25f * even));
}

/// Chance that a vertex looks for light at all, as a number of the 2^24 that a uniform number may be. All
/// do but those of paths that carry little: shadow rays are better spent where they tell more.
///   carried  largest component of the throughput
float placesOfAll(float carried)
{
    return floor(16777216.0f * min2(max2(carried * 4.0f, 0.0625f), 1.0f));
}

/// Where the share of something ends, as a number of the 2^24 that the uniform number may be.
///   all     where that of all ends
///   isLast  the rest is its
float endOfShare(float sum, float perSum, float all, bool isLast)
{
    return isLast ? all : min2(floor(sum * perSum + 0.5f), all);
}

/// Chooses the one light that `place` falls to.
///   begin   where the shares of the lights begin
///   sum     of all estimates before them, likewise
///   least   that every estimate is raised by
///   count   lights of which something would arrive, at least 1
///   all     where their shares end
void chooseSingleLight(READ(SurfaceInteraction) isect, bool through, float place, float begin, float sum,
                       float least, float perSum, float all, uint count, INOUT(LightChoice) choice)
{
    for (uint i = 0u; i < UNIFORM(singleCount); i++) {
        float arriving = arrivingFromLight(loadLight(i), isect, through);
        if (!(arriving > 0.0f)) continue;
        count--;
        sum += arriving + least;
        float end = endOfShare(sum, perSum, all, count == 0u);
        if (place < end) {
            choice.light = i;
            choice.chance = (end - begin) * 5.96046448e-8f;
            return;
        }
        begin = end;
    }
}

/// Chooses where to look for light.
///   through  light from behind the surface counts
///   carried  largest component of the path's throughput
///   u        uniform in [0,1), a multiple of 2^-24. So are the chances, which therefore are exact
LightChoice chooseLight(READ(SurfaceInteraction) isect, bool through, float carried, float u)
{
    float all = placesOfAll(carried);
    float place = u * 16777216.0f;
    LightChoice choice;
    bool hasProbe = HAS_PROBE_LIGHT && UNIFORM(probeMean) > 0.0f;
    bool hasTable = (HAS_FAR_LIGHTS || HAS_SHAPE_LIGHTS) && UNIFORM(choiceCount) != 0u;
    choice.light = hasProbe ? TAKE_PROBE : TAKE_TABLE;
    choice.chance = all * 5.96046448e-8f;
    choice.probeChance = hasProbe ? choice.chance : 0.0f;
    choice.tableChance = hasProbe ? 0.0f : choice.chance;
    if (!(place < all)) choice.light = TAKE_NOTHING;
    if ((!HAS_FAR_LIGHTS || UNIFORM(singleCount) == 0u) && hasProbe != hasTable) return choice;

    float ofProbe = 0.0f;
    float ofTable = 0.0f;
    float ofLights = 0.0f;
    uint shining = 0u;
    if (HAS_PROBE_LIGHT && hasProbe) ofProbe = arrivingFromProbe(isect, through);
    if ((HAS_FAR_LIGHTS || HAS_SHAPE_LIGHTS) && hasTable) ofTable = arrivingFromTable(isect, through);
    if (HAS_FAR_LIGHTS) {
        for (uint i = 0u; i < UNIFORM(singleCount); i++) {
            float arriving = arrivingFromLight(loadLight(i), isect, through);
            ofLights += arriving;
            if (arriving > 0.0f) shining++;
        }
    }
    float total = (ofProbe + ofTable) + ofLights;
    choice.light = TAKE_NOTHING;
    choice.probeChance = 0.0f;
    choice.tableChance = 0.0f;
    if (!(total > 0.0f)) return choice;

    float least = total * LEAST_SHARE;
    if (ofProbe > 0.0f) ofProbe += least;
    if (ofTable > 0.0f) ofTable += least;
    float perSum = quotient(all, (ofProbe + ofTable) + (ofLights + float(shining) * least));
    bool tableIsLast = shining == 0u;
    float endOfProbe = endOfShare(ofProbe, perSum, all, tableIsLast && !(ofTable > 0.0f));
    float endOfTable = endOfShare(ofProbe + ofTable, perSum, all, tableIsLast);
    choice.probeChance = endOfProbe * 5.96046448e-8f;
    choice.tableChance = (endOfTable - endOfProbe) * 5.96046448e-8f;

    if (HAS_PROBE_LIGHT && place < endOfProbe) {
        choice.light = TAKE_PROBE;
        choice.chance = choice.probeChance;
    } else if (place < endOfTable) {
        choice.light = TAKE_TABLE;
        choice.chance = choice.tableChance;
    } else if (HAS_FAR_LIGHTS && place < all) {
        chooseSingleLight(isect, through, place, endOfTable, ofProbe + ofTable, least, perSum, all, shining,
                          choice);
    }
    return choice;
}
