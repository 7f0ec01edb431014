"""What users set, which the file keeps, and the list of frames, which it does not."""

import bpy
from bpy.props import BoolProperty, CollectionProperty, EnumProperty, FloatProperty, IntProperty, PointerProperty, StringProperty


class TactObject(bpy.types.PropertyGroup):
    """What an object is to tact."""

    surface: EnumProperty(
        name="Surface",
        items=[("closed", "Closed", "The surface of a solid, with an inside"), ("sheet", "Sheet", "Cloth: no inside, both sides count")],
    )
    margin: FloatProperty(name="Margin", description="How far ahead of the surface contact points are seen", unit="LENGTH", min=0.0, precision=4)
    self_contact: BoolProperty(name="Self-Contact", description="Checks the object against itself")


class TactScene(bpy.types.PropertyGroup):
    """What is checked, and how."""

    source: EnumProperty(
        name="Check",
        items=[("selected", "Selected", "The objects that are selected"), ("collection", "Collection", "All objects of a collection")],
    )
    collection: PointerProperty(name="Collection", type=bpy.types.Collection)
    accuracy: EnumProperty(
        name="Accuracy",
        items=[("exact", "Exact", "Every pair of faces that meets and no other"), ("paper", "Paper", "After three criteria; may miss pairs"), ("hulls", "Hulls", "Convex hulls alone")],
    )
    impacts: BoolProperty(name="Between Frames", description="Finds what meets on the way from a frame to the next, every vertex moving straight")


class TactFrame(bpy.types.PropertyGroup):
    """What was found in a frame."""

    frame: IntProperty()
    facet_pairs: IntProperty()
    self_pairs: IntProperty()
    points: IntProperty()
    least_gap: FloatProperty()
    impacts: IntProperty()
    first_time: FloatProperty()
    crossing: StringProperty()
    told: StringProperty()


def _go_there(results, context):
    if 0 <= results.active < len(results.frames):
        context.scene.frame_set(results.frames[results.active].frame)


class TactResults(bpy.types.PropertyGroup):
    """The list of frames, of this session."""

    frames: CollectionProperty(type=TactFrame)
    active: IntProperty(update=_go_there)
    shown: BoolProperty(name="Show in View", description="Draws faces that meet, contact points and normals over the view", default=True)


CLASSES = (TactObject, TactScene, TactFrame, TactResults)


def register():
    for one in CLASSES:
        bpy.utils.register_class(one)
    bpy.types.Object.tact = PointerProperty(type=TactObject)
    bpy.types.Scene.tact = PointerProperty(type=TactScene)
    bpy.types.WindowManager.tact = PointerProperty(type=TactResults)


def unregister():
    del bpy.types.WindowManager.tact, bpy.types.Scene.tact, bpy.types.Object.tact
    for one in reversed(CLASSES):
        bpy.utils.unregister_class(one)
