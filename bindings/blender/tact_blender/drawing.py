"""What was found in the frame that is shown, drawn over the 3D view."""

import bpy
import gpu
import numpy as np
from gpu_extras.batch import batch_for_shader

from . import session

MEETING = (1.0, 0.1, 0.1, 0.55)
POINT = (1.0, 0.75, 0.2, 1.0)
NORMAL = (0.45, 0.85, 1.0, 1.0)
NORMAL_LENGTH = 0.02  # of the size of all that was checked

_handle = None


def _shader():
    return gpu.shader.from_builtin("UNIFORM_COLOR" if bpy.app.version >= (4, 0, 0) else "3D_UNIFORM_COLOR")


def shapes(found):
    """What is drawn: corners of triangles that meet, places of points, and the two ends of each normal."""
    triangles = [found.surfaces[body].positions[found.surfaces[body].facets[facets]].reshape(-1, 3) for body, facets in found.crossing.items()]
    ends = np.empty((0, 3))
    if len(found.gaps):
        all_corners = np.concatenate([surface.positions for surface in found.surfaces])
        reach = NORMAL_LENGTH * float(np.linalg.norm(np.ptp(all_corners, axis=0)))
        ends = np.stack([found.points_a, found.points_a + reach * found.normals], axis=1).reshape(-1, 3)
    return (np.concatenate(triangles) if triangles else np.empty((0, 3))), found.points_a, ends


def _draw():
    context = bpy.context
    found = session.found_now(context)
    if found is None or not context.window_manager.tact.shown:
        return
    shader = _shader()
    gpu.state.blend_set("ALPHA")
    gpu.state.point_size_set(6.0)
    gpu.state.line_width_set(1.5)
    for kind, places, color in zip(("TRIS", "POINTS", "LINES"), shapes(found), (MEETING, POINT, NORMAL)):
        if len(places):
            shader.bind()
            shader.uniform_float("color", color)
            batch_for_shader(shader, kind, {"pos": places.astype(np.float32)}).draw(shader)
    gpu.state.blend_set("NONE")


def register():
    global _handle
    if not bpy.app.background:
        _handle = bpy.types.SpaceView3D.draw_handler_add(_draw, (), "WINDOW", "POST_VIEW")


def unregister():
    global _handle
    if _handle is not None:
        bpy.types.SpaceView3D.draw_handler_remove(_handle, "WINDOW")
        _handle = None
