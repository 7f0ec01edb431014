"""Looks at the add-on in Blender's window, and keeps a picture of it; check_window.sh starts it.

Undo takes back what an operator changed, Esc ends the check of a range, and what was found until then stays in the list.
"""

import os
import pathlib
import sys
import traceback

here = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(here.parents[1] / "bindings/blender"))
sys.path[:0] = os.environ.get("PYTHONPATH", "").split(":")  # Blender leaves it out

import bpy
import tact_blender

PICTURE = os.environ["TACT_PICTURE"]


def view():
    window = bpy.context.window_manager.windows[0]
    area = next(area for area in window.screen.areas if area.type == "VIEW_3D")
    return {"window": window, "screen": window.screen, "area": area, "region": next(region for region in area.regions if region.type == "WINDOW")}


def begin():
    bpy.ops.wm.read_factory_settings(use_empty=True)
    return scene, 1.0


def scene():
    tact_blender.register()
    context = bpy.context.scene
    context.frame_start, context.frame_end = 1, 12
    with bpy.context.temp_override(**view()):
        bpy.ops.mesh.primitive_uv_sphere_add(radius=0.5, segments=32, ring_count=16)
        ball = bpy.context.object
        bpy.ops.mesh.primitive_grid_add(x_subdivisions=40, y_subdivisions=40, size=2, location=(0, 0, 0.62))
        cloth = bpy.context.object
        ball.name, cloth.name = "ball", "cloth"
        cloth.tact.surface, cloth.tact.margin, cloth.tact.self_contact = "sheet", 0.02, True
        for frame, height in ((1, 0.0), (12, 0.35)):
            ball.location = (0.1, 0, height)
            ball.keyframe_insert("location", frame=frame)
        bpy.ops.object.select_all(action="SELECT")
        bpy.ops.view3d.view_selected()
    space = view()["area"].spaces[0]
    space.show_region_ui = True
    space.region_3d.view_perspective = "PERSP"
    return check, 1.0


def check():
    bpy.context.scene.tact.impacts = True
    with bpy.context.temp_override(**view()):
        assert bpy.ops.tact.check_range("EXEC_DEFAULT") == {"FINISHED"}
        bpy.context.scene.frame_set(8)
        assert bpy.ops.tact.check_frame() == {"FINISHED"}
        bpy.ops.view3d.view_selected()
    assert len(bpy.context.window_manager.tact.frames) == 12
    return choose_tab, 1.0


def choose_tab():
    """A click on the fourth tab of the sidebar, where Blender 3.4 draws it."""
    window = bpy.context.window_manager.windows[0]
    sidebar = next(region for region in view()["area"].regions if region.type == "UI")
    place = {"x": sidebar.x + sidebar.width - 10, "y": window.height - 240}
    for kind, value in (("MOUSEMOVE", "NOTHING"), ("LEFTMOUSE", "PRESS"), ("LEFTMOUSE", "RELEASE")):
        window.event_simulate(type=kind, value=value, **place)
    return picture, 3.0


def picture():
    with bpy.context.temp_override(**view()):
        bpy.ops.screen.screenshot(filepath=PICTURE)
    return undo, 0.5


def undo():
    mesh = bpy.data.objects["cloth"].data
    with bpy.context.temp_override(**view()):
        bpy.ops.ed.undo_push(message="before")
        assert bpy.ops.tact.write_attributes("EXEC_DEFAULT") == {"FINISHED"} and "tact_gap" in mesh.attributes
        bpy.ops.ed.undo_push(message="Write Attributes")
        assert bpy.ops.ed.undo() == {"FINISHED"}
    assert "tact_gap" not in bpy.data.objects["cloth"].data.attributes
    assert tact_blender.session.found_now(bpy.context) is not None
    return start_range, 0.5


def start_range():
    bpy.context.scene.frame_end = 5000
    with bpy.context.temp_override(**view()):
        assert bpy.ops.tact.check_range("INVOKE_DEFAULT") == {"RUNNING_MODAL"}
    return wait_for_some, 1.0


def wait_for_some():
    if len(bpy.context.window_manager.tact.frames) < 3:
        return wait_for_some, 0.5
    for value in ("PRESS", "RELEASE"):
        bpy.context.window_manager.windows[0].event_simulate(type="ESC", value=value, x=400, y=300)
    return wait_for_end, 1.0


waited = [0]


def wait_for_end():
    """After Esc the frame is that of before, and the list does not grow."""
    waited[0] += 1
    assert waited[0] < 60, "Esc did not end the range"
    if bpy.context.scene.frame_current != 8:
        return wait_for_end, 0.5
    found = len(bpy.context.window_manager.tact.frames)
    assert 3 <= found < 5000
    print(f"Esc ended the range after {found} frames")
    return None


def run(step):
    def call():
        try:
            following = step()
            if following is None:
                sys.stdout.flush()
                os._exit(0)
            bpy.app.timers.register(run(following[0]), first_interval=following[1])
        except BaseException:
            traceback.print_exc()
            sys.stderr.flush()
            os._exit(1)

    return call


bpy.app.timers.register(run(begin), first_interval=0.5)
