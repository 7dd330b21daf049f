"""Scene files of Tungsten (JSON) as scenes of Sahl: lambert boxes and quads, and lamps."""

import json

import transforms as tr
from mitsuba_xml import Unsupported


def read(path):
    """The scene; and their pixel filter is a tent, ours a box."""
    file = json.loads(path.read_text(encoding="utf-8"))
    camera, view = file["camera"], file["camera"]["transform"]
    if camera["type"] != "pinhole":
        raise Unsupported(f"the camera {camera['type']}")
    width, height = camera["resolution"]
    scene = {"camera": {"eye": view["position"], "lookAt": view["look_at"], "up": view["up"],
                        "fovDeg": camera["fov"], "fovAxis": "horizontal"},
             "film": {"width": width, "height": height},
             "integrator": {"maxBounces": file["integrator"]["max_bounces"] - 1},
             "materials": {bsdf["name"]: material(bsdf) for bsdf in file["bsdfs"]}, "shapes": []}
    for primitive in file["primitives"]:
        name = primitive["bsdf"]
        if "emission" in primitive:
            name = primitive["name"] + " lamp"
            scene["materials"][name] = {**scene["materials"][primitive["bsdf"]], "emission": primitive["emission"]}
        scene["shapes"] += shapes(primitive, name)
    return scene


def material(bsdf):
    if bsdf["type"] == "null":  # of lamps
        return {"type": "lambert", "baseColor": [0, 0, 0]}
    if bsdf["type"] != "lambert":
        raise Unsupported(f"the bsdf {bsdf['type']}")
    albedo = bsdf["albedo"]
    return {"type": "lambert", "baseColor": albedo if isinstance(albedo, list) else [albedo] * 3}


def matrix(transform):
    """Scale, then turn about Z, X and Y, then move. Their angle about Y counts clockwise."""
    x, y, z = transform.get("rotation", [0, 0, 0])
    made = tr.scaling(*transform.get("scale", [1, 1, 1]))
    for axis, angle in (([0, 0, 1], z), ([1, 0, 0], x), ([0, 1, 0], -y)):
        made = tr.times(tr.rotation(axis, angle), made)
    return tr.times(tr.translation(*transform.get("position", [0, 0, 0])), made)


def shapes(primitive, name):
    """A quad is the unit square around the origin with +Y in front, a cube the unit cube."""
    place = matrix(primitive["transform"])
    if primitive["type"] == "quad":
        return [square(place, [-0.5, 0, -0.5], [0, 0, 1], [1, 0, 0], name)]
    if primitive["type"] != "cube":
        raise Unsupported(f"the primitive {primitive['type']}")
    made = []
    for axis in range(3):
        edges = [[float(i == (axis + turn) % 3) for i in range(3)] for turn in (1, 2)]
        for side in (-0.5, 0.5):
            corner = [side if i == axis else -0.5 for i in range(3)]
            made.append(square(place, corner, *(edges if side > 0 else edges[::-1]), name))
    return made


def square(place, corner, first, second, name):
    return {"type": "rectangle", "material": name, "corner": tr.point(place, corner),
            "edgeU": tr.vector(place, first), "edgeV": tr.vector(place, second)}
