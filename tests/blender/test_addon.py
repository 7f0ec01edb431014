"""The add-on in Blender: what it finds is what the program finds in the same doubles, and files stay as they were."""

import json
import math
import os
import pathlib
import subprocess

import bpy
import numpy as np
import pytest
import tact_blender
from tact_blender import checker, session


@pytest.fixture(autouse=True)
def empty_file():
    bpy.ops.wm.read_factory_settings(use_empty=True)
    tact_blender.register()
    yield
    tact_blender.unregister()


def named(name):
    bpy.context.object.name = name
    return bpy.context.object


def ball(name, location=(0, 0, 0), **options):
    bpy.ops.mesh.primitive_uv_sphere_add(radius=0.5, segments=12, ring_count=8, location=location, **options)
    return named(name)


def cube(name, location=(0, 0, 0)):
    bpy.ops.mesh.primitive_cube_add(size=1, location=location)
    return named(name)


def select(*objects):
    bpy.ops.object.select_all(action="DESELECT")
    for object in objects:
        object.select_set(True)


def moves(object, *places):
    for frame, place in enumerate(places, 1):
        object.location = place
        object.keyframe_insert("location", frame=1 + 4 * (frame - 1))


def cloth_over_a_moving_ball():
    bpy.ops.mesh.primitive_grid_add(x_subdivisions=14, y_subdivisions=14, size=2, location=(0, 0, 0.7))
    cloth = named("cloth")
    modifier = cloth.modifiers.new("Cloth", "CLOTH")
    modifier.collision_settings.use_self_collision = True
    cloth.tact.surface, cloth.tact.margin, cloth.tact.self_contact = "sheet", 0.05, True
    falling = ball("ball")
    falling.modifiers.new("Collision", "COLLISION")
    moves(falling, (0, 0, 0), (0.2, 0, 0.4), (0.4, 0, 0.9))
    return ["cloth", "ball"], range(1, 10)


def garments_in_layers():
    for k, name in enumerate(("shirt", "vest", "coat")):
        bpy.ops.mesh.primitive_cylinder_add(radius=0.5 + 0.01 * k, vertices=20, end_fill_type="NOTHING")
        layer = named(name)
        layer.modifiers.new("Subdivision", "SUBSURF").subdivision_type = "SIMPLE"
        layer.tact.surface, layer.tact.margin = "sheet", 0.004
        for frame, wide in ((1, 1.0), (5, 1.04 - 0.02 * k)):  # what is worn inside grows through what is over it
            layer.scale = (wide, 1.0, 1.0)
            layer.keyframe_insert("scale", frame=frame)
    return ["shirt", "vest", "coat"], range(1, 6)


def arm_that_passes_its_body():
    bpy.ops.object.armature_add(location=(0.9, 0, 0))
    rig = named("rig")
    bpy.ops.mesh.primitive_cylinder_add(radius=0.15, depth=1.2, vertices=10, location=(0.9, 0, 0.6), end_fill_type="NGON")
    arm = named("arm")
    arm.vertex_groups.new(name="Bone").add(range(len(arm.data.vertices)), 1.0, "REPLACE")
    arm.modifiers.new("Armature", "ARMATURE").object = rig
    bone = rig.pose.bones["Bone"]
    bone.rotation_mode = "XYZ"
    for frame, angle in ((1, 0.6), (5, -1.2)):
        bone.rotation_euler = (0, 0, angle)
        bone.keyframe_insert("rotation_euler", frame=frame)
        bone.rotation_euler = (angle, 0, angle)
        bone.keyframe_insert("rotation_euler", frame=frame)
    ball("body", (0.5, 0.1, 0.5))
    return ["arm", "body"], range(1, 6)


def a_quad_that_bends():
    """Blender cuts it along one diagonal, then along the other: for tact it is one surface that moves."""
    mesh = bpy.data.meshes.new("quad")
    mesh.from_pydata([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)], [], [(0, 1, 2, 3)])
    quad = bpy.data.objects.new("quad", mesh)
    bpy.context.scene.collection.objects.link(quad)
    quad.shape_key_add(name="Basis")
    bent = quad.shape_key_add(name="bent")
    bent.data[1].co = (0.2, 0.7, 0.3)
    for frame, value in ((1, 0.0), (5, 1.0)):
        bent.value = value
        bent.keyframe_insert("value", frame=frame)
    quad.tact.surface = "sheet"
    ball("ball", (0.5, 0.5, 0.4))
    return ["quad", "ball"], range(1, 6)


def instances_scaled():
    group = bpy.data.collections.new("parts")
    bpy.context.scene.collection.children.link(group)
    bpy.ops.mesh.primitive_monkey_add(size=0.8)
    head = named("head")
    group.objects.link(head)
    bpy.context.scene.collection.objects.unlink(head)
    bpy.context.view_layer.layer_collection.children["parts"].exclude = True
    names = []
    for k in range(2):
        bpy.ops.object.collection_instance_add(collection="parts", location=(0.5 * k, 0, 0.3 * k), rotation=(0.3 * k, 0, 1 + k))
        placed = named(f"place{k}")
        placed.scale = (1, 2, 3) if k == 0 else (-1, 2, 3)
        names.append(placed.name)
    parent = cube("parent", (0.2, 0.1, 0))
    parent.scale = (1, 2, 3)
    child = ball("child")
    child.parent, child.rotation_euler = parent, (0.4, 0.5, 0.6)
    return [*names, "child"], range(1, 2)


SCENES = (cloth_over_a_moving_ball, garments_in_layers, arm_that_passes_its_body, a_quad_that_bends, instances_scaled)


def written(surface, path):
    lines = ["v " + " ".join(map(repr, row)) for row in surface.positions.tolist()]
    lines += ["f " + " ".join(str(v + 1) for v in row) for row in surface.facets.tolist()]
    path.write_text("\n".join(lines) + "\n")


@pytest.mark.parametrize("scene", SCENES, ids=lambda scene: scene.__name__)
def test_what_is_found_is_what_the_program_finds(scene, tmp_path, monkeypatch):
    names, frames = scene()
    seen, step = [], checker.Checker.step
    monkeypatch.setattr(checker.Checker, "step", lambda self, surfaces, **more: (seen.append(surfaces), step(self, surfaces, **more))[1])
    bpy.context.view_layer.update()
    found = tact_blender.check(names, frames=frames, points=True, impacts=True, threads=2, out=tmp_path / "found.json")
    assert found == json.loads((tmp_path / "found.json").read_text())
    assert all(np.array_equal(one.facets, same.facets) for surfaces in seen for one, same in zip(surfaces, seen[0]))
    words = []
    for body, surface in enumerate(seen[0]):
        (tmp_path / f"b{body}").mkdir()
        for frame, surfaces in enumerate(seen):
            written(surfaces[body], tmp_path / f"b{body}" / f"{frame}.obj")
        settings = surface.object.tact
        words += ["--sheet", f"b{body}"] if settings.surface == "sheet" else []
        words += ["--self", f"b{body}"] if settings.self_contact else []
        words += ["--margin", f"b{body}={settings.margin!r}"]
    meshes = [f"b{body}" for body in range(len(seen[0]))]
    command = [os.environ["TACT_PROGRAM"], "check", *meshes, *words, "--points", "--impacts", "--threads", "2", "--json", "-"]
    expected = json.loads(subprocess.run(command, cwd=tmp_path, check=True, capture_output=True, text=True).stdout)
    assert [{**body, "name": None} for body in found["bodies"]] == [{**body, "name": None} for body in expected["bodies"]]
    assert len(found["frames"]) == len(expected["frames"])
    for ours, theirs in zip(found["frames"], expected["frames"]):
        for part in ("hash", "pairs"):
            assert ours[part] == theirs[part], (part, ours["frame"])
        if ours["frame"] != frames[0]:
            assert (ours["impacts"], ours["first_time"]) == (theirs["impacts"], theirs["first_time"])
        assert ours["stats"].keys() == theirs["stats"].keys() and ours["times_ms"].keys() == theirs["times_ms"].keys()
    assert any(pair["facet_pairs"] or pair["points"] for frame in found["frames"] for pair in frame["pairs"])


def test_buttons_find_what_the_check_finds_and_the_list_leads_there():
    names, frames = arm_that_passes_its_body()
    found = tact_blender.check(names, frames=frames, points=True, out=os.devnull)
    scene, results = bpy.context.scene, bpy.context.window_manager.tact
    select(*(bpy.data.objects[name] for name in names))
    scene.frame_start, scene.frame_end, scene.tact.impacts = frames[0], frames[-1], True
    scene.frame_set(3)
    assert bpy.ops.tact.check_range() == {"FINISHED"} and scene.frame_current == 3
    listed = [(row.frame, row.facet_pairs, row.points) for row in results.frames]
    assert listed == [(frame["frame"], sum(len(pair["facet_pairs"]) for pair in frame["pairs"]), sum(len(pair["points"]) for pair in frame["pairs"])) for frame in found["frames"]]
    assert any(row.impacts for row in results.frames) and any("arm" in row.crossing for row in results.frames)
    results.active = 1
    assert scene.frame_current == results.frames[1].frame
    assert bpy.ops.tact.check_motion() == {"FINISHED"} and bpy.ops.tact.check_frame() == {"FINISHED"} and len(results.frames) == len(frames)


def test_a_file_changes_only_where_it_is_asked_for(tmp_path):
    first, second = cube("box"), ball("ball", (0.5, 0.2, 0.1))
    second.tact.margin, second.tact.surface = 0.25, "sheet"
    select(first, second)

    def state():
        def plain(data):
            return [tuple(v.co) for v in data.vertices], [tuple(p.vertices) for p in data.polygons], [p.select for p in data.polygons]

        return {object.name: (object.tact.margin, object.tact.surface, tuple(map(tuple, object.matrix_world)), plain(object.data), [a for a in object.data.attributes.keys() if a.startswith("tact")], object.data.shape_keys) for object in bpy.data.objects}

    before = state()
    assert bpy.ops.tact.check_frame() == {"FINISHED"}
    assert state() == before
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "kept.blend"))
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "kept.blend"))
    assert state() == before
    assert not session.found_in and not bpy.ops.tact.write_attributes.poll()
    select(*bpy.data.objects)
    bpy.ops.tact.check_frame()
    assert bpy.ops.tact.write_attributes() == bpy.ops.tact.select_crossing() == {"FINISHED"}
    found = session.found_now(bpy.context)
    for body, surface in enumerate(found.surfaces):
        mesh = surface.object.data
        crossing, gaps = np.empty(len(mesh.polygons), bool), np.empty(len(mesh.vertices), np.float32)
        mesh.attributes["tact_crossing"].data.foreach_get("value", crossing)
        mesh.attributes["tact_gap"].data.foreach_get("value", gaps)
        faces = set(surface.polygons[found.crossing[body]].tolist())
        assert set(np.flatnonzero(crossing)) == faces == {p.index for p in mesh.polygons if p.select} and faces
        assert np.array_equal(gaps, found.nearest[body].astype(np.float32)) and gaps.min() < 0
    bpy.ops.tact.write_attributes()  # in place of those of before
    assert [name for name in mesh.attributes.keys() if name.startswith("tact")] == ["tact_gap", "tact_crossing"]


def test_untangling_ends_crossings_in_a_shape_key():
    still, moved = cube("box"), ball("ball", (0, 0, 0.9))
    places = [tuple(v.co) for v in moved.data.vertices]
    bpy.context.scene.tact.source = "collection"
    bpy.context.scene.tact.collection = bpy.context.scene.collection
    select(moved)
    assert bpy.ops.tact.untangle(passes=20) == {"FINISHED"}
    assert session.found_now(bpy.context).facet_pairs == 0
    keys = moved.data.shape_keys.key_blocks
    assert keys.keys() == ["Basis", "tact untangled"] and still.data.shape_keys is None
    assert [tuple(point.co) for point in keys["Basis"].data] == places
    assert max(math.dist(point.co, place) for point, place in zip(keys[1].data, places)) < 0.4


def refused(says, call):
    with pytest.raises((RuntimeError, ValueError), match=says):
        call()


def test_trouble_is_told_in_blenders_way(tmp_path):
    box = cube("box")
    select()
    refused("no object is selected", bpy.ops.tact.check_frame)
    bpy.context.scene.tact.source = "collection"
    refused("choose the collection", bpy.ops.tact.check_range)
    refused("no object called lost", lambda: tact_blender.check(["lost"]))
    refused("no collection is called lost", lambda: tact_blender.check(collection="lost"))
    bpy.context.scene.tact.source = "selected"
    bpy.ops.object.light_add()
    refused("has no surface", bpy.ops.tact.check_frame)
    bpy.context.object.select_set(False)
    empty = bpy.data.objects.new("points", bpy.data.meshes.new("points"))
    empty.data.from_pydata([(0, 0, 0)], [], [])
    bpy.context.scene.collection.objects.link(empty)
    select(empty)
    refused("points has no faces", bpy.ops.tact.check_frame)
    select(box)
    box.hide_set(True)
    refused("box is hidden", lambda: tact_blender.check(["box"]))
    box.hide_set(False)
    box.data.vertices[0].co.x = math.nan
    bpy.context.view_layer.update()
    refused("body 'box': vertex 0 has x", lambda: tact_blender.check(["box"]))


def test_what_is_gone_or_linked_is_told(tmp_path):
    box, other = cube("box"), ball("ball", (0.5, 0, 0))
    run = session.Run(bpy.context, [box, other])
    found = run.step()
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "library.blend"), copy=True)
    bpy.data.objects.remove(other)
    with pytest.raises(session.Trouble, match="ball is gone"):
        run.step()
    assert tact_blender.changes.write_attributes(found) == (1, ["ball is gone"])
    with bpy.data.libraries.load(str(tmp_path / "library.blend"), link=True) as (there, here):
        here.objects = ["ball"]
    bpy.context.scene.collection.objects.link(here.objects[0])
    bpy.context.view_layer.update()
    found = session.Run(bpy.context, [box, here.objects[0]]).step()
    assert found.facet_pairs > 0
    assert tact_blender.changes.write_attributes(found) == (1, ["ball is linked from another file"])


def test_faces_that_change_from_frame_to_frame_are_told():
    names, _ = arm_that_passes_its_body()
    modifier = bpy.data.objects["body"].modifiers.new("Subdivision", "SUBSURF")
    for frame, levels in ((1, 0), (2, 1)):
        modifier.levels = levels
        modifier.keyframe_insert("levels", frame=frame)
    run = session.Run(bpy.context, [bpy.data.objects[name] for name in names])
    told = [(run.step(frame).restarted, len(run.told)) for frame in (1, 2, 3)]
    assert told == [(False, 0), (True, 1), (False, 0)]


def test_the_zip_holds_the_addon(tmp_path):
    project = pathlib.Path(__file__).resolve().parents[2]
    subprocess.run([project / "bindings/blender/make_zip.sh", tmp_path / "addon.zip"], check=True, capture_output=True)
    listed = subprocess.run(["python3", "-m", "zipfile", "-l", tmp_path / "addon.zip"], check=True, capture_output=True, text=True).stdout
    assert all(f"tact_blender/{path.name}" in listed for path in (project / "bindings/blender/tact_blender").glob("*.py"))
