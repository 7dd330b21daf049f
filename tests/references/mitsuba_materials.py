"""Surfaces of Mitsuba as materials of Sahl."""

import copy
import dataclasses
import math
import typing

import bitmaps
import ply
from mitsuba_xml import Unsupported

INDICES = {"vacuum": 1.0, "air": 1.000277, "water": 1.333, "bk7": 1.5046, "polypropylene": 1.49,
           "diamond": 2.419}

# Spectra as colours. The lamps' is the integral over the CIE's curves of 1931; what Mitsuba's scenes/cbox/cbox-rgb.xml
# has in place of it is 3.2 % too dark. The other is that file's, of lamps' bodies.
SPECTRA = {"400:0, 500:8, 600:15.6, 700:18.4": [20.698, 10.8563, 2.7662],
           "400:0.78, 500:0.78, 600:0.78, 700:0.78": [0.936461, 0.740433, 0.705267]}

V_DOWN = {"scale": [1, -1], "offset": [0, 1]}


@dataclasses.dataclass
class Checkers:
    """A board of two colours: a unit of texture coordinates times `scale` has two rows of two fields each."""
    even: list
    odd: list
    scale: list

    def cells(self):
        """Fields with their materials; u0, v0, u1, v1 in texture coordinates from 0 to 1."""
        across, up = (round(2 * scale) for scale in self.scale)
        for i in range(across):
            for j in range(up):
                material = lambert(self.even if (i + j) % 2 == 0 else self.odd)
                yield (i / across, j / up, (i + 1) / across, (j + 1) / up), material


@dataclasses.dataclass
class Surface:
    material: dict
    one_sided: bool = False                           # black on the back
    checkers: typing.Optional[Checkers] = None        # in place of `material`
    by_face: typing.Optional[typing.Callable] = None  # of a file: shapes with their materials

    def described(self, v_down):
        """The material for a shape whose texture coordinates are as in files, or with v from the top."""
        made = copy.deepcopy(self.material)
        for texture in made.values():
            if v_down and isinstance(texture, dict):
                texture.update(V_DOWN)
        return made


class Maker:
    """Makes surfaces of one scene's file.
      folder    for pictures that have to be written anew
      beckmann  the largest alpha at which GGX will do for Beckmann's distribution"""

    def __init__(self, document, folder, beckmann):
        self.document, self.folder, self.beckmann = document, folder, beckmann

    def surface(self, node):
        maker = getattr(self, "_" + node.get("type"), None)
        if maker is None:
            raise Unsupported(f"the bsdf {node.get('type')}")
        return maker(node)

    def add_lamp(self, surface, node):
        """The emission of an area light."""
        child = self.document.child(node, "radiance")
        if child is not None and child.tag == "texture":
            surface.material.update(emission=[1, 1, 1], emissionTexture={"file": self.picture(child)})
        elif child is not None and child.get("value") in SPECTRA:
            surface.material["emission"] = SPECTRA[child.get("value")]
        else:
            surface.material["emission"] = self.document.color(node, "radiance", 1)

    def picture(self, texture):
        """The file of a bitmap, as a kind that Sahl reads."""
        if texture.get("type") != "bitmap":
            raise Unsupported(f"the texture {texture.get('type')}")
        file = self.document.file(self.document.word(texture, "filename", ""))
        if file.suffix != ".bmp":
            return str(file)
        target = self.folder / (file.stem + ".png")
        bitmaps.write_png(target, bitmaps.read(file))
        return target.name

    def eta(self, node, inside="bk7"):
        def index(name, otherwise):
            word = self.document.word(node, name, otherwise)
            return INDICES[word] if word in INDICES else float(word)
        return index("int_ior", inside) / index("ext_ior", "air")

    def roughness(self, node):
        alpha = self.document.number(node, "alpha", 0.1)
        if self.document.word(node, "distribution", "beckmann") != "ggx" and alpha > self.beckmann:
            raise Unsupported(f"Beckmann's distribution (alpha {alpha:g})")
        if any(self.document.child(node, name) is not None for name in ("alpha_u", "alpha_v")):
            raise Unsupported("a roughness that depends on the direction")
        return math.sqrt(alpha)

    def _diffuse(self, node):
        child = self.document.child(node, "reflectance")
        if child is not None and child.tag == "texture":
            return self._textured_diffuse(child)
        if child is not None and child.get("value") in SPECTRA:
            return Surface(lambert(SPECTRA[child.get("value")]), one_sided=True)
        return Surface(lambert(self.document.color(node, "reflectance", 0.5)), one_sided=True)

    def _textured_diffuse(self, texture):
        kind = texture.get("type")
        if kind == "bitmap":
            return Surface({**lambert([1, 1, 1]), "baseColorTexture": {"file": self.picture(texture)}}, True)
        if kind == "checkerboard":
            scale = self.document.transform(texture, "to_uv")
            colors = [self.document.color(texture, *field) for field in (("color0", 0.4), ("color1", 0.2))]
            return Surface(lambert(colors[0]), True, Checkers(*colors, [scale[0][0], scale[1][1]]))
        if kind == "mesh_attribute" and self.document.word(texture, "name", "") == "face_color":
            return Surface(lambert([0.5] * 3), True, by_face=lambda file: ply.by_face(file, lambda face: lambert(
                [face["color_0"], face["color_1"], face["color_2"]])))
        raise Unsupported(f"the texture {kind} {self.document.word(texture, 'name', '')}".rstrip())

    def _blendbsdf(self, node):
        """Two diffuse surfaces, mixed by a weight of each face: again one diffuse surface."""
        weight = self.document.child(node, "weight")
        if weight.get("type") != "mesh_attribute" or self.document.word(weight, "name", "") != "face_weight":
            raise Unsupported("a mixture that no face decides")
        first, second = (self._diffuse(child).material["baseColor"]
                         for child in self.document.members(node, "bsdf"))

        def mixed(face):
            share = face["weight_0"]
            return lambert([a + share * (b - a) for a, b in zip(first, second)])
        return Surface(lambert([0.5] * 3), True, by_face=lambda file: ply.by_face(file, mixed))

    def _twosided(self, node):
        surface = self.surface(self.document.members(node, "bsdf")[0])
        surface.one_sided = False
        return surface

    def _mask(self, node):
        """Ours are open where opacity is below a half, theirs half open where it is a half."""
        raise Unsupported("a mask that is half open in places")

    def _dielectric(self, node):
        return Surface({"type": "dielectric", "eta": self.eta(node)})

    def _roughdielectric(self, node):
        return Surface({"type": "dielectric", "eta": self.eta(node), "roughness": self.roughness(node)})

    def _conductor(self, node):
        if self.document.child(node, "material") is not None:
            raise Unsupported(f"the metal {self.document.word(node, 'material', '')}, whose numbers are missing")
        return Surface({"type": "conductor", "conductorEta": self.document.color(node, "eta", 0),
                        "conductorK": self.document.color(node, "k", 1)})

    def _roughconductor(self, node):
        roughness = self.roughness(node)
        surface = self._conductor(node)
        surface.material["roughness"] = roughness
        return surface

    def _plastic(self, node):
        eta = self.eta(node, "polypropylene")
        color = self.document.color(node, "diffuse_reflectance", 0.5)
        if self.document.word(node, "nonlinear", "false") != "true":
            color = linear_base(color, eta)
        return Surface({"type": "plastic", "eta": eta, "baseColor": color, "roughness": 0}, one_sided=True)

    def _roughplastic(self, node):
        surface = self._plastic(node)
        surface.material["roughness"] = self.roughness(node)
        if self.document.word(node, "nonlinear", "false") != "true":
            color, eta = self.document.color(node, "diffuse_reflectance", 0.5), surface.material["eta"]
            surface.material["baseColor"] = linear_base(color, eta, coarse_reflectance(1 / eta, surface.material["roughness"] ** 2))
        return surface


def lambert(color):
    return {"type": "lambert", "baseColor": color}


def fresnel(cosine, eta):
    """Reflectance of a dielectric surface, eta of the far side relative to the near."""
    sine2 = (1 - cosine * cosine) / (eta * eta)
    if sine2 >= 1:
        return 1.0
    far = math.sqrt(1 - sine2)
    across, along = (cosine - eta * far) / (cosine + eta * far), (eta * cosine - far) / (eta * cosine + far)
    return (across * across + along * along) / 2


def diffuse_reflectance(eta, steps=4096):
    """Of diffuse light: the average of `fresnel` over the hemisphere by projected solid angle."""
    return sum(fresnel(math.sqrt((i + 0.5) / steps), eta) for i in range(steps)) / steps


def rough_reflectance(cosine, eta, alpha, steps=32):
    """Of a rough dielectric surface, what it reflects of a ray by single scattering: the mean of Fresnel's share and
    Smith's masking over the normals of GGX that the ray sees (Heitz 2018, "Sampling the GGX Distribution of Visible
    Normals"), on a grid of steps x steps."""
    x, z = alpha * math.sqrt(1 - cosine * cosine), cosine
    length = math.hypot(x, z)
    x, z = x / length, z / length
    total = 0
    for i in range(steps * steps):
        radius, turn = math.sqrt((i // steps + 0.5) / steps), 2 * math.pi * (i % steps + 0.5) / steps
        side, up = radius * math.cos(turn), radius * math.sin(turn)
        share = (1 + z) / 2
        up = (1 - share) * math.sqrt(1 - side * side) + share * up
        along = math.sqrt(max(0, 1 - side * side - up * up))
        normal = alpha * (along * x - up * z), alpha * side, max(0, along * z + up * x)
        length = math.sqrt(sum(value * value for value in normal))
        normal = [value / length for value in normal]
        towards = math.sqrt(1 - cosine * cosine) * normal[0] + cosine * normal[2]
        away = 2 * towards * normal[2] - cosine
        if away > 0 and towards > 0:
            slope2 = (1 - away * away) / (away * away)
            total += fresnel(towards, eta) * 2 / (1 + math.sqrt(1 + alpha * alpha * slope2))
    return total / (steps * steps)


def coarse_reflectance(eta, alpha, steps=64):
    """The reflectance of diffuse light as their rough plastic finds it, 1.5 % off: by the mean of so many cosines from
    0 to 1."""
    cosines = [max(1e-6, i / (steps - 1)) for i in range(steps)]
    return sum(2 * cosine * rough_reflectance(cosine, eta, alpha) for cosine in cosines) / steps


def linear_base(color, eta, theirs=None):
    """Light in a coat comes back to the base with the probability k each time. Ours adds that up, rho / (1 - k rho);
    theirs, unless it is told to be nonlinear, takes rho / (1 - k): the rho of ours that gives as much.
      theirs  k as they have it, if it is not the true one"""
    k = diffuse_reflectance(1 / eta)
    sent_back = [rho / (1 - (k if theirs is None else theirs)) for rho in color]
    return [value / (1 + k * value) for value in sent_back]
