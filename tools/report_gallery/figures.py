"""The report's figures as data: which scenes make them, with which options, and what to look at."""

from dataclasses import dataclass, field


@dataclass
class Step:
    """One command of `sahl`. In `args` a word @NAME stands for the file NAME of the figure's folder."""
    command: str
    name: str                 # of its statistics, and for messages
    args: list
    scene: str = ""           # in scenes/report/, for render
    spp: int = 0              # 0: the scene's
    quick: list = field(default_factory=list)  # options that a quick run adds


@dataclass
class Pane:
    """A picture of a figure: the file that a step writes, and a few words below it."""
    file: str
    label: str
    reference: str = ""       # the report's own picture, where it is at hand
    legend: tuple = ()        # colours ("grey", "viridis"), what the low and the high end mean


@dataclass
class Figure:
    number: int
    title: str
    caption: str
    steps: list
    panes: list
    fitted_teapot: bool = False  # takes the report's own teapot in place of ours where that is at hand


def render(name, scene, *args, spp=0, quick=()):
    return Step("render", name, list(args), scene, spp, list(quick))


def heat_maps(name, scene):
    return render(name, scene, "-o", "@picture.png", "--map", "normals=@normals.png",
                  "--map", "nodes=@nodes.png", "--map", "primitives=@primitives.png",
                  "--map-colors", "grey", "--map-scale", "off")


def heat_panes(normals, nodes):
    return [Pane("normals.png", "Normals of what is seen", normals),
            Pane("nodes.png", "Nodes of the tree that each ray visits", nodes,
                 ("grey", "fewest", "{nodeVisitsMax} nodes")),
            Pane("primitives.png", "Triangles that each ray is tested against", "",
                 ("grey", "fewest", "{primitiveTestsMax} triangles"))]


FIGURES = [
    Figure(5, "The tree over the teapot",
           "Left, where the surface faces: red, green and blue are x, y and z of the normal. The other two "
           "show what finding that surface cost. Rays that miss all boxes are done at once; along rims, "
           "handle and spout, where many boxes overlap, a ray has to look into more of them.",
           [heat_maps("teapot", "fig05/teapot.json")], heat_panes("nteapot", "tbteapot"),
           fitted_teapot=True),
    Figure(6, "The tree over the bunny",
           "The same for a mesh that is scanned rather than designed. The surface area heuristic has cut it "
           "into boxes that shrink with the triangles, and the outline glows, since rays that graze it pass "
           "many boxes without a hit.",
           [heat_maps("bunny", "fig06/bunny.json")], heat_panes("nbunny", "tbbunny")),
    Figure(7, "Ambient, diffuse, specular",
           "Phong's model, one term after the other. The ambient term is a constant; the diffuse one follows "
           "the angle between normal and light; the specular one adds a highlight where the mirror "
           "direction of the light meets the viewer.",
           [render("ambient", "fig07/phong.json", "--terms", "ambient", "--tone-map", "exposure",
                   "--gamma", "1", "-o", "@ambient.png", spp=8),
            render("diffuse", "fig07/phong.json", "--terms", "ambient,diffuse", "--tone-map", "exposure",
                   "--gamma", "1", "-o", "@diffuse.png", spp=8),
            render("specular", "fig07/phong.json", "--terms", "ambient,diffuse,specular", "--tone-map",
                   "exposure", "--gamma", "1", "-o", "@specular.png", spp=8)],
           [Pane("ambient.png", "ambient", "ambientteapot"),
            Pane("diffuse.png", "ambient + diffuse", "diffuseteapot"),
            Pane("specular.png", "ambient + diffuse + specular", "specularteapot")],
           fitted_teapot=True),
    Figure(8, "Normals of the teapot",
           "A triangle has one normal. Interpolating the normals of its corners (Phong interpolation) makes "
           "the same few hundred triangles look curved; only the outline still gives them away.",
           [render("flat", "fig08/teapot.json", "--normals", "flat", "--map", "normals=@flat.png",
                   "--map-scale", "off", "-o", "@flat_picture.png"),
            render("interpolated", "fig08/teapot.json", "--normals", "interpolated", "--map",
                   "normals=@interpolated.png", "--map-scale", "off", "-o", "@interpolated_picture.png")],
           [Pane("flat.png", "normals of the triangles", "nnteapot"),
            Pane("interpolated.png", "interpolated normals", "nteapot")],
           fitted_teapot=True),
    Figure(9, "Normals of Sponza",
           "The same for a building. Flat walls look alike either way; columns, arches and vaults become "
           "round.",
           [render("flat", "fig09/sponza.json", "--normals", "flat", "--map", "normals=@flat.png",
                   "--map-scale", "off", "-o", "@flat_picture.png"),
            render("interpolated", "fig09/sponza.json", "--normals", "interpolated", "--map",
                   "normals=@interpolated.png", "--map-scale", "off", "-o", "@interpolated_picture.png")],
           [Pane("flat.png", "normals of the triangles", "nnsponza"),
            Pane("interpolated.png", "interpolated normals", "nsponza")]),
    Figure(10, "The benchmark's scenes",
           "Teapot, bunny and palace under a point light without shadows, one ray a pixel. The fourth scene, "
           "20 bunnies turned, sheared and stretched, needs transforms: here they are instances of one mesh, "
           "in the memory of one.",
           [render(name, f"fig10/{name}.json", "--tone-map", "exposure", "--gamma", "1", "-o", f"@{name}.png")
            for name in ("teapot", "bunny", "sponza", "bunnies")],
           [Pane("teapot.png", "teapot", "benchmarkteapot"), Pane("bunny.png", "bunny", "benchmarkbunny"),
            Pane("sponza.png", "Sponza", "benchmarksponza"),
            Pane("bunnies.png", "20 bunnies, which the report had to leave out")],
           fitted_teapot=True),
    Figure(11, "The benchmark's numbers",
           "Every scene at 512 x 512, one ray a pixel, as above. Ratios are ours to the report's; counts are "
           "exact and the same on every device, seconds are this machine's.",
           [Step("bench", "report", ["report", "--json", "@bench.json"], quick=["--size", "32"])], []),
    Figure(12, "Shadow rays",
           "A light to the right, a wall behind. Without shadow rays everything that faces the light is lit; "
           "with them spheres throw shadows onto the wall, and the teapot's spout one onto its body.",
           [render("off", "fig12/shadows.json", "--shadows", "off", "--tone-map", "exposure", "--gamma", "1.8",
                   "-o", "@off.png"),
            render("on", "fig12/shadows.json", "--shadows", "on", "--tone-map", "exposure", "--gamma", "1.8",
                   "-o", "@on.png")],
           [Pane("off.png", "without shadow rays", "withoutshadow"), Pane("on.png", "with", "withshadow")],
           fitted_teapot=True),
    Figure(13, "Light probes",
           "No lamp but a picture of the light from all around. Both probes are built into Sahl: a dim "
           "cathedral with bright windows, and a basilica of warm stone. Each sphere of water shows the room "
           "upside down.",
           [render("cathedral", "fig13/cathedral.json", "-o", "@cathedral.png"),
            render("basilica", "fig13/basilica.json", "-o", "@basilica.png")],
           [Pane("cathedral.png", "in the cathedral", "grace"), Pane("basilica.png", "in the basilica")]),
    Figure(14, "A mirror and water",
           "The teapot reflects everything (the report used a refractive index near 0 for that); the spheres "
           "reflect and refract by Snell's law and Fresnel's equations with the index of water, 1.33.",
           [render("mirror", "fig14/mirror.json", "-o", "@mirror.png")],
           [Pane("mirror.png", "mirror teapot, spheres of water")]),
    Figure(15, "A teapot in a sphere",
           "Light that meets two mirrors: the sphere shows the room and the teapot, the teapot shows the room "
           "and, small and stretched, the sphere.",
           [render("reflection", "fig15/reflection.json", "-o", "@reflection.png")],
           [Pane("reflection.png", "a mirror teapot before a mirror sphere", "reflec")]),
    Figure(16, "A diffuse teapot",
           "A diffuse surface sends light into all directions, of which each path follows one. The average of "
           "few is noisy; ten times less noise takes a hundred times more paths.",
           [render(f"spp{n}", "fig16/lambert.json", "-o", f"@spp{n}.png", spp=n) for n in (10, 50, 1000)],
           [Pane(f"spp{n}.png", f"{n:,} samples") for n in (10, 50, 1000)]),
    Figure(17, "A thin lens",
           "Paths start all over a lens that is sharp at the mirror teapot, so what lies behind it blurs. "
           "One sample chooses one point of the lens and looks torn; ten begin to look like a photograph.",
           [render(f"spp{n}", "fig17/lens.json", "-o", f"@spp{n}.png", spp=n) for n in (1, 10)],
           [Pane("spp1.png", "1 sample"), Pane("spp10.png", "10 samples")]),
    Figure(18, "Tone mapping",
           "The cathedral's lamps are hundreds of times brighter than its walls. Mapped from the smallest to "
           "the largest value the room is black; mapped from the 5th to the 95th percentile it is there, and "
           "lamps and windows are white.",
           [render("film", "fig18/tone_mapping.json", "-o", "@film.exr"),
            Step("tonemap", "naive", ["@film.exr", "-o", "@naive.png", "--operator", "naive",
                                      "--histogram", "@naive_values.png"]),
            Step("tonemap", "percentile", ["@film.exr", "-o", "@percentile.png", "--operator", "percentile",
                                           "--histogram", "@percentile_values.png"])],
           [Pane("naive.png", "from minimum to maximum"),
            Pane("percentile.png", "from the 5th to the 95th percentile")]),
    Figure(19, "The values behind figure 18",
           "How many of the picture's values lie where, before and after each mapping. Without percentiles "
           "almost all of them end up beside 0 for the sake of a few.",
           [], [Pane("../fig18/naive_values.png", "from minimum to maximum"),
                Pane("../fig18/percentile_values.png", "from the 5th to the 95th percentile")]),
    Figure(20, "Path tracing",
           "20 paths a pixel, each with up to 6 scatterings. Mirror, water and room are quiet; the diffuse "
           "teapot on the right is not.",
           [render("picture", "fig20/path_tracing.json", "-o", "@picture.png")],
           [Pane("picture.png", "20 samples", "noise")]),
    Figure(21, "Adaptive path tracing",
           "The report's rule stops a pixel once its mean hardly moves, after 20 samples at the least and "
           "1,000 at most. The map shows where the samples went: to the diffuse teapot and to the rims of "
           "the spheres. A rule that looks at the samples it decides about is biased: pixels with rare bright "
           "samples stop before they have met one. The rule crossed decides about each half of a pixel's "
           "samples by the other half: it is right on average, and shows its noise instead of hiding it.",
           [render("picture", "fig21/adaptive.json", "-o", "@picture.png", "--map", "samples=@samples.png",
                   "--map-colors", "viridis", "--map-range", "1:1000", "--map-scale", "off",
                   quick=["--min-spp", "2", "--max-spp", "4"]),
            render("crossed", "fig21/adaptive.json", "--adaptive", "crossed", "--target-error", "0.1",
                   "--min-spp", "64", "--max-spp", "1008", "-o", "@crossed.png",
                   "--map", "samples=@crossed-samples.png",
                   "--map-colors", "viridis", "--map-range", "1:1000", "--map-scale", "off",
                   quick=["--min-spp", "16", "--max-spp", "32"])],
           [Pane("../fig20/picture.png", "for comparison: figure 20, 20 samples"),
            Pane("picture.png", "adaptive, at most 1,000 samples", "denoised"),
            Pane("samples.png", "samples of each pixel", "", ("viridis", "1", "1,000")),
            Pane("crossed.png", "crossed, at most 1,008 samples, target 10 %", "unbiased"),
            Pane("crossed-samples.png", "its samples", "", ("viridis", "1", "1,000"))]),
]
