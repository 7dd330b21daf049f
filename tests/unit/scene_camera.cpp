// Cameras of scene files: what their rays do, with known answers.
#include "support/scene_files.h"

#include <cmath>

namespace sahl {
namespace {

using namespace sahl::testing;

/// The camera of a square picture.
Camera cameraOf(const std::string& camera, const std::string& shapes = "")
{
    return loadJson(R"({ "film": { "width": 64, "height": 64 }, "shapes": [)" + shapes +
                    R"(], "camera": )" + camera + " }")
        .camera;
}

std::string errorOf(const std::string& camera, const std::string& shapes = "")
{
    return errorOfJson(R"({ "camera": )" + camera + R"(, "shapes": [)" + shapes + "] }");
}

TEST(JsonCamera, withoutALensIsAPinhole)
{
    const Camera camera = cameraOf(R"({ "eye": [0, 0, 7], "lookAt": [0, 0, 0] })");
    EXPECT_EQ(camera.type, CAMERA_PERSPECTIVE);
    EXPECT_EQ(camera.lensRight, vec3(0));
    EXPECT_EQ(camera.lensDown, vec3(0));
    EXPECT_EQ(camera.focusDistance, 1);
}

TEST(JsonCamera, lensFocusesOnWhatItLooksAt)
{
    const Camera camera =
        cameraOf(R"({ "eye": [0, 0, 7], "lookAt": [0, 0, 2], "lensRadius": 0.25 })");
    EXPECT_EQ(camera.focusDistance, 5);
    EXPECT_EQ(camera.lensRight, vec3(0.25f, 0, 0));
    EXPECT_EQ(camera.lensDown, vec3(0, -0.25f, 0));
}

TEST(JsonCamera, lensFocusesAtADistanceAPointOrAShape)
{
    const std::string lens =
        R"({ "type": "perspective", "eye": [0, 0, 7], "lookAt": [0, 0, 0], "lensRadius": 0.5, )";
    EXPECT_EQ(cameraOf(lens + R"("focusDistance": 3 })").focusDistance, 3);
    // Along the view: beside it counts for nothing.
    EXPECT_EQ(cameraOf(lens + R"("focusOn": [100, -3, 1] })").focusDistance, 6);
    const std::string shapes = R"({ "type": "sphere", "center": [5, 0, 3], "radius": 2 },
        { "type": "sphere", "name": "drop", "center": [1, 1, -4], "radius": 0.5 },
        { "type": "rectangle", "name": "sheet", "corner": [0, 0, 1], "edgeU": [1, 0, 0], "edgeV": [0, 0, 2] })";
    EXPECT_EQ(cameraOf(lens + R"("focusOn": "drop" })", shapes).focusDistance, 11);
    EXPECT_EQ(cameraOf(lens + R"("focusOn": "sheet" })", shapes).focusDistance, 5);
}

TEST(JsonCamera, orthographicHasASizeInMetres)
{
    SceneOptions options;
    options.width = 200;
    options.height = 100;
    const Camera camera = loadJson(R"({ "camera": { "type": "orthographic", "eye": [0, 0, 7],
        "lookAt": [0, 0, 0], "height": 3 } })",
                                   options)
                              .camera;
    EXPECT_EQ(camera.type, CAMERA_ORTHOGRAPHIC);
    EXPECT_EQ(camera.position, vec3(0, 0, 7));
    EXPECT_EQ(camera.right, vec3(3, 0, 0));
    EXPECT_EQ(camera.down, vec3(0, -1.5f, 0));
    EXPECT_EQ(camera.forward, vec3(0, 0, -1));
}

TEST(JsonCamera, directionsGiveARightHandedCamera)
{
    // 2 atan(1/2): the tangent of half the field of view is 1/2.
    const Camera camera =
        cameraOf(R"({ "position": [1, 2, 3], "right": [4, 0, 0], "up": [0, 0.5, 0],
        "fovRad": 0.9272952180016122 })");
    EXPECT_EQ(camera.position, vec3(1, 2, 3));
    EXPECT_EQ(camera.forward, vec3(0, 0, -1));
    EXPECT_NEAR(camera.right.x, 0.5, 1e-7);
    EXPECT_NEAR(camera.down.y, -0.5, 1e-7);
}

TEST(JsonCamera, leftHandedLooksTheOtherWay)
{
    const Camera camera = cameraOf(R"({ "position": [0, 0, 0], "right": [1, 0, 0], "up": [0, 1, 0],
        "fovRad": 1, "leftHanded": true })");
    EXPECT_EQ(camera.forward, vec3(0, 0, 1));
    EXPECT_GT(camera.right.x, 0);
    EXPECT_LT(camera.down.y, 0);
}

TEST(JsonCamera, directionsMeanTheHorizontalFieldOfView)
{
    SceneOptions options;
    options.width = 200;
    options.height = 100;
    const Camera camera = loadJson(R"({ "camera": { "position": [0, 0, 0], "right": [1, 0, 0],
        "up": [0, 1, 0], "fovRad": 1.5707963267948966 } })",
                                   options)
                              .camera;
    EXPECT_NEAR(camera.right.x, 1, 1e-7);
    EXPECT_NEAR(camera.down.y, -0.5, 1e-7);
}

TEST(JsonCamera, mistakesAreNamedWithLineAndColumn)
{
    const std::string lens = R"({ "eye": [0, 0, 7], "lookAt": [0, 0, 0], "lensRadius": 0.5, )";
    const std::string axes = R"({ "position": [0, 0, 0], "fovRad": 1, )";
    const std::pair<std::string, const char*> mistakes[] = {
        {lens + R"("focusDistance": 1, "focusOn": [0, 0, 0] })",
         "1:104: the camera has both \"focusDistance\" and \"focusOn\""},
        {lens + R"("focusOn": [0, 0, 8] })",
         "1:84: \"focusOn\" of the camera is not in front of it"},
        {lens + R"("focusOn": "bal" })", "no shape has the name \"bal\"; did you mean \"ball\"?"},
        {lens + R"("focusDistance": 0 })", "\"focusDistance\" of the camera is 0"},
        {R"({ "eye": [0, 0, 0], "lookAt": [0, 0, 0], "focusOn": [0, 0, 1] })",
         "1:13: camera: eye and lookAt coincide"},
        {axes + R"("right": [0, 0, 0], "up": [0, 1, 0] })",
         "1:60: \"right\" of the camera is zero"},
        {axes + R"("right": [1, 0, 0], "up": [0, 0, 0] })", "1:77: \"up\" of the camera is zero"},
        {axes + R"("right": [1, 0.1, 0], "up": [0, 1, 0] })",
         "1:13: camera: right (0.9950371902099893, 0.09950371902099893, 0) and up (0, 1, 0) are "
         "not at a right angle"},
        {axes + R"("right": [1, 0, 0], "up": [0, 1, 0], "lensRadius": 1 })",
         "1:13: camera: a lens needs focusDistance or focusOn"},
        {R"({ "position": [0, 0, 0], "lookAt": [0, 0, 1] })",
         "unknown key \"position\" in the camera; did you mean \"eye\"?"},
        {R"({ "type": "orthographic", "eye": [0, 0, 1], "lookAt": [0, 0, 0] })",
         "the camera lacks the key \"height\""},
        {R"({ "type": "orthographic", "eye": [0, 0, 1], "lookAt": [0, 0, 0], "height": 1, "fovDeg": 30 })",
         "unknown key \"fovDeg\" in the camera"},
        {R"({ "type": "fisheye", "eye": [0, 0, 1], "lookAt": [0, 0, 0] })",
         "\"type\" of the camera is \"fisheye\""},
    };
    for (const auto& [camera, message] : mistakes) {
        EXPECT_CONTAINS(errorOf(camera, R"({ "type": "sphere", "name": "ball" })"), message);
    }
}

}  // namespace
}  // namespace sahl
