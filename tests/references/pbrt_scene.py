"""Scene files of pbrt-v3 as scenes of Sahl, as far as "Coffee Maker" needs them; materials as Tungsten, which
made the picture beside it, has them."""

import re

import transforms as tr
from mitsuba_scene import BEHIND
from mitsuba_xml import Unsupported

TOKEN = re.compile(r'"([^"]*)"|([][])|([^\s"\[\]]+)')
PLASTIC_ETA = 1.5
SMOOTH = 0.01  # of pbrt's roughness: what is below was smooth in the original


def directives(text):
    """Tuples of a directive's name, its plain arguments, and its parameters by name as lists of strings."""
    words = [(match.group(1) is not None, "".join(group or "" for group in match.groups()))
             for match in TOKEN.finditer(text)]
    found, at = [], 0
    while at < len(words):
        name, at = words[at][1], at + 1
        plain, parameters = [], {}
        while at < len(words) and (words[at][0] or words[at][1] == "["):
            quoted, word = words[at]
            if quoted and " " in word and words[at + 1] == (False, "["):
                values, at = bracketed(words, at + 1)
                parameters[word.split()[1]] = values
            elif quoted:
                plain.append(word)
                at += 1
            else:
                values, at = bracketed(words, at)
                plain += values
        found.append((name, plain, parameters))
    return found


def bracketed(words, at):
    """Between the bracket at `at` and the next closing one, and the place behind that."""
    end = next(i for i in range(at, len(words)) if words[i] == (False, "]"))
    return [word for _, word in words[at + 1:end]], end + 1


def vectors(values):
    values = [float(value) for value in values]
    return [values[i:i + 3] for i in range(0, len(values), 3)]


class Reader:
    def __init__(self, path):
        self.folder = path.parent
        self.scene = {"materials": {}, "shapes": [], "integrator": {}, "film": {}, "camera": {}}
        self.current, self.lamp, self.saved = None, None, []
        for name, plain, parameters in directives(path.read_text(encoding="ascii")):
            act = getattr(self, "_" + name.lower(), None)
            if act is None and name not in ("Sampler", "PixelFilter", "WorldBegin", "WorldEnd"):
                raise Unsupported(f"the directive {name}")
            if act:
                act(plain, parameters)

    def _integrator(self, plain, parameters):
        self.scene["integrator"]["maxBounces"] = int(parameters["maxdepth"][0])

    def _transform(self, plain, parameters):
        """From the world to the camera, column by column; the camera looks along +Z, its +X is right."""
        values = [float(value) for value in plain]
        back = tr.inverse([[values[4 * column + row] for column in range(4)] for row in range(4)])
        eye = tr.point(back, [0, 0, 0])
        self.scene["camera"].update(eye=eye, lookAt=tr.plus(eye, tr.vector(back, [0, 0, 1])),
                                    up=tr.vector(back, [0, 1, 0]))

    def _film(self, plain, parameters):
        self.scene["film"].update(width=int(parameters["xresolution"][0]), height=int(parameters["yresolution"][0]))

    def _camera(self, plain, parameters):
        """Their angle is that of the shorter side."""
        film = self.scene["film"]
        self.scene["camera"].update(fovDeg=float(parameters["fov"][0]),
                                    fovAxis="horizontal" if film["width"] < film["height"] else "vertical")

    def _makenamedmaterial(self, plain, parameters):
        self.scene["materials"][plain[0]] = material(parameters)

    def _namedmaterial(self, plain, parameters):
        self.current = plain[0]

    def _attributebegin(self, plain, parameters):
        self.saved.append((self.current, self.lamp))

    def _attributeend(self, plain, parameters):
        self.current, self.lamp = self.saved.pop()

    def _arealightsource(self, plain, parameters):
        self.lamp = vectors(parameters["L"])[0]

    def _material(self, plain, parameters):
        if plain != ["matte"]:
            raise Unsupported(f"the material {plain[0]}")
        self.current = "lamp"
        self.scene["materials"]["lamp"] = {"type": "lambert", "baseColor": vectors(parameters["Kd"])[0],
                                           "emission": self.lamp}

    def _shape(self, plain, parameters):
        if plain == ["plymesh"]:
            self.scene["shapes"].append({"type": "mesh", "file": str(self.folder / parameters["filename"][0]),
                                         "material": self.current})
            return
        shape = {"type": "triangles", "material": self.current, "positions": vectors(parameters["P"]),
                 "indices": [[int(value) for value in triple] for triple in vectors(parameters["indices"])]}
        self.scene["shapes"].append(shape)
        if self.lamp:  # which shines on its front alone
            normal = vectors(parameters["N"])[0]
            self.scene["materials"]["back"] = {"type": "lambert", "baseColor": [0, 0, 0]}
            self.scene["shapes"].append({**shape, "material": "back", "positions": [
                tr.plus(position, tr.scaled(normal, -BEHIND)) for position in shape["positions"]]})


def material(parameters):
    kind = parameters["type"][0]
    if kind == "mirror":
        return {"type": "mirror"}
    if kind == "glass":
        return {"type": "dielectric", "eta": float(parameters["index"][0])}
    if kind != "substrate":
        raise Unsupported(f"the material {kind}")
    alpha = float(parameters["uroughness"][0])
    return {"type": "plastic", "eta": PLASTIC_ETA, "baseColor": vectors(parameters["Kd"])[0],
            "roughness": 0 if alpha < SMOOTH else alpha ** 0.5}
