"""tact in Blender: in which frames, where and how deep surfaces cross.

Without a window: blender -b FILE --python-expr 'import tact_blender; tact_blender.check()'
"""

bl_info = {
    "name": "tact: contacts between surfaces",
    "description": "In which frames, where and how deep surfaces cross",
    "author": "the authors of tact",
    "version": (0, 1, 0),
    "blender": (3, 4, 0),
    "location": "3D View > Sidebar > tact",
    "category": "Mesh",
}

from .headless import check  # noqa: E402, F401


def _forget(_=None):
    from . import session

    session.found_in.clear()


def register():
    import bpy

    from . import drawing, operators, panel, properties

    bpy.app.handlers.load_post.append(bpy.app.handlers.persistent(_forget))

    for part in (properties, operators, panel, drawing):
        part.register()


def unregister():
    import bpy

    from . import drawing, operators, panel, properties

    bpy.app.handlers.load_post.remove(_forget)
    for part in (drawing, panel, operators, properties):
        part.unregister()
    _forget()
