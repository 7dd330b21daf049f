// Russian roulette: a path that carries little ends by chance, and if it goes on it carries as much more.
// Arvo and Kirk 1990, "Particle Transport and Image Synthesis", SIGGRAPH.

CONST float LEAST_SURVIVAL = 0.05f;  // so that no path comes back 20 times as bright as it was

/// Probability that the path goes on: the fourth root of what it carries, so that the dark ones still tell something. With
/// what it carries itself, rays are saved and as much noise is made (docs/sampling.md). What refraction has divided
/// radiance by does not count: the path gets it back where it leaves the dense medium.
float survivalOf(vec3 beta, float etaScale)
{
    return min2(1.0f, max2(LEAST_SURVIVAL, root(root(maxComponent(beta) * etaScale))));
}

/// Whether the path goes on after it was scattered at a vertex.
///   dimension  of the vertex
bool survivesRoulette(uint dimension, INOUT(PathState) path)
{
    if (path.depth < UNIFORM(rouletteDepth)) return true;
    float survival = survivalOf(path.beta, path.etaScale);
    if (!(survival < 1.0f)) return true;
    float u = random4(path.pixel, path.sampleIndex, dimension + DIMENSION_LIGHT).w;
    if (!(u < survival)) return false;
    path.beta = path.beta * quotient(1.0f, survival);
    return true;
}
