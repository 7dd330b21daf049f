"""Surfaces of Mitsuba as materials of Sahl."""

import dataclasses
import typing

import ply
from mitsuba_xml import Unsupported, numbers

INDICES = {"vacuum": 1.0, "air": 1.000277, "water": 1.333, "bk7": 1.5046, "polypropylene": 1.49,
           "diamond": 2.419}

# Spectra that Mitsuba's own scenes (scenes/cbox/cbox-rgb.xml beside cbox-spectral.xml) give as colours, too.
SPECTRA = {"400:0, 500:8, 600:15.6, 700:18.4": [18.387, 10.9873, 2.75357],
           "400:0.78, 500:0.78, 600:0.78, 700:0.78": [0.936461, 0.740433, 0.705267]}


@dataclasses.dataclass
class Checkers:
    """A board of two materials: `scale` units of texture coordinates have two rows of two fields each."""
    even: dict
    odd: dict
    scale: list

    def cells(self):
        """Fields with their materials; u0, v0, u1, v1 in texture coordinates from 0 to 1."""
        across, up = (round(2 * scale) for scale in self.scale)
        for i in range(across):
            for j in range(up):
                material = self.even if (i + j) % 2 == 0 else self.odd
                yield (i / across, j / up, (i + 1) / across, (j + 1) / up), material


@dataclasses.dataclass
class Surface:
    material: dict
    one_sided: bool = False                           # black on the back
    checkers: typing.Optional[Checkers] = None        # in place of `material`
    by_face: typing.Optional[typing.Callable] = None  # of a file: shapes with their materials


def convert(reader, node):
    name = node.get("type")
    maker = globals().get("_" + name)
    if maker is None:
        raise Unsupported(f"the bsdf {name}")
    return maker(reader.document, node)


def lamp(reader, node):
    child = reader.document.child(node, "radiance")
    if child is not None and child.tag == "spectrum" and child.get("value") in SPECTRA:
        return SPECTRA[child.get("value")]
    return reader.document.color(node, "radiance", 1)


def lambert(color):
    return {"type": "lambert", "baseColor": color}


def _eta(document, node, inside="bk7"):
    def index(name, otherwise):
        word = document.word(node, name, otherwise)
        return INDICES[word] if word in INDICES else float(word)
    return index("int_ior", inside) / index("ext_ior", "air")


def _diffuse(document, node):
    child = document.child(node, "reflectance")
    if child is not None and child.tag == "texture":
        return _textured_diffuse(document, child)
    if child is not None and child.get("value") in SPECTRA:
        return Surface(lambert(SPECTRA[child.get("value")]), one_sided=True)
    return Surface(lambert(document.color(node, "reflectance", 0.5)), one_sided=True)


def _textured_diffuse(document, texture):
    kind = texture.get("type")
    if kind == "checkerboard":
        scale = document.transform(texture, "to_uv")
        fields = [lambert(document.color(texture, name, value)) for name, value in (("color0", 0.4), ("color1", 0.2))]
        return Surface(fields[0], True, Checkers(*fields, [scale[0][0], scale[1][1]]))
    if kind == "mesh_attribute" and document.word(texture, "name", "") == "face_color":
        return Surface(lambert([0.5] * 3), True, by_face=lambda file: ply.by_face(file, lambda face: lambert(
            [face["color_0"], face["color_1"], face["color_2"]])))
    raise Unsupported(f"the texture {kind} {document.word(texture, 'name', '')}".rstrip())


def _blendbsdf(document, node):
    """Two diffuse surfaces, mixed by a weight of each face: again one diffuse surface."""
    weight = document.child(node, "weight")
    if weight.get("type") != "mesh_attribute" or document.word(weight, "name", "") != "face_weight":
        raise Unsupported("a mixture that no face decides")
    first, second = (_diffuse(document, child).material["baseColor"] for child in document.members(node, "bsdf"))

    def mixed(face):
        share = face["weight_0"]
        return lambert([a + share * (b - a) for a, b in zip(first, second)])
    return Surface(lambert([0.5] * 3), True, by_face=lambda file: ply.by_face(file, mixed))


def _twosided(document, node):
    inner = document.members(node, "bsdf")[0]
    surface = globals()["_" + inner.get("type")](document, inner)
    surface.one_sided = False
    return surface


def _dielectric(document, node):
    return Surface({"type": "dielectric", "eta": _eta(document, node)})


def _conductor(document, node):
    if document.child(node, "material") is not None:
        raise Unsupported(f"the metal {document.word(node, 'material', '')}, whose numbers are missing")
    return Surface({"type": "conductor", "conductorEta": document.color(node, "eta", 0),
                    "conductorK": document.color(node, "k", 1)})
