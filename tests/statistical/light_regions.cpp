// Both ways of finding light together, against the better one alone: of the whole picture, ray for
// ray, and of each of its regions, sample for sample.
#include "support/render_scenes.h"
#include "support/veach_scene.h"

#include <gtest/gtest.h>

namespace sahl::testing {
namespace {

constexpr uint32_t COLUMNS = 8, ROWS = 4;  // regions of the picture
constexpr uint32_t WAYS[] = {LIGHTS_MIS, LIGHTS_ONLY, LIGHTS_BSDF_ONLY};

/// Mean and its standard error, of numbers that are measured again and again.
struct Estimate {
    double mean = 0, error = 0;
};

Estimate estimateOf(const std::vector<double>& values)
{
    const double n = double(values.size());
    double sum = 0, sum2 = 0;
    for (double value : values) sum += value / n;
    for (double value : values) sum2 += (value - sum) * (value - sum);
    return {sum, std::sqrt(sum2 / (n * (n - 1)))};
}

/// The mean of a over that of b, which were measured together.
Estimate ratioOf(const std::vector<double>& a, const std::vector<double>& b)
{
    const double below = estimateOf(b).mean;
    const double ratio = estimateOf(a).mean / below;
    std::vector<double> residues;
    for (size_t i = 0; i < a.size(); i++) residues.push_back((a[i] - ratio * b[i]) / below);
    return {ratio, estimateOf(residues).error};
}

/// What a way of finding light costs and is worth, in several parts of the samples.
struct Measured {
    std::vector<double> regions[COLUMNS * ROWS];  ///< variance of a sample, in each part
    std::vector<double> frame;
    double rays = 0;
};

/// Variance of a sample's luminance about its pixel's mean.
double varianceOf(const Film& film, size_t i)
{
    double sum = 0, sum2 = 0, n = 0;
    for (const auto& half : film.half) {
        const HalfPixel& pixel = half[i];
        sum += 0.2126 * pixel.sum[0].toDouble() + 0.7152 * pixel.sum[1].toDouble() +
               0.0722 * pixel.sum[2].toDouble();
        sum2 += pixel.sumY2.toDouble();
        n += pixel.samples;
    }
    return std::max(0.0, (sum2 - sum * sum / n) / (n - 1));
}

Measured measure(Scene scene, uint32_t way, uint32_t parts, uint32_t spp)
{
    scene.settings.lightSampling = way;
    const PreparedScene prepared = prepareScene(std::move(scene), BvhBuild::automatic, 2);
    const auto device = makeCpuDevice({});
    Measured found;
    for (uint32_t part = 0; part < parts; part++) {
        const Film film = renderFilm(*device, prepared, part * spp, spp);
        double regions[COLUMNS * ROWS] = {}, frame = 0;
        for (uint32_t y = 0; y < film.height; y++) {
            for (uint32_t x = 0; x < film.width; x++) {
                const double variance = varianceOf(film, size_t{y} * film.width + x);
                regions[y * ROWS / film.height * COLUMNS + x * COLUMNS / film.width] += variance;
                frame += variance;
            }
        }
        const double pixels = double(film.width) * film.height;
        for (size_t r = 0; r < COLUMNS * ROWS; r++)
            found.regions[r].push_back(regions[r] * COLUMNS * ROWS / pixels);
        found.frame.push_back(frame / pixels);
        found.rays += double(film.counters.cameraRays + film.counters.indirectRays +
                             film.counters.shadowRays) /
                      (pixels * parts * spp);
    }
    return found;
}
void print(const char* name, const Scene& scene, uint32_t parts, uint32_t spp)
{
    std::vector<Measured> all;
    for (uint32_t way : WAYS) {
        all.push_back(measure(scene, way, parts, spp));
        auto f = estimateOf(all.back().frame);
        printf("%s way %u rays %.3f frame %.5g +- %.2g  var*rays %.5g\n", name, way,
               all.back().rays, f.mean, f.error, f.mean * all.back().rays);
        fflush(stdout);
    }
    for (int w : {1, 2}) {
        auto r = ratioOf(all[0].frame, all[w].frame);
        double k = all[0].rays / all[w].rays;
        printf("frame mis/%d: samples %.5f +- %.5f, rays %.5f\n", w, r.mean, r.error, r.mean * k);
    }
    for (size_t r = 0; r < COLUMNS * ROWS; r++) {
        double l = estimateOf(all[1].regions[r]).mean, b = estimateOf(all[2].regions[r]).mean;
        if (!(l > 0) && !(b > 0)) continue;
        auto& better = l < b ? all[1] : all[2];
        auto q = ratioOf(all[0].regions[r], better.regions[r]);
        auto e = estimateOf(better.regions[r]);
        printf("%zu,%zu lights %.4g bsdf %.4g (err better %.1f%%) mis/better %.4f +- %.4f %s\n",
               r % COLUMNS, r / COLUMNS, l, b, 100 * e.error / e.mean, q.mean, q.error,
               q.mean + 1.645 * q.error > 1.1 ? "***" : "");
    }
}
TEST(LongLightRegions, proto)
{
    if (getenv("VEACH")) print("veach", veachScene(128, 72), 32, 64);
    if (getenv("SPONZA")) {
        Scene scene = loadScene(assetFolder() / "meshes/miro/sponza.obj", {});
        scene.settings = {128, 72, 0, 6, 1};
        scene.settings.shading |= 0;
        scene.materials.clear();
        scene.materialNames.clear();
        addMaterialOf(scene, MATERIAL_LAMBERT, vec3(0.7f));
        for (auto& p : scene.primitives) p.material = 0;
        scene.probe = blackProbe();
        scene.background.reset();
        addMaterialOf(scene, MATERIAL_LAMBERT, vec3(0)).emission = vec3(1000);
        addSphere(scene, {-4, 3.0f, 0}, 0.1f);
        lookFrom(scene, {-9.5, 3, 0}, {0, 3.6, 0}, 65);
        print("sponza", scene, 16, 64);
    }
}
}  // namespace
}  // namespace sahl::testing
