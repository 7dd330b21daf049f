"""Run by Blender (tested with 3.4): renders the scene that cycles.py wrote, once for every file named.
Arguments behind "--": the scene, samples per pixel, files. Prints "CPU SECONDS" for each, of all threads."""

import json
import math
import sys
import time

import bpy
from mathutils import Matrix, Vector


def nodes_of(owner):
    owner.use_nodes = True
    owner.node_tree.nodes.clear()
    return owner.node_tree


def make_object(scene, description):
    mesh = bpy.data.meshes.new("mesh")
    mesh.from_pydata(description["positions"], [], description["triangles"])
    material = bpy.data.materials.new("material")
    tree = nodes_of(material)
    diffuse = tree.nodes.new("ShaderNodeBsdfDiffuse")
    diffuse.inputs["Color"].default_value = (*description["color"], 1)
    output = tree.nodes.new("ShaderNodeOutputMaterial")
    surface = diffuse.outputs[0]
    strength = max(description["emission"])
    if strength > 0:
        emission, both = tree.nodes.new("ShaderNodeEmission"), tree.nodes.new("ShaderNodeAddShader")
        emission.inputs["Color"].default_value = (*(value / strength for value in description["emission"]), 1)
        emission.inputs["Strength"].default_value = strength
        tree.links.new(surface, both.inputs[0])
        tree.links.new(emission.outputs[0], both.inputs[1])
        surface = both.outputs[0]
    tree.links.new(surface, output.inputs["Surface"])
    mesh.materials.append(material)
    scene.collection.objects.link(bpy.data.objects.new("object", mesh))


def make_world(scene, plain):
    scene.world = bpy.data.worlds.new("world")
    tree = nodes_of(scene.world)
    background, output = tree.nodes.new("ShaderNodeBackground"), tree.nodes.new("ShaderNodeOutputWorld")
    tree.links.new(background.outputs[0], output.inputs["Surface"])
    background.inputs["Strength"].default_value = plain["scale"]
    if plain["radiance"]:
        background.inputs["Color"].default_value = (*plain["radiance"], 1)
        return
    image = bpy.data.images.load(plain["probe"])
    image.colorspace_settings.name = "Linear"
    texture = tree.nodes.new("ShaderNodeTexEnvironment")
    texture.image, texture.projection, texture.interpolation = image, "EQUIRECTANGULAR", "Linear"
    tree.links.new(texture.outputs["Color"], background.inputs["Color"])
    # Blender's maps have +Z up and +X in the middle, ours +Y up and -Z in the middle: (-z, -x, y).
    place, parts, turned = (tree.nodes.new("ShaderNode" + name) for name in ("TexCoord", "SeparateXYZ", "CombineXYZ"))
    tree.links.new(place.outputs["Generated"], parts.inputs[0])
    for source, target in (("Z", "X"), ("X", "Y")):
        negative = tree.nodes.new("ShaderNodeMath")
        negative.operation = "MULTIPLY"
        negative.inputs[1].default_value = -1
        tree.links.new(parts.outputs[source], negative.inputs[0])
        tree.links.new(negative.outputs[0], turned.inputs[target])
    tree.links.new(parts.outputs["Y"], turned.inputs["Z"])
    tree.links.new(turned.outputs[0], texture.inputs["Vector"])


def make_camera(scene, plain):
    camera = bpy.data.cameras.new("camera")
    scene.camera = bpy.data.objects.new("camera", camera)
    scene.collection.objects.link(scene.camera)
    eye, target, up = (Vector(plain[name]) for name in ("eye", "lookAt", "up"))
    back = (eye - target).normalized()
    right = up.cross(back).normalized()
    axes = Matrix((right, back.cross(right), back)).transposed().to_4x4()
    scene.camera.matrix_world = Matrix.Translation(eye) @ axes
    camera.sensor_fit = "VERTICAL" if plain["vertical"] else "HORIZONTAL"
    camera.angle = math.radians(plain["fovDeg"])
    camera.clip_start, camera.clip_end = 1e-3, 1e5


def set_up_render(scene, plain, samples):
    """Plain path tracing: nothing adaptive, clamped, denoised or blurred, a box as pixel filter; roulette where the
    scene asks for it."""
    render, cycles = scene.render, scene.cycles
    render.engine = "CYCLES"
    render.resolution_x, render.resolution_y, render.resolution_percentage = plain["width"], plain["height"], 100
    render.image_settings.file_format = "OPEN_EXR"
    render.image_settings.color_depth, render.image_settings.exr_codec = "32", "ZIP"
    scene.view_settings.view_transform = "Raw"
    # A path of theirs with N bounces sees what a path of ours with N + 1 scatterings sees.
    bounces = plain["bounces"] - 1
    cycles.max_bounces = cycles.diffuse_bounces = cycles.glossy_bounces = cycles.transmission_bounces = bounces
    if not plain.get("roulette"):
        cycles.min_light_bounces = cycles.min_transparent_bounces = bounces + 2
    if "threads" in plain:
        render.threads_mode, render.threads = "FIXED", plain["threads"]
    cycles.device, cycles.samples = "CPU", samples
    cycles.use_adaptive_sampling = cycles.use_denoising = False
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = cycles.blur_glossy = 0
    cycles.pixel_filter_type, cycles.filter_width = "BOX", 1


def main():
    scene_file, samples, *pictures = sys.argv[sys.argv.index("--") + 1:]
    with open(scene_file, encoding="utf-8") as file:
        plain = json.load(file)
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    for description in plain["objects"]:
        make_object(scene, description)
    make_world(scene, plain)
    make_camera(scene, plain)
    set_up_render(scene, plain, int(samples))
    for seed, picture in enumerate(pictures):
        scene.cycles.seed = seed
        scene.render.filepath = picture
        before = time.process_time()
        bpy.ops.render.render(write_still=True)
        print(f"CPU {time.process_time() - before}", flush=True)


main()
