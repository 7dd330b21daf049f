"""Nori's tests (<test type="ttest">) as scenes of Sahl with the mean luminance that each must have."""

import xml.etree.ElementTree

import transforms as tr
from mitsuba_xml import Unsupported, numbers

ONE_BOUNCE = ("whitted", "direct_ems", "direct_mats", "direct_mis")
ALL_BOUNCES = ("path_ems", "path_mats", "path_mis")
STRATEGIES = {"ems": "lights", "mats": "bsdf", "mis": "mis"}  # of --light-sampling
ENDLESS = 100  # bounces; a surface of albedo 0.8 reflects 0.8^100 = 2e-10 after that many


class StudentTest:
    """What a file says: scenes with references, and how sure to be."""

    def __init__(self, path):
        root = xml.etree.ElementTree.parse(path).getroot()
        self.references = numbers(text(root, "references"))
        self.level = float(text(root, "significanceLevel", "0.01"))
        self.samples = int(text(root, "sampleCount", "100000"))
        self.scenes = [scene(node, path.parent) for node in root.findall("scene")]
        if len(self.scenes) != len(self.references):
            raise Unsupported("anything but whole scenes")


def text(node, name, otherwise=None):
    for child in node:
        if child.get("name") == name:
            return child.get("value")
    return otherwise


def scene(node, folder):
    integrator = node.find("integrator").get("type")
    if integrator not in ONE_BOUNCE + ALL_BOUNCES:
        raise Unsupported(f"the integrator {integrator}")
    made = {"camera": camera(node.find("camera")), "materials": {}, "shapes": [],
            "integrator": {"maxBounces": 1 if integrator in ONE_BOUNCE else ENDLESS}}
    for i, mesh in enumerate(node.findall("mesh")):
        made["materials"][f"material {i}"] = material(mesh)
        made["shapes"].append({"type": "mesh", "file": str(folder / text(mesh, "filename")),
                               "material": f"material {i}"})
    return integrator, made


def camera(node):
    """Square pictures only, so that it does not matter which side the angle is of."""
    matrix = tr.identity()
    for transform in node.findall("transform"):
        step = transform.find("lookat")
        matrix = tr.look_at(*(numbers(step.get(name)) for name in ("origin", "target", "up")))
    eye = tr.point(matrix, [0, 0, 0])
    return {"eye": eye, "lookAt": tr.plus(eye, tr.vector(matrix, [0, 0, 1])), "up": tr.vector(matrix, [0, 1, 0]),
            "fovDeg": float(text(node, "fov", "30"))}


def material(mesh):
    bsdf, emitter = mesh.find("bsdf"), mesh.find("emitter")
    if bsdf.get("type") != "diffuse":
        raise Unsupported(f"the bsdf {bsdf.get('type')}")
    made = {"type": "lambert", "baseColor": numbers(text(bsdf, "albedo", "0.5 0.5 0.5"))}
    if emitter is not None:
        made["emission"] = numbers(text(emitter, "radiance"))
    return made


def strategy(integrator):
    """How the integrator finds lamps, as --light-sampling says it."""
    return STRATEGIES.get(integrator.rpartition("_")[2], "mis")
