// What the tests of nested JSON share: files written by Sahl, and by other people's hands.
#pragma once

#include "support/saved_files.h"

namespace sahl::testing {

class TreeJsonTest : public ::testing::Test {
protected:
    PreparedScene writtenAndRead(const PreparedScene& prepared, const SceneOptions& options = {})
    {
        writeTreeJson(prepared, path);
        return loadTreeJson(path, options);
    }

    /// A file with this root, and a scene of one material; what is wrong with it, without the
    /// folder.
    std::string errorOfRoot(const std::string& root) { return errorOf(file(root)); }

    std::string errorOf(const std::string& text)
    {
        writeFileAtomically(path, text);
        std::string error = badInputOf([&] { loadTreeJson(path, {}); });
        const std::string place = folder.path.string() + "/";
        for (size_t at; (at = error.find(place)) != std::string::npos;)
            error.erase(at, place.size());
        return error;
    }

    /// A file of the given values; `objects` is left out when empty.
    static std::string file(const std::string& root, const std::string& texels = "[]",
                            const std::string& objects = "")
    {
        static const std::string head = [] {
            TemporaryFolder place;
            writeTreeJson(prepareText(R"({"shapes": [{"type": "sphere", "radius": 1}]})"),
                          place.path / "a.json");
            const std::string text = readTextFile(place.path / "a.json");
            return text.substr(0, text.find("\"texels\""));
        }();
        const std::string placed = objects.empty() ? "" : fmt::format("\"objects\":{},\n", objects);
        return fmt::format("{}\"texels\":{},\n{}\"root\":{}}}", head, texels, placed, root);
    }

    static std::string sphere(int number)
    {
        return fmt::format(R"({{"type":"sphere","number":{},"material":0,"center":[{},0,0],)"
                           R"("radius":0.5}})",
                           number, number);
    }

    TemporaryFolder folder;
    fs::path path = folder.path / "tree.json";
};

}  // namespace sahl::testing
