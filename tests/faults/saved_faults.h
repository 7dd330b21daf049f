// What the tests of broken saved scenes share: a whole file, and ways to alter it.
#pragma once

#include "support/saved_files.h"
#include "support/soups.h"

#include <functional>

namespace sahl::testing {

class SavedFaults : public ::testing::Test {
protected:
    SavedFaults()
    {
        writeSavedScene(prepareText(richScene()), path);
        whole = readFile(path);
    }

    /// What loading these bytes says, without the folder.
    std::string errorOfBytes(const std::vector<uint8_t>& bytes)
    {
        std::ofstream(path, std::ios::binary)
            .write(reinterpret_cast<const char*>(bytes.data()),
                   static_cast<std::streamsize>(bytes.size()));
        return errorOfFile();
    }

    std::string errorOfFile()
    {
        std::string error = badInputOf([&] { loadSavedScene(path, {}); });
        const std::string place = folder.path.string() + "/";
        for (size_t at; (at = error.find(place)) != std::string::npos;)
            error.erase(at, place.size());
        return error;
    }

    /// What is said of a file whose hashes are right and whose sections are as `alter` leaves them.
    std::string errorOfSections(const std::function<void(std::vector<OwnSection>&)>& alter)
    {
        writeFileAtomically(path, whole);
        std::vector<OwnSection> sections = sectionsOf(path);
        alter(sections);
        writeSections(path, sections);
        return errorOfFile();
    }

    /// The same for one element of one section.
    template <class Element>
    std::string errorOfElement(const std::string& section, size_t index,
                               const std::function<void(Element&)>& alter)
    {
        return errorOfSections([&](std::vector<OwnSection>& sections) {
            OwnSection& own = sectionNamed(sections, section);
            Element element = own.get<Element>(index);
            alter(element);
            own.set(index, element);
        });
    }

    std::string errorOfDescription(const std::string& from, const std::string& to)
    {
        return errorOfSections([&](std::vector<OwnSection>& sections) {
            OwnSection& own = sectionNamed(sections, "scene");
            std::string text = own.text();
            ASSERT_NE(text.find(from), std::string::npos) << text;
            own.setText(text.replace(text.find(from), from.size(), to));
        });
    }

    /// Error for a header with one field altered and its hash made right again.
    std::string errorOfHeader(
        const std::function<void(SavedHeader&, std::vector<SavedEntry>&)>& alter)
    {
        std::vector<uint8_t> bytes = whole;
        SavedHeader header;
        std::memcpy(&header, bytes.data(), sizeof(header));
        std::vector<SavedEntry> table(header.sectionCount);
        const size_t tableBytes = table.size() * sizeof(SavedEntry);
        std::memcpy(table.data(), bytes.data() + sizeof(header), tableBytes);
        alter(header, table);
        header.hash = 0;
        std::memcpy(bytes.data(), &header, sizeof(header));
        std::memcpy(bytes.data() + sizeof(header), table.data(), tableBytes);
        header.hash = hashOf(std::as_bytes(std::span(bytes)).first(sizeof(header) + tableBytes));
        std::memcpy(bytes.data(), &header, sizeof(header));
        return errorOfBytes(bytes);
    }

    TemporaryFolder folder;
    fs::path path = folder.path / "x.sahl";
    std::vector<uint8_t> whole;
};

/// Loads files with a few words of one section replaced, hashes right; renders what is not refused.
/// Returns how many were rendered.
inline int renderHostileVariants(const fs::path& path, uint64_t seed, int count)
{
    Random random(seed);
    const std::vector<OwnSection> good = sectionsOf(path);
    const std::unique_ptr<Device> device = makeCpuDevice({});
    int rendered = 0;
    for (int i = 0; i < count; i++) {
        std::vector<OwnSection> sections = good;
        OwnSection* section = nullptr;
        while (section == nullptr || section->name == "scene" || section->bytes.empty()) {
            section = &sections[random.below(static_cast<uint>(sections.size()))];
        }
        const uint words = static_cast<uint>(section->bytes.size() / 4);
        for (uint k = random.below(2) + 1; k > 0; k--) {
            const uint32_t hard[] = {0,          1,
                                     0x7f800000, 0x7fc00000,
                                     0xffffffff, 0x80000000,
                                     0x7f7fffff, 0x00000001,
                                     0x3f800000, static_cast<uint32_t>(random.bits())};
            section->set<uint32_t>(random.below(words), hard[random.below(std::size(hard))]);
        }
        writeSections(path, sections);
        PreparedScene prepared;
        const SceneOptions options = smallPicture(6, 4, 2);
        if (!badInputOf([&] { prepared = loadSavedScene(path, options); }).empty()) continue;
        renderFilm(*device, prepared);
        rendered++;
    }
    return rendered;
}

}  // namespace sahl::testing
