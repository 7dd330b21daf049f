// MTL files: tinyobjloader reads them, after a check of the colours with line numbers, since it
// takes 0 for whatever is not a number.
#include "scene/numbers.h"
#include "scene/obj_reader.h"
#include "scene/phong.h"
#include "scene/statements.h"
#include "util/error.h"

#include <tiny_obj_loader.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>

namespace sahl {

namespace {

constexpr uint64_t MAX_MTL_BYTES = uint64_t{64} << 20;
constexpr double MAX_EMISSION = 1e18;

/// What the check of an MTL file found out.
struct MtlCheck {
    std::set<std::pair<std::string, std::string>> given;  ///< material and keyword of a number
    std::set<std::string> unused;          ///< keywords and options that Sahl makes nothing of
    std::map<std::string, MtlMaps> maps;   ///< by material

    bool has(const std::string& material, const char* keyword) const
    {
        return given.count({material, keyword}) > 0;
    }
};

/// Where the maps of this keyword go; nullptr for other keywords.
std::optional<MtlMap>* mapOf(MtlMaps& maps, std::string_view keyword)
{
    static const std::map<std::string_view, std::optional<MtlMap> MtlMaps::*> places = {
        {"map_Kd", &MtlMaps::color},      {"map_d", &MtlMaps::alpha},
        {"map_Ke", &MtlMaps::emission},   {"norm", &MtlMaps::normal},
        {"map_Pr", &MtlMaps::roughness},  {"map_Pm", &MtlMaps::metallic},
    };
    const auto found = places.find(keyword);
    return found == places.end() ? nullptr : &(maps.*found->second);
}

MtlCheck checkMtl(std::string_view text, const std::string& file, const PathPolicy& policy)
{
    static const std::set<std::string_view> harmless = {"illum", "newmtl"};
    static const std::set<std::string_view> colors = {"Ka", "Kd", "Ks", "Ke"};
    static const std::set<std::string_view> numbers = {"Ns", "Pr", "Pm", "d"};
    MtlCheck check;
    StatementReader statements(text, file);
    Statement s;
    std::string material;
    while (statements.next(s)) {
        if (s.keyword == "newmtl") {
            material = std::string(s.rest);
        } else if (colors.count(s.keyword) > 0 || numbers.count(s.keyword) > 0) {
            const size_t count = numbers.count(s.keyword) > 0 ? 1 : 3;
            checkNumbers(s, count, count);
            check.given.emplace(material, s.keyword);
        } else if (auto* map = mapOf(check.maps[material], s.keyword)) {
            *map = readMtlMap(s, policy, check.unused);
        } else if (harmless.count(s.keyword) == 0) {
            check.unused.insert(std::string(s.keyword.substr(0, 20)));
        }
    }
    return check;
}

/// Clamps each channel to [0, most]; counts a material whose colour changed.
vec3 clampColor(const tinyobj::real_t (&color)[3], double most, uint64_t& clamped)
{
    vec3 result;
    bool changed = false;
    for (int i = 0; i < 3; i++) {
        double value = color[i];
        changed = changed || value < 0 || value > most;
        result[i] = toFloat(std::clamp(value, 0.0, most));
    }
    if (changed) clamped++;
    return result;
}

/// Ka, Ks and Ns, for the phong integrator.
void readPhong(const tinyobj::material_t& m, const MtlCheck& check, ObjMaterial& material,
               uint64_t& clamped)
{
    if (check.has(material.name, "Ka")) material.ambientColor = clampColor(m.ambient, 1, clamped);
    if (check.has(material.name, "Ks")) material.specularColor = clampColor(m.specular, 1, clamped);
    if (!check.has(material.name, "Ns")) return;
    const double exponent = m.shininess;
    if (exponent < 0 || exponent > MAX_SHININESS) clamped++;
    material.shininess = toFloat(std::clamp(exponent, 0.0, MAX_SHININESS));
}

/// Pr, Pm and d, and the maps.
void readSurface(const tinyobj::material_t& m, MtlCheck& check, ObjMaterial& material, uint64_t& clamped)
{
    auto share = [&](double value) {
        if (!(value >= 0 && value <= 1)) clamped++;
        return std::isfinite(value) ? std::clamp(value, 0.0, 1.0) : 0.0;
    };
    if (check.has(material.name, "Pr")) material.roughness = toFloat(share(m.roughness));
    if (check.has(material.name, "Pm")) material.metallic = toFloat(share(m.metallic));
    if (check.has(material.name, "d")) material.opacity = share(m.dissolve);
    material.maps = check.maps[material.name];
    if (material.maps.color && !check.has(material.name, "Kd")) material.baseColor = vec3(1);
    if (material.maps.emission && !check.has(material.name, "Ke")) material.emission = vec3(1);
}

void tellUnused(const std::set<std::string>& unused, const std::string& file)
{
    if (unused.empty()) return;
    std::string list;
    for (const std::string& keyword : unused) list += (list.empty() ? "" : ", ") + keyword;
    warn(fmt::format("{}: only Ka, Kd, Ks, Ke, Ns, Pr, Pm, d with map_d, map_Kd, map_Ke, map_Pr, map_Pm and "
                     "norm are used; left out: {}",
                     file, list.substr(0, 200)));
}

}  // namespace

void readMtl(const fs::path& file, const PathPolicy& policy, std::map<std::string, ObjMaterial>& materials)
{
    std::string text = normaliseLines(readTextFile(file, MAX_MTL_BYTES), file.string());
    MtlCheck check = checkMtl(text, file.string(), policy);

    std::map<std::string, int> indices;
    std::vector<tinyobj::material_t> read;
    std::string warning, error;
    std::istringstream stream(text);
    tinyobj::LoadMtl(&indices, &read, &stream, &warning, &error);

    uint64_t clamped = 0;
    for (const tinyobj::material_t& m : read) {
        std::string name(trimmed(m.name));
        if (name.empty()) continue;  // tinyobjloader flushes an unnamed one from an empty file
        ObjMaterial material;
        material.name = name;
        if (check.has(name, "Kd")) material.baseColor = clampColor(m.diffuse, 1, clamped);
        material.emission = clampColor(m.emission, MAX_EMISSION, clamped);
        readPhong(m, check, material, clamped);
        readSurface(m, check, material, clamped);
        if (!isFinite(material.baseColor) || !isFinite(material.emission) ||
            !isFinite(material.specularColor) ||
            !isFinite(material.ambientColor.value_or(vec3(0))) ||
            !std::isfinite(material.shininess.value_or(0))) {
            throw badInput("{}: tinyobjloader misreads a colour of \"{}\"; write it more simply",
                           file.string(), name);
        }
        if (material.opacity < 1 && !material.maps.alpha) check.unused.insert("d without map_d");
        materials.emplace(name, material);
    }
    tellUnused(check.unused, file.string());
    if (clamped > 0) {
        warn(fmt::format(
            "{}: {} colours outside [0,1] (Ka, Kd, Ks) or below 0 (Ke), shares (Pr, Pm, d) outside "
            "[0,1] or exponents (Ns) outside [0,1e6], were clamped",
            file.string(), clamped));
    }
}

}  // namespace sahl
