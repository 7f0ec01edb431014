"""What a frame of 100,000 facets costs in the add-on, beside the engine's time and Blender's own.

usage: PYTHONPATH=... blender -b --factory-startup --python tests/blender/measure_cost.py
Processor seconds of one thread, so that other programs do not count: median of some frames.
"""

import os
import pathlib
import statistics
import sys
import time

here = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(here.parents[1] / "bindings/blender"))
sys.path[:0] = os.environ.get("PYTHONPATH", "").split(":")  # Blender leaves it out

import bpy
import tact
import tact_blender
from tact_blender import checker, session, surfaces

FRAMES = 7
spent = {"engine": 0.0, "blender": 0.0}


def timed(part, call):
    def measured(*words, **more):
        began = time.process_time()
        try:
            return call(*words, **more)
        finally:
            spent[part] += time.process_time() - began

    return measured


class TimedWorld:
    def __init__(self, settings):
        self.world = timed("engine", tact.World)(settings)

    def __getattr__(self, name):
        found = getattr(self.world, name)
        return timed("engine", found) if name in ("add_body", "set_positions", "detect", "detect_motion") else found


class TimedTact:
    World = TimedWorld

    def __getattr__(self, name):
        return getattr(tact, name)


def scene():
    bpy.ops.wm.read_factory_settings(use_empty=True)
    tact_blender.register()
    bpy.ops.mesh.primitive_grid_add(x_subdivisions=158, y_subdivisions=158, size=2, location=(0, 0, 0.48))  # 50,000 triangles
    cloth = bpy.context.object
    cloth.tact.surface, cloth.tact.margin, cloth.tact.self_contact = "sheet", 0.004, True
    wave = cloth.modifiers.new("Wave", "WAVE")
    wave.height, wave.width, wave.narrowness = 0.05, 0.4, 4.0
    bpy.ops.mesh.primitive_uv_sphere_add(radius=0.5, segments=224, ring_count=113)  # 50,000 triangles
    ball = bpy.context.object
    for frame, height in ((1, 0.0), (FRAMES + 1, 0.05)):
        ball.location.z = height
        ball.keyframe_insert("location", frame=frame)
    return [cloth, ball]


def blenders_own(context, objects, frame):
    """Evaluation and triangulation, as the add-on needs them and no more."""
    context.scene.frame_set(frame)
    depsgraph = context.evaluated_depsgraph_get()
    for object in objects:
        evaluated = object.evaluated_get(depsgraph)
        mesh = evaluated.to_mesh()
        mesh.calc_loop_triangles()
        evaluated.to_mesh_clear()


objects = scene()
checker.tact = TimedTact()
run = session.Run(bpy.context, objects, threads=1)
rows = []
for frame in range(1, FRAMES + 1):
    began = time.process_time()
    blenders_own(bpy.context, objects, frame)
    own = time.process_time() - began
    bpy.context.scene.frame_set(0)
    spent["engine"] = 0.0
    began = time.process_time()
    found = run.step(frame)
    whole = time.process_time() - began
    rows.append((whole, spent["engine"], own))
facets = sum(len(surface.facets) for surface in found.surfaces)
first, later = rows[0], [statistics.median(column) for column in zip(*rows[1:])]
print(f"{facets} facets, {found.facet_pairs} pairs, {len(found.gaps)} points; ms of processor time")
for name, (whole, engine, own) in (("the first frame", first), ("a later frame", later)):
    print(f"{name}: {1e3 * whole:.1f}, engine {1e3 * engine:.1f}, Blender {1e3 * own:.1f}: {whole / (engine + own):.2f} x")
sys.stdout.flush()
os._exit(0)
