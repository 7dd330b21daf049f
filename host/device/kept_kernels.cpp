#include "device/kept_kernels.h"

#include "util/cache_folder.h"
#include "util/error.h"
#include "util/files.h"
#include "util/hash.h"
#include "vulkan/fold_constants.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

namespace sahl {

namespace {

constexpr uint64_t LARGEST_FILE = uint64_t{16} << 20;

fs::path folderOfKernels()
{
    const fs::path cache = cacheFolder();
    return cache.empty() ? fs::path() : cache / "kernels";
}

fs::path fileOf(uint64_t key)
{
    return folderOfKernels() / (hashText(key) + ".spv");
}

/// The last two words of a file: what the words before them must add up to, for that key.
std::array<uint32_t, 2> sealOf(uint64_t key, std::span<const uint32_t> words)
{
    Hash hash;
    hash.add(std::as_bytes(std::span(&key, 1)));
    hash.add(std::as_bytes(words));
    return std::bit_cast<std::array<uint32_t, 2>>(hash.value());
}

/// Room for one more.
void removeOldest(const fs::path& folder)
{
    std::vector<std::pair<fs::file_time_type, fs::path>> files;
    for (const auto& entry : fs::directory_iterator(folder))
        if (entry.path().extension() == ".spv")
            files.emplace_back(entry.last_write_time(), entry.path());
    if (files.size() < MAX_KEPT_KERNELS) return;
    const auto end = files.end() - (MAX_KEPT_KERNELS - 1);
    std::nth_element(files.begin(), end, files.end());
    for (auto file = files.begin(); file != end; ++file) fs::remove(file->second);
}

}  // namespace

uint64_t kernelKey(std::span<const uint32_t> spirv, std::span<const uint32_t> constants)
{
    Hash hash;
    const std::string passes = foldingPasses();
    hash.add(std::as_bytes(std::span(passes)));
    hash.add(std::as_bytes(spirv));
    hash.add(std::as_bytes(constants));
    return hash.value();
}

std::optional<std::vector<uint32_t>> keptKernel(uint64_t key)
{
    std::error_code unknown;
    if (folderOfKernels().empty() || !fs::exists(fileOf(key), unknown)) return {};
    try {
        const std::vector<uint8_t> bytes = readFile(fileOf(key), LARGEST_FILE);
        constexpr size_t WORD = sizeof(uint32_t);
        if (bytes.size() < 2 * WORD || bytes.size() % WORD != 0) return {};
        std::vector<uint32_t> words(bytes.size() / WORD);
        std::memcpy(words.data(), bytes.data(), bytes.size());
        const std::array<uint32_t, 2> seal = {words[words.size() - 2], words[words.size() - 1]};
        words.resize(words.size() - 2);
        if (seal != sealOf(key, words)) return {};
        return words;
    } catch (const Error&) {
        return {};
    }
}

void keepKernel(uint64_t key, std::span<const uint32_t> folded)
{
    const fs::path folder = folderOfKernels();
    if (folder.empty()) return;
    try {
        fs::create_directories(folder);
        removeOldest(folder);
        const auto seal = sealOf(key, folded);
        std::vector<uint32_t> words(folded.begin(), folded.end());
        words.insert(words.end(), seal.begin(), seal.end());
        const auto* bytes = reinterpret_cast<const uint8_t*>(words.data());
        writeFileAtomically(fileOf(key), std::span(bytes, words.size() * sizeof(uint32_t)));
    } catch (const Error&) {
    } catch (const fs::filesystem_error&) {
    }
}

}  // namespace sahl
