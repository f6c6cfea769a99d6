"""Answers an export of Gnomon with Blender, and hands the masks back.

    blender -b --factory-startup -P blender.py -- EXPORT OUT [--pictures]

EXPORT  the folder that `gnomon export` wrote
OUT     gets masks/VIEW_LIGHT.png, a mask for every view and light: white is lit, black is shadowed,
        grey (128) has no sample. Rays of Blender's BVH start at the exported samples.
--pictures  Cycles renders the displaced mesh from every camera as well: drawn/VIEW_LIGHT.png, the mask
        of what its own primary rays meet (compare it with EXPORT/drawn/masks), and the picture that
        it comes from, pictures/VIEW_LIGHT.png.

Then: gnomon compare OUT/masks EXPORT/masks
      gnomon compare OUT/drawn EXPORT/drawn/masks
"""

import json
import pathlib
import struct
import sys
import time
import zlib

import bpy
import numpy as np
from mathutils import Matrix, Vector
from mathutils.bvhtree import BVHTree

LIT, SHADOWED, NO_SAMPLE = 255, 0, 128


def read_ply(file):
    """Vertices (n, 3) float32 and triangles (m, 3) int32. Blender's own reader takes minutes."""
    data = file.read_bytes()
    begin = data.index(b"end_header\n") + len(b"end_header\n")
    header = data[:begin].decode().split("\n")
    order = "<" if "format binary_little_endian 1.0" in header else ">"
    counts = {line.split()[1]: int(line.split()[2]) for line in header if line.startswith("element")}
    vertices = np.frombuffer(data, order + "f4", 3 * counts["vertex"], begin).reshape(-1, 3)
    face = np.dtype([("corners", "u1"), ("vertices", order + "i4", 3)])
    faces = np.frombuffer(data, face, counts["face"], begin + vertices.nbytes)
    return vertices.astype(np.float32), faces["vertices"].astype(np.int32)


def write_grey(file, grey):
    """An 8-bit PNG, row 0 at the top: Blender's own writer would change the values by its colours."""
    height, width = grey.shape
    rows = np.hstack([np.zeros((height, 1), np.uint8), grey.astype(np.uint8)]).tobytes()

    def chunk(kind, body):
        return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))

    file.parent.mkdir(parents=True, exist_ok=True)
    head = struct.pack(">IIBBBBB", width, height, 8, 0, 0, 0, 0)
    file.write_bytes(
        b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(rows, 6))
        + chunk(b"IEND", b"")
    )


def answer(tree, point, light, lift):
    """Whether the light reaches a point of the truth's surface: LIT or SHADOWED.

    The ray starts on Blender's own mesh, at the nearest point, lifted off that triangle. The truth's
    point lies a little above or below this mesh: from there a ray would meet the mesh at once, or
    miss what it should meet.
    """
    place, normal, _, _ = tree.find_nearest(Vector(point))
    if normal.dot(light) <= 0:
        return SHADOWED
    return LIT if tree.ray_cast(place + lift * normal, light)[0] is None else SHADOWED


def trace(tree, samples, order, light, lift):
    """The mask of one view under one light."""
    first = order.index("point.X")
    points = samples[..., first : first + 3]
    mask = np.full(samples.shape[:2], NO_SAMPLE, np.uint8)
    for place in np.argwhere(samples[..., order.index("face")] >= 0):
        mask[tuple(place)] = answer(tree, points[tuple(place)], light, lift)
    return mask


def make_object(vertices, triangles):
    """The mesh as a white object without the tricks by which Cycles softens its shadows."""
    mesh = bpy.data.meshes.new("displaced")
    mesh.vertices.add(len(vertices))
    mesh.vertices.foreach_set("co", vertices.ravel())
    mesh.loops.add(triangles.size)
    mesh.loops.foreach_set("vertex_index", triangles.ravel())
    mesh.polygons.add(len(triangles))
    mesh.polygons.foreach_set("loop_start", np.arange(0, triangles.size, 3, dtype=np.int32))
    mesh.polygons.foreach_set("loop_total", np.full(len(triangles), 3, np.int32))
    mesh.update(calc_edges=True)
    white = bpy.data.materials.new("white")
    white.use_nodes = True
    nodes = white.node_tree.nodes
    nodes.clear()
    diffuse = nodes.new("ShaderNodeBsdfDiffuse")
    diffuse.inputs["Color"].default_value = (1, 1, 1, 1)
    output = nodes.new("ShaderNodeOutputMaterial")
    white.node_tree.links.new(diffuse.outputs[0], output.inputs["Surface"])
    mesh.materials.append(white)
    made = bpy.data.objects.new("displaced", mesh)
    made.cycles.shadow_terminator_offset = 0
    made.cycles.shadow_terminator_geometry_offset = 0
    bpy.context.collection.objects.link(made)


def prepare_cycles():
    """One ray a pixel through its centre, light from the sun alone."""
    scene = bpy.context.scene
    for thing in list(bpy.data.objects):
        bpy.data.objects.remove(thing)
    scene.world = bpy.data.worlds.new("dark")
    scene.world.color = (0, 0, 0)
    scene.render.engine = "CYCLES"
    scene.cycles.device = "CPU"
    scene.cycles.samples = 1
    scene.cycles.use_adaptive_sampling = False
    scene.cycles.use_denoising = False
    scene.cycles.max_bounces = 0
    scene.cycles.light_sampling_threshold = 0
    scene.cycles.pixel_filter_type = "BOX"
    scene.cycles.filter_width = 0.01
    scene.render.film_transparent = True
    scene.view_settings.view_transform = "Standard"


def add_camera(view):
    about = view["camera"]
    data = bpy.data.cameras.new(view["name"])
    data.sensor_fit = "VERTICAL"
    data.angle = np.radians(about["vertical_fov_degrees"])
    distance = (Vector(about["eye"]) - Vector(about["target"])).length
    data.clip_start, data.clip_end = 1e-4 * distance, 1e4 * distance
    camera = bpy.data.objects.new(view["name"], data)
    camera.matrix_world = Matrix(about["view"]).inverted()
    bpy.context.collection.objects.link(camera)
    scene = bpy.context.scene
    scene.camera = camera
    scene.render.resolution_x, scene.render.resolution_y = view["width"], view["height"]
    scene.render.resolution_percentage = 100


def add_sun(direction):
    data = bpy.data.lights.new("sun", "SUN")
    data.angle = 0
    data.energy = 3
    sun = bpy.data.objects.new("sun", data)
    sun.rotation_mode = "QUATERNION"
    sun.rotation_quaternion = direction.to_track_quat("Z", "Y")
    bpy.context.collection.objects.link(sun)
    return sun


def render(out, name):
    """Renders the scene into a picture; the mask of what it shows."""
    scene = bpy.context.scene
    settings = scene.render.image_settings
    settings.file_format, settings.color_mode, settings.color_depth = "OPEN_EXR", "RGBA", "32"
    file = out / "pictures" / (name + ".exr")
    scene.render.filepath = str(file)
    bpy.ops.render.render(write_still=True)
    image = bpy.data.images.load(str(file))
    image.colorspace_settings.name = "Non-Color"
    pixels = np.empty(4 * image.size[0] * image.size[1], np.float32)
    image.pixels.foreach_get(pixels)
    pixels = pixels.reshape(image.size[1], image.size[0], 4)[::-1]  # Blender's row 0 is the lowest
    bpy.data.images.remove(image)
    file.unlink()
    seen, light = pixels[..., 3] > 0.5, pixels[..., 0]
    write_grey(out / "pictures" / (name + ".png"),
               np.where(seen, 255 * np.clip(light, 0, 1) ** (1 / 2.2), 64).round())
    return np.where(seen, np.where(light > 0, LIT, SHADOWED), NO_SAMPLE)


def complete(mask, drawn, tree, light, lift):
    """At an outline a ray of Cycles may just miss what the truth's ray just meets: the BVH answers
    there. What only Cycles meets is left out."""
    seen = drawn[..., 3:6].any(axis=2)
    missed = np.argwhere(seen & (mask == NO_SAMPLE))
    for place in missed:
        mask[tuple(place)] = answer(tree, drawn[tuple(place)][:3], light, lift)
    print(f"drawn: {seen.sum()} points, of which Cycles misses {len(missed)}")
    return np.where(seen, mask, NO_SAMPLE)


def names_of(view):
    """What the masks of a view are called: as the truth's, without their ending."""
    return [pathlib.Path(mask["truth"]).stem[: -len("_truth")] for mask in view["masks"]]


def main():
    arguments = sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else []
    pictures = "--pictures" in arguments
    folders = [pathlib.Path(text) for text in arguments if text != "--pictures"]
    if len(folders) != 2:
        sys.exit(__doc__)
    export, out = folders
    about = json.loads((export / "export.json").read_text())
    for light in about["lights"]:
        if light.get("radius_degrees", 0) > 0:
            sys.exit(f"light \"{light['name']}\": a disc found, a point expected: masks are hard here")
    lights = [Vector(light["direction"]) for light in about["lights"]]
    vertices, triangles = read_ply(export / about["displaced_mesh"]["file"])
    start = time.monotonic()
    tree = BVHTree.FromPolygons(vertices.tolist(), triangles.tolist(), all_triangles=True)
    print(f"{len(triangles)} triangles, BVH in {time.monotonic() - start:.1f} s")
    for view in about["views"]:
        start = time.monotonic()
        samples = np.load(export / view["samples_npy"])
        for name, light in zip(names_of(view), lights):
            mask = trace(tree, samples, about["channel_order"], light, about["ray_lift"])
            write_grey(out / "masks" / (name + ".png"), mask)
        print(f"{view['name']}: {len(lights)} masks in {time.monotonic() - start:.1f} s")
    if not pictures:
        return
    prepare_cycles()
    make_object(vertices, triangles)
    for view in about["views"]:
        if view["type"] != "camera":
            continue
        add_camera(view)
        drawn = np.load(export / view["drawn"]["samples_npy"])
        for name, light in zip(names_of(view), lights):
            sun = add_sun(light)
            mask = complete(render(out, name), drawn, tree, light, about["ray_lift"])
            write_grey(out / "drawn" / (name + ".png"), mask)
            bpy.data.objects.remove(sun)


try:
    main()
except Exception as error:  # Blender itself would go on, and end with 0
    sys.exit(f"blender.py: {type(error).__name__}: {error}")
