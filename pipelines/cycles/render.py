"""Renders a baked scene with Cycles: blender --background --python render.py -- SCENE.glb CAMERA.json WIDTH HEIGHT
THREADS BOUNCES OUT SAMPLES[:SEED]...  Writes OUT-SAMPLES.exr, or OUT-SAMPLES-SEED.exr, (pixels in cd/m2) and prints
"cycles SAMPLES CPU-SECONDS" for each. Lights that SCENE.edits.json switches off are left out.
"""
import json
import os
import sys
import time

import bpy
import numpy
from mathutils import Matrix, Vector

numpy.bool = bool  # Blender 3.4's glTF importer uses a name that numpy 1.24 dropped

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import lights as city_lights  # noqa: E402

# Cycles turns an IES value of one candela into 1 / 177.83 W/sr per watt of the lamp.
IES_LUMENS_A_WATT = 177.83


def to_blender(v):
    """Converts from glTF, which is y up, to Blender, which is z up."""
    return Vector((v[0], -v[2], v[1]))


def make_diffuse(material):
    """Makes a material that both programs show alike: Lambertian with the base colour, and emission. No gloss."""
    tree = material.node_tree
    colour, emission, strength = (0.5, 0.5, 0.5, 1.0), (0, 0, 0, 1), 0.0
    for node in tree.nodes:
        if node.type == "BSDF_PRINCIPLED":
            colour = tuple(node.inputs["Base Color"].default_value)
            emission = tuple(node.inputs["Emission"].default_value)
            strength = node.inputs["Emission Strength"].default_value
    tree.nodes.clear()
    output = tree.nodes.new("ShaderNodeOutputMaterial")
    if strength > 0 and max(emission[:3]) > 0:
        shader = tree.nodes.new("ShaderNodeEmission")
        shader.inputs["Color"].default_value, shader.inputs["Strength"].default_value = emission, strength
        material.cycles.sample_as_light = True
    else:
        shader = tree.nodes.new("ShaderNodeBsdfDiffuse")
        shader.inputs["Color"].default_value = colour
    tree.links.new(shader.outputs[0], output.inputs["Surface"])


def pass_light_through(thing):
    """Hides what casts no shadow, the housings of lamps, from all rays but the camera's, as nightview does."""
    if thing.get("nightcity", {}).get("casts_shadow", True):
        return
    thing.visible_shadow = thing.visible_diffuse = thing.visible_glossy = thing.visible_transmission = False


def add_lamp(light, ies):
    data = bpy.data.lights.new("lamp", "POINT")
    data.color = light.colour
    data.shadow_soft_size = max(light.radius, 1e-3)
    data.energy = light.flux_lm
    if ies is not None:
        data.energy *= IES_LUMENS_A_WATT / 1000
        data.use_nodes = True
        tree = data.node_tree
        node = tree.nodes.new("ShaderNodeTexIES")
        node.ies = ies
        emission = next(n for n in tree.nodes if n.type == "EMISSION")
        tree.links.new(node.outputs["Fac"], emission.inputs["Strength"])
    lamp = bpy.data.objects.new("lamp", data)
    # Cycles turns C from -y towards -x, and gamma = 0 is -z.
    axis, tangent = to_blender(light.axis), to_blender(light.tangent)
    turn = Matrix((-axis.cross(tangent), -tangent, -axis)).transposed().to_4x4()
    lamp.matrix_world = Matrix.Translation(to_blender(light.position)) @ turn
    lamp.visible_camera = False
    bpy.context.collection.objects.link(lamp)


def add_camera(path):
    with open(path) as file:
        pose = json.load(file)
    camera = bpy.data.objects.new("eye", bpy.data.cameras.new("eye"))
    eye, target, up = (to_blender(pose[k]) for k in ("position", "target", "up"))
    back = (eye - target).normalized()
    right = up.cross(back).normalized()
    turn = Matrix((right, back.cross(right), back)).transposed().to_4x4()
    camera.matrix_world = Matrix.Translation(eye) @ turn
    camera.data.sensor_fit = "VERTICAL"
    camera.data.angle_y = pose["fov_deg"] * 3.141592653589793 / 180
    camera.data.clip_start, camera.data.clip_end = 0.01, 1e5
    bpy.context.collection.objects.link(camera)
    bpy.context.scene.camera = camera


def set_up(width, height, threads, bounces, filter_width=1.0):
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.cycles.device = "CPU"
    scene.render.threads_mode, scene.render.threads = "FIXED", threads
    scene.render.resolution_x, scene.render.resolution_y, scene.render.resolution_percentage = width, height, 100
    scene.render.use_persistent_data = True  # the BVH is built once, and not timed
    scene.cycles.pixel_filter_type, scene.cycles.filter_width = "GAUSSIAN", 0.01
    scene.cycles.use_adaptive_sampling = scene.cycles.use_denoising = False
    scene.cycles.max_bounces = scene.cycles.diffuse_bounces = bounces  # as nightview counts them
    scene.cycles.sample_clamp_direct = scene.cycles.sample_clamp_indirect = 0
    scene.cycles.light_sampling_threshold = 0
    world = bpy.data.worlds.new("night")
    world.use_nodes = True
    world.node_tree.nodes["Background"].inputs["Strength"].default_value = 0
    scene.world = world
    image = scene.render.image_settings
    image.file_format, image.color_mode, image.color_depth = "OPEN_EXR", "RGB", "32"


def main(glb, camera, width, height, threads, bounces, out, *samples):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.import_scene.gltf(filepath=glb)
    for material in bpy.data.materials:
        if material.use_nodes:
            make_diffuse(material)
    for thing in bpy.data.objects:
        pass_light_through(thing)
    lights, profiles = city_lights.read(os.path.splitext(glb)[0] + ".lights")
    texts = []
    for i, profile in enumerate(profiles):
        texts.append(bpy.data.texts.new(f"profile {i}"))
        texts[-1].write(city_lights.as_ies(profile))
    off = city_lights.read_switched_off(os.path.splitext(glb)[0] + ".edits.json")
    for light in lights:
        if light.identity in off:
            continue
        if light.kind != 0:
            raise SystemExit("this comparison is of lamps: bake the scene without lit windows")
        add_lamp(light, texts[light.profile] if light.profile >= 0 else None)
    add_camera(camera)
    set_up(int(width), int(height), int(threads), int(bounces))
    scene = bpy.context.scene
    scene.cycles.samples = 1
    bpy.ops.render.render()  # builds the BVH
    for sample in samples:
        count, _, seed = sample.partition(":")
        scene.cycles.samples, scene.cycles.seed = int(count), int(seed or 0)
        scene.render.filepath = os.path.abspath(f"{out}-{sample.replace(':', '-')}.exr")
        start = time.process_time()
        bpy.ops.render.render(write_still=True)
        print(f"cycles {count} {time.process_time() - start:.3f}", flush=True)


main(*sys.argv[sys.argv.index("--") + 1:])
