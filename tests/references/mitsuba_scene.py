"""Scene files of Mitsuba 3 as scenes of Sahl. What Sahl has no like of raises Unsupported."""

import math

import envmap
import transforms as tr
from mitsuba_materials import Maker, Surface, lambert
from mitsuba_xml import Document, Unsupported, numbers

BEHIND = 1e-4  # how far a black back lies behind its surface [m]
SPOT_STEPS = 64
INTEGRATORS = ("path", "direct", "ptracer")  # all give the same picture


class Reader:
    """One file; `scene` is the result.
      folder     for what the scene needs beside it
      beckmann   the largest alpha at which GGX will do for Beckmann's distribution
      stand_ins  what Sahl has no like of is left out if it is an emitter, and black if it is a shape;
                 `left_out` names it, in the order of the file"""

    def __init__(self, programs, path, folder, beckmann=0, stand_ins=False):
        self.programs, self.folder, self.stand_ins = programs, folder, stand_ins
        self.document = Document(path, programs.references("mitsuba", "common"))
        self.maker = Maker(self.document, folder, beckmann)
        self.scene = {"materials": {}, "shapes": [], "lights": []}
        self.left_out = []
        for node in self.document.nodes:
            kind = getattr(self, "_" + node.tag, None)
            if kind:
                kind(node)

    def _integrator(self, node):
        inner = self.document.members(node, "integrator")
        node = inner[0] if inner else node
        name = self.document.text(node, "type")
        if name not in INTEGRATORS:
            raise Unsupported(f"the integrator {name}")
        # A depth of theirs counts rays, a bounce of ours counts what lies between two of them.
        depth = 2 if name == "direct" else int(self.document.number(node, "max_depth", -1))
        self.scene["integrator"] = {"type": "path", "maxBounces": depth - 1 if depth > 0 else 65535}

    def _sensor(self, node):
        document = self.document
        film = document.members(node, "film")[0]
        filters = document.members(film, "rfilter")
        if not filters or filters[0].get("type") != "box":
            raise Unsupported("a pixel filter other than the box")
        width, height = (int(document.number(film, name, 0)) for name in ("width", "height"))
        self.scene["film"] = {"width": width, "height": height}
        matrix = document.transform(node)
        eye, forward, up = tr.point(matrix, [0, 0, 0]), tr.vector(matrix, [0, 0, 1]), tr.vector(matrix, [0, 1, 0])
        camera = {"type": node.get("type"), "eye": eye, "lookAt": tr.plus(eye, forward), "up": up}
        if camera["type"] == "orthographic":
            camera["height"] = 2 * tr.length(tr.vector(matrix, [1, 0, 0])) * height / width
        else:
            camera.update(fovAxis="horizontal", fovDeg=self._fov(node, width / height))
        self.scene["camera"] = camera

    def _fov(self, node, aspect):
        """Horizontal; by default that of 50 mm in 35 mm film, across the diagonal."""
        fov, axis = self.document.number(node, "fov", None), self.document.word(node, "fov_axis", "x")
        if fov is None:
            half = math.hypot(36, 24) / 2 / 50
            axis = "diagonal"
        else:
            half = math.tan(math.radians(fov) / 2)
        if axis in ("smaller", "larger"):
            axis = "x" if (axis == "smaller") == (aspect <= 1) else "y"
        half *= {"x": 1, "y": aspect, "diagonal": 1 / math.hypot(1, 1 / aspect)}[axis]
        return math.degrees(2 * math.atan(half))

    def _emitter(self, node):
        try:
            getattr(self, "_emitter_" + node.get("type"), self._no_emitter)(node)
        except Unsupported as lack:
            if not self.stand_ins:
                raise
            self.left_out.append((node, str(lack)))

    def _no_emitter(self, node):
        raise Unsupported(f"the emitter {node.get('type')}")

    def _emitter_constant(self, node):
        self.scene["environment"] = {"radiance": self.document.color(node, "radiance", 1)}

    def _emitter_envmap(self, node):
        source = self.document.file(self.document.word(node, "filename", ""))
        target = self.folder / (source.stem + ".pfm")
        if not target.exists():
            envmap.resampled(self.programs.pictures, source, target)
        # The middle of their picture is +Z, of ours -Z.
        self.scene["environment"] = {"file": target.name, "rotateDeg": 180,
                                     "scale": self.document.number(node, "scale", 1)}

    def _emitter_point(self, node):
        place = self.document.child(node, "position")
        position = [float(place.get(axis)) for axis in "xyz"] if place is not None else \
            tr.point(self.document.transform(node), [0, 0, 0])
        self.scene["lights"].append({"type": "point", "position": position,
                                     "intensity": self.document.color(node, "intensity", 1)})

    def _emitter_directional(self, node):
        direction = numbers(self.document.word(node, "direction", ""))
        self.scene["lights"].append({"type": "directional", "direction": direction,
                                     "irradiance": self.document.color(node, "irradiance", 1)})

    def _emitter_spot(self, node):
        if self.document.child(node, "texture") is not None:
            raise Unsupported("a spot light with a texture")
        matrix = self.document.transform(node)
        outer = self.document.number(node, "cutoff_angle", 20)
        inner = self.document.number(node, "beam_width", 0.75 * outer)
        intensity = self.document.color(node, "intensity", 1)
        self.scene["lights"] += spot_lights(tr.point(matrix, [0, 0, 0]), tr.vector(matrix, [0, 0, 1]),
                                            intensity, inner, outer)

    def _shape(self, node):
        build = getattr(self, "_shape_" + node.get("type"), None)
        if build is None:
            raise Unsupported(f"the shape {node.get('type')}")
        bsdfs = self.document.members(node, "bsdf")
        try:
            surface = self.maker.surface(bsdfs[0]) if bsdfs else Surface(lambert([0.5] * 3), True)
        except Unsupported as lack:
            if not self.stand_ins:
                raise
            self.left_out.append((node, str(lack)))
            surface = Surface(lambert([0, 0, 0]))
        for emitter in self.document.members(node, "emitter"):
            self.maker.add_lamp(surface, emitter)
        build(node, self.document.transform(node), surface)
        if node.get("id"):
            self.scene["shapes"][-1]["name"] = node.get("id")

    def material(self, description):
        """The name of such a material, made where there is none yet."""
        known = self.scene["materials"]
        for name, other in known.items():
            if other == description:
                return name
        name = f"material {len(known)}"
        known[name] = description
        return name

    def _shape_obj(self, node, matrix, surface):
        file = self.document.file(self.document.word(node, "filename", ""))
        if file.stem == "rectangle" and surface.one_sided:
            self._mesh(file, behind(matrix), lambert([0, 0, 0]))
        self._mesh(file, matrix, surface.described(False))

    def _mesh(self, file, matrix, material):
        self.scene["shapes"].append({"type": "mesh", "file": str(file), "smoothNormals": True,
                                     "material": self.material(material), "transform": {"matrix": tr.flat(matrix)}})

    def _shape_rectangle(self, node, matrix, surface):
        if surface.one_sided:
            self._rectangle(behind(matrix), (0, 0, 1, 1), lambert([0, 0, 0]))
        if surface.checkers:
            for cell, material in surface.checkers.cells():
                self._rectangle(matrix, cell, material)
        else:
            self._rectangle(matrix, (0, 0, 1, 1), surface.described(True))

    def _rectangle(self, matrix, cell, material):
        """The part of the square from -1 to 1 whose texture coordinates are in `cell`: u0, v0, u1, v1."""
        u0, v0, u1, v1 = cell
        self.scene["shapes"].append({"type": "rectangle", "material": self.material(material),
                                     "corner": tr.point(matrix, [2 * u0 - 1, 2 * v0 - 1, 0]),
                                     "edgeU": tr.vector(matrix, [2 * (u1 - u0), 0, 0]),
                                     "edgeV": tr.vector(matrix, [0, 2 * (v1 - v0), 0])})

    def _shape_sphere(self, node, matrix, surface):
        if surface.checkers:
            raise Unsupported("a texture on an exact sphere")
        self.scene["shapes"].append({"type": "sphere", "material": self.material(surface.material),
                                     "transform": {"matrix": tr.flat(matrix)}})

    def _shape_ply(self, node, matrix, surface):
        file = self.document.file(self.document.word(node, "filename", ""))
        if surface.by_face is None:
            self._mesh(file, matrix, surface.described(True))
            return
        for shape, material in surface.by_face(file):
            shape.update(material=self.material(material), transform={"matrix": tr.flat(matrix)})
            self.scene["shapes"].append(shape)


def behind(matrix):
    """The same a little behind itself. Their surfaces are black on the back, ours look alike on both sides: a
    black one stands behind them."""
    normal = tr.unit(tr.cross(tr.vector(matrix, [1, 0, 0]), tr.vector(matrix, [0, 1, 0])))
    return tr.times(tr.translation(*tr.scaled(normal, -BEHIND)), matrix)


def spot_lights(position, direction, intensity, inner, outer):
    """Their spot fades linearly in the angle, ours by a smooth step: many that fade one after another add up
    to theirs, with an error of less than a tenth of one step."""
    step = (outer - inner) / SPOT_STEPS
    return [{"type": "spot", "position": position, "direction": direction,
             "intensity": tr.scaled(intensity, 1 / SPOT_STEPS),
             "innerDeg": inner + i * step, "outerDeg": inner + (i + 1) * step} for i in range(SPOT_STEPS)]
